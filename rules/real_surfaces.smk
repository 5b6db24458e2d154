# Real surfaces: parameters from the literature, or topographies analysed for their spectrum. No fidelity
# changes them: contact is simulated on the heights as they were measured.

ANALYSED = f"{SHARED_RESULTS}/real_surfaces/{{real_surface}}.nc"


def analysed(names):
    """Files of some real surfaces."""
    return expand(ANALYSED, real_surface=names)


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
        ANALYSED,
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
