# The report of all results, and for every real surface its verdicts and a page.

from common.paper import compare_panels


def figure_sources(wildcards, output):
    """Datasets that each figure shows."""
    # A module may put the results below a prefix, which parameters lack.
    moved = f"{Path(output[0]).parents[2]}/"
    return {
        figure: [
            re.sub(f"^{re.escape(SHARED_RESULTS)}/", lambda _: moved, str(file))
            for files in FIGURE_INPUTS[figure].values()
            for file in ([files] if isinstance(files, str) else files)
        ]
        for figure in FIGURES
    }


rule write_report:
    input:
        template=project_file("report/report.html.j2"),
        parts=[
            *PAGE_PARTS,
            project_file("report/errata.j2"),
            project_file("report/panels.j2"),
            project_file("report/claim_verdicts.j2"),
        ],
        figures=several("figures/{figure}.png", figure=FIGURES),
        captions=[project_file(f"report/{figure}.rst") for figure in FIGURES],
        claims=f"{RESULTS}/claims/claims.nc",
        verdicts=f"{RESULTS}/criteria/verdicts.nc",
        criterion=f"{RESULTS}/criteria/map.nc",
        experiments=f"{RESULTS}/experiments/experiments.nc",
        adhesive_maps=f"{RESULTS}/adhesion/full/fig2/maps.nc",
        experiments_figure=f"{RESULTS}/figures/experiments.png",
        experiments_caption=project_file("report/experiments.rst"),
        ensembles=several("contact/ensembles/{case}.nc", case=COMPLETE),
        comparisons=several("fits/theory/{case}.nc", case=COMPLETE),
        surfaces=analysed(REAL_SURFACES),
        answers=several("cases/{case}.nc", case=CASES),
        laws=ERROR_MODELS,
        heights=HEIGHTS_TABLE,
        trade=TRADE_SUMMARY,
        trade_figure=f"{RESULTS}/figures/tradeoff.png",
        trade_caption=project_file("report/tradeoff.rst"),
    output:
        report(
            f"{RESULTS}/report/report.html",
            category="Report",
            caption="../report/report.rst",
        ),
    log:
        f"{RESULTS}/logs/write_report/report/report.log",
    benchmark:
        f"{RESULTS}/benchmarks/write_report/report/report.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        presets=PRESETS,
        materials=MATERIALS,
        surfaces=REAL_SURFACES,
        fidelity=config["fidelity"],
        figure_sources=figure_sources,
        panels=compare_panels(config),
        code=source_hash("report/write_report.py"),
    message:
        "Write the report of all results"
    script:
        "../scripts/report/write_report.py"


rule write_surface:
    input:
        parts=[
            *PAGE_PARTS,
            *(
                project_file(f"scripts/stickiness/pages/templates/{part}.html.j2")
                for part in ("surface", "thresholds", "reasons")
            ),
        ],
        surface=ANALYSED,
        verdicts=f"{RESULTS}/criteria/verdicts/{{real_surface}}.nc",
    output:
        page=report(
            f"{RESULTS}/report/surfaces/{{real_surface}}.html",
            category="Surfaces",
            caption="../report/surface.rst",
        ),
    log:
        f"{RESULTS}/logs/write_surface/report/surfaces/{{real_surface}}.log",
    benchmark:
        f"{RESULTS}/benchmarks/write_surface/report/surfaces/{{real_surface}}.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        surface=lambda wildcards: REAL_SURFACES[wildcards.real_surface],
        code=source_hash("report/write_surface.py"),
    message:
        "Write the page of a surface: {wildcards.real_surface}"
    script:
        "../scripts/report/write_surface.py"


rule write_findings:
    input:
        template=project_file("report/findings.md.j2"),
        parts=[
            project_file("scripts/stickiness/pages/templates/left_out.j2"),
            project_file("report/panels.j2"),
            project_file("report/claim_verdicts.j2"),
        ],
        adhesive_maps=f"{RESULTS}/adhesion/full/fig2/maps.nc",
        claims=f"{RESULTS}/claims/claims.nc",
        a_v=several("fits/a_v/ensembles/{case}.nc", case=COMPLETE),
        lattices=several("fits/a_v/lattice/{case}.nc", case=COMPLETE),
        gamma=f"{RESULTS}/fits/gamma.nc",
        dmt_error=f"{RESULTS}/adhesion/full/dmt_error.nc",
        edges=several("adhesion/edges/{adhesion}.nc", adhesion=SIMULATED_IN_FULL),
        remaining=REMAINING_TABLE,
        heights=HEIGHTS_TABLE,
        verdicts=f"{RESULTS}/criteria/verdicts.nc",
        criterion=f"{RESULTS}/criteria/map.nc",
        experiments=f"{RESULTS}/experiments/experiments.nc",
        tradeoff=TRADE_SUMMARY,
    output:
        f"{RESULTS}/report/findings.md",
    log:
        f"{RESULTS}/logs/write_findings/report/findings.log",
    benchmark:
        f"{RESULTS}/benchmarks/write_findings/report/findings.tsv"
    conda:
        "../envs/environment.yaml"
    params:
        fidelity=config["fidelity"],
        panels=compare_panels(config),
        code=source_hash("report/write_findings.py"),
    message:
        "Write the findings"
    script:
        "../scripts/report/write_findings.py"
