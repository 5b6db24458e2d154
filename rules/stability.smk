# Where each part of the library is right, refuses, or fails, at the extremes of two parameters.
# Independent of fidelity and cases.

COMPONENTS = [
    "spectrum",
    "surface",
    "wave",
    "contact",
    "adhesion",
    "paths",
    "theory",
    "PSD",
    "criteria",
    "verdict",
    "layer",
    "layer-contact",
]


rule probe_stability:
    output:
        f"{RESULTS}/stability/{{component}}.nc",
    wildcard_constraints:
        component=choices(COMPONENTS),
    resources:
        runtime=20,
    script:
        "../scripts/stability/probe_stability.py"


rule plot_stability:
    input:
        components=expand(f"{RESULTS}/stability/{{component}}.nc", component=COMPONENTS),
    output:
        png=report(
            f"{RESULTS}/figures/stability.png",
            category="Figures",
            caption="../report/stability.rst",
        ),
        pdf=f"{RESULTS}/figures/stability.pdf",
    script:
        "../scripts/stability/plot_stability.py"
