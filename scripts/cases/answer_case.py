"""What a case asks for: values at its loads, their error by source, and which source dominates."""

import logging
from typing import ClassVar

import numpy as np
import xarray as xr

from pipeline.conventions import DESCRIBED, VARIANT, logarithmic_grid, spectrum_of, window_of
from pipeline.error_budgets import BY_THEORY, QUADRATURE, SIMULATED
from pipeline.fits import fit_one
from pipeline.job import start
from pipeline.quantities import GAP, TEXTS, statistics
from pipeline.theory import contact_of
from stickiness.accuracy import error_laws, sequential
from stickiness.core import datasets
from stickiness.core.budget import SOURCES, Part, absent, with_budget
from stickiness.persson.theory import Persson
from stickiness.surfaces.synthesis import lattice_spectrum

DIMS = ("column", "pressure")
RANGES = {"minimum": 1e-4, "maximum": 10.0, "per_decade": 16}


def main(job):
    plan, laws = job.params.plan, error_laws.read_laws(job.input.laws)
    columns = [c for name in plan["quantities"] for c in error_laws.QUANTITIES[name]]
    pressures = np.array(plan["pressures"])
    values = np.full((len(columns), len(pressures)), np.nan)
    errors = np.zeros((len(SOURCES), *values.shape))
    at = Simulated(job.input, plan, laws) if plan["simulated"] else Theory(job.input, plan, laws)
    for row, column in enumerate(columns):
        values[row], errors[:, row] = at(column)
    bandwidth = absent("the case's own spectrum")
    if "carry_to" in plan:
        change, size = carried(plan, columns, pressures)
        error = carrying_errors(laws, plan, columns, values, size)
        bandwidth = Part(xr.DataArray(error, dims=DIMS), "of the difference that theory adds")
        values += change
    dataset = xr.Dataset(
        {
            "value": (DIMS, values),
            "extrapolated": ("pressure", outside(plan, pressures).astype(np.int8)),
        },
        coords={"column": columns, "pressure": pressures},
    )
    parts = {
        source: Part(xr.DataArray(error, dims=DIMS), at.texts[source])
        for source, error in zip(SOURCES, errors, strict=True)
        if source != "bandwidth"
    }
    dataset = with_budget(annotated(dataset, columns), "value", bandwidth=bandwidth, **parts)
    if "asked" in plan and (text := missed(dataset, plan)):
        dataset.attrs["missed"] = f"{job.wildcards.case}: {text}"
        logging.warning("%s", text)
    datasets.write(
        dataset,
        job.output[0],
        title="quantities of a case and their errors",
        parameters={**plan, "case": job.wildcards.case},
    )


class Simulated:
    """Values and errors that cover 90 %, by source, from the files of an ensemble."""

    texts: ClassVar = {
        "discretisation": "left in the limit of fine grids, or as measured if that is less",
        "solver": "by the tolerance, as measured",
        "sampling": "Student's t of the standard error, which rounds of seeds pool with the laws'",
        "model": SIMULATED["model"].text,
    }

    def __init__(self, inputs, plan, laws):
        self.plan, self.laws = plan, laws
        self.ensemble = datasets.read(inputs.solved, ["area_fraction_mean", "mean_gap_mean"])
        self.fits = {
            name: datasets.read(inputs[name], [f"{name}_standard_error"])
            for name in ("a_v", "kappa")
            if inputs.get(name)
        }
        self.drawn = None
        if inputs.get("drawn"):
            self.drawn = datasets.read(inputs.drawn, ["sampling_error", "state"])
            for name in ("seeds", "coarse_seeds"):
                plan["settings"][name] = int(self.drawn[name])
            plan["stopped"] = sequential.STATES[int(self.drawn.state)]

    def __call__(self, column):
        """Values of a column at every load, and its errors by source."""
        mean, sampling, grid = statistics(column, self.ensemble, **self.fits)
        settings = error_laws.Settings(**self.plan["settings"])
        surface, pressures = error_laws.Surface.of(self.plan["surface"]), self.plan["pressures"]
        solver = [
            error_laws.single_error(
                self.laws, "solver", column, surface, p, tolerance=settings.tolerance
            )
            for p in pressures
        ]
        if self.drawn is not None:  # what the seeds were stopped by
            covers = mean.values * self.drawn.sampling_error.sel(column=column).values
        else:
            factor = [
                error_laws.covering_factor(self.laws, settings, surface, p, column)
                for p in pressures
            ]
            covers = factor * sampling.values
        size, pixels = np.abs(mean.values), settings.pixels_per_wavelength
        grid_error = [
            error_laws.grid_error(self.laws, column, surface, p, pixels, found)
            for p, found in zip(pressures, np.abs(grid.values) / size, strict=True)
        ]
        parts = {
            "discretisation": size * grid_error,
            "solver": size * solver,
            "sampling": covers,
        }
        return mean.values, np.abs([parts.get(source, 0 * size) for source in SOURCES])


