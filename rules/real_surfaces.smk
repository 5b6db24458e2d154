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


rule write_surface:
    input:
        library=library_of("write_surface.py"),
        template="report/surface.html.j2",
        surface=f"{RESULTS}/real_surfaces/{{real_surface}}.nc",
        verdicts=f"{RESULTS}/criteria/verdicts.nc",
    output:
        figure=f"{RESULTS}/figures/surfaces/{{real_surface}}.png",
        page=report(
            f"{RESULTS}/report/surfaces/{{real_surface}}.html",
            category="Surfaces",
            caption="../report/surface.rst",
        ),
    log:
        f"{LOGS}/write_surface/{{real_surface}}.log",
    benchmark:
        f"{BENCHMARKS}/write_surface/{{real_surface}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    script:
        "../scripts/write_surface.py"
