# Real surfaces: parameters from the literature, or topographies analysed for their spectrum.


rule analyse_surface:
    input:
        library=library_of("real_surfaces/analyse_surface.py"),
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
        "../scripts/real_surfaces/analyse_surface.py"


rule contact_measured:
    input:
        library=library_of("real_surfaces/contact_measured.py"),
        surface=f"{RESULTS}/real_surfaces/{{real_surface}}.nc",
        topographies=topography_files,
    output:
        f"{RESULTS}/real_surfaces/contact/{{real_surface}}.nc",
    log:
        f"{LOGS}/contact_measured/{{real_surface}}.log",
    benchmark:
        f"{BENCHMARKS}/contact_measured/{{real_surface}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=4000,
        runtime=60,
    params:
        surface=lambda wildcards: REAL_SURFACES[wildcards.real_surface],
        tolerance=FIDELITY["tolerance"],
        pixels_per_wavelength=FIDELITY["pixels_per_wavelength"],
        gamma=config["theory"]["gamma"],
        gaps=config["gaps"],
    script:
        "../scripts/real_surfaces/contact_measured.py"


rule write_surface:
    input:
        library=library_of("report/write_surface.py"),
        template="report/surface.html.j2",
        parts=PAGE_PARTS,
        surface=f"{RESULTS}/real_surfaces/{{real_surface}}.nc",
        verdicts=f"{RESULTS}/criteria/verdicts.nc",
        pressed=pressed_heights,
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
        "../scripts/report/write_surface.py"
