"""Answer a case: values of its quantities at its loads, and their errors by source."""

import logging

import numpy as np
import xarray as xr

from common import conventions
from common.conventions import VARIANT
from common.error_budgets import BY_THEORY, NOT_MEASURED, QUADRATURE, SIMULATED
from common.job import start
from common.quantities import derive, quote, statistics
from stickiness import datasets
from stickiness.accuracy.error_models import (
    Settings,
    Surface,
    extrapolated,
    grid_error,
    read_models,
    single_error,
)
from stickiness.accuracy.quantities import COLUMNS, columns_of, has_error_model
from stickiness.accuracy.settings import Problem, covering_factor, joint_error, seeds_enough
from stickiness.error_budget import SOURCES, ErrorComponent, not_applicable, part, with_budget
from stickiness.statistics import students_t

DIMS = ("column", "pressure")
BY_SIMULATION = {
    "discretisation": "as in the ensemble's file, or as measured if that is less",
    "solver": "by the tolerance, as measured",
    "sampling": "Student's t of the standard error",
    "model": SIMULATED["model"].text,
}
THEORY_ALONE = {
    "discretisation": "of the quadrature, as tested",
    "solver": BY_THEORY["solver"].text,
    "sampling": BY_THEORY["sampling"].text,
    "model": "of theory in place of simulation, as measured",
}
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
    # Grid and tolerance matter to a simulation alone.
    knobs = {}
    if plan["simulated"]:
        knobs = {"pixels": settings.pixels_per_wavelength, "tolerance": settings.tolerance}
        files = {"ensemble": datasets.read(job.input.solved, ["area_fraction_mean"])}
        for name in ("a_v", "kappa"):
            if job.input.get(name):
                files[name] = datasets.read(job.input[name], [f"{name}_standard_error"])
        found = [simulate(problem, settings, column, files) for column in columns]
        texts = dict(BY_SIMULATION)
    else:
        state = datasets.read(job.input.solved, ["area_fraction", "mean_gap", "attractive_area"])
        state = derive(state.sel(variant=VARIANT), job.params.fit_interval)
        found, texts = [by_theory(problem, column, state) for column in columns], dict(THEORY_ALONE)
    if lacking := [column for column in columns if not has_error_model(column)]:
        texts["solver"] += f"; of {', '.join(lacking)} not known: {NOT_MEASURED}"

    outside = np.array([extrapolated(surface, load, **knobs) for load in loads], np.int8)
    dataset = xr.Dataset(
        {"value": (DIMS, [value for value, _ in found]), "extrapolated": ("pressure", outside)},
        coords={"column": columns, "pressure": loads},
    )
    dataset = conventions.annotate(
        dataset,
        column="; ".join(f"{column}: {COLUMNS[column].text}" for column in columns),
        value="value of the column at a load",
        extrapolated=OUTSIDE,
    )
    parts = {}
    for source in (one for one in SOURCES if one in texts):
        errors = [np.abs(by_source.get(source, np.zeros(len(loads)))) for _, by_source in found]
        parts[source] = ErrorComponent(xr.DataArray(errors, dims=DIMS), texts[source])
    dataset = with_budget(
        dataset, "value", bandwidth=not_applicable("the case's own spectrum"), **parts
    )
    if plan["accuracy"] and (text := describe_miss(dataset, problem, settings, plan, case)):
        dataset.attrs["missed"] = f"{case}: {text}"
        logging.warning("%s", text)
    title = "quantities of a case and their errors"
    datasets.write(dataset, job.output[0], title=title, parameters={**plan, "case": case})


def simulate(problem, settings, column, files):
    """Return the values of a column at every load, and its errors by source, covering 90 %."""
    mean, standard_error, left = (part.values for part in statistics(column, **files))
    if not has_error_model(column):
        return mean, {
            "discretisation": left,
            "solver": np.full_like(mean, np.nan),
            "sampling": students_t(settings.seeds) * standard_error,
        }
    models, surface, size = problem.models, problem.surface, np.abs(mean)
    pixels, tolerance = settings.pixels_per_wavelength, settings.tolerance
    grid, solver, factor = [], [], []
    for load, found in zip(problem.pressures, np.abs(left) / size, strict=True):
        grid.append(grid_error(models, column, surface, load, pixels, found))
        solver.append(single_error(models, "solver", column, surface, load, tolerance=tolerance))
        factor.append(covering_factor(problem, settings, load, column))
    sampling = factor * standard_error
    return mean, {"discretisation": size * grid, "solver": size * solver, "sampling": sampling}


def by_theory(problem, column, state):
    """Return the same by Persson's theory on the lattice spectrum."""
    values = quote(column, state).values
    at = problem.models, "theory", column, problem.surface
    model = [single_error(*at, load) for load in problem.pressures]
    return values, {"discretisation": QUADRATURE["gap_density"] * values, "model": values * model}


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
