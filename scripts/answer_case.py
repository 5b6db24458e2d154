"""What a case asks for: values at its loads, their error by source, and which source dominates."""

from typing import ClassVar

import numpy as np
import xarray as xr

from _budgets import BY_THEORY, QUADRATURE, SIMULATED
from _job import start
from _model import DESCRIBED, VARIANT, logarithmic_grid, spectrum_of, window_of
from fit_a_v import fit_one
from measure_theory import contact_of
from stickiness import accuracy, datasets
from stickiness import plan as plan_of
from stickiness.budget import SOURCES, Part, absent, with_budget
from stickiness.persson import Persson
from stickiness.surface import lattice_spectrum

DIMS = ("column", "pressure")
RANGES = {"minimum": 1e-4, "maximum": 10.0, "per_decade": 16}
GAP = 0.1  # over h_rms, at which P(u) is quoted; the ensemble's file has all of it
TEXTS = {
    "area": "repulsive contact area over nominal area",
    "mean_gap": "mean gap over h_rms",
    "attractive_area_0.01": "attractive area at range 0.01 h_rms over nominal area",
    "attractive_area_0.1": "attractive area at range 0.1 h_rms over nominal area",
    "gap_distribution": "P(u) times h_rms at gap 0.1 h_rms",
    "a_v": "a_V",
    "kappa": "kappa_rep",
}


def main(job):
    plan, laws = job.params.plan, accuracy.read_laws(job.input.laws)
    columns = [c for name in plan["quantities"] for c in accuracy.QUANTITIES[name]]
    pressures = np.array(plan["pressures"])
    values = np.full((len(columns), len(pressures)), np.nan)
    errors = np.zeros((len(SOURCES), *values.shape))
    at = Simulated(job.input) if plan["simulated"] else Theory(job.input, plan, laws)
    for row, column in enumerate(columns):
        values[row], errors[:, row] = at(column)
    bandwidth = absent("the case's own spectrum")
    if "carry_to" in plan:
        change, size = carried(plan, columns, pressures)
        error = carrying_error(laws, plan, columns, values, size)
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
    datasets.write(
        with_budget(annotated(dataset, columns), "value", bandwidth=bandwidth, **parts),
        job.output[0],
        title="quantities of a case and their errors",
        parameters={**plan, "case": job.wildcards.case},
    )


class Simulated:
    """Values and errors that cover 90 %, by source, from the files of an ensemble."""

    texts: ClassVar = {
        "discretisation": "left in the limit of fine grids",
        "solver": "by the tolerance, as measured",
        "sampling": "Student's t of the standard error",
        "model": SIMULATED["model"].text,
    }

    def __init__(self, inputs):
        self.inputs = inputs
        self.ensemble = datasets.read(inputs.solved, ["area_fraction_mean", "mean_gap_mean"])

    def __call__(self, column):
        """Values of a column at every load, and its errors by source."""
        found, name = self.found(column)
        return found[name].values, found[f"{name}_error"].transpose("source", "pressure").values

    def found(self, column):
        """Dataset and name of a column."""
        if column == "kappa":
            return datasets.read(self.inputs.kappa, ["kappa", "kappa_error"]), "kappa"
        if column == "a_v":
            return datasets.read(self.inputs.a_v, ["a_v_mean_error"]).isel(window=0), "a_v_mean"
        name, where = {
            "area": ("area_fraction_mean", {}),
            "mean_gap": ("mean_gap_mean", {}),
            "attractive_area_0.01": ("attractive_area_mean", {"range": 0.01}),
            "attractive_area_0.1": ("attractive_area_mean", {"range": 0.1}),
            "gap_distribution": ("gap_density_mean", {"gap": GAP}),
        }[column]
        found = self.ensemble[[name, f"{name}_error"]]
        return found.sel(where, method="nearest") if where else found, name


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
        surface = plan_of.surface_of(self.plan["surface"])
        error = [
            accuracy.single_error(self.laws, "theory", column, surface, p)
            for p in self.plan["pressures"]
        ]
        parts = {"discretisation": QUADRATURE["gap_density"] * values, "model": values * error}
        return values, np.abs([parts.get(source, 0 * values) for source in SOURCES])


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
    """Where surface or load is outside what the laws were measured on, by load."""
    surface = plan_of.surface_of(plan["surface"])
    return np.array([accuracy.measured(surface, p)[-1] > 1 for p in pressures])


def carrying_error(laws, plan, columns, values, size):
    """Error of theory's difference, covering 90 %: a share of the value simulated, before it.

    `size` is by how much of itself theory changes the area. As measured up to 8 times the
    magnification, the configuration allows no more.
    """
    surface = plan_of.surface_of(plan["surface"])
    share = [
        [accuracy.single_error(laws, "carrying", column, surface, p) for p in plan["pressures"]]
        for column in columns
    ]
    return share * size * np.abs(values)


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
            "1 where surface or load is outside what the laws of solver and model were measured on",
        ),
    )


if __name__ == "__main__":
    main(start(globals(), "answer_case", case="H0.8_zeta64"))
