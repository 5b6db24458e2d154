"""Quantities derived from areas: P(u), a_V and kappa, with their errors by source.

The registry of quantities that a case may want is `stickiness.accuracy.quantities`. kappa is
A_rep E* h'_rms/(A_nom p), load by load and fitted. a_V is fitted to the attractive areas of
simulation or theory in every fit interval (`window`) of the configuration.
"""

import numpy as np
import xarray as xr

from common import continuum_values
from common.conventions import LINEAR_UP_TO, annotate, middles
from common.ensemble_means import add_errors, coarse, describe_errors, standard_error
from common.error_budgets import BY_THEORY, QUADRATURE, SIMULATED, Simulation, theory_parts
from stickiness import datasets
from stickiness.accuracy.error_models import read_models
from stickiness.accuracy.quantities import COLUMNS
from stickiness.criteria import a_v_fit
from stickiness.error_budget import ENDINGS, ErrorComponent, unknown_error, with_budget

KAPPA = "kappa = A_rep E* h'_rms/(A_nom p)"
KAPPA_VARIABLES = describe_errors(
    {
        "kappa": KAPPA,
        "kappa_fit": f"{KAPPA}, fitted through the origin up to {LINEAR_UP_TO:.0%} area",
    },
    plain=True,
    discretisation=continuum_values.INHERITED,
)
A_V_VARIABLES = {
    "a_v": "a_V, slope of A_ad against (3/2) p (range/h_rms)^(2/3)",
    "a_v_fit_error": "standard error of the fit of a_V within its window",
    "window_low": "low end of the fit window of range/h_rms",
    "window_high": "high end of the fit window of range/h_rms",
    "exponent": (
        "1",
        "local exponent d ln A_ad/d ln range",
        "a range that the grid does not resolve, or no area within one of them",
    ),
    **describe_errors({"a_v": "a_V"}, discretisation=continuum_values.INHERITED),
}


def statistics(column, **files):
    """Take mean, standard error and grid error of a column from files by `Column.file`."""
    entry = COLUMNS[column]
    name = entry.variable
    if entry.file == "a_v":
        data = files["a_v"].isel(window=0)
    else:
        data = at_point(files[entry.file], entry)
    mean = data[name if entry.file == "kappa" else f"{name}_mean"]
    return mean, data[f"{name}_standard_error"], data[f"{name}_discretisation_error"]


def quote(column, contact):
    """Take a column from a contact to which `derive` has added its quantities."""
    entry = COLUMNS[column]
    return at_point(contact, entry)[entry.variable]


def at_point(dataset, column):
    """A dataset at the gap or range that a column is for, if it is for one."""
    return dataset.sel(column.at, method="nearest", drop=True) if column.at else dataset


def derive(contact, fit_interval):
    """Add P(u), a_V and kappa to a contact: area, rms slope and attractive areas by load and range.

    `fit_interval` is for a_V, in ranges over h_rms.
    """
    a_v, _ = fit_a_v(contact, fit_interval)
    return contact.assign(gap_density=gap_density(contact), a_v=a_v, kappa=slope_of_area(contact))


def gap_density(solutions):
    """P(u) between neighbouring ranges, as the slope of the attractive area."""
    edges = solutions["range"].values
    density = solutions.attractive_area.diff("range") / xr.DataArray(np.diff(edges), dims="range")
    return density.rename(range="gap").assign_coords(gap=middles(edges))


def slope_of_area(solutions):
    """kappa, area times rms slope over pressure, load by load."""
    return solutions.area_fraction * solutions.rms_slope / solutions.pressure


def fit_slope(ensemble):
    """Least-squares slope of area h'_rms against pressure through the origin, A <= 30 %."""
    area = ensemble.area_fraction.where(ensemble.area_fraction <= LINEAR_UP_TO)
    pressure = ensemble.pressure.where(area.notnull())
    fitted = (area * pressure).sum("pressure") / (pressure**2).sum("pressure")
    return fitted * ensemble.rms_slope


def fit_a_v(areas, fit_interval):
    """Fit a_V and its standard error, along every dimension but the range's."""
    ranges = areas["range"].values
    window = tuple(fit_interval)

    def fit(area, pressure):
        fitted = a_v_fit.fit_a_v(ranges, area, float(pressure), window=window)
        return fitted.value, fitted.standard_error

    return xr.apply_ufunc(
        fit,
        areas.attractive_area,
        areas.pressure,
        input_core_dims=[["range"], []],
        output_core_dims=[[], []],
        vectorize=True,
    )


def fit_intervals(areas, windows):
    """Fit a_V and its standard error in every fit interval."""
    fits = [fit_a_v(areas, window) for window in windows]
    values, errors = zip(*fits, strict=True)
    low, high = np.transpose(np.array(windows, float))
    return xr.Dataset(
        {
            "a_v": xr.concat(values, "window"),
            "a_v_fit_error": xr.concat(errors, "window"),
            "window_low": ("window", low),
            "window_high": ("window", high),
        }
    )


def local_exponent(areas):
    """Exponent d ln A_ad/d ln(range): 2/3 where P(u) falls as u^(-1/3); of means over seeds."""
    area = areas.get("attractive_area_mean", areas.attractive_area).transpose(..., "range")
    logs = np.log(area.where((area > 0).all("range")))
    return logs.copy(data=np.gradient(logs, np.log(area["range"]), axis=-1))


