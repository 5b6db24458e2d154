"""One self-contained page: figures, claims, verdicts, errors, run times and provenance."""

from pathlib import Path

import _captions
import _report
from _job import start
from stickiness import datasets

CLAIMS = ("statement", "quantity", "value", "uncertainty", "claimed", "verdict", "sources")
VERDICTS = ("margin", "modulus_threshold", "simulated", "verdict", "disagrees", "a_v", "a_v_low")
SURFACES = ("h_rms", "hurst", "q0", "q1", "C0_reference_upper")
COMPARISONS = ("area_fraction_difference", "mean_gap_difference", "attractive_area_difference")
ENSEMBLES = ("area_fraction_mean", "mean_gap_mean", "attractive_area_mean", "residual")


def main(job):
    captions = [Path(path).read_text(encoding="utf-8") for path in job.input.captions]
    page = render(
        job.input.template,
        claims=datasets.read(job.input.claims, CLAIMS),
        verdicts=datasets.read(job.input.verdicts, VERDICTS),
        ensembles=[datasets.read(path, ENSEMBLES) for path in job.input.ensembles],
        comparisons=[datasets.read(path, COMPARISONS) for path in job.input.comparisons],
        surfaces={Path(path).stem: datasets.read(path, SURFACES) for path in job.input.surfaces},
        figures=[_captions.figure(*pair) for pair in zip(job.input.figures, captions, strict=True)],
        benchmarks=job.params.benchmarks,
        fidelity=job.params.fidelity,
    )
    with datasets.whole_file(job.output[0]) as path:
        path.write_text(page, encoding="utf-8")


def render(
    template,
    *,
    claims,
    verdicts,
    ensembles,
    comparisons,
    surfaces,
    figures,
    benchmarks,
    fidelity,
):
    """The page as text, from datasets and figures that have been read."""
    return _captions.template_of(template).render(
        fidelity=fidelity,
        summary=_report.summary(claims, verdicts, ensembles),
        figures=figures,
        claims=_report.claims_table(claims),
        errata=_report.errata_rows(claims),
        matrix=_report.verdict_matrix(verdicts, surfaces),
        disagreements=_report.disagreements(verdicts, surfaces),
        surfaces=_report.surface_rows(surfaces),
        budgets=_report.error_budgets(ensembles),
        comparisons=_report.theory_rows(comparisons),
        quantities=list(_report.QUANTITIES.values()),
        run_times=_report.run_times(benchmarks),
        provenance=_report.provenance(
            [claims, verdicts, *surfaces.values(), *ensembles], ensembles
        ),
    )


if __name__ == "__main__":
    main(start(globals(), "write_report"))
