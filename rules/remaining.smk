# How much adhesion remains: approach and separation of rough surfaces, simulated once for all. The
# model of the verdicts is compared with the committed table.

MEASURED = REMAINING_CAMPAIGN["sets"]


wildcard_constraints:
    remaining_set=choices(MEASURED),


def measured_points(wildcards):
    """Points of the grid of a set."""
    return MEASURED[wildcards.remaining_set]["points"] ** 2


rule measure_remaining:
    output:
        f"{REMAINING}/{{remaining_set}}/seed{{seed}}.nc",
    log:
        f"{REMAINING}/logs/measure_remaining/{{remaining_set}}/seed{{seed}}.log",
    benchmark:
        f"{REMAINING}/benchmarks/measure_remaining/{{remaining_set}}/seed{{seed}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=2000,
        runtime=120,
    params:
        surface=lambda wildcards: MEASURED[wildcards.remaining_set],
        law=REMAINING_CAMPAIGN["law"],
        squeeze=REMAINING_CAMPAIGN["squeeze"],
        code=source_hash("remaining/measure_remaining.py"),
    script:
        "../scripts/remaining/measure_remaining.py"


# The committed table is a copy of this one, so that a run shows it without an hour of simulation.
rule tabulate_remaining:
    input:
        [
            f"{REMAINING}/{name}/seed{seed}.nc"
            for name, measured in MEASURED.items()
            for seed in measured["seeds"]
        ],
    output:
        table=f"{REMAINING}/remaining.csv",
        summary=f"{REMAINING}/remaining.md",
    log:
        f"{REMAINING}/logs/tabulate_remaining/remaining.log",
    benchmark:
        f"{REMAINING}/benchmarks/tabulate_remaining/remaining.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        code=source_hash("remaining/tabulate_remaining.py"),
    script:
        "../scripts/remaining/tabulate_remaining.py"