class Theory:
    """Values of Persson's theory on the lattice spectrum, and what it errs by."""

    texts: ClassVar = {
        "discretisation": "of the quadrature, as tested",
        "solver": BY_THEORY["solver"].text,
        "sampling": BY_THEORY["sampling"].text,
        "model": "of theory in place of simulation, as measured",
    }

    def __init__(self, inputs, plan, laws):
        self.plan, self.laws = plan, laws
        state = datasets.read(inputs.solved, ["area_fraction", "mean_gap", "attractive_area"])
        self.state = state.sel(variant=VARIANT)

    def __call__(self, column):
        """Values of a column at every load, and its errors by source."""
        values = quoted(self.state, column)
        surface = error_laws.Surface.of(self.plan["surface"])
        error = [
            error_laws.single_error(self.laws, "theory", column, surface, p)
            for p in self.plan["pressures"]
        ]
        parts = {"discretisation": QUADRATURE["gap_density"] * values, "model": values * error}
        return values, np.abs([parts.get(source, 0 * values) for source in SOURCES])


def missed(dataset, plan):
    """What keeps a case from the accuracy that it asks for, in words; None if nothing does."""
    relative = (dataset.value_total_error / abs(dataset.value)).values
    if not np.isfinite(relative).all():
        row, at = np.argwhere(~np.isfinite(relative))[0]
        column, load = str(dataset.column.values[row]), float(dataset.pressure[at])
        return f"error of {column} at pressure {load:g} not known"
    error, column, load = sequential.worst(relative, sequential.Asked(**plan["asked"]))
    if error <= plan["accuracy"]:
        return None
    seeds = "{seeds} seeds and {coarse_seeds} coarse ones".format(**plan["settings"])
    why = {
        sequential.CAP: f"at the cap, {seeds}",
        sequential.GRID: f"its grid errs too much for any number of seeds, {seeds} so far",
        sequential.ENOUGH: "what theory adds of the spectrum errs too much",
    }[plan["stopped"]]
    return (
        f"error {error:.3g} of {plan['accuracy']:g} asked, largest in {column} at pressure "
        f"{load:g}; {why}"
    )


def quoted(state, column):
    """One column of a contact by theory, along its pressures."""
    if column == "area":
        return state.area_fraction.values
    if column == "mean_gap":
        return state.mean_gap.values
    if column == "kappa":
        return (state.area_fraction * state.rms_slope / state.pressure).values
    areas, ranges = state.attractive_area, state["range"].values
    if column == "a_v":
        pairs = zip(areas.values, state.pressure.values, strict=True)
        return np.array([fit_one(ranges, area, load, (0.01, 0.1))[0] for area, load in pairs])
    if column == "gap_distribution":
        here = np.argmin(np.abs(np.log(ranges[1:] * ranges[:-1]) / 2 - np.log(GAP)))
        return (areas.diff("range").isel(range=here) / np.diff(ranges)[here]).values
    return areas.sel(range=float(column.rsplit("_", 1)[1]), method="nearest").values


def outside(plan, pressures):
    """Where surface, load, grid or tolerance is outside what the laws were measured on, by load."""
    surface, settings = error_laws.Surface.of(plan["surface"]), plan["settings"]
    knobs = (settings["pixels_per_wavelength"], settings["tolerance"]) if plan["simulated"] else ()
    return np.array([error_laws.extrapolated(surface, p, *knobs) for p in pressures])


def carrying_errors(laws, plan, columns, values, size):
    """Error of theory's difference, covering 90 %, by column and load."""
    surface = error_laws.Surface.of(plan["surface"])
    loads = list(zip(plan["pressures"], size, strict=True))
    share = [
        [
            error_laws.carrying_error(laws, surface, plan["carry_to"], change, column, p)
            for p, change in loads
        ]
        for column in columns
    ]
    return share * np.abs(values)


def carried(plan, columns, pressures):
    """What theory says that a broader spectrum adds to each column, and what it takes of the area.

    The difference, not the ratio: from magnification 64 to 512 it leaves half the error of the
    ratio in attractive areas at H = 0.8, and about the same at H = 0.5.
    """
    surface, ranges = plan["surface"], logarithmic_grid(RANGES)
    own, broad = (
        contact_of(
            Persson(lattice_spectrum(spectrum_of(asked), window_of(asked))), pressures, ranges
        )
        for asked in (surface, surface | {"magnification": plan["carry_to"]})
    )
    change = np.array([quoted(broad, column) - quoted(own, column) for column in columns])
    size = np.abs(quoted(broad, "area") / quoted(own, "area") - 1)
    return change, size


def annotated(dataset, columns):
    return datasets.annotate(
        dataset,
        column=("1", "; ".join(f"{column}: {TEXTS[column]}" for column in columns)),
        pressure=DESCRIBED["pressure"],
        value=("1", "value of the column at a load"),
        extrapolated=(
            "1",
            "1 where surface, load, grid or tolerance is outside what the laws were measured on",
        ),
    )


if __name__ == "__main__":
    main(start(globals(), "answer_case", case="H0.8_zeta64"))
