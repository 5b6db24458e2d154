"""a_V fitted to attractive areas, of simulation or theory, in every window of the configuration."""

import numpy as np
import xarray as xr

from common import conventions, grid_limits
from common.ensemble_means import SUFFIXES, add_errors, coarse, describe_errors, standard_error
from common.error_budgets import BY_THEORY, QUADRATURE, SIMULATED, Simulation, theory_parts
from common.quantities import fit_intervals
from stickiness import datasets
from stickiness.accuracy.error_models import read_models
from stickiness.criteria import a_v_fit
from stickiness.error_budget import Part, unknown, with_budget


def write_fits(areas_file, output, windows, laws):
    """Fit a_V to the attractive areas of a file in all windows, and write it with its errors."""
    areas = datasets.read(areas_file, ["attractive_area", "pressure"])
    dataset = fit_intervals(areas, windows)
    dataset["exponent"] = local_exponent(areas)
    if "edge_gap_mean" in areas:
        resolved = areas["range"] >= areas.edge_gap_mean
        dataset["exponent"] = dataset.exponent.where(resolved)
    add_budgets = add_theory_budgets
    if "seed" in dataset.a_v.dims:
        dataset, add_budgets = average(dataset, areas, windows), add_simulation_budgets
    datasets.write(
        add_budgets(annotate(dataset), areas, read_models(laws)),
        output,
        title="a_V from attractive areas",
        parameters={**datasets.parameters(areas), "windows": windows},
    )


def average(dataset, ensemble, windows):
    """Add mean and errors, with what the attractive areas know of the limit of fine grids."""

    def quantity(solved):
        return fit_intervals(solved, windows).a_v

    limit = grid_limits.inherit(ensemble, quantity, ["attractive_area"])
    return add_errors(dataset, "a_v", dataset.a_v, coarse(ensemble, quantity), limit=limit)


def add_simulation_budgets(dataset, ensemble, models):
    """Budgets of the means over the seeds; a window is part of what is asked."""
    simulation = Simulation.of(models, datasets.parameters(ensemble))
    mean = (dataset[f"a_v_{kind}"] for kind in SUFFIXES)
    parts = simulation.parts("a_v", *mean, grid_limits.INHERITED)
    dataset = with_budget(dataset, "a_v_mean", **parts)
    solver = simulation.solver("attractive_area", dataset.exponent)
    factor = simulation.factors("attractive_area", dataset.exponent)
    limit = grid_limits.inherit(ensemble, local_exponent, ["attractive_area"])
    seeds = local_exponent(ensemble[["attractive_area", "pressure"]])
    steps = np.diff(np.log(ensemble["range"].values)).min()
    return with_budget(
        dataset,
        "exponent",
        discretisation=Part(limit.error, grid_limits.INHERITED),
        solver=Part(2 * solver / steps, "of neighbouring areas, by the tolerance, as measured"),
        sampling=Part(factor * standard_error(seeds), "Student's t, of the plain mean of seeds"),
        **SIMULATED,
    )


def add_theory_budgets(dataset, areas, models):
    """Budgets of the fits to theory, on a lattice spectrum or on continuous ones."""
    made = datasets.parameters(areas)
    like = dataset.a_v.assign_coords(pressure=areas.pressure)
    surface, quadrature = made if "case" in made else None, "attractive_area"
    parts = theory_parts(models, "a_v", like, surface, quadrature)
    dataset = with_budget(dataset, "a_v", **parts)
    error = 2 * QUADRATURE[quadrature] / np.diff(np.log(areas["range"].values)).min()
    return with_budget(
        dataset,
        "exponent",
        discretisation=Part(error, "of the quadrature in neighbouring areas"),
        model=unknown("how theory's error changes with the range is not measured"),
        **BY_THEORY,
    )


def local_exponent(areas):
    """Exponent d ln A_ad/d ln(range): 2/3 where P(u) falls as u^(-1/3); of means over seeds."""
    area = areas.get("attractive_area_mean", areas.attractive_area)
    ranges = area["range"].values
    return xr.apply_ufunc(
        lambda a: a_v_fit.local_exponent(ranges, a) if np.all(a > 0) else np.full(len(a), np.nan),
        area,
        input_core_dims=[["range"]],
        output_core_dims=[["range"]],
        vectorize=True,
    )


def annotate(dataset):
    missing = "a range that the grid does not resolve, or no area within one of them"
    texts = {
        "a_v": ("1", "a_V, slope of A_ad against (3/2) p (range/h_rms)^(2/3)"),
        "a_v_fit_error": ("1", "standard error of the fit of a_V within its window"),
        "window_low": ("1", "low end of the fit window of range/h_rms"),
        "window_high": ("1", "high end of the fit window of range/h_rms"),
        "exponent": ("1", "local exponent d ln A_ad/d ln range", missing),
        **describe_errors("a_v", "a_V", discretisation=grid_limits.INHERITED),
    }
    return conventions.annotate(dataset, **texts)
