# The claims of the paper, each recomputed and given a verdict.

from common.paper import find_differences
from snakemake.exceptions import WorkflowError

# Surfaces that the paper speaks of. A table of one's own may lack them.
PAPER_SURFACES = ("asphalt", "polished_steel")


def paper_surface(name):
    """Input function: the file of one of them."""

    def find(wildcards):
        if name not in REAL_SURFACES:
            raise WorkflowError(f"{config['surfaces']}: the claims need the surface {name!r}")
        return ANALYSED.format(real_surface=name)

    return find


def ledger_inputs():
    """Files behind the claims, by the names that the claims in scripts/claims use."""
    return {
        "kappa_middle_band": f"{RESULTS}/fits/kappa/{ROLES.middle_band}.nc",
        "kappa_broad_band": f"{RESULTS}/fits/kappa/{ROLES.broad_band}.nc",
        "kappa_wide_cell": f"{RESULTS}/fits/kappa/{ROLES.wide_cell}.nc",
        "lattice_broad_band": f"{RESULTS}/persson/lattice/{ROLES.broad_band}.nc",
        "lattice_wide_cell": f"{RESULTS}/persson/lattice/{ROLES.wide_cell}.nc",
        "fit_lattice_broad_band": f"{RESULTS}/fits/a_v/lattice/{ROLES.broad_band}.nc",
        "ensemble_wide_cell": f"{RESULTS}/contact/ensembles/{ROLES.wide_cell}.nc",
        "fit_bem_wide_cell": a_v_of_simulation(ROLES.wide_cell),
        "fit_bem_middle_band": a_v_of_simulation(ROLES.middle_band),
        "fit_bem_broad_band": a_v_of_simulation(ROLES.broad_band),
        **{f"fig{n}": f"{RESULTS}/persson/sweeps/fig{n}.nc" for n in ("1b", "3a", "3b", "3d")},
        **{f"fit_fig{n}": f"{RESULTS}/fits/a_v/sweeps/fig{n}.nc" for n in ("3a", "3c", "3d")},
        "loop": f"{RESULTS}/adhesion/loops/fig4a.nc",
        "adhesive_fig2": f"{RESULTS}/adhesion/full/fig2.nc",
        "adhesive_sets": [f"{RESULTS}/adhesion/full/fig4b_{name}.nc" for name in FIG4B],
        "adhesion_fig2": f"{RESULTS}/adhesion/dmt/fig2.nc",
        "adhesion_sets": [f"{RESULTS}/adhesion/dmt/fig4b_{name}.nc" for name in FIG4B],
        "map": rules.map_criterion.output.map,
        "verdicts": rules.judge.output.dataset,
        **{name: paper_surface(name) for name in PAPER_SURFACES},
        "remaining": REMAINING_TABLE,
        "experiments": rules.predict_experiments.output.dataset,
        "measured_surfaces": analysed(MEASURED_SURFACES),
        "seeds": lambda wildcards: surfaces_of(ROLES.middle_band, seeds_of(ROLES.middle_band)),
    }


rule check_claims:
    input:
        **ledger_inputs(),
        prose=project_file("report/claims.j2"),
        page=project_file("report/claims.md.j2"),
        errata=project_file("report/errata.j2"),
        legend=project_file("report/claim_verdicts.j2"),
    output:
        dataset=f"{RESULTS}/claims/claims.nc",
        table=report(
            f"{RESULTS}/claims/claims.md",
            category="Claims",
            caption="../report/claims.rst",
        ),
    log:
        f"{RESULTS}/logs/check_claims/claims/claims.log",
    benchmark:
        f"{RESULTS}/benchmarks/check_claims/claims/claims.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        differences=find_differences(config, REAL_SURFACES),
        code=source_hash("claims/check_claims.py"),
    message:
        "Check the claims of the paper"
    script:
        "../scripts/claims/check_claims.py"
