"""Tabulate error and cost of every setting, fit the error models, choose presets, validate both."""

import itertools
from pathlib import Path

import numpy as np
import pandas as pd

import campaigns.verdicts
from common import committed, heights_table, remaining_models
from common import tradeoff_table as summary
from common.conventions import annotate
from common.job import start
from stickiness import datasets
from stickiness.accuracy.error_models import FULL, Surface, read_models, single_error, write_models
from stickiness.accuracy.quantities import MODELLED, columns_of
from stickiness.accuracy.settings import Problem, UnreachableError, cheapest
from stickiness.pages.rendering import write_page
from tradeoff.adhesion_table import tabulate_adhesion
from tradeoff.contact_table import DESCRIBED_SEEDS, make_pool, tabulate_contact
from tradeoff.fit_models import Records, fit_models
from tradeoff.presets import list_presets
from tradeoff.verdict_table import condense_verdicts

TRADEOFF_VARIABLES = {
    "row": "number",
    "problem": "contact without adhesion, full adhesion or pull-off",
    "quantity": "what the error is of",
    "setting": "what is varied",
    "value": "its value",
    "surface": "model surface",
    "pressure": "load over E* q0 h_rms",
    "error": "relative error that covers 90 % of single surfaces, or of means for seeds",
    "cost": "cost over that of a pair of transforms of 1024 x 1024 doubles",
}
COMMENT = """\
Error and cost models, fitted by the target tradeoff; scripts/stickiness/accuracy/ says how they
are read. To adopt a new measurement, copy it here and set the presets that it gives."""


def main(job):
    records = Records()
    for problem, paths, tabulate in (
        ("contact", job.input.contact, tabulate_contact),
        ("adhesion", job.input.adhesive, tabulate_adhesion),
        ("pull-off", job.input.pull_off, tabulate_adhesion),
    ):
        for path in paths:
            measured = datasets.read(path)
            records.start(problem, Path(path).stem, Surface.of(datasets.parameters(measured)))
            tabulate(measured, records)
    rows = pd.DataFrame(records.rows)
    models = fit_models(records.points)
    models |= {
        # The control of full adhesion is its DMT sum, in proportion to an attractive area.
        ("coarse_share", column): models["coarse_share", "attractive_area_0.1"]
        for part, column in [*models]
        if part == "fine_share" and ("coarse_share", column) not in models
    }
    title = "error and cost of every setting"
    parameters = {"surfaces": [Path(path).stem for path in job.input.contact]}
    table = annotate(rows.rename_axis("row").to_xarray(), **TRADEOFF_VARIABLES)
    datasets.write(table, job.output.dataset, title=title, parameters=parameters)
    medians = rows.groupby(summary.KEYS, sort=False)[["error", "cost"]].median().reset_index()
    verdicts = committed.read(job.input.verdicts, campaigns.verdicts.COLUMNS, "tradeoff")
    medians = pd.concat([medians, condense_verdicts(verdicts)], ignore_index=True)
    with datasets.whole_file(job.output.summary) as path:
        summary.write(path, medians)
    with datasets.whole_file(job.output.laws) as path:
        write_models(path, models, COMMENT)
    models = read_models(job.output.laws)  # as they are written, rounded
    presets = list_presets(
        models, job.params.presets, job.params.surface, job.params.descriptor_seeds
    )
    write_page(
        job.input.template,
        job.output.table,
        tables=summary.tables(medians),
        verdicts=summary.list_verdicts(medians),
        maps=verdicts["set"].nunique(),
        energies=job.params.energies,
        asked=job.params.presets,
        presets=presets,
        remaining_models=remaining_models.condense(heights_table.read(job.input.heights)),
        least_share=remaining_models.LEAST_SHARE,
        within=np.array(validate(models, job.input.validation, job.params.accuracies)),
    )


def validate(models, paths, accuracies):
    """Share of means from chosen settings that are within the accuracy, of every case in reach.

    The surfaces are ones that nothing was fitted to.
    """
    within = []
    # Quantities that cases of the validation ask for.
    validated = (("area",), ("mean_gap",), ("a_v",), ("area", "attractive_area"), MODELLED)
    for path in paths:
        measured = datasets.read(path)
        pool = make_pool(measured)
        loads = measured.pressure.values.tolist()
        surface = Surface.of(datasets.parameters(measured))
        for quantities, accuracy in itertools.product(validated, accuracies):
            problem = Problem(models, surface, loads, columns_of(quantities), DESCRIBED_SEEDS)
            try:
                chosen = cheapest(problem, accuracy)
            except UnreachableError:
                continue
            within.append(np.mean(find_worst_errors(pool, problem, chosen) <= accuracy))
    return within


def find_worst_errors(pool, problem, settings):
    """Largest error of each repetition over columns and loads, with what the tolerance adds."""
    errors = pool.draw(settings)
    worst = []
    for load, column in problem.points:
        solver = 0.0
        # Down to the tolerance of the measurement, which has no error beside itself.
        if settings.tolerance > FULL:
            solver = single_error(
                problem.models,
                "solver",
                column,
                problem.surface,
                load,
                tolerance=settings.tolerance,
            )
        worst.append(np.hypot(errors[column, load], solver))
    return np.max(worst, axis=0)


if __name__ == "__main__":
    main(start(globals()))
