# Real surfaces: parameters from the literature, or topographies analysed for their spectrum.


def topographies(wildcards):
    """Files of a real surface's measurements, or of its spectrum."""
    entry = REAL_SURFACES[wildcards.real_surface]
    if entry["kind"] not in ("measured", "spectrum"):
        return []
    measurements = list_measurements(entry) if entry["kind"] == "measured" else [entry]
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
