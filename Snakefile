# Do two rough solids stick? From random surfaces to stickiness verdicts.
#
#   model surfaces ──► repulsive BEM ──► ensembles ──► a_V, kappa ──► criteria ──► figures
#        ├─ adhesive BEM ──► slopes, loops, error of the DMT limit ─────┤
#        └─ lattice spectrum ─► Persson's theory ──────┘               ▲           claims
#   real surfaces ──► PSD, H, C0 ──────────────────────────────────────┘           report

from snakemake.utils import min_version

min_version("9.0")


configfile: "config/config.yaml"


report: "report/workflow.rst"


include: "rules/common.smk"
include: "rules/surfaces.smk"
include: "rules/contact.smk"
include: "rules/persson.smk"
include: "rules/fits.smk"
include: "rules/adhesion.smk"
include: "rules/real_surfaces.smk"
include: "rules/criteria.smk"
include: "rules/figures.smk"
include: "rules/tradeoff.smk"
include: "rules/report.smk"
include: "rules/stability.smk"


localrules:
    all,
    fig1,
    fig2,
    fig3,
    fig4,
    fig5,
    fig6,
    fig7,
    fig8,
    fig9,
    fig10,
    claims,
    verdicts,
    surfaces,
    cases,
    tradeoff,
    dmt_error,
    report,
    stability,


rule all:
    default_target: True
    input:
        expand(f"{RESULTS}/figures/{{figure}}.png", figure=FIGURES),
        f"{RESULTS}/fits/a_v_table.nc",
        f"{RESULTS}/criteria/verdicts.md",
        f"{RESULTS}/claims/claims.md",
        f"{RESULTS}/report/report.html",
        expand(f"{RESULTS}/report/surfaces/{{real_surface}}.html", real_surface=REAL_SURFACES),


rule fig1:
    input:
        f"{RESULTS}/figures/fig1.png",


rule fig2:
    input:
        f"{RESULTS}/figures/fig2.png",


rule fig3:
    input:
        f"{RESULTS}/figures/fig3.png",


rule fig4:
    input:
        f"{RESULTS}/figures/fig4.png",


rule fig5:
    input:
        f"{RESULTS}/figures/fig5.png",


rule fig6:
    input:
        f"{RESULTS}/figures/fig6.png",


rule fig7:
    input:
        f"{RESULTS}/figures/fig7.png",


rule fig8:
    input:
        f"{RESULTS}/figures/fig8.png",


rule fig9:
    input:
        f"{RESULTS}/figures/fig9.png",


rule fig10:
    input:
        f"{RESULTS}/figures/fig10.png",


rule verdicts:
    input:
        f"{RESULTS}/criteria/verdicts.md",


rule surfaces:
    input:
        expand(f"{RESULTS}/report/surfaces/{{real_surface}}.html", real_surface=REAL_SURFACES),


rule dmt_error:
    input:
        f"{RESULTS}/adhesion/dmt_error.csv",


rule claims:
    input:
        f"{RESULTS}/claims/claims.md",


rule cases:
    input:
        expand(f"{RESULTS}/cases/{{case}}.nc", case=CASES),


rule tradeoff:
    input:
        f"{TRADEOFF}/tradeoff.md",
        f"{TRADEOFF}/presets.md",
        f"{TRADEOFF}/validation.md",
        f"{TRADEOFF}/tradeoff.png",


rule report:
    input:
        f"{RESULTS}/report/report.html",


rule stability:
    input:
        f"{RESULTS}/figures/stability.png",
