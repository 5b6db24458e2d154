# Real surfaces: parameters from the literature, or topographies analysed for their spectrum, and
# contact of measured heights where that is asked for.


def topographies(wildcards):
    """Files of a real surface's measurements; those that come with the project are left out."""
    surface = REAL_SURFACES[wildcards.real_surface]
    if surface["kind"] != "measured":
        return []
    files = [measurement["file"] for _, measurement in checks.measurements(surface)]
    return [file for file in files if not file.startswith("builtin:")]


rule analyse_surface:
    input:
        topographies=topographies,
    output:
        f"{RESULTS}/real_surfaces/{{real_surface}}.nc",
    params:
        surface=lambda wildcards: REAL_SURFACES[wildcards.real_surface],
    script:
        "../scripts/real_surfaces/analyse_surface.py"


rule contact_measured:
    input:
        surface=f"{RESULTS}/real_surfaces/{{real_surface}}.nc",
        topographies=topographies,
    output:
        f"{RESULTS}/real_surfaces/contact/{{real_surface}}.nc",
    resources:
        mem_mb=4000,
        runtime=60,
    params:
        surface=lambda wildcards: REAL_SURFACES[wildcards.real_surface],
        tolerance=FIDELITY["tolerance"],
        pixels_per_wavelength=FIDELITY["pixels_per_wavelength"],
        gamma=GAMMA,
        gaps=GAPS,
    script:
        "../scripts/real_surfaces/contact_measured.py"
