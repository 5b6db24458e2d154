# Where each part of the library is right, refuses, or fails, at the extremes of its parameters.
# Independent of fidelity and cases.

COMPONENTS = [
    "spectrum",
    "odd-spectra",
    "synthesise",
    "measured",
    "sampling",
    "accuracy",
    "persson",
    "repulsive",
    "sub-pixel",
    "dmt",
    "dmt-limit",
    "adhesive",
    "tension",
    "paths",
    "model-choice",
    "edge-adhesion",
    "a_v-table",
    "criteria",
    "moduli",
]


rule probe_stability:
    input:
        library=library_of("stability/probe_stability.py"),
    output:
        f"{RESULTS}/stability/{{component}}.nc",
    log:
        f"{LOGS}/probe_stability/{{component}}.log",
    benchmark:
        f"{BENCHMARKS}/probe_stability/{{component}}.tsv"
    wildcard_constraints:
        component="|".join(COMPONENTS),
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
        runtime=20,
    script:
        "../scripts/stability/probe_stability.py"


rule plot_stability:
    input:
        library=library_of("stability/plot_stability.py"),
        components=expand(f"{RESULTS}/stability/{{component}}.nc", component=COMPONENTS),
    output:
        png=report(
            f"{RESULTS}/figures/stability.png",
            category="Figures",
            caption="../report/stability.rst",
        ),
        pdf=f"{RESULTS}/figures/stability.pdf",
    log:
        f"{LOGS}/plot_stability.log",
    benchmark:
        f"{BENCHMARKS}/plot_stability.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    script:
        "../scripts/stability/plot_stability.py"
