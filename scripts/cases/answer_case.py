"""What a case asks for: values at its loads, their error by source, and which source dominates."""

import logging

import numpy as np
import xarray as xr

from common import conventions
from common.conventions import VARIANT, logarithmic_grid
from common.error_budgets import BY_THEORY, NOT_MEASURED, QUADRATURE, SIMULATED
from common.job import start
from common.model_surfaces import cell_size, model_spectrum
from common.quantities import derive, quote, statistics
from common.theory import contact_of
from stickiness import datasets
from stickiness.accuracy.choice import seeds_enough
from stickiness.accuracy.error_models import (
    Settings,
    Surface,
    extrapolated,
    grid_error,
    read_models,
    single_error,
)
from stickiness.accuracy.extrapolation import carrying_error
from stickiness.accuracy.prediction import Problem, covering_factor, joint_error
from stickiness.accuracy.quantities import COLUMNS, columns_of, has_error_model
from stickiness.error_budget import SOURCES, Part, absent, part, with_budget
from stickiness.persson.theory import Persson
from stickiness.statistics import students_t
from stickiness.surface import lattice_spectrum

DIMS = ("column", "pressure")
RANGES = {"minimum": 1e-4, "maximum": 10.0, "per_decade": 16}
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


def main(job):
    plan, fit_interval = job.params.plan, job.params.fit_interval
    columns = list(columns_of(plan["quantities"]))
    models, surface = read_models(job.input.laws), Surface.of(plan["surface"])
    problem = Problem(models, surface, plan["pressures"], columns)
    if plan["simulated"]:
        settings, texts = Settings(**plan["settings"]), BY_SIMULATION
        files = read_files(job.input)
        found = [simulate(problem, settings, column, files) for column in columns]
    else:
        state = datasets.read(job.input.solved, ["area_fraction", "mean_gap", "attractive_area"])
        state, texts = derive(state.sel(variant=VARIANT), fit_interval), THEORY_ALONE
        found = [by_theory(problem, column, state) for column in columns]
    values = np.array([value for value, _ in found])
    errors = {
        source: np.abs([parts.get(source, np.zeros_like(value)) for value, parts in found])
        for source in SOURCES
    }
    bandwidth = absent("the case's own spectrum")
    if "carry_to" in plan:
        change, size = extrapolate(plan, columns, fit_interval)
        error = extrapolation_errors(problem, plan["carry_to"], values, size)
        bandwidth = Part(xr.DataArray(error, dims=DIMS), "of the difference that theory adds")
        values = values + change
    unmeasured = outside(surface, plan).astype(np.int8)
    dataset = xr.Dataset(
        {"value": (DIMS, values), "extrapolated": ("pressure", unmeasured)},
        coords={"column": columns, "pressure": plan["pressures"]},
    )
    parts = {s: Part(xr.DataArray(errors[s], dims=DIMS), text) for s, text in texts.items()}
    if lacking := [column for column in columns if not has_error_model(column)]:
        text = f"{parts['solver'].text}; of {', '.join(lacking)} not known: {NOT_MEASURED}"
        parts["solver"] = Part(parts["solver"].error, text)
    dataset = with_budget(annotate(dataset), "value", bandwidth=bandwidth, **parts)
    case = job.wildcards.case
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
    """The ensemble of a case and its fits, by the names of `Column.file`."""
    fits = {
        name: datasets.read(inputs[name], [f"{name}_standard_error"])
        for name in ("a_v", "kappa")
        if inputs.get(name)
    }
    ensemble = datasets.read(inputs.solved, ["area_fraction_mean", "mean_gap_mean"])
    return {"ensemble": ensemble, **fits}


def simulate(problem, settings, column, files):
    """Values of a column at every load, and its errors by source, each covering 90 %."""
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
    """The same by Persson's theory on the lattice spectrum, from a contact with all quantities."""
    values = quote(column, state).values
    at = problem.models, "theory", column, problem.surface
    model = [single_error(*at, load) for load in problem.pressures]
    return values, {"discretisation": QUADRATURE["gap_density"] * values, "model": values * model}


def describe_miss(dataset, problem, plan, case):
    """What keeps a case from the accuracy that it asks for, in words; None if nothing does."""
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
    remedy = (
        f"set cases.{case}.seeds to {enough}, which is predicted to be enough"
        if enough
        else "no number of seeds is predicted to be enough; ask for less accuracy, or for more "
        "than is needed, so that a finer grid is chosen"
    )
    return (
        f"error {error:.3g} of {accuracy:g} asked, largest in {problem.columns[row]} at pressure "
        f"{problem.pressures[at]:g}, with {settings.seeds} seeds and {settings.coarse_seeds} "
        f"coarse ones; {remedy}"
    )


def outside(surface, plan):
    """Where surface, load, grid or tolerance is outside what was measured, by load."""
    names = ("pixels_per_wavelength", "tolerance") if plan["simulated"] else ()
    knobs = [plan["settings"][name] for name in names]
    return np.array([extrapolated(surface, load, *knobs) for load in plan["pressures"]])


def extrapolation_errors(problem, carry_to, values, size):
    """Error of theory's difference, covering 90 %, by column and load."""
    models, surface, loads = problem.models, problem.surface, problem.pressures

    def share(column, load, change):
        return carrying_error(models, surface, carry_to, change, column, load)

    rows = [list(map(share, [column] * len(loads), loads, size)) for column in problem.columns]
    return rows * np.abs(values)


def extrapolate(plan, columns, fit_interval):
    """What theory says that a broader spectrum adds to each column, and what it takes of the area.

    The difference, not the ratio: from magnification 64 to 512 it leaves half the error of the
    ratio in attractive areas at H = 0.8, and about the same at H = 0.5.
    """
    surface, ranges = plan["surface"], logarithmic_grid(RANGES)

    def contact(asked):
        theory = Persson(lattice_spectrum(model_spectrum(asked), cell_size(asked)))
        return derive(contact_of(theory, plan["pressures"], ranges), fit_interval)

    own, broad = contact(surface), contact(surface | {"magnification": plan["carry_to"]})
    change = [quote(column, broad).values - quote(column, own).values for column in columns]
    size = np.abs(quote("area", broad).values / quote("area", own).values - 1)
    return np.array(change), size


def annotate(dataset):
    columns = dataset.column.values
    text = "1 where surface, load, grid or tolerance is outside what the laws were measured on"
    return conventions.annotate(
        dataset,
        column=("1", "; ".join(f"{column}: {COLUMNS[column].text}" for column in columns)),
        value=("1", "value of the column at a load"),
        extrapolated=("1", text),
    )


if __name__ == "__main__":
    main(start(globals(), "answer_case", case="H0.8_zeta64"))
