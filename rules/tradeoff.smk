# What accuracy costs: every setting of simulation and every model, its error in each quantity beside
# its cost, measured on a few surfaces. It does not depend on the fidelities, which come from it.

TRADE_SETS = {
    name: TRADE[part]
    for part in ("cases", "finer", "validation")
    for name in TRADE[part]["surfaces"]
}
TRADE_SURFACES = {name: part["surfaces"][name] for name, part in TRADE_SETS.items()}
ADHESIVE_SURFACES = TRADE["adhesion"]["surfaces"]
PRESETS = {
    "presets": TRADE["presets"],
    "surface": MODEL_SURFACES.get(TRADE["presets"]["surface"]),
    "fidelities": config["fidelities"],
    "descriptor_seeds": config["sampling"]["descriptor_seeds"],
}


wildcard_constraints:
    trade_case=choices([*TRADE_SURFACES, *ADHESIVE_SURFACES]),


def trade_set(wildcards):
    """The part of the configuration that a surface belongs to."""
    return TRADE_SETS[wildcards.trade_case]


rule measure_contact:
    output:
        f"{TRADEOFF}/contact/{{trade_case}}.nc",
    log:
        f"{TRADEOFF}/logs/measure_contact/contact/{{trade_case}}.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/measure_contact/contact/{{trade_case}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=3000,
    params:
        case=lambda wildcards: TRADE_SURFACES[wildcards.trade_case],
        pressures=lambda wildcards: trade_set(wildcards)["pressures"] or TRADE["pressures"],
        pixels=lambda wildcards: trade_set(wildcards)["pixels"],
        counts=lambda wildcards: trade_set(wildcards)["counts"],
        first_seed=lambda wildcards: trade_set(wildcards)["first_seed"],
        tolerances=TRADE["settings"]["tolerances"],
        tolerance=TRADE["settings"]["at_tolerance"],
        at_pixels=TRADE["settings"]["at_pixels"],
        gaps=GAPS,
        code=source_hash("tradeoff/measure_contact.py"),
    message:
        "Measure what settings of contact cost: {wildcards.trade_case}"
    script:
        "../scripts/tradeoff/measure_contact.py"


rule measure_adhesion:
    output:
        states=f"{TRADEOFF}/adhesive/{{trade_case}}.nc",
        pull_off=f"{TRADEOFF}/pull_off/{{trade_case}}.nc",
    log:
        f"{TRADEOFF}/logs/measure_adhesion/{{trade_case}}.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/measure_adhesion/{{trade_case}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=2000,
    params:
        case=lambda wildcards: ADHESIVE_SURFACES[wildcards.trade_case],
        adhesion={key: value for key, value in TRADE["adhesion"].items() if key != "surfaces"},
        code=source_hash("tradeoff/measure_adhesion.py"),
    message:
        "Measure what settings of adhesion cost: {wildcards.trade_case}"
    script:
        "../scripts/tradeoff/measure_adhesion.py"


rule tabulate_tradeoff:
    input:
        contact=expand(
            rules.measure_contact.output,
            trade_case=[*TRADE["cases"]["surfaces"], *TRADE["finer"]["surfaces"]],
        ),
        adhesive=expand(rules.measure_adhesion.output.states, trade_case=ADHESIVE_SURFACES),
        pull_off=expand(rules.measure_adhesion.output.pull_off, trade_case=ADHESIVE_SURFACES),
        validation=expand(rules.measure_contact.output, trade_case=TRADE["validation"]["surfaces"]),
        verdicts=campaign_table("verdicts"),
        heights=HEIGHTS_TABLE,
        template=project_file("report/tradeoff.md.j2"),
    output:
        dataset=f"{TRADEOFF}/tradeoff.nc",
        laws=f"{TRADEOFF}/accuracy.csv",
        summary=f"{TRADEOFF}/tradeoff.csv",
        table=f"{TRADEOFF}/tradeoff.md",
    log:
        f"{TRADEOFF}/logs/tabulate_tradeoff/tradeoff.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/tabulate_tradeoff/tradeoff.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        **PRESETS,
        accuracies=TRADE["validation"]["accuracies"],
        energies=TRADE["verdicts"]["energies"],
        code=source_hash("tradeoff/tabulate_tradeoff.py"),
    message:
        "Tabulate accuracy against cost, and fit error models"
    script:
        "../scripts/tradeoff/tabulate_tradeoff.py"


rule plot_tradeoff:
    input:
        summary=rules.tabulate_tradeoff.output.summary,
        laws=rules.tabulate_tradeoff.output.laws,
    output:
        png=report(
            f"{TRADEOFF}/tradeoff.png",
            category="Figures",
            caption="../report/tradeoff.rst",
        ),
        pdf=f"{TRADEOFF}/tradeoff.pdf",
    log:
        f"{TRADEOFF}/logs/plot_tradeoff/tradeoff.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/plot_tradeoff/tradeoff.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        **PRESETS,
        code=source_hash("tradeoff/plot_tradeoff.py"),
    message:
        "Draw accuracy against cost"
    script:
        "../scripts/tradeoff/plot_tradeoff.py"


# The report shows the measurement that is in use: the committed tables.
use rule plot_tradeoff as plot_measured_trade with:
    input:
        summary=TRADE_SUMMARY,
        laws=ERROR_MODELS,
    output:
        png=f"{RESULTS}/figures/tradeoff.png",
        pdf=f"{RESULTS}/figures/tradeoff.pdf",
    log:
        f"{RESULTS}/logs/plot_measured_trade/figures/tradeoff.log",
    benchmark:
        f"{RESULTS}/benchmarks/plot_measured_trade/figures/tradeoff.tsv"
    message:
        "Draw accuracy against cost, as committed"
