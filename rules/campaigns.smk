# Campaigns: what this project simulated once, for its models, limits and choices. Each has a table
# with a row for every simulation. What reads such a table takes the committed one.

# By name: its sets, and what is common to all of them.
CAMPAIGNS = {
    "remaining": REMAINING_CAMPAIGN,
    "heights": HEIGHT_CAMPAIGN,
    "verdicts": TRADE["verdicts"],
    **{
        name: {"law": LIMIT_CAMPAIGN["law"], **LIMIT_CAMPAIGN[name]}
        for name in (
            *("solids", "patches", "ranges", "pull_offs"),
            *("unresolved", "larger", "coated", "balls", "long_ranges"),
        )
    },
}
# Where its results are, and the target that makes its table.
CAMPAIGN_STAGES = dict.fromkeys(CAMPAIGNS, "limits") | {
    "remaining": "remaining",
    "heights": "remaining",
    "verdicts": "tradeoff",
}
CAMPAIGN_TARGETS = dict.fromkeys(CAMPAIGNS, "limits_measured") | {
    "remaining": "remaining_measured",
    "heights": "heights_measured",
    "verdicts": "tradeoff",
}
LIMIT_TABLES = [name for name, stage in CAMPAIGN_STAGES.items() if stage == "limits"]


wildcard_constraints:
    stage=choices(sorted({*CAMPAIGN_STAGES.values()})),
    campaign=choices(CAMPAIGNS),
    set=choices(name for campaign in CAMPAIGNS.values() for name in campaign["sets"]),


def campaign_table(name):
    """Table that a campaign makes."""
    return f"{SHARED_RESULTS}/{CAMPAIGN_STAGES[name]}/{name}.csv"


def setting_of(wildcards):
    """What one set is: what a further seed leaves as it is."""
    setting = CAMPAIGNS[wildcards.campaign]["sets"][wildcards.set]
    return {key: value for key, value in setting.items() if key != "seeds"}


def shared_by_sets(wildcards):
    """What is common to all sets of a campaign."""
    return {key: value for key, value in CAMPAIGNS[wildcards.campaign].items() if key != "sets"}


rule measure:
    output:
        f"{SHARED_RESULTS}/{{stage}}/{{campaign}}/{{set}}/seed{{seed}}.nc",
    log:
        f"{SHARED_RESULTS}/{{stage}}/logs/measure/{{campaign}}/{{set}}/seed{{seed}}.log",
    benchmark:
        f"{SHARED_RESULTS}/{{stage}}/benchmarks/measure/{{campaign}}/{{set}}/seed{{seed}}.tsv"
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=3000,
        runtime=120,
    params:
        setting=setting_of,
        shared=shared_by_sets,
        code=source_hash("campaigns/measure.py"),
        code_of_campaign=lambda wildcards: source_hash(f"campaigns/{wildcards.campaign}.py"),
    message:
        "Simulate {wildcards.campaign}: {wildcards.set}, seed {wildcards.seed}"
    script:
        "../scripts/campaigns/measure.py"


def measured_files(wildcards):
    """Files of all sets and seeds of a campaign."""
    folder = f"{SHARED_RESULTS}/{wildcards.stage}/{wildcards.campaign}"
    return [
        f"{folder}/{name}/seed{seed}.nc"
        for name, setting in CAMPAIGNS[wildcards.campaign]["sets"].items()
        for seed in setting["seeds"]
    ]


rule tabulate:
    input:
        measured_files,
    output:
        f"{SHARED_RESULTS}/{{stage}}/{{campaign}}.csv",
    log:
        f"{SHARED_RESULTS}/{{stage}}/logs/tabulate/{{campaign}}.log",
    benchmark:
        f"{SHARED_RESULTS}/{{stage}}/benchmarks/tabulate/{{campaign}}.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        target=lambda wildcards: CAMPAIGN_TARGETS[wildcards.campaign],
        code=source_hash("campaigns/tabulate.py"),
    message:
        "Tabulate what was simulated: {wildcards.campaign}"
    script:
        "../scripts/campaigns/tabulate.py"
