# What accuracy costs: every knob of simulation and theory varied on a few surfaces, its error in
# each quantity beside its cost. Measured apart from the fidelities, which come from it.

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
    hurst=choices(map(str, TRADE["bands"]["hurst"])),


def trade_set(wildcards):
    """The part of the configuration that a surface belongs to."""
    return TRADE_SETS[wildcards.trade_case]


rule measure_grids:
    output:
        f"{TRADEOFF}/grids/{{trade_case}}.nc",
    log:
        f"{TRADEOFF}/logs/measure_grids/grids/{{trade_case}}.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/measure_grids/grids/{{trade_case}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=3000,
    params:
        case=lambda wildcards: TRADE_SURFACES[wildcards.trade_case],
        settings={k: v for k, v in TRADE["settings"].items() if k != "surfaces"},
        pressures=TRADE["pressures"],
        seeds=TRADE["seeds"],
        gaps=GAPS,
        code=source_hash("tradeoff/measure_grids.py"),
    script:
        "../scripts/tradeoff/measure_grids.py"


rule measure_seeds:
    output:
        f"{TRADEOFF}/seeds/{{trade_case}}.nc",
    log:
        f"{TRADEOFF}/logs/measure_seeds/seeds/{{trade_case}}.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/measure_seeds/seeds/{{trade_case}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=2000,
    params:
        case=lambda wildcards: TRADE_SURFACES[wildcards.trade_case],
        pressures=lambda wildcards: trade_set(wildcards).get("pressures", TRADE["pressures"]),
        pixels=lambda wildcards: trade_set(wildcards)["pixels"],
        counts=lambda wildcards: trade_set(wildcards)["counts"],
        tolerance=TRADE["settings"]["at_tolerance"],
        first_seed=lambda wildcards: trade_set(wildcards)["first_seed"],
        gaps=GAPS,
        code=source_hash("tradeoff/measure_seeds.py"),
    script:
        "../scripts/tradeoff/measure_seeds.py"


rule measure_bands:
    output:
        f"{TRADEOFF}/bands/H{{hurst}}.nc",
    log:
        f"{TRADEOFF}/logs/measure_bands/bands/H{{hurst}}.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/measure_bands/bands/H{{hurst}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=3000,
    params:
        bands=TRADE["bands"],
        pressures=TRADE["pressures"],
        tolerance=TRADE["settings"]["at_tolerance"],
        gaps=GAPS,
        code=source_hash("tradeoff/measure_bands.py"),
    script:
        "../scripts/tradeoff/measure_bands.py"


rule measure_theory:
    output:
        f"{TRADEOFF}/theory.nc",
    log:
        f"{TRADEOFF}/logs/measure_theory/theory.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/measure_theory/theory.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        nodes=TRADE["nodes"],
        pressures=TRADE["pressures"],
        gaps=GAPS,
        code=source_hash("tradeoff/measure_theory.py"),
    script:
        "../scripts/tradeoff/measure_theory.py"


rule measure_adhesive:
    output:
        f"{TRADEOFF}/adhesive/{{trade_case}}.nc",
    log:
        f"{TRADEOFF}/logs/measure_adhesive/adhesive/{{trade_case}}.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/measure_adhesive/adhesive/{{trade_case}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=2000,
    params:
        case=lambda wildcards: ADHESIVE_SURFACES[wildcards.trade_case],
        adhesion={
            key: value
            for key, value in TRADE["adhesion"].items()
            if key not in ("surfaces", "pull_off")
        },
        code=source_hash("tradeoff/measure_adhesive.py"),
    script:
        "../scripts/tradeoff/measure_adhesive.py"


rule measure_pull_off:
    output:
        f"{TRADEOFF}/pull_off/{{trade_case}}.nc",
    log:
        f"{TRADEOFF}/logs/measure_pull_off/pull_off/{{trade_case}}.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/measure_pull_off/pull_off/{{trade_case}}.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        case=lambda wildcards: ADHESIVE_SURFACES[wildcards.trade_case],
        pull_off=TRADE["adhesion"]["pull_off"]
        | {key: TRADE["adhesion"][key] for key in ("q0_h_rms", "law", "at_pixels")},
        code=source_hash("tradeoff/measure_pull_off.py"),
    script:
        "../scripts/tradeoff/measure_pull_off.py"


rule tabulate_tradeoff:
    input:
        grids=expand(f"{TRADEOFF}/grids/{{name}}.nc", name=TRADE["settings"]["surfaces"]),
        seeds=expand(
            f"{TRADEOFF}/seeds/{{name}}.nc",
            name=[*TRADE["cases"]["surfaces"], *TRADE["finer"]["surfaces"]],
        ),
        bands=expand(f"{TRADEOFF}/bands/H{{hurst}}.nc", hurst=TRADE["bands"]["hurst"]),
        theory=f"{TRADEOFF}/theory.nc",
        adhesive=expand(f"{TRADEOFF}/adhesive/{{name}}.nc", name=ADHESIVE_SURFACES),
        pull_off=expand(f"{TRADEOFF}/pull_off/{{name}}.nc", name=ADHESIVE_SURFACES),
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
        code=source_hash("tradeoff/tabulate_tradeoff.py"),
    script:
        "../scripts/tradeoff/tabulate_tradeoff.py"


rule validate_accuracy:
    input:
        laws=f"{TRADEOFF}/accuracy.csv",
        seeds=expand(f"{TRADEOFF}/seeds/{{name}}.nc", name=TRADE["validation"]["surfaces"]),
    output:
        dataset=f"{TRADEOFF}/validation.nc",
        table=f"{TRADEOFF}/validation.md",
    log:
        f"{TRADEOFF}/logs/validate_accuracy/validation.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/validate_accuracy/validation.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        accuracies=TRADE["validation"]["accuracies"],
        code=source_hash("tradeoff/validate_accuracy.py"),
    script:
        "../scripts/tradeoff/validate_accuracy.py"


rule choose_presets:
    input:
        laws=f"{TRADEOFF}/accuracy.csv",
    output:
        f"{TRADEOFF}/presets.md",
    log:
        f"{TRADEOFF}/logs/choose_presets/presets.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/choose_presets/presets.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        **PRESETS,
        code=source_hash("tradeoff/choose_presets.py"),
    script:
        "../scripts/tradeoff/choose_presets.py"


rule plot_tradeoff:
    input:
        summary=f"{TRADEOFF}/tradeoff.csv",
        laws=f"{TRADEOFF}/accuracy.csv",
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
