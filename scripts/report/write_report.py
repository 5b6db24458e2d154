"""One self-contained page: figures, claims, verdicts, errors, run times and provenance."""

from pathlib import Path

from common.job import start
from experiments import outcomes as experiments
from report import captions, interactive
from report import report_parts as report
from report.benchmarks import run_times
from report.pairs_figure import draw_pairs
from report.provenance import describe_provenance
from stickiness import datasets
from stickiness.accuracy.error_models import read_models
from stickiness.accuracy.quantities import COLUMNS, MODELLED
from tradeoff import summary

NEEDED_VARIABLES = {
    "claims": ("statement", "quantity", "value", "value_error", "claimed", "verdict", "sources"),
    "verdicts": (
        *("margin", "margin_total_error", "modulus_threshold", "modulus_threshold_low"),
        *(
            "remaining",
            "pull_off",
            "energy_ratio",
            "probability",
            "verdict",
            "disagrees",
        ),
    ),
    "criterion": ("a_v", "a_v_low", "a_v_high"),
    "surfaces": ("h_rms", "hurst", "hurst_total_error", "q0", "q1", "C0_reference_upper"),
    "experiments": ("quantity", "outcome", "criterion_outcome", "remaining", "work_of_approach"),
    "ensembles": ("area_fraction_mean", "mean_gap_mean", "attractive_area_mean", "residual"),
    "answers": ("value", "value_error", "value_total_error", "value_dominant"),
    "comparisons": tuple(f"{name}_difference" for name in report.QUANTITIES),
}


def main(job):
    inputs, params = job.input, job.params
    page = render(
        inputs.template,
        job.output[0],
        read_results(inputs, params.figure_sources),
        figures=list(map(embed, inputs.figures, inputs.captions)),
        experiments_figure=embed(inputs.experiments_figure, inputs.experiments_caption),
        tradeoff={
            "figure": embed(inputs.trade_figure, inputs.trade_caption),
            "source": inputs.trade,
            "tables": report.head_tables(summary.read(inputs.trade)),
            "presets": report.describe_presets(read_models(inputs.laws), **params.presets),
        },
        benchmarks=params.benchmarks,
        fidelity=params.fidelity,
    )
    with datasets.whole_file(job.output[0]) as path:
        path.write_text(page, encoding="utf-8")


def embed(figure, caption):
    return captions.embed_figure(figure, Path(caption).read_text(encoding="utf-8"))


def read_results(inputs, figure_sources):
    """The datasets that the page is made of, with their paths."""
    paths, contents = {"figures": figure_sources}, {}
    for kind, variables in NEEDED_VARIABLES.items():
        if isinstance(inputs[kind], str):
            paths[kind], contents[kind] = inputs[kind], datasets.read(inputs[kind], variables)
        else:
            paths[kind] = {Path(path).stem: path for path in inputs[kind]}
            contents[kind] = {n: datasets.read(p, variables) for n, p in paths[kind].items()}
    for kind in ("ensembles", "answers", "comparisons"):
        contents[kind] = list(contents[kind].values())
    return report.Results(**contents, paths=paths)


def render(template, page, results, *, figures, experiments_figure, tradeoff, benchmarks, fidelity):
    """The page as text.

    `results` are the datasets as `report.Results`, `figures` and `experiments_figure` as
    `captions.embed_figure` makes them;
    `tradeoff` is what accuracy costs: its `figure`, a table for each knob (`tables`), the `source`
    of both, and `presets`; `benchmarks` is the folder of Snakemake's benchmark files.
    """
    claims, verdicts, surfaces = results.claims, results.verdicts, results.surfaces
    matrix = report.arrange_verdicts(verdicts, surfaces)
    data = [claims, verdicts, results.experiments, *surfaces.values(), *results.ensembles]
    return captions.template_of(template, page).render(
        fidelity=fidelity,
        files_of=results.paths,
        answers=report.answer_own(verdicts, surfaces),
        summary=report.summarise(claims, verdicts, results.criterion, results.ensembles),
        figures=figures,
        claims=[report.describe_claim(claims.sel(claim=number)) for number in claims.claim.values],
        errata=report.describe_errata(claims),
        matrix=matrix,
        library=interactive.library(),
        every_pair=interactive.embed(draw_pairs(verdicts, matrix["pairs"])),
        disagreements=report.find_disagreements(verdicts, surfaces),
        experiments=experiments.describe(results.experiments) | {"figure": experiments_figure},
        surfaces=[report.describe_surface(name, data) for name, data in surfaces.items()],
        budgets=list(map(report.describe_budgets, results.answers)),
        tradeoff=tradeoff,
        asked_quantities=[name_quantity(name) for name in MODELLED],
        comparisons=report.compare_theory(results.comparisons),
        quantities=list(report.QUANTITIES.values()),
        run_times=run_times(benchmarks),
        provenance=describe_provenance(data, results.ensembles),
    )


def name_quantity(name):
    """A quantity as a reader knows it; one of several columns has no label of its own."""
    return COLUMNS[name].label if name in COLUMNS else name.replace("_", " ")


if __name__ == "__main__":
    main(start(globals(), "write_report"))
