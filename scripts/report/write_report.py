"""One self-contained page: figures, claims, verdicts, errors, run times and provenance."""

from pathlib import Path

from pipeline.job import start
from pipeline.pages import benchmarks as _benchmarks
from pipeline.pages import captions as _captions
from pipeline.pages import provenance, report
from pipeline.tradeoff import summary
from stickiness.accuracy.error_models import read_models
from stickiness.accuracy.quantities import MODELLED
from stickiness.core import datasets

CLAIMS = ("statement", "quantity", "value", "value_error", "claimed", "verdict", "sources")
VERDICTS = (
    "margin",
    "margin_total_error",
    "modulus_threshold",
    "modulus_threshold_low",
    "probability",
    "simulated",
    "verdict",
    "disagrees",
    "a_v",
    "a_v_low",
)
SURFACES = ("h_rms", "hurst", "hurst_total_error", "q0", "q1", "C0_reference_upper")
COMPARISONS = ("area_fraction_difference", "mean_gap_difference", "attractive_area_difference")
ANSWERS = ("value", "value_error", "value_total_error", "value_dominant")
ENSEMBLES = ("area_fraction_mean", "mean_gap_mean", "attractive_area_mean", "residual")


def main(job):
    captions = [Path(path).read_text(encoding="utf-8") for path in job.input.captions]
    page = render(
        job.input.template,
        job.output[0],
        files={
            "claims": job.input.claims,
            "verdicts": job.input.verdicts,
            "figures": job.params.figure_sources,
            **{
                group: by_name(job.input[group])
                for group in ("ensembles", "answers", "comparisons", "surfaces")
            },
        },
        figures=[_captions.figure(*pair) for pair in zip(job.input.figures, captions, strict=True)],
        benchmarks=job.params.benchmarks,
        fidelity=job.params.fidelity,
        trade={
            "figure": _captions.figure(
                job.input.trade_figure,
                Path(job.input.trade_caption).read_text(encoding="utf-8"),
            ),
            "source": job.input.trade,
            "tables": report.trade_tables(summary.read(job.input.trade)),
        },
        presets=report.preset_rows(read_models(job.input.laws), **job.params.presets),
        **read(job.input),
    )
    with datasets.whole_file(job.output[0]) as path:
        path.write_text(page, encoding="utf-8")


def by_name(paths):
    """Paths by the names of their files, which are those of cases or surfaces."""
    return {Path(path).stem: path for path in paths}


def read(inputs):
    """The datasets that the page is made of."""
    return {
        "claims": datasets.read(inputs.claims, CLAIMS),
        "verdicts": datasets.read(inputs.verdicts, VERDICTS),
        "ensembles": [datasets.read(path, ENSEMBLES) for path in inputs.ensembles],
        "answers": [datasets.read(path, ANSWERS) for path in inputs.answers],
        "comparisons": [datasets.read(path, COMPARISONS) for path in inputs.comparisons],
        "surfaces": {
            name: datasets.read(path, SURFACES) for name, path in by_name(inputs.surfaces).items()
        },
    }


def render(
    template,
    page,
    *,
    files,
    claims,
    verdicts,
    ensembles,
    answers,
    presets,
    trade,
    comparisons,
    surfaces,
    figures,
    benchmarks,
    fidelity,
):
    """The page as text, from datasets and figures that have been read.

    `files` says where they were read from: paths of `claims` and `verdicts`, and paths by name of
    `surfaces`, `ensembles`, `answers`, `comparisons` and, a list for each, of the `figures`.
    `trade` is what accuracy costs: its figure, a table for each knob, and the `source` of both.
    """
    return _captions.template_of(template, page).render(
        fidelity=fidelity,
        files_of=files,
        summary=report.summary(claims, verdicts, ensembles),
        figures=figures,
        claims=report.claim_rows(claims),
        errata=report.errata_rows(claims),
        matrix=report.verdict_matrix(verdicts, surfaces),
        disagreements=report.disagreements(verdicts, surfaces),
        surfaces=report.surface_rows(surfaces),
        budgets=report.error_budgets(answers),
        presets=presets,
        trade=trade,
        asked_quantities=list(MODELLED),
        comparisons=report.theory_rows(comparisons),
        quantities=list(report.QUANTITIES.values()),
        run_times=_benchmarks.run_times(benchmarks),
        provenance=provenance.provenance(
            [claims, verdicts, *surfaces.values(), *ensembles], ensembles
        ),
    )


if __name__ == "__main__":
    main(start(globals(), "write_report"))
