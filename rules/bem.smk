# Repulsive boundary-element contact: one job per case and seed walks the whole load path, then
# the seeds of a case are averaged.


rule solve_repulsive:
    input:
        library=library_of("solve_repulsive.py"),
        surface=surface_of,
    output:
        f"{RESULTS}/bem/{{case}}/seed{{seed}}.nc",
    log:
        f"{LOGS}/solve_repulsive/{{case}}/seed{{seed}}.log",
    benchmark:
        f"{BENCHMARKS}/solve_repulsive/{{case}}/seed{{seed}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=2000,
    params:
        pressures=lambda wildcards: CASES[wildcards.case]["pressures"],
        tolerance=FIDELITY["tolerance"],
        pixels_per_wavelength=FIDELITY["pixels_per_wavelength"],
        gaps=config["gaps"],
    script:
        "../scripts/solve_repulsive.py"


rule contact_maps:
    input:
        library=library_of("contact_maps.py"),
        surface=lambda wildcards: surface_of(wildcards).format(seed=1),
    output:
        f"{RESULTS}/bem/{{case}}/maps.nc",
    log:
        f"{LOGS}/contact_maps/{{case}}.log",
    benchmark:
        f"{BENCHMARKS}/contact_maps/{{case}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=2000,
    params:
        pressures=lambda wildcards: CASES[wildcards.case].get("maps", []),
        tolerance=FIDELITY["tolerance"],
    script:
        "../scripts/contact_maps.py"


rule average_ensemble:
    input:
        library=library_of("average_ensemble.py"),
        realisations=realisations,
    output:
        f"{RESULTS}/ensembles/{{case}}.nc",
    log:
        f"{LOGS}/average_ensemble/{{case}}.log",
    benchmark:
        f"{BENCHMARKS}/average_ensemble/{{case}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=1000,
    script:
        "../scripts/average_ensemble.py"
