# Contact without adhesion, by boundary elements. A job walks the whole load path of a few seeds of a
# case, others walk it for many more on a coarse grid; together they give the means and the slope of
# area against load. A surface with which theory alone is compared takes one job.


def realisations(wildcards):
    """Fine solutions of a case, which an earlier case on the same surface may hold."""
    solved_by = PLANS[wildcards.case].solved_by
    parts = plan.batches_covering(len(seeds_of(wildcards.case)), among=len(seeds_of(solved_by)))
    return [f"{RESULTS}/contact/{solved_by}/seeds{part}.nc" for part in parts]


def coarse_solutions(wildcards):
    """Coarse solutions behind a case's means, shared likewise; none for plain means."""
    planned = PLANS[wildcards.case]
    parts = plan.coarse_batches(planned.settings.coarse_seeds)
    return [f"{RESULTS}/contact/{planned.solved_by}/coarse{part}.nc" for part in parts]


def measured_of(wildcards):
    """Quantities of single solutions that a case asks for beyond areas and mean gaps."""
    return list(PLANS[wildcards.case].measured)


def solutions(wildcards):
    """Solutions in a file of fine or coarse seeds."""
    return len(plan.seeds_in(wildcards.part)) * len(pressures_of(wildcards.case))


def gaps_of(wildcards):
    """Ranges at which a case's attractive areas are taken; none if it does not want any."""
    return GAPS if PLANS[wildcards.case].gaps else None


def comparison_pixels(wildcards):
    """Grid points per shortest wavelength of a comparison: its own at most."""
    preset = FIDELITY["pixels_per_wavelength"]
    most = COMPARISONS[wildcards.comparison]["pixels_per_wavelength"]
    return preset if most is None else min(most, preset)


def comparison_solutions(wildcards):
    """Fine solutions of a comparison, and its coarse ones by what they cost beside these."""
    comparison = COMPARISONS[wildcards.comparison]
    coarse = comparison["coarse_seeds"] * (2 / comparison_pixels(wildcards)) ** 2
    return (comparison["seeds"] + coarse) * len(config["comparisons"]["pressures"])


rule solve_repulsive:
    input:
        surfaces=lambda wildcards: surfaces_of(wildcards.case, wildcards.part),
    output:
        f"{RESULTS}/contact/{{case}}/seeds{{part}}.nc",
    log:
        f"{RESULTS}/logs/solve_repulsive/contact/{{case}}/seeds{{part}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/solve_repulsive/contact/{{case}}/seeds{{part}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory(17 + plan.SEEDS_A_FILE, case_size),
        runtime=minutes(1.1, case_size, solutions),
    params:
        seeds=lambda wildcards: plan.seeds_in(wildcards.part),
        pressures=lambda wildcards: pressures_of(wildcards.case),
        tolerance=lambda wildcards: PLANS[wildcards.case].settings.tolerance,
        pixels_per_wavelength=lambda wildcards: pixels_of_case(wildcards.case),
        gaps=gaps_of,
        measured=measured_of,
        code=source_hash("contact/solve_repulsive.py"),
    message:
        "Solve contact without adhesion: {wildcards.case}, seeds {wildcards.part}"
    script:
        "../scripts/contact/solve_repulsive.py"


rule solve_coarse:
    output:
        f"{RESULTS}/contact/{{case}}/coarse{{part}}.nc",
    log:
        f"{RESULTS}/logs/solve_coarse/contact/{{case}}/coarse{{part}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/solve_coarse/contact/{{case}}/coarse{{part}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory(4 * 14, coarse_size),
        runtime=minutes(1.1, coarse_size, solutions),
    params:
        surface=lambda wildcards: model_surface_of(wildcards.case),
        pressures=lambda wildcards: pressures_of(wildcards.case),
        tolerance=lambda wildcards: PLANS[wildcards.case].settings.tolerance,
        gaps=gaps_of,
        measured=measured_of,
        after=lambda wildcards: plan.seeds_in(wildcards.part)[0] - 1,
        seeds=lambda wildcards: plan.seeds_in(wildcards.part)[-1],
        descriptor_seeds=config["sampling"]["descriptor_seeds"],
        code=source_hash("contact/solve_coarse.py"),
    message:
        "Solve contact without adhesion on a coarse grid: {wildcards.case}, seeds {wildcards.part}"
    script:
        "../scripts/contact/solve_coarse.py"


rule contact_maps:
    input:
        surfaces=lambda wildcards: surfaces_of(wildcards.case),
    output:
        f"{RESULTS}/contact/{{case}}/maps.nc",
    log:
        f"{RESULTS}/logs/contact_maps/contact/{{case}}/maps.log",
    benchmark:
        f"{RESULTS}/benchmarks/contact_maps/contact/{{case}}/maps.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory(22 + plan.SEEDS_A_FILE, case_size),
    params:
        pressures=lambda wildcards: CASES[wildcards.case]["maps"] or [],
        tolerance=lambda wildcards: PLANS[wildcards.case].settings.tolerance,
        code=source_hash("contact/contact_maps.py"),
    message:
        "Map gaps and pressures of one realisation: {wildcards.case}"
    script:
        "../scripts/contact/contact_maps.py"


rule solve_ensemble:
    input:
        laws=ERROR_MODELS,
    output:
        f"{RESULTS}/contact/ensembles/{{comparison}}.nc",
    log:
        f"{RESULTS}/logs/solve_ensemble/contact/ensembles/{{comparison}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/solve_ensemble/contact/ensembles/{{comparison}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory(17, comparison_size),
        runtime=minutes(1.1, comparison_size, comparison_solutions),
    params:
        surface=lambda wildcards: model_surface_of(wildcards.comparison),
        pressures=config["comparisons"]["pressures"],
        seeds=lambda wildcards: COMPARISONS[wildcards.comparison]["seeds"],
        coarse_seeds=lambda wildcards: COMPARISONS[wildcards.comparison]["coarse_seeds"],
        descriptor_seeds=config["sampling"]["descriptor_seeds"],
        tolerance=FIDELITY["tolerance"],
        pixels_per_wavelength=comparison_pixels,
        gaps=GAPS,
        code=source_hash("contact/solve_ensemble.py"),
    message:
        "Solve contact that theory is compared with: {wildcards.comparison}"
    script:
        "../scripts/contact/solve_ensemble.py"
