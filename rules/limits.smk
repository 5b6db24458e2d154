# Simulations behind the limits of verdicts: on other solids, on patches of surfaces, at ranges
# shorter than a grid resolves, their pull-offs, with waves that it lacks, on surfaces larger than a
# scan, and of balls. Limits are calibrated on the committed tables.

SIMULATED_SETS = {
    kind: LIMIT_CAMPAIGN[kind]["sets"]
    for kind in ("solids", "patches", "ranges", "pull_offs", "unresolved", "larger", "balls")
}


wildcard_constraints:
    limits_kind=choices(SIMULATED_SETS),
    solid_set=choices(SIMULATED_SETS["solids"]),
    patch_set=choices(SIMULATED_SETS["patches"]),
    range_set=choices(SIMULATED_SETS["ranges"]),
    pull_off_set=choices(SIMULATED_SETS["pull_offs"]),
    unresolved_set=choices(SIMULATED_SETS["unresolved"]),
    larger_set=choices(SIMULATED_SETS["larger"]),
    ball_set=choices(SIMULATED_SETS["balls"]),


def solid_of(wildcards):
    """Solid and surface of a set."""
    return SIMULATED_SETS["solids"][wildcards.solid_set]


rule measure_solids:
    output:
        f"{LIMITS}/solids/{{solid_set}}/seed{{seed}}.nc",
    log:
        f"{LIMITS}/logs/measure_solids/{{solid_set}}/seed{{seed}}.log",
    benchmark:
        f"{LIMITS}/benchmarks/measure_solids/{{solid_set}}/seed{{seed}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=2000,
        runtime=30,
    params:
        surface=solid_of,
        law=LIMIT_CAMPAIGN["law"],
        pixels_in_zone=lambda wildcards: LIMIT_CAMPAIGN["solids"]["pixels_in_zone"][
            solid_of(wildcards)["kind"]
        ],
        energies=LIMIT_CAMPAIGN["solids"]["energies"],
        code=source_hash("limits/measure_solids.py"),
    message:
        "Simulate adhesion on layers and skins: {wildcards.solid_set}, seed {wildcards.seed}"
    script:
        "../scripts/limits/measure_solids.py"


rule measure_patches:
    output:
        f"{LIMITS}/patches/{{patch_set}}/seed{{seed}}.nc",
    log:
        f"{LIMITS}/logs/measure_patches/{{patch_set}}/seed{{seed}}.log",
    benchmark:
        f"{LIMITS}/benchmarks/measure_patches/{{patch_set}}/seed{{seed}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=2000,
        runtime=30,
    params:
        surface=lambda wildcards: SIMULATED_SETS["patches"][wildcards.patch_set],
        patches=LIMIT_CAMPAIGN["patches"]["patches"],
        range=LIMIT_CAMPAIGN["patches"]["range"],
        code=source_hash("limits/measure_patches.py"),
    message:
        "Simulate adhesion on patches of a surface: {wildcards.patch_set}, seed {wildcards.seed}"
    script:
        "../scripts/limits/measure_patches.py"


rule measure_ranges:
    output:
        f"{LIMITS}/ranges/{{range_set}}/seed{{seed}}.nc",
    log:
        f"{LIMITS}/logs/measure_ranges/{{range_set}}/seed{{seed}}.log",
    benchmark:
        f"{LIMITS}/benchmarks/measure_ranges/{{range_set}}/seed{{seed}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=2000,
        runtime=30,
    params:
        surface=lambda wildcards: SIMULATED_SETS["ranges"][wildcards.range_set],
        law=LIMIT_CAMPAIGN["law"],
        works=LIMIT_CAMPAIGN["ranges"]["works"],
        shares=LIMIT_CAMPAIGN["ranges"]["shares"],
        code=source_hash("limits/measure_ranges.py"),
    message:
        "Simulate ranges that a grid does not resolve: {wildcards.range_set}, seed {wildcards.seed}"
    script:
        "../scripts/limits/measure_ranges.py"


rule measure_pull_offs:
    output:
        f"{LIMITS}/pull_offs/{{pull_off_set}}/seed{{seed}}.nc",
    log:
        f"{LIMITS}/logs/measure_pull_offs/{{pull_off_set}}/seed{{seed}}.log",
    benchmark:
        f"{LIMITS}/benchmarks/measure_pull_offs/{{pull_off_set}}/seed{{seed}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=2000,
        runtime=30,
    params:
        surface=lambda wildcards: SIMULATED_SETS["pull_offs"][wildcards.pull_off_set],
        law=LIMIT_CAMPAIGN["law"],
        works=LIMIT_CAMPAIGN["pull_offs"]["works"],
        shares=LIMIT_CAMPAIGN["pull_offs"]["shares"],
        squeeze=LIMIT_CAMPAIGN["pull_offs"]["squeeze"],
        steps=LIMIT_CAMPAIGN["pull_offs"]["steps"],
        code=source_hash("limits/measure_pull_offs.py"),
    message:
        "Simulate pull-off at short ranges: {wildcards.pull_off_set}, seed {wildcards.seed}"
    script:
        "../scripts/limits/measure_pull_offs.py"


rule measure_unresolved:
    output:
        f"{LIMITS}/unresolved/{{unresolved_set}}/seed{{seed}}.nc",
    log:
        f"{LIMITS}/logs/measure_unresolved/{{unresolved_set}}/seed{{seed}}.log",
    benchmark:
        f"{LIMITS}/benchmarks/measure_unresolved/{{unresolved_set}}/seed{{seed}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=2000,
        runtime=30,
    params:
        surface=lambda wildcards: SIMULATED_SETS["unresolved"][wildcards.unresolved_set],
        ranges=LIMIT_CAMPAIGN["unresolved"]["ranges"],
        strides=LIMIT_CAMPAIGN["unresolved"]["strides"],
        code=source_hash("limits/measure_unresolved.py"),
    message:
        "Simulate waves that a grid lacks: {wildcards.unresolved_set}, seed {wildcards.seed}"
    script:
        "../scripts/limits/measure_unresolved.py"


rule measure_larger:
    output:
        f"{LIMITS}/larger/{{larger_set}}/seed{{seed}}.nc",
    log:
        f"{LIMITS}/logs/measure_larger/{{larger_set}}/seed{{seed}}.log",
    benchmark:
        f"{LIMITS}/benchmarks/measure_larger/{{larger_set}}/seed{{seed}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=2000,
        runtime=30,
    params:
        surface=lambda wildcards: SIMULATED_SETS["larger"][wildcards.larger_set],
        range=LIMIT_CAMPAIGN["larger"]["range"],
        patches=LIMIT_CAMPAIGN["larger"]["count"],
        code=source_hash("limits/measure_larger.py"),
    message:
        "Simulate surfaces larger than a scan: {wildcards.larger_set}, seed {wildcards.seed}"
    script:
        "../scripts/limits/measure_larger.py"


rule measure_balls:
    output:
        f"{LIMITS}/balls/{{ball_set}}/seed{{seed}}.nc",
    log:
        f"{LIMITS}/logs/measure_balls/{{ball_set}}/seed{{seed}}.log",
    benchmark:
        f"{LIMITS}/benchmarks/measure_balls/{{ball_set}}/seed{{seed}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=2000,
        runtime=30,
    params:
        surface=lambda wildcards: SIMULATED_SETS["balls"][wildcards.ball_set],
        code=source_hash("limits/measure_balls.py"),
    message:
        "Simulate the pull-off of balls: {wildcards.ball_set}, seed {wildcards.seed}"
    script:
        "../scripts/limits/measure_balls.py"


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
