"""Tabulate error and cost of every setting, fit the error models, choose presets, validate both."""

import itertools
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
from jinja2 import Environment, FileSystemLoader, StrictUndefined

from common.formatting import table as markdown_table
from common.job import start
from stickiness import datasets
from stickiness.accuracy import plan
from stickiness.accuracy.error_models import (
    COARSE,
    FULL,
    Surface,
    read_models,
    single_error,
    write_models,
)
from stickiness.accuracy.prediction import Problem, predicted_cost, predicted_error
from stickiness.accuracy.quantities import MODELLED, columns_of
from stickiness.accuracy.settings import (
    ADHESIVE_COLUMNS,
    UnreachableError,
    adhesive_cost,
    adhesive_error,
    cheapest,
    preset_by_rule,
)
from tradeoff import summary
from tradeoff.adhesion_table import list_pull_offs, list_states, tabulate_adhesion
from tradeoff.contact_table import DESCRIBED_SEEDS, REPETITIONS, tabulate_contact
from tradeoff.fit_models import Points
from tradeoff.measuring import COVERED
from tradeoff.seed_pool import Resampling, make_pool

TEXTS = {
    "problem": ("1", "contact without adhesion, full adhesion or pull-off"),
    "quantity": ("1", "what the error is of"),
    "setting": ("1", "what is varied"),
    "value": ("1", "its value"),
    "surface": ("1", "model surface"),
    "pressure": ("1", "load over E* q0 h_rms"),
    "error": ("1", "relative error that covers 90 % of single surfaces, or of means for seeds"),
    "cost": ("1", "cost over that of a pair of transforms of 1024 x 1024 doubles"),
    "seconds": ("s", "processor time"),
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
    rows, points = [], Points()
    for path in job.input.contact:
        measured = datasets.read(path)
        rows += tabulate_contact(Path(path).stem, measured, make_pool(measured), points)
    for problem, paths, list_quantities in (
        ("adhesion", job.input.adhesive, list_states),
        ("pull-off", job.input.pull_off, list_pull_offs),
    ):
        for path in paths:
            measured = datasets.read(path)
            quantities = list_quantities(measured)
            rows += tabulate_adhesion(Path(path).stem, measured, quantities, problem, points)
    found = pd.DataFrame(rows, columns=summary.COLUMNS)
    datasets.write(
        datasets.annotate(found.rename_axis("row").to_xarray(), row=("1", "number"), **TEXTS),
        job.output.dataset,
        title="error and cost of every setting",
        parameters={"surfaces": [Path(path).stem for path in job.input.contact]},
    )
    medians = summary.take_medians(found)
    with datasets.whole_file(job.output.summary) as path:
        summary.write(path, medians)

    models = points.fit()
    models |= {
        # The control of full adhesion is its DMT limit, in proportion to an attractive area.
        ("coarse_share", column): models["coarse_share", "attractive_area_0.1"]
        for part, column in [*models]
        if part == "fine_share" and ("coarse_share", column) not in models
    }
    with datasets.whole_file(job.output.laws) as path:
        write_models(path, models, COMMENT)

    # Presets and validation use the models as they are written, rounded.
    models = read_models(job.output.laws)
    template = Path(job.input.template)
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


def list_presets(models, presets, surface, fidelities, descriptor_seeds):
    """List the presets that the rule gives and those of the configuration, with their errors."""
    where = models, Surface.of(surface), presets["pressures"]
    contact = Problem(*where, columns_of(MODELLED), descriptor_seeds)
    adhesion = Problem(*where, ADHESIVE_COLUMNS, descriptor_seeds)

    def row(text, chosen):
        errors = [
            max(error(problem, chosen, p, column) for p in problem.pressures)
            for error, problem in ((predicted_error, contact), (adhesive_error, adhesion))
            for column in problem.columns
        ]
        costs = predicted_cost(contact, chosen), adhesive_cost(adhesion, chosen)
        pixels, tolerance, seeds, coarse = vars(chosen).values()
        settings = [pixels, f"{tolerance:.0e}", seeds, coarse, *(f"{cost:.0f}" for cost in costs)]
        return [text, *settings, *map(summary.percent, errors)]

    lines = []
    for name, error in presets["accuracy"].items():
        by_rule = models, presets, name, surface, descriptor_seeds
        for text, free in ((f"{name}: below {error:.0%}", False), ("without full adhesion", True)):
            try:
                lines.append(row(text, preset_by_rule(*by_rule, free=free)))
            except UnreachableError as refusal:
                lines.append([f"{text}: out of reach, {refusal}"])
        lines.append(row("in the configuration", plan.preset(fidelities[name])))
    settings = "preset", "pixels", "tolerance", "seeds", "coarse seeds", "cost", "adhesive cost"
    head = [*settings, *contact.columns, *adhesion.columns]
    lines = [[*line, *[""] * (len(head) - len(line))] for line in lines]
    return {"asked": presets, "head": head, "lines": lines}


def validate(models, paths, accuracies):
    """Let cases ask for accuracies on surfaces that the models were not fitted to.

    Settings are chosen by the error models, and seeds are drawn from a pool of solved ones. Their
    mean is compared with that of all.
    """
    rows = []
    for path in paths:
        measured = datasets.read(path)
        surface, pool = Surface.of(datasets.parameters(measured)), make_pool(measured)
        resampling, loads = Resampling(pool, REPETITIONS, DESCRIBED_SEEDS), measured.pressure.values
        for (text, quantities), asked in itertools.product(VALIDATED.items(), accuracies):
            columns = columns_of(quantities)
            problem = Problem(models, surface, loads.tolist(), columns, DESCRIBED_SEEDS)
            row = {"surface": Path(path).stem, "quantities": text, "accuracy": asked}
            try:
                chosen = cheapest(problem, asked)
            except UnreachableError:
                rows.append(row)
                continue
            errors = find_worst_errors(resampling, problem, chosen)
            within, error = np.mean(errors <= asked), np.quantile(errors, COVERED)
            cost = measure_cost(measured, chosen, models["tolerance_cost", ""], surface)
            rows.append(row | vars(chosen) | {"within": within, "error": error, "cost": cost})
    found = pd.DataFrame(rows)
    lines = found.map(lambda x: x if isinstance(x, str) else f"{x:.3g}").values.tolist()
    return {"head": list(found.columns), "lines": lines, "within": found.within.dropna()}


def find_worst_errors(resampling, problem, settings):
    """Largest error of each repetition over columns and loads, with what the tolerance adds."""
    drawn, _ = resampling.draw(replace(settings, tolerance=FULL))
    errors = resampling.pool.by_quantity(drawn)

    def solver_error(load, column):
        if settings.tolerance <= FULL:  # the tolerance of the measurement
            return 0.0
        at = problem.models, "solver", column, problem.surface, load
        return single_error(*at, tolerance=settings.tolerance)

    return np.max(
        [np.hypot(errors[column, at], solver_error(at, column)) for at, column in problem.points],
        axis=0,
    )


def measure_cost(measured, settings, tolerance_cost, surface):
    """Measured cost of a case for all its loads; a model says what a larger tolerance saves."""
    pixels, tolerance = settings.pixels_per_wavelength, settings.tolerance / FULL
    saved = tolerance_cost(surface, tolerance=tolerance) if tolerance > 1 else 1.0
    grids = sorted({pixels, pixels // 2, COARSE})
    one = float(measured.seconds.mean("seed").sel(pixels=grids).sum())
    total = saved * settings.seeds * one
    if settings.coarse_seeds:
        total += saved * settings.coarse_seeds * float(measured.coarse_seconds.mean())
        total += DESCRIBED_SEEDS * float(measured.describing_seconds)
    return total / float(measured.pair_time)


if __name__ == "__main__":
    main(start(globals(), "tabulate_tradeoff"))
