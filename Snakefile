# Do two rough solids stick? From random surfaces to stickiness verdicts.
#
#   model surfaces ──► contact ──► ensembles ──► a_V, kappa ──► criteria ──► figures
#        ├─ full adhesion ──► slopes, loops, error of the DMT limit ──┤
#        └─ spectrum of the cell ─► Persson's theory ─────┘           ▲        claims
#   real surfaces ──► spectrum, H, C0 ────────────────────────────────┘        report
#
# The rules of a stage are in rules/<stage>.smk, their scripts are scripts/<stage>/<rule>.py, and their
# results are in results/<fidelity>/<stage>/.

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
include: "rules/resources.smk"
include: "rules/surfaces.smk"
include: "rules/contact.smk"
include: "rules/persson.smk"
include: "rules/fits.smk"
include: "rules/cases.smk"
include: "rules/adhesion.smk"
include: "rules/real_surfaces.smk"
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
    "verdicts": expand(f"{RESULTS}/criteria/verdicts.{{kind}}", kind=["html", "md", "csv", "xlsx"]),
    "experiments": [
        f"{RESULTS}/experiments/experiments.md",
        f"{RESULTS}/figures/experiments.png",
    ],
    "claims": f"{RESULTS}/claims/claims.md",
    "report": f"{RESULTS}/report/report.html",
    "findings": f"{RESULTS}/report/findings.md",
    "surfaces": expand(f"{RESULTS}/report/surfaces/{{surface}}.html", surface=REAL_SURFACES),
    "cases": expand(f"{RESULTS}/cases/{{case}}.nc", case=CASES),
    "stability": f"{RESULTS}/figures/stability.png",
    "dmt_error": f"{RESULTS}/adhesion/dmt_error.csv",
    "remaining_measured": f"{REMAINING}/remaining.csv",
    "heights_measured": f"{REMAINING}/heights.csv",
    "limits_calibrated": [f"{LIMITS}/limits.csv", f"{RESULTS}/figures/limits.png"],
    "limits_measured": expand(f"{LIMITS}/{{kind}}.csv", kind=SIMULATED_SETS),
    "tradeoff": expand(
        f"{TRADEOFF}/{{file}}",
        file=["tradeoff.md", "tradeoff.png"],
    ),
}


# The report shows the claims, which need the paper's surfaces.
ALL = (*FIGURES, "verdicts", "experiments", "surfaces")
ALL += ("claims", "report", "findings") if REAL_SURFACES.keys() >= set(PAPER_SURFACES) else ()


rule all:
    input:
        [TARGETS[target] for target in ALL],
        f"{RESULTS}/fits/a_v_table.nc",


for target, files in TARGETS.items():

    rule:
        name:
            target
        input:
            files,


save_cache()
