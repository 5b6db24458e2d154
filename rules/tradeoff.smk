# What accuracy costs: every knob of simulation and theory varied on a few surfaces, its error in
# each quantity beside its cost. Measured apart from the fidelities, which come from it.


rule measure_grids:
    input:
        library=library_of("tradeoff/measure_grids.py"),
    output:
        f"{TRADEOFF}/grids/{{trade_case}}.nc",
    log:
        f"{TRADEOFF}/logs/measure_grids/{{trade_case}}.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/measure_grids/{{trade_case}}.tsv"
    wildcard_constraints:
        trade_case="|".join(map(re.escape, TRADE_SURFACES)),
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=3000,
    params:
        case=lambda wildcards: TRADE_SURFACES[wildcards.trade_case],
        settings={k: v for k, v in TRADE["settings"].items() if k != "surfaces"},
        pressures=TRADE["pressures"],
        seeds=TRADE["seeds"],
        gaps=config["gaps"],
    script:
        "../scripts/tradeoff/measure_grids.py"


rule measure_seeds:
    input:
        library=library_of("tradeoff/measure_seeds.py"),
    output:
        f"{TRADEOFF}/seeds/{{trade_case}}.nc",
    log:
        f"{TRADEOFF}/logs/measure_seeds/{{trade_case}}.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/measure_seeds/{{trade_case}}.tsv"
    wildcard_constraints:
        trade_case="|".join(map(re.escape, TRADE_SURFACES)),
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
        gaps=config["gaps"],
    script:
        "../scripts/tradeoff/measure_seeds.py"


rule measure_bands:
    input:
        library=library_of("tradeoff/measure_bands.py"),
    output:
        f"{TRADEOFF}/bands/H{{hurst}}.nc",
    log:
        f"{TRADEOFF}/logs/measure_bands/H{{hurst}}.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/measure_bands/H{{hurst}}.tsv"
    wildcard_constraints:
        hurst="|".join(re.escape(str(hurst)) for hurst in TRADE["bands"]["hurst"]),
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=3000,
    params:
        bands=TRADE["bands"],
        pressures=TRADE["pressures"],
        tolerance=TRADE["settings"]["at_tolerance"],
        gaps=config["gaps"],
    script:
        "../scripts/tradeoff/measure_bands.py"


rule measure_theory:
    input:
        library=library_of("tradeoff/measure_theory.py"),
    output:
        f"{TRADEOFF}/theory.nc",
    log:
        f"{TRADEOFF}/logs/measure_theory.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/measure_theory.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=1000,
    params:
        nodes=TRADE["nodes"],
        pressures=TRADE["pressures"],
        gaps=config["gaps"],
    script:
        "../scripts/tradeoff/measure_theory.py"


rule measure_adhesive:
    input:
        library=library_of("tradeoff/measure_adhesive.py"),
    output:
        f"{TRADEOFF}/adhesive/{{trade_case}}.nc",
    log:
        f"{TRADEOFF}/logs/measure_adhesive/{{trade_case}}.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/measure_adhesive/{{trade_case}}.tsv"
    wildcard_constraints:
        trade_case="|".join(map(re.escape, TRADE["adhesion"]["surfaces"])),
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=2000,
    params:
        case=lambda wildcards: TRADE["adhesion"]["surfaces"][wildcards.trade_case],
        adhesion={
            key: value
            for key, value in TRADE["adhesion"].items()
            if key not in ("surfaces", "pull_off")
        },
    script:
        "../scripts/tradeoff/measure_adhesive.py"


rule measure_pull_off:
    input:
        library=library_of("tradeoff/measure_pull_off.py"),
    output:
        f"{TRADEOFF}/pull_off/{{trade_case}}.nc",
    log:
        f"{TRADEOFF}/logs/measure_pull_off/{{trade_case}}.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/measure_pull_off/{{trade_case}}.tsv"
    wildcard_constraints:
        trade_case="|".join(map(re.escape, TRADE["adhesion"]["surfaces"])),
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=1000,
    params:
        case=lambda wildcards: TRADE["adhesion"]["surfaces"][wildcards.trade_case],
        pull_off=TRADE["adhesion"]["pull_off"]
        | {key: TRADE["adhesion"][key] for key in ("q0_h_rms", "law", "at_pixels")},
    script:
        "../scripts/tradeoff/measure_pull_off.py"


