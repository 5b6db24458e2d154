# Claims ledger and report: both read everything that came before.


rule check_claims:
    input:
        **ledger_inputs(),
        library=library_of("claims/check_claims.py"),
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
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=1000,
    script:
        "../scripts/claims/check_claims.py"


rule write_report:
    input:
        library=library_of("report/write_report.py"),
        template="report/report.html.j2",
        parts=PAGE_PARTS,
        figures=expand(f"{RESULTS}/figures/{{figure}}.png", figure=FIGURES),
        captions=expand("report/{figure}.rst", figure=FIGURES),
        claims=f"{RESULTS}/claims/claims.nc",
        verdicts=f"{RESULTS}/criteria/verdicts.nc",
        ensembles=expand(f"{RESULTS}/contact/ensembles/{{case}}.nc", case=COMPLETE),
        comparisons=expand(f"{RESULTS}/fits/theory/{{case}}.nc", case=COMPLETE),
        surfaces=expand(f"{RESULTS}/real_surfaces/{{real_surface}}.nc", real_surface=REAL_SURFACES),
        answers=expand(f"{RESULTS}/cases/{{case}}.nc", case=CASES),
        laws=config["tradeoff"]["table"],
        trade=config["tradeoff"]["summary"],
        trade_figure=f"{RESULTS}/figures/tradeoff.png",
        trade_caption="report/tradeoff.rst",
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
    conda:
        "../envs/environment.yaml"
    resources:
        mem_mb=500,
    params:
        benchmarks=BENCHMARKS,
        presets={
            "fidelities": config["fidelities"],
            "asked": TRADE["presets"],
            "surface": config["model_surfaces"].get(TRADE["presets"]["surface"]),
            "descriptor_seeds": config["sampling"]["descriptor_seeds"],
        },
        fidelity=config["fidelity"],
        figure_sources={figure: data_of(f"plot_{figure}") for figure in FIGURES},
    script:
        "../scripts/report/write_report.py"
