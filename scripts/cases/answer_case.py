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
from stickiness.error_budget import SOURCES, Part, absent, part, with_budget
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
MISSED = (
    "error {error:.3g} of {accuracy:g} asked, largest in {column} at pressure {pressure:g}, "
    "with {seeds} seeds and {coarse_seeds} coarse ones; {remedy}"
)
MORE_SEEDS = "set cases.{case}.seeds to {seeds}, which is predicted to be enough"
NO_SEEDS = (
    "no number of seeds is predicted to be enough; ask for less accuracy, or for more than is "
    "needed, so that a finer grid is chosen"
)


def main(job):
    plan, case = job.params.plan, job.wildcards.case
    columns = list(columns_of(plan["quantities"]))
    models, surface = read_models(job.input.laws), Surface.of(plan["surface"])
    problem = Problem(models, surface, plan["pressures"], columns)
    if plan["simulated"]:
        settings, texts = Settings(**plan["settings"]), dict(BY_SIMULATION)
        files = read_files(job.input)
        found = [simulate(problem, settings, column, files) for column in columns]
    else:
        state = datasets.read(job.input.solved, ["area_fraction", "mean_gap", "attractive_area"])
        state = derive(state.sel(variant=VARIANT), job.params.fit_interval)
        found, texts = [by_theory(problem, column, state) for column in columns], dict(THEORY_ALONE)
    if lacking := [column for column in columns if not has_error_model(column)]:
        texts["solver"] += f"; of {', '.join(lacking)} not known: {NOT_MEASURED}"

    values = np.array([value for value, _ in found])
    errors = {
        source: np.abs([parts.get(source, np.zeros_like(value)) for value, parts in found])
        for source in SOURCES
    }
    parts = {s: Part(xr.DataArray(errors[s], dims=DIMS), text) for s, text in texts.items()}
    # Grid and tolerance matter to a simulation alone.
    names = ("pixels_per_wavelength", "tolerance") if plan["simulated"] else ()
    knobs = [plan["settings"][name] for name in names]
    unmeasured = [extrapolated(surface, load, *knobs) for load in plan["pressures"]]
    dataset = conventions.annotate(
        xr.Dataset(
            {
                "value": (DIMS, values),
                "extrapolated": ("pressure", np.array(unmeasured).astype(np.int8)),
            },
            coords={"column": columns, "pressure": plan["pressures"]},
        ),
        column=("1", "; ".join(f"{column}: {COLUMNS[column].text}" for column in columns)),
        value=("1", "value of the column at a load"),
        extrapolated=(
            "1",
            "1 where surface, load, grid or tolerance is outside what the laws were measured on",
        ),
    )
    dataset = with_budget(dataset, "value", bandwidth=absent("the case's own spectrum"), **parts)
    if plan["accuracy"] and (text := describe_miss(dataset, problem, plan, case)):
        dataset.attrs["missed"] = f"{case}: {text}"
        logging.warning("%s", text)
    datasets.write(
        dataset,
        job.output[0],
        title="quantities of a case and their errors",
        parameters={**plan, "case": case},
    )


def read_files(inputs):
    """Read the ensemble of a case and its fits, by the names of `Column.file`."""
    fits = {
        name: datasets.read(inputs[name], [f"{name}_standard_error"])
        for name in ("a_v", "kappa")
        if inputs.get(name)
    }
    ensemble = datasets.read(inputs.solved, ["area_fraction_mean", "mean_gap_mean"])
    return {"ensemble": ensemble, **fits}


def simulate(problem, settings, column, files):
    """Return the values of a column at every load, and its errors by source, covering 90 %."""
    mean, standard_error, left = (part.values for part in statistics(column, **files))
    if not has_error_model(column):
        return mean, {
            "discretisation": left,
            "solver": np.full_like(mean, np.nan),
            "sampling": students_t(settings.seeds) * standard_error,
        }
    models, surface, loads = problem.models, problem.surface, problem.pressures
    tolerance, pixels = settings.tolerance, settings.pixels_per_wavelength
    size = np.abs(mean)
    by_grid = [
        grid_error(models, column, surface, load, pixels, found)
        for load, found in zip(loads, np.abs(left) / size, strict=True)
    ]
    at = models, "solver", column, surface
    by_solver = [single_error(*at, load, tolerance=tolerance) for load in loads]
    factor = [covering_factor(problem, settings, load, column) for load in loads]
    return mean, {
        "discretisation": size * by_grid,
        "solver": size * by_solver,
        "sampling": factor * standard_error,
    }


def by_theory(problem, column, state):
    """Return the same by Persson's theory on the lattice spectrum."""
    values = quote(column, state).values
    at = problem.models, "theory", column, problem.surface
    model = [single_error(*at, load) for load in problem.pressures]
    return values, {"discretisation": QUADRATURE["gap_density"] * values, "model": values * model}


def describe_miss(dataset, problem, plan, case):
    """Say by how much a case misses its accuracy, and what would help; None if it does not."""
    relative = (dataset.value_total_error / abs(dataset.value)).values
    if not np.isfinite(relative).all():
        row, at = np.argwhere(~np.isfinite(relative))[0]
        column, load = problem.columns[row], problem.pressures[at]
        return f"error of {column} at pressure {load:g} not known"
    error, accuracy = float(joint_error(relative.ravel())), plan["accuracy"]
    if error <= accuracy:
        return None
    row, at = np.unravel_index(relative.argmax(), relative.shape)
    settings = Settings(**plan["settings"])
    sampling = (part(dataset, "value", "sampling") / abs(dataset.value)).values
    fixed = np.sqrt(np.maximum(relative**2 - sampling**2, 0))
    enough = seeds_enough(problem, settings, accuracy, fixed, sampling)
    return MISSED.format(
        error=error,
        accuracy=accuracy,
        column=problem.columns[row],
        pressure=problem.pressures[at],
        seeds=settings.seeds,
        coarse_seeds=settings.coarse_seeds,
        remedy=MORE_SEEDS.format(case=case, seeds=enough) if enough else NO_SEEDS,
    )


if __name__ == "__main__":
    main(start(globals(), "answer_case", case="H0.8_zeta64"))
