# How much adhesion remains: approach and separation of rough surfaces, simulated once for all. The
# model of the verdicts is compared with the committed summary.

MEASURED = REMAINING_CAMPAIGN["sets"]


wildcard_constraints:
    remaining_set=choices(MEASURED),


def measured_points(wildcards):
    """Points of the grid of a set."""
    return MEASURED[wildcards.remaining_set]["points"] ** 2


rule measure_remaining:
    output:
        f"{REMAINING}/{{remaining_set}}/seed{{seed}}.nc",
    resources:
        mem_mb=2000,
        runtime=120,
    params:
        surface=lambda wildcards: MEASURED[wildcards.remaining_set],
        law=REMAINING_CAMPAIGN["law"],
        squeeze=REMAINING_CAMPAIGN["squeeze"],
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
    script:
        "../scripts/remaining/tabulate_remaining.py"
