# The claims of the paper, each recomputed and given a verdict.

from common.paper_claims import find_differences
from snakemake.exceptions import WorkflowError

# Surfaces that the paper speaks of. A table of one's own may lack them.
PAPER_SURFACES = ("asphalt", "polished_steel")


def paper_surface(name):
    """Input function: the file of one of them."""

    def find(wildcards):
        if name not in REAL_SURFACES:
            raise WorkflowError(f"{config['surfaces']}: the claims need the surface {name!r}")
        return f"{RESULTS}/real_surfaces/{name}.nc"

    return find


def ledger_inputs():
    """Files behind the claims, by the names that the claims in scripts/claims use."""
    parts = plan.seed_batches(len(seeds_of("H0.8_zeta64")))
    return {
        "kappa_64": f"{RESULTS}/fits/kappa/H0.8_zeta64.nc",
        "kappa_128": f"{RESULTS}/fits/kappa/H0.8_zeta128.nc",
        "kappa_wide": f"{RESULTS}/fits/kappa/H0.8_zeta32_wide.nc",
        "lattice_128": f"{RESULTS}/persson/lattice/H0.8_zeta128.nc",
        "lattice_wide": f"{RESULTS}/persson/lattice/H0.8_zeta32_wide.nc",
        "fit_lattice_128": f"{RESULTS}/fits/a_v/lattice/H0.8_zeta128.nc",
        "ensemble_wide": f"{RESULTS}/contact/ensembles/H0.8_zeta32_wide.nc",
        "fit_bem_wide": a_v_of_simulation("H0.8_zeta32_wide"),
        "fit_bem_64": a_v_of_simulation("H0.8_zeta64"),
        "fit_bem_128": a_v_of_simulation("H0.8_zeta128"),
        **{f"fig{n}": f"{RESULTS}/persson/sweeps/fig{n}.nc" for n in ("1b", "3a", "3b", "3d")},
        **{f"fit_fig{n}": f"{RESULTS}/fits/a_v/sweeps/fig{n}.nc" for n in ("3a", "3c", "3d")},
        "loop": f"{RESULTS}/adhesion/loops/fig4a.nc",
        "adhesive_fig2": f"{RESULTS}/adhesion/full/fig2.nc",
        "adhesive_sets": [f"{RESULTS}/adhesion/full/fig4b_{name}.nc" for name in FIG4B],
        "adhesion_fig2": f"{RESULTS}/adhesion/dmt/fig2.nc",
        "adhesion_sets": [f"{RESULTS}/adhesion/dmt/fig4b_{name}.nc" for name in FIG4B],
        "map": f"{RESULTS}/criteria/map.nc",
        "verdicts": f"{RESULTS}/criteria/verdicts.nc",
        **{name: paper_surface(name) for name in PAPER_SURFACES},
        "remaining": REMAINING_TABLE,
        "experiments": f"{RESULTS}/experiments/experiments.nc",
        "measured_surfaces": several("real_surfaces/{surface}.nc", surface=MEASURED_SURFACES),
        "seeds": [surfaces_of("H0.8_zeta64", part) for part in parts],
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
    script:
        "../scripts/claims/check_claims.py"