rule tabulate_tradeoff:
    input:
        library=library_of("tradeoff/tabulate_tradeoff.py"),
        grids=expand(f"{TRADEOFF}/grids/{{name}}.nc", name=TRADE["settings"]["surfaces"]),
        seeds=expand(
            f"{TRADEOFF}/seeds/{{name}}.nc",
            name=[*TRADE["cases"]["surfaces"], *TRADE["finer"]["surfaces"]],
        ),
        bands=expand(f"{TRADEOFF}/bands/H{{hurst}}.nc", hurst=TRADE["bands"]["hurst"]),
        theory=f"{TRADEOFF}/theory.nc",
        adhesive=expand(f"{TRADEOFF}/adhesive/{{name}}.nc", name=TRADE["adhesion"]["surfaces"]),
        pull_off=expand(f"{TRADEOFF}/pull_off/{{name}}.nc", name=TRADE["adhesion"]["surfaces"]),
    output:
        dataset=f"{TRADEOFF}/tradeoff.nc",
        laws=f"{TRADEOFF}/accuracy.csv",
        summary=f"{TRADEOFF}/tradeoff.csv",
        table=f"{TRADEOFF}/tradeoff.md",
    log:
        f"{TRADEOFF}/logs/tabulate_tradeoff.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/tabulate_tradeoff.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=1000,
    script:
        "../scripts/tradeoff/tabulate_tradeoff.py"


rule validate_accuracy:
    input:
        library=library_of("tradeoff/validate_accuracy.py"),
        laws=f"{TRADEOFF}/accuracy.csv",
        seeds=expand(f"{TRADEOFF}/seeds/{{name}}.nc", name=TRADE["validation"]["surfaces"]),
    output:
        dataset=f"{TRADEOFF}/validation.nc",
        table=f"{TRADEOFF}/validation.md",
    log:
        f"{TRADEOFF}/logs/validate_accuracy.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/validate_accuracy.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=1000,
    params:
        accuracies=TRADE["validation"]["accuracies"],
    script:
        "../scripts/tradeoff/validate_accuracy.py"


rule choose_presets:
    input:
        library=library_of("tradeoff/choose_presets.py"),
        laws=f"{TRADEOFF}/accuracy.csv",
    output:
        f"{TRADEOFF}/presets.md",
    log:
        f"{TRADEOFF}/logs/choose_presets.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/choose_presets.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    params:
        presets=TRADE["presets"],
        surface=config["model_surfaces"].get(TRADE["presets"]["surface"]),
        fidelities=config["fidelities"],
        descriptor_seeds=config["sampling"]["descriptor_seeds"],
    script:
        "../scripts/tradeoff/choose_presets.py"


rule plot_tradeoff:
    input:
        library=library_of("tradeoff/plot_tradeoff.py"),
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
        f"{TRADEOFF}/logs/plot_tradeoff.log",
    benchmark:
        f"{TRADEOFF}/benchmarks/plot_tradeoff.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    params:
        presets=TRADE["presets"],
        surface=config["model_surfaces"].get(TRADE["presets"]["surface"]),
        fidelities=config["fidelities"],
        descriptor_seeds=config["sampling"]["descriptor_seeds"],
    script:
        "../scripts/tradeoff/plot_tradeoff.py"


# The report shows the measurement that is in use: the committed tables.
use rule plot_tradeoff as plot_measured_trade with:
    input:
        library=library_of("tradeoff/plot_tradeoff.py"),
        summary=TRADE["summary"],
        laws=TRADE["table"],
    output:
        png=f"{RESULTS}/figures/tradeoff.png",
        pdf=f"{RESULTS}/figures/tradeoff.pdf",
    log:
        f"{LOGS}/plot_measured_trade.log",
    benchmark:
        f"{BENCHMARKS}/plot_measured_trade.tsv"
