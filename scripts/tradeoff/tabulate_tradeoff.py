"""Tabulate error and cost of every setting, fit the error models, choose presets, validate both."""

import itertools
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
from jinja2 import Environment, FileSystemLoader, StrictUndefined

from common import tradeoff_table as summary
from common.formatting import table as markdown_table
from common.job import start
from stickiness import datasets
from stickiness.accuracy.error_models import FULL, Surface, read_models, single_error, write_models
from stickiness.accuracy.quantities import MODELLED, columns_of
from stickiness.accuracy.settings import Problem, UnreachableError, cheapest
from tradeoff.adhesion_table import list_pull_offs, list_states, tabulate_adhesion
from tradeoff.contact_table import tabulate_contact
from tradeoff.fit_models import fit_models
from tradeoff.measuring import COVERED
from tradeoff.presets import list_presets
from tradeoff.seed_pool import DESCRIBED_SEEDS, Resampling, make_pool

TEXTS = {
    "row": ("1", "number"),
    "problem": ("1", "contact without adhesion, full adhesion or pull-off"),
    "quantity": ("1", "what the error is of"),
    "setting": ("1", "what is varied"),
    "value": ("1", "its value"),
    "surface": ("1", "model surface"),
    "pressure": ("1", "load over E* q0 h_rms"),
    "error": ("1", "relative error that covers 90 % of single surfaces, or of means for seeds"),
    "cost": ("1", "cost over that of a pair of transforms of 1024 x 1024 doubles"),
}
COMMENT = """\
Error and cost models, fitted by the target tradeoff; scripts/stickiness/accuracy/ says how they
are read. To take a new measurement over, copy it here and set the presets that it gives."""
VALIDATED = {
    "area": ("area",),
    "mean gap": ("mean_gap",),
    "a_V": ("a_v",),
    "area, attractive area": ("area", "attractive_area"),
    "everything": MODELLED,
}


def main(job):
    records = summary.Records()
    for problem, paths, tabulate, *given in (
        ("contact", job.input.contact, tabulate_contact),
        ("adhesion", job.input.adhesive, tabulate_adhesion, list_states),
        ("pull-off", job.input.pull_off, tabulate_adhesion, list_pull_offs),
    ):
        for path in paths:
            measured = datasets.read(path)
            records.start(problem, Path(path).stem, Surface.of(datasets.parameters(measured)))
            tabulate(measured, *given, records)
    found = pd.DataFrame(records.rows, columns=summary.COLUMNS)
    datasets.write(
        datasets.annotate(found.rename_axis("row").to_xarray(), **TEXTS),
        job.output.dataset,
        title="error and cost of every setting",
        parameters={"surfaces": [Path(path).stem for path in job.input.contact]},
    )
    medians, models = summary.take_medians(found), fit_models(records.points)
    models |= {
        # The control of full adhesion is its DMT limit, in proportion to an attractive area.
        ("coarse_share", column): models["coarse_share", "attractive_area_0.1"]
        for part, column in [*models]
        if part == "fine_share" and ("coarse_share", column) not in models
    }
    with datasets.whole_file(job.output.summary) as path:
        summary.write(path, medians)
    with datasets.whole_file(job.output.laws) as path:
        write_models(path, models, COMMENT)

    # Presets and validation use the models as they are written, rounded.
    models, template = read_models(job.output.laws), Path(job.input.template)
    environment = Environment(
        loader=FileSystemLoader(template.parent), undefined=StrictUndefined, trim_blocks=True
    )
    environment.globals["table"] = markdown_table
    for output, values in (
        (job.output.table, {"tables": list(summary.tables(medians))}),
        (job.output.presets, list_presets(models, **job.params.presets)),
        (job.output.validation, validate(models, job.input.validation, job.params.accuracies)),
    ):
        with datasets.whole_file(output) as path:
            part = Path(output).stem
            text = environment.get_template(template.name).render(part=part, **values)
            path.write_text(text, encoding="utf-8")


def validate(models, paths, accuracies):
    """Compare means from chosen settings with the truth on surfaces that nothing was fitted to."""
    rows = []
    for path in paths:
        measured = datasets.read(path)
        surface, (pool, _) = Surface.of(datasets.parameters(measured)), make_pool(measured)
        resampling, loads = Resampling(pool), measured.pressure.values.tolist()
        for (text, quantities), asked in itertools.product(VALIDATED.items(), accuracies):
            problem = Problem(models, surface, loads, columns_of(quantities), DESCRIBED_SEEDS)
            rows.append({"surface": Path(path).stem, "quantities": text, "accuracy": asked})
            try:
                chosen = cheapest(problem, asked)
            except UnreachableError:
                continue
            errors = find_worst_errors(resampling, problem, chosen)
            saved, tolerance = models["tolerance_cost", ""], chosen.tolerance / FULL
            cost = pool.cost(chosen) * (saved(surface, tolerance=tolerance) if tolerance > 1 else 1)
            rows[-1] |= vars(chosen) | {
                "within": np.mean(errors <= asked),
                "error": np.quantile(errors, COVERED),
                "cost": cost,
            }
    found = pd.DataFrame(rows)
    lines = found.map(lambda x: x if isinstance(x, str) else f"{x:.3g}").values.tolist()
    return {"head": list(found.columns), "lines": lines, "within": found.within.dropna()}


def find_worst_errors(resampling, problem, settings):
    """Largest error of each repetition over columns and loads, with what the tolerance adds."""
    errors = resampling.draw(replace(settings, tolerance=FULL))
    worst = []
    for load, column in problem.points:
        at = problem.models, "solver", column, problem.surface, load
        # Down to the tolerance of the measurement, which has no error beside itself.
        measured = settings.tolerance <= FULL
        solver = 0.0 if measured else single_error(*at, tolerance=settings.tolerance)
        worst.append(np.hypot(errors[column, load], solver))
    return np.max(worst, axis=0)


if __name__ == "__main__":
    main(start(globals(), "tabulate_tradeoff"))