def fit_kappa(ensemble, models):
    """Compute kappa of an ensemble, load by load and fitted, beside the mean area, with errors."""
    area = ensemble.area_fraction_mean
    dataset = xr.Dataset({"area_fraction": area})
    # The errors of the fit are those at the largest of its loads.
    largest = ensemble.pressure.where(area <= LINEAR_UP_TO).max()
    simulation = Simulation(models, datasets.parameters(ensemble))
    for name, quantity, load in (
        ("kappa", slope_of_area, ensemble.pressure),
        ("kappa_fit", fit_slope, largest),
    ):
        correction = continuum_values.inherit(ensemble, quantity, ["area_fraction"])
        values = quantity(ensemble)
        more = coarse(ensemble, quantity)
        dataset = add_errors(dataset, name, values, more, plain=True, correction=correction)
        texts = {n: text for n, text in KAPPA_VARIABLES.items() if n.startswith(name)}
        dataset = annotate(dataset, **texts)
        parts = simulation.parts(
            "kappa",
            dataset[name].assign_coords(pressure=load),
            dataset[f"{name}_standard_error"],
            dataset[f"{name}_discretisation_error"],
            text=continuum_values.INHERITED,
        )
        dataset = with_budget(dataset, name, **parts)
    for ending in ENDINGS:
        dataset[f"area_fraction{ending}"] = ensemble[f"area_fraction_mean{ending}"]
    return dataset


def add_kappa(theory, models, surface):
    """Add kappa and its error budget to theory on the lattice spectrum of a surface."""
    text = f"{KAPPA} by Persson's theory on the lattice spectrum"
    theory = datasets.annotate(theory.assign(kappa=slope_of_area(theory)), kappa=("1", text))
    parts = theory_parts(models, "kappa", theory.kappa, surface, "area_fraction")
    return with_budget(theory, "kappa", **parts)


def write_a_v(areas_file, output, windows, laws):
    """Fit a_V to the attractive areas of a file in all windows, and write it with its errors."""
    areas = datasets.read(areas_file, ["attractive_area", "pressure"])
    dataset = fit_intervals(areas, windows)
    dataset["exponent"] = local_exponent(areas)
    if "edge_gap_mean" in areas:
        dataset["exponent"] = dataset.exponent.where(areas["range"] >= areas.edge_gap_mean)
    if "seed" in dataset.a_v.dims:
        dataset = average_a_v(dataset, areas, windows)
        add_budgets = add_simulation_budgets
    else:
        add_budgets = add_theory_budgets
    dataset = add_budgets(annotate(dataset, **A_V_VARIABLES), areas, read_models(laws))
    title = "a_V from attractive areas"
    parameters = {**datasets.parameters(areas), "windows": windows}
    datasets.write(dataset, output, title=title, parameters=parameters)


def average_a_v(dataset, ensemble, windows):
    """Add mean and errors of a_V, in the limit of fine grids of the attractive areas."""

    def quantity(solved):
        return fit_intervals(solved, windows).a_v

    correction = continuum_values.inherit(ensemble, quantity, ["attractive_area"])
    return add_errors(
        dataset, "a_v", dataset.a_v, coarse(ensemble, quantity), correction=correction
    )


def add_simulation_budgets(dataset, ensemble, models):
    """Add budgets to the means over seeds; the choice of the window is no source of error."""
    simulation = Simulation(models, datasets.parameters(ensemble))
    parts = simulation.parts(
        "a_v",
        dataset.a_v_mean,
        dataset.a_v_standard_error,
        dataset.a_v_discretisation_error,
        text=continuum_values.INHERITED,
    )
    dataset = with_budget(dataset, "a_v_mean", **parts)
    correction = continuum_values.inherit(ensemble, local_exponent, ["attractive_area"])
    steps = np.diff(np.log(ensemble["range"].values)).min()
    solver = 2 * simulation.solver("attractive_area", dataset.exponent) / steps
    factor = simulation.factors("attractive_area", dataset.exponent)
    sampling = factor * standard_error(local_exponent(ensemble[["attractive_area", "pressure"]]))
    return with_budget(
        dataset,
        "exponent",
        discretisation=ErrorComponent(correction.error, continuum_values.INHERITED),
        solver=ErrorComponent(solver, "of neighbouring areas, by the tolerance, as measured"),
        sampling=ErrorComponent(sampling, "Student's t, of the plain mean of seeds"),
        **SIMULATED,
    )


def add_theory_budgets(dataset, areas, models):
    """Add budgets to the fits to theory, on a lattice spectrum or on continuous ones."""
    parameters = datasets.parameters(areas)
    like = dataset.a_v.assign_coords(pressure=areas.pressure)
    surface = parameters if "case" in parameters else None
    parts = theory_parts(models, "a_v", like, surface, "attractive_area")
    dataset = with_budget(dataset, "a_v", **parts)
    error = 2 * QUADRATURE["attractive_area"] / np.diff(np.log(areas["range"].values)).min()
    return with_budget(
        dataset,
        "exponent",
        discretisation=ErrorComponent(error, "of the quadrature in neighbouring areas"),
        model=unknown_error("how theory's error changes with the range is not measured"),
        **BY_THEORY,
    )
