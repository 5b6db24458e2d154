# Real surfaces: parameters from the literature, or topographies analysed for their spectrum. Every
# measured map has a picture of its contact; `bem` in its entry adds contact with error estimates.

from common.provided import choose_pictured

PICTURED_MATERIAL = choose_pictured(MATERIALS)


def topographies(wildcards):
    """Files of a real surface's measurements."""
    if wildcards.real_surface not in MEASURED_SURFACES:
        return []
    measurements = list_measurements(REAL_SURFACES[wildcards.real_surface])
    return [local(file) for file in dict.fromkeys(each["file"] for each in measurements)]


def largest_contact(wildcards):
    """Megapixels of the largest grid on which measured heights are pressed."""
    return REAL_SURFACES[wildcards.real_surface]["bem"]["most_points"] ** 2 / 1e6


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


rule contact_measured:
    input:
        surface=f"{RESULTS}/real_surfaces/{{real_surface}}.nc",
        topographies=topographies,
    output:
        f"{RESULTS}/real_surfaces/contact/{{real_surface}}.nc",
    log:
        f"{RESULTS}/logs/contact_measured/real_surfaces/contact/{{real_surface}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/contact_measured/real_surfaces/contact/{{real_surface}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=memory(36, largest_contact),
        runtime=lambda wildcards: 60 + math.ceil(15 * largest_contact(wildcards)),
    params:
        surface=lambda wildcards: without_texts(REAL_SURFACES[wildcards.real_surface]),
        tolerance=FIDELITY["tolerance"],
        pixels_per_wavelength=FIDELITY["pixels_per_wavelength"],
        gamma=GAMMA,
        gaps=GAPS,
        code=source_hash("real_surfaces/contact_measured.py"),
    message:
        "Simulate contact on measured heights: {wildcards.real_surface}"
    script:
        "../scripts/real_surfaces/contact_measured.py"


rule picture_contact:
    input:
        surface=f"{RESULTS}/real_surfaces/{{real_surface}}.nc",
        topographies=topographies,
    output:
        contact=f"{RESULTS}/real_surfaces/pictures/{{real_surface}}.nc",
        pull_off=f"{RESULTS}/real_surfaces/pull_off/{{real_surface}}.nc",
        figure=f"{RESULTS}/figures/surfaces/{{real_surface}}_contact.png",
    log:
        f"{RESULTS}/logs/picture_contact/real_surfaces/pictures/{{real_surface}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/picture_contact/real_surfaces/pictures/{{real_surface}}.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        surface=lambda wildcards: without_texts(REAL_SURFACES[wildcards.real_surface]),
        material=PICTURED_MATERIAL,
        entry=without_texts(MATERIALS[PICTURED_MATERIAL]),
        squeeze=REMAINING_CAMPAIGN["squeeze"],
        code=source_hash("real_surfaces/picture_contact.py"),
    message:
        "Picture contact on measured heights: {wildcards.real_surface}"
    script:
        "../scripts/real_surfaces/picture_contact.py"
