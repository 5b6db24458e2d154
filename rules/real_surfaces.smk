# Real surfaces: parameters from the literature, or topographies analysed for their spectrum.


def topographies(wildcards):
    """Files of a real surface's measurements."""
    if wildcards.real_surface not in MEASURED_SURFACES:
        return []
    measurements = list_measurements(REAL_SURFACES[wildcards.real_surface])
    return [local(file) for file in dict.fromkeys(each["file"] for each in measurements)]


rule analyse_surface:
    input:
        topographies=topographies,
    output:
        f"{RESULTS}/real_surfaces/{{real_surface}}.nc",
    log:
        f"{RESULTS}/logs/analyse_surface/real_surfaces/{{real_surface}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/analyse_surface/real_surfaces/{{real_surface}}.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        surface=lambda wildcards: without_texts(REAL_SURFACES[wildcards.real_surface]),
        code=source_hash("real_surfaces/analyse_surface.py"),
    message:
        "Analyse a real surface: {wildcards.real_surface}"
    script:
        "../scripts/real_surfaces/analyse_surface.py"
