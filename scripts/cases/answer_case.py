"""Average a case, fit its a_V, and answer it: its quantities at its loads, with their errors."""

import logging

import numpy as np
import xarray as xr

from common.conventions import VARIANT, annotate
from common.derived_quantities import derive, quote, statistics, write_a_v
from common.error_budgets import Simulation, theory_parts
from common.job import start
from contact.ensembles import average_case
from stickiness import datasets
from stickiness.accuracy import error_models
from stickiness.accuracy.error_models import Settings, Surface, read_models
from stickiness.accuracy.quantities import COLUMNS, columns_of, has_error_model
from stickiness.accuracy.settings import Problem, joint_error, seeds_enough
from stickiness.error_budget import SOURCES, ErrorComponent, part, with_budget

DIMS = ("column", "pressure")


def main(job):
    plan = job.params.plan
    case = job.wildcards.case
    columns = list(columns_of(plan["quantities"]))
    loads = plan["pressures"]
    models = read_models(job.input.laws)
    surface = Surface.of(plan["surface"])
    settings = Settings(**plan["settings"])
    problem = Problem(models, surface, loads, columns)
    if plan["simulated"]:
        values, budgets = answer_by_simulation(job, columns, models, settings)
        # Grid and tolerance matter to a simulation alone.
        knobs = {"pixels": settings.pixels_per_wavelength, "tolerance": settings.tolerance}
    else:
        values, budgets = answer_by_theory(job, columns, models)
        knobs = {}

    outside = [error_models.extrapolated(surface, load, **knobs) for load in loads]
    variables = {
        "value": (DIMS, [values[column].values for column in columns]),
        "extrapolated": ("pressure", np.array(outside, np.int8)),
    }
    outside_text = (
        "1 where surface, load, grid or tolerance is outside what the laws were measured on"
    )
    dataset = annotate(
        xr.Dataset(variables, {"column": columns, "pressure": loads}),
        column="; ".join(f"{column}: {COLUMNS[column].text}" for column in columns),
        value="value of the column at a load",
        extrapolated=outside_text,
    )
    parts = {source: join_components(source, budgets, len(loads)) for source in SOURCES}
    dataset = with_budget(dataset, "value", **parts)
    if plan["accuracy"] and (text := describe_miss(dataset, problem, settings, plan, case)):
        dataset.attrs["missed"] = f"{case}: {text}"
        logging.warning("%s", text)
    title = "quantities of a case and their errors"
    datasets.write(dataset, job.output.answer, title=title, parameters={**plan, "case": case})


def answer_by_simulation(job, columns, models, settings):
    """Average the realisations; return values and budgets by column."""
    plan = job.params.plan
    output = job.output
    average_case(job.wildcards.case, plan, job.input, output)
    files = {
        "ensemble": datasets.read(output.means, ["area_fraction_mean"]),
        "kappa": datasets.read(output.kappa, ["kappa_standard_error"]),
    }
    if "a_v" in plan["quantities"]:
        write_a_v(output.means, output.a_v, job.params.windows, job.input.laws)
        files["a_v"] = datasets.read(output.a_v, ["a_v_standard_error"])
    else:
        title = "a_V, which the case does not ask for"
        datasets.write(xr.Dataset(), output.a_v, title=title, parameters=plan)
    parameters = plan["surface"] | plan["settings"] | {"seeds": range(settings.seeds)}
    simulation = Simulation(models, parameters)
    values = {}
    budgets = {}
    for column in columns:
        values[column], budgets[column] = simulate(simulation, column, files)
    return values, budgets


def answer_by_theory(job, columns, models):
    """Take Persson's theory on the lattice spectrum; return values and budgets by column."""
    state = datasets.read(job.input.theory, ["area_fraction", "mean_gap", "attractive_area"])
    state = derive(state.sel(variant=VARIANT), job.params.windows[0])
    values = {column: quote(column, state) for column in columns}
    surface = job.params.plan["surface"]
    budgets = {
        column: theory_parts(models, column, value, surface, "gap_density")
        for column, value in values.items()
    }
    return values, budgets


def join_components(source, budgets, count):
    """Errors of all columns from one source, with what is said of them."""
    errors = [np.broadcast_to(budget[source].error, count) for budget in budgets.values()]
    columns = {}  # by what a text says of them
    for column, budget in budgets.items():
        columns.setdefault(budget[source].text, []).append(column)
    if len(columns) > 1:
        text = "; ".join(f"{', '.join(names)}: {text}" for text, names in columns.items())
    else:
        (text,) = columns
    return ErrorComponent(xr.DataArray(errors, dims=DIMS), text)


def simulate(simulation, column, files):
    """Return the values of a column at every load, and their errors by source."""
    mean, standard_error, left = statistics(column, **files)
    parts = simulation.parts(column, mean, standard_error, left)
    if has_error_model(column):
        problem = simulation.problem
        size = abs(mean)
        errors = [
            error_models.grid_error(
                problem.models,
                column,
                problem.surface,
                load,
                simulation.settings.pixels_per_wavelength,
                relative,
            )
            for load, relative in zip(mean.pressure.values, (abs(left) / size).values, strict=True)
        ]
        text = "as in the ensemble's file, or as measured if that is less"
        parts["discretisation"] = ErrorComponent(size * errors, text)
    return mean, parts


def describe_miss(dataset, problem, settings, plan, case):
    """Say by how much a case misses its accuracy, and what would help; None if it does not."""
    relative = (dataset.value_total_error / abs(dataset.value)).values
    unknown = ~np.isfinite(relative)
    worst = np.argwhere(unknown)[0] if unknown.any() else np.argwhere(relative == relative.max())[0]
    where = f"{problem.columns[worst[0]]} at pressure {problem.pressures[worst[1]]:g}"
    if unknown.any():
        return f"error of {where} not known"
    error = float(joint_error(relative.ravel()))
    accuracy = plan["accuracy"]
    if error <= accuracy:
        return None
    sampling = (part(dataset, "value", "sampling") / abs(dataset.value)).values
    fixed = np.sqrt(np.maximum(relative**2 - sampling**2, 0))
    remedy = (
        "no number of seeds is predicted to be enough; ask for less accuracy, or for more than is "
        "needed, so that a finer grid is chosen"
    )
    if enough := seeds_enough(problem, settings, accuracy, fixed, sampling):
        remedy = f"set cases.{case}.seeds to {enough}, which is predicted to be enough"
    return (
        f"error {error:.3g} of {accuracy:g} asked, largest in {where}, with {settings.seeds} seeds "
        f"and {settings.coarse_seeds} coarse ones; {remedy}"
    )


if __name__ == "__main__":
    main(start(globals()))
