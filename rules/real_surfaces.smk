# Real surfaces: parameters from the literature, or topographies analysed for their spectrum.


rule analyse_surface:
    input:
        library=library_of("analyse_surface.py"),
        topographies=topography_files,
    output:
        f"{RESULTS}/real_surfaces/{{real_surface}}.nc",
    log:
        f"{LOGS}/analyse_surface/{{real_surface}}.log",
    benchmark:
        f"{BENCHMARKS}/analyse_surface/{{real_surface}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=1000,
    params:
        surface=lambda wildcards: REAL_SURFACES[wildcards.real_surface],
    script:
        "../scripts/analyse_surface.py"
