# Where each part of the library is right, refuses, or fails, at the extremes of two parameters.
# Independent of fidelity and cases.

COMPONENTS = ["surface", "contact", "adhesion", "paths", "theory", "PSD", "criteria", "layer"]


rule probe_stability:
    output:
        f"{RESULTS}/stability/{{component}}.nc",
    log:
        f"{RESULTS}/logs/probe_stability/stability/{{component}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/probe_stability/stability/{{component}}.tsv"
    wildcard_constraints:
        component=choices(COMPONENTS),
    conda:
        "../envs/environment.yaml"
    resources:
        runtime=20,
    params:
        code=source_hash("stability/probe_stability.py"),
    message:
        "Probe the library at extremes: {wildcards.component}"
    script:
        "../scripts/stability/probe_stability.py"


rule plot_stability:
    input:
        components=expand(rules.probe_stability.output, component=COMPONENTS),
    output:
        png=report(
            f"{RESULTS}/figures/stability.png",
            category="Figures",
            caption="../report/stability.rst",
        ),
        pdf=f"{RESULTS}/figures/stability.pdf",
    log:
        f"{RESULTS}/logs/plot_stability/figures/stability.log",
    benchmark:
        f"{RESULTS}/benchmarks/plot_stability/figures/stability.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        code=source_hash("stability/plot_stability.py"),
    message:
        "Draw where the library is right, refuses or fails"
    script:
        "../scripts/stability/plot_stability.py"
