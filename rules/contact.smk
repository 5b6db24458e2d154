# Repulsive boundary-element contact: one job per case and seed walks the whole load path, another
# one walks it for many more seeds on a coarse grid, then all of these give the case's means.
# A case that asks for an accuracy draws its seeds in rounds, each assessed before the next is known.
# Surfaces that theory alone is compared with take one job for all of it.


rule solve_repulsive:
    input:
        library=library_of("contact/solve_repulsive.py"),
        surface=surface_of,
    output:
        f"{RESULTS}/contact/{{case}}/seed{{seed}}.nc",
    log:
        f"{LOGS}/solve_repulsive/{{case}}/seed{{seed}}.log",
    benchmark:
        f"{BENCHMARKS}/solve_repulsive/{{case}}/seed{{seed}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory_of("solve_repulsive"),
        runtime=runtime_of("solve_repulsive"),
    params:
        pressures=lambda wildcards: PLANS[wildcards.case].pressures,
        tolerance=lambda wildcards: PLANS[wildcards.case].settings.tolerance,
        pixels_per_wavelength=lambda wildcards: (
            PLANS[wildcards.case].settings.pixels_per_wavelength
        ),
        gaps=gaps_of,
    script:
        "../scripts/contact/solve_repulsive.py"


rule solve_coarse:
    input:
        library=library_of("contact/solve_coarse.py"),
    output:
        f"{RESULTS}/contact/{{case}}/coarse{{part}}.nc",
    log:
        f"{LOGS}/solve_coarse/{{case}}{{part}}.log",
    benchmark:
        f"{BENCHMARKS}/solve_coarse/{{case}}{{part}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory_of("solve_coarse"),
        runtime=runtime_of("solve_coarse"),
    params:
        surface=lambda wildcards: config["model_surfaces"][CASES[wildcards.case]["surface"]],
        pressures=lambda wildcards: PLANS[wildcards.case].pressures,
        tolerance=lambda wildcards: PLANS[wildcards.case].settings.tolerance,
        gaps=gaps_of,
        seeds=lambda wildcards: coarse_range(wildcards).stop,
        after=lambda wildcards: coarse_range(wildcards).start,
        descriptor_seeds=config["sampling"]["descriptor_seeds"],
    script:
        "../scripts/contact/solve_coarse.py"


checkpoint assess_seeds:
    input:
        library=library_of("contact/assess_seeds.py"),
        realisations=lambda wildcards: realisations_of(*in_round(wildcards)),
        coarse=lambda wildcards: coarse_files(*in_round(wildcards)),
        laws=config["tradeoff"]["table"],
    output:
        f"{RESULTS}/draws/{{case}}/round{{round}}.nc",
    log:
        f"{LOGS}/assess_seeds/{{case}}/round{{round}}.log",
    benchmark:
        f"{BENCHMARKS}/assess_seeds/{{case}}/round{{round}}.tsv"
    wildcard_constraints:
        case="|".join(map(re.escape, DRAWN)) or "none",
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=1000,
    params:
        settings=lambda wildcards: asdict(PLANS[wildcards.case].settings),
        asked=lambda wildcards: asdict(PLANS[wildcards.case].asked),
        windows=config["a_v"]["windows"][:1],
    script:
        "../scripts/contact/assess_seeds.py"


rule contact_maps:
    input:
        library=library_of("contact/contact_maps.py"),
        surface=lambda wildcards: surface_of(wildcards).format(seed=1),
    output:
        f"{RESULTS}/contact/{{case}}/maps.nc",
    log:
        f"{LOGS}/contact_maps/{{case}}.log",
    benchmark:
        f"{BENCHMARKS}/contact_maps/{{case}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory_of("contact_maps"),
        runtime=runtime_of("contact_maps"),
    params:
        pressures=lambda wildcards: CASES[wildcards.case].get("maps", []),
        tolerance=lambda wildcards: PLANS[wildcards.case].settings.tolerance,
    script:
        "../scripts/contact/contact_maps.py"


rule average_ensemble:
    input:
        library=library_of("contact/average_ensemble.py"),
        laws=config["tradeoff"]["table"],
        realisations=realisations,
        coarse=coarse_solutions,
    output:
        f"{RESULTS}/contact/ensembles/{{case}}.nc",
    log:
        f"{LOGS}/average_ensemble/{{case}}.log",
    benchmark:
        f"{BENCHMARKS}/average_ensemble/{{case}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=1000,
    params:
        pressures=lambda wildcards: PLANS[wildcards.case].pressures,
        quantities=lambda wildcards: PLANS[wildcards.case].quantities,
    script:
        "../scripts/contact/average_ensemble.py"


rule solve_ensemble:
    input:
        library=library_of("contact/solve_ensemble.py"),
        laws=config["tradeoff"]["table"],
    output:
        f"{RESULTS}/contact/ensembles/{{comparison}}.nc",
    log:
        f"{LOGS}/solve_ensemble/{{comparison}}.log",
    benchmark:
        f"{BENCHMARKS}/solve_ensemble/{{comparison}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory_of("solve_ensemble"),
        runtime=runtime_of("solve_ensemble"),
    params:
        surface=lambda wildcards: COMPARED[wildcards.comparison][0],
        pressures=config["comparisons"]["pressures"],
        seeds=lambda wildcards: COMPARISONS[wildcards.comparison]["seeds"],
        coarse_seeds=lambda wildcards: COMPARISONS[wildcards.comparison].get("coarse_seeds", 0),
        descriptor_seeds=config["sampling"]["descriptor_seeds"],
        tolerance=FIDELITY["tolerance"],
        pixels_per_wavelength=lambda wildcards: min(
            COMPARISONS[wildcards.comparison].get("pixels_per_wavelength", 10**9),
            FIDELITY["pixels_per_wavelength"],
        ),
        gaps=config["gaps"],
    script:
        "../scripts/contact/solve_ensemble.py"
