# Limits of verdicts: calibrated on the committed tables of campaigns, whose simulations are in
# `campaigns.smk`.


# The committed table is a copy of this one: the library reads it, so that a calibration changes
# verdicts only when it is taken over.
rule calibrate_limits:
    input:
        [project_file(f"config/{table}.csv") for table in ("heights", "remaining", *LIMIT_TABLES)],
    output:
        table=f"{LIMITS}/limits.csv",
        summary=f"{LIMITS}/limits.md",
        dataset=f"{LIMITS}/limits.nc",
    log:
        f"{LIMITS}/logs/calibrate_limits/limits.log",
    benchmark:
        f"{LIMITS}/benchmarks/calibrate_limits/limits.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        code=source_hash("limits/calibrate_limits.py"),
    message:
        "Calibrate the limits of verdicts"
    script:
        "../scripts/limits/calibrate_limits.py"


rule plot_limits:
    input:
        errors=rules.calibrate_limits.output.dataset,
    output:
        png=f"{RESULTS}/figures/limits.png",
        pdf=f"{RESULTS}/figures/limits.pdf",
    log:
        f"{RESULTS}/logs/plot_limits/figures/limits.log",
    benchmark:
        f"{RESULTS}/benchmarks/plot_limits/figures/limits.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        code=source_hash("limits/plot_limits.py"),
    message:
        "Draw how well the limits of verdicts hold"
    script:
        "../scripts/limits/plot_limits.py"
