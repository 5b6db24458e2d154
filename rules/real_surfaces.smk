# Real surfaces: parameters from the literature, or topographies analysed for their spectrum.


def topography_file(wildcards):
    """The measured file of a real surface, if it has one of its own."""
    file = REAL_SURFACES[wildcards.real_surface].get("file", "builtin:")
    return [] if file.startswith("builtin:") else [file]


rule analyse_surface:
    input:
        library=library_of("analyse_surface.py"),
        topography=topography_file,
    output:
        f"{RESULTS}/real_surfaces/{{real_surface}}.nc",
    log:
        f"{LOGS}/analyse_surface/{{real_surface}}.log",
    benchmark:
        f"{BENCHMARKS}/analyse_surface/{{real_surface}}.tsv"
    resources:
        mem_mb=1000,
    params:
        surface=lambda wildcards: REAL_SURFACES[wildcards.real_surface],
    script:
        "../scripts/analyse_surface.py"
