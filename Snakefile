# Do two rough solids stick? From random surfaces to stickiness verdicts.
#
#   model surfaces ──► contact ──► ensembles ──► a_V, kappa ──► criteria ──► figures
#        ├─ full adhesion ──► slopes, loops, error of the DMT limit ──┤
#        └─ spectrum of the cell ─► Persson's theory ─────┘           ▲        claims
#   real surfaces ──► spectrum, H, C0 ────────────────────────────────┘        report
#
# The rules of a stage are in rules/<stage>.smk, their scripts are scripts/<stage>/<rule>.py, and their
# results are in results/<fidelity>/<stage>/, or in results/<stage>/ if no fidelity changes them.

from pathlib import Path

from snakemake.utils import min_version

min_version("9.0")


include: "rules/project.smk"


# What the user sets; rules/common.smk adds the other keys. Snakemake leaves this out in a module that
# is given its configuration.
if Path("config/config.yaml").exists():
    if not MODULE:
        with one_line():
            load.load("config/config.yaml")

    configfile: "config/config.yaml"


report: "report/workflow.rst"


include: "rules/common.smk"
include: "rules/store.smk"
include: "rules/resources.smk"
include: "rules/surfaces.smk"
include: "rules/contact.smk"
include: "rules/persson.smk"
include: "rules/fits.smk"
include: "rules/cases.smk"
include: "rules/adhesion.smk"
include: "rules/real_surfaces.smk"
include: "rules/campaigns.smk"
include: "rules/remaining.smk"
include: "rules/limits.smk"
include: "rules/criteria.smk"
include: "rules/experiments.smk"
include: "rules/figures.smk"
include: "rules/claims.smk"
include: "rules/tradeoff.smk"
include: "rules/report.smk"
include: "rules/stability.smk"


TARGETS = {
    **{figure: f"{RESULTS}/figures/{figure}.png" for figure in FIGURES},
    "verdicts": [rules.judge.output[kind] for kind in ("page", "table", "csv", "workbook")]
    + list(rules.check_surfaces.output),
    "experiments": [rules.predict_experiments.output[kind] for kind in ("table", "png")],
    "claims": rules.check_claims.output.table,
    "report": rules.write_report.output,
    "findings": rules.write_findings.output,
    "surfaces": expand(rules.write_surface.output.page, real_surface=REAL_SURFACES),
    # With the means, without which Snakemake does not notice that theory is now to be simulated.
    "cases": expand(f"{RESULTS}/cases/{{case}}.nc", case=CASES)
    + expand(f"{RESULTS}/contact/ensembles/{{case}}.nc", case=SIMULATED_CASES),
    "stability": rules.plot_stability.output.png,
    "dmt_error": rules.tabulate_dmt_error.output,
    "remaining_measured": campaign_table("remaining"),
    "heights_measured": campaign_table("heights"),
    "limits_calibrated": [rules.calibrate_limits.output.table, rules.plot_limits.output.png],
    "limits_measured": [campaign_table(name) for name in LIMIT_TABLES],
    "tradeoff": [rules.tabulate_tradeoff.output.table, rules.plot_tradeoff.output.png],
}


# The report shows the claims, which need the paper's surfaces.
ALL = (*FIGURES, "verdicts", "experiments", "surfaces")
ALL += ("claims", "report", "findings") if REAL_SURFACES.keys() >= set(PAPER_SURFACES) else ()


rule all:
    input:
        [TARGETS[target] for target in ALL],
    message:
        "All is made"


for target, files in TARGETS.items():

    rule:
        name:
            target
        input:
            files,
        message:
            f"Made: {target}"


save_cache()
