# Simulations behind the limits of verdicts: on other solids, on patches of surfaces, at ranges
# shorter than a grid resolves, their pull-offs, with waves that it lacks, on surfaces larger than a
# scan, on solids and surfaces whose finest waves a map lacks, and of balls. Limits are calibrated on
# the committed tables.

SIMULATED_SETS = {
    kind: LIMIT_CAMPAIGN[kind]["sets"]
    for kind in (
        *("solids", "patches", "ranges", "pull_offs", "unresolved", "larger", "coated", "balls"),
    )
}


wildcard_constraints:
    limits_kind=choices(SIMULATED_SETS),
    limits_set=choices(name for sets in SIMULATED_SETS.values() for name in sets),


def setting_of(wildcards):
    """What one set is: what a further seed leaves as it is."""
    simulated = SIMULATED_SETS[wildcards.limits_kind][wildcards.limits_set]
    return {key: value for key, value in simulated.items() if key != "seeds"}


def campaign_of(wildcards):
    """What is common to all sets of one kind."""
    campaign = LIMIT_CAMPAIGN[wildcards.limits_kind]
    common = {key: value for key, value in campaign.items() if key != "sets"}
    return {"law": LIMIT_CAMPAIGN["law"], **common}


rule measure_limits:
    output:
        f"{LIMITS}/{{limits_kind}}/{{limits_set}}/seed{{seed}}.nc",
    log:
        f"{LIMITS}/logs/measure_limits/{{limits_kind}}/{{limits_set}}/seed{{seed}}.log",
    benchmark:
        f"{LIMITS}/benchmarks/measure_limits/{{limits_kind}}/{{limits_set}}/seed{{seed}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=2000,
        runtime=30,
    params:
        setting=setting_of,
        campaign=campaign_of,
        code=lambda wildcards: source_hash(f"limits/measure_{wildcards.limits_kind}.py"),
    message:
        "Simulate {wildcards.limits_kind} for limits: {wildcards.limits_set}, seed {wildcards.seed}"
    script:
        "../scripts/limits/measure_{wildcards.limits_kind}.py"


def simulated_files(wildcards):
    """Files of all sets of one kind."""
    kind = wildcards.limits_kind
    return [
        f"{LIMITS}/{kind}/{name}/seed{seed}.nc"
        for name, simulated in SIMULATED_SETS[kind].items()
        for seed in simulated["seeds"]
    ]


# The committed tables are copies of these.
rule tabulate_limits:
    input:
        simulated_files,
    output:
        f"{LIMITS}/{{limits_kind}}.csv",
    log:
        f"{LIMITS}/logs/tabulate_limits/{{limits_kind}}.log",
    benchmark:
        f"{LIMITS}/benchmarks/tabulate_limits/{{limits_kind}}.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        code=source_hash("limits/tabulate_limits.py"),
    message:
        "Tabulate the simulations behind limits: {wildcards.limits_kind}"
    script:
        "../scripts/limits/tabulate_limits.py"


# The committed table is a copy of this one: the library reads it, so that a calibration changes
# verdicts only when it is taken over.
rule calibrate_limits:
    input:
        [project_file(f"config/{table}.csv") for table in ("heights", "remaining", *SIMULATED_SETS)],
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
        touching=LIMIT_CAMPAIGN["touching"],
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
