# Claims ledger and report: both read everything that came before.


def ledger_inputs():
    """Files behind the claims, by the names that scripts/_claims.py uses."""
    return {
        "kappa_64": f"{RESULTS}/fits/kappa/H0.8_zeta64.nc",
        "kappa_128": f"{RESULTS}/fits/kappa/H0.8_zeta128.nc",
        "ensemble_wide": f"{RESULTS}/ensembles/H0.8_zeta32_wide.nc",
        "fit_bem_wide": f"{RESULTS}/fits/ensembles/H0.8_zeta32_wide.nc",
        "fit_bem_128": f"{RESULTS}/fits/ensembles/H0.8_zeta128.nc",
        **{f"fig{n}": f"{RESULTS}/persson/fig{n}.nc" for n in ("1b", "3a", "3b", "3c", "3d")},
        **{f"fit_fig{n}": f"{RESULTS}/fits/persson/fig{n}.nc" for n in ("3a", "3c", "3d")},
        "adhesion_fig2": f"{RESULTS}/adhesion/fig2.nc",
        "adhesion_rough": f"{RESULTS}/adhesion/fig4b_rough.nc",
        "adhesion_smooth": f"{RESULTS}/adhesion/fig4b_smooth.nc",
        "map": f"{RESULTS}/criteria/map.nc",
        "asphalt": f"{RESULTS}/real_surfaces/asphalt.nc",
        "polished_steel": f"{RESULTS}/real_surfaces/polished_steel.nc",
        "surfaces": [f"{RESULTS}/real_surfaces/{name}.nc" for name in REAL_SURFACES],
        "seeds": [
            f"{RESULTS}/surfaces/H0.8_zeta64/seed{seed}.nc" for seed in seeds_of("H0.8_zeta64")
        ],
    }


rule check_claims:
    input:
        **ledger_inputs(),
        library=library_of("check_claims.py"),
    output:
        dataset=f"{RESULTS}/claims/claims.nc",
        table=report(
            f"{RESULTS}/claims/claims.md",
            category="Claims",
            caption="../report/claims.rst",
        ),
    log:
        f"{LOGS}/check_claims.log",
    benchmark:
        f"{BENCHMARKS}/check_claims.tsv"
    resources:
        mem_mb=1000,
    script:
        "../scripts/check_claims.py"


rule write_report:
    input:
        library=library_of("write_report.py"),
        template="report/report.html.j2",
        figures=expand(f"{RESULTS}/figures/{{figure}}.png", figure=FIGURES),
        captions=expand("report/{figure}.rst", figure=FIGURES),
        claims=f"{RESULTS}/claims/claims.nc",
        verdicts=f"{RESULTS}/criteria/verdicts.nc",
        ensembles=expand(f"{RESULTS}/ensembles/{{case}}.nc", case=CASES),
        surfaces=expand(f"{RESULTS}/real_surfaces/{{real_surface}}.nc", real_surface=REAL_SURFACES),
    output:
        report(
            f"{RESULTS}/report/report.html",
            category="Report",
            caption="../report/report.rst",
        ),
    log:
        f"{LOGS}/write_report.log",
    benchmark:
        f"{BENCHMARKS}/write_report.tsv"
    resources:
        mem_mb=500,
    params:
        benchmarks=BENCHMARKS,
        fidelity=config["fidelity"],
        materials=MATERIALS,
    script:
        "../scripts/write_report.py"
