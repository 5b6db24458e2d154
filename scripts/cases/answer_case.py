"""Average a case, fit its a_V, and answer it: its quantities at its loads, with their errors."""

import logging

import numpy as np
import xarray as xr

from common.conventions import VARIANT, annotate
from common.error_budgets import Simulation, theory_parts
from common.job import start
from common.quantities import derive, quote, statistics, write_a_v
from contact.ensembles import average_case
from stickiness import datasets
from stickiness.accuracy import error_models
from stickiness.accuracy.error_models import Settings, Surface, read_models
from stickiness.accuracy.quantities import COLUMNS, columns_of, has_error_model
from stickiness.accuracy.settings import Problem, joint_error, seeds_enough
from stickiness.error_budget import SOURCES, ErrorComponent, part, with_budget

DIMS = ("column", "pressure")
GRID = "as in the ensemble's file, or as measured if that is less"
OUTSIDE = "1 where surface, load, grid or tolerance is outside what the laws were measured on"
NO_SEEDS = (
    "no number of seeds is predicted to be enough; ask for less accuracy, or for more than is "
    "needed, so that a finer grid is chosen"
)


def main(job):
    plan, case = job.params.plan, job.wildcards.case
    columns, loads = list(columns_of(plan["quantities"])), plan["pressures"]
    models, surface = read_models(job.input.laws), Surface.of(plan["surface"])
    problem, settings = Problem(models, surface, loads, columns), Settings(**plan["settings"])
    knobs = ()
    if plan["simulated"]:  # grid and tolerance matter to a simulation alone
        knobs, output = (settings.pixels_per_wavelength, settings.tolerance), job.output
        average_case(case, plan, job.input, output)
        files = {"ensemble": datasets.read(output.means, ["area_fraction_mean"])}
        files["kappa"] = datasets.read(output.kappa, ["kappa_standard_error"])
        if "a_v" in plan["quantities"]:
            write_a_v(output.means, output.a_v, job.params.windows, job.input.laws)
            files["a_v"] = datasets.read(output.a_v, ["a_v_standard_error"])
        made = plan["surface"] | plan["settings"] | {"seeds": range(settings.seeds)}
        found = [simulate(Simulation(models, made), column, files) for column in columns]
    else:
        state = datasets.read(job.input.theory, ["area_fraction", "mean_gap", "attractive_area"])
        state = derive(state.sel(variant=VARIANT), job.params.windows[0])
        # By Persson's theory on the lattice spectrum.
        quoted, given = {column: quote(column, state) for column in columns}, plan["surface"]
        found = [
            (value, theory_parts(models, column, value, given, "gap_density"))
            for column, value in quoted.items()
        ]

    outside = [error_models.extrapolated(surface, load, *knobs) for load in loads]
    variables = {
        "value": (DIMS, [value.values for value, _ in found]),
        "extrapolated": ("pressure", np.array(outside, np.int8)),
    }
    dataset = annotate(
        xr.Dataset(variables, {"column": columns, "pressure": loads}),
        column="; ".join(f"{column}: {COLUMNS[column].text}" for column in columns),
        value="value of the column at a load",
        extrapolated=OUTSIDE,
    )
    parts = {}
    for source in SOURCES:
        components = [by_source[source] for _, by_source in found]
        errors = [np.broadcast_to(one.error, len(loads)) for one in components]
        about = {}  # columns by what a text says of them
        for column, one in zip(columns, components, strict=True):
            about.setdefault(one.text, []).append(column)
        texts = [f"{', '.join(names)}: {text}" for text, names in about.items()]
        text = "; ".join(texts if len(about) > 1 else about)
        parts[source] = ErrorComponent(xr.DataArray(errors, dims=DIMS), text)
    dataset = with_budget(dataset, "value", **parts)
    if plan["accuracy"] and (text := describe_miss(dataset, problem, settings, plan, case)):
        dataset.attrs["missed"] = f"{case}: {text}"
        logging.warning("%s", text)
    title = "quantities of a case and their errors"
    datasets.write(dataset, job.output.answer, title=title, parameters={**plan, "case": case})


def simulate(simulation, column, files):
    """Return the values of a column at every load, and their errors by source."""
    mean, standard_error, left = statistics(column, **files)
    parts = simulation.parts(column, mean, standard_error, left)
    if has_error_model(column):
        problem, pixels = simulation.problem, simulation.settings.pixels_per_wavelength
        size, at = abs(mean), (problem.models, column, problem.surface)
        error = [
            error_models.grid_error(*at, load, pixels, found)
            for load, found in zip(mean.pressure.values, (abs(left) / size).values, strict=True)
        ]
        parts["discretisation"] = ErrorComponent(size * error, GRID)
    return mean, parts


def describe_miss(dataset, problem, settings, plan, case):
    """Say by how much a case misses its accuracy, and what would help; None if it does not."""
    relative = (dataset.value_total_error / abs(dataset.value)).values
    unknown = ~np.isfinite(relative)
    worst = np.argwhere(unknown)[0] if unknown.any() else np.argwhere(relative == relative.max())[0]
    where = f"{problem.columns[worst[0]]} at pressure {problem.pressures[worst[1]]:g}"
    if unknown.any():
        return f"error of {where} not known"
    error, accuracy = float(joint_error(relative.ravel())), plan["accuracy"]
    if error <= accuracy:
        return None
    sampling = (part(dataset, "value", "sampling") / abs(dataset.value)).values
    fixed = np.sqrt(np.maximum(relative**2 - sampling**2, 0))
    remedy = NO_SEEDS
    if enough := seeds_enough(problem, settings, accuracy, fixed, sampling):
        remedy = f"set cases.{case}.seeds to {enough}, which is predicted to be enough"
    return (
        f"error {error:.3g} of {accuracy:g} asked, largest in {where}, with {settings.seeds} seeds "
        f"and {settings.coarse_seeds} coarse ones; {remedy}"
    )


if __name__ == "__main__":
    main(start(globals(), "answer_case", case="H0.8_zeta64"))
