"""DMT sum and weak limit of adhesion, from the attractive areas of contact without adhesion."""

from dataclasses import replace
from functools import partial

import numpy as np
import xarray as xr

from common import conventions, grid_limits
from common.adhesion_sets import AXES, OUTSIDE, axes, roughness, scaled_law
from common.conventions import LINEAR_UP_TO
from common.ensemble_means import add_errors, coarse, describe_errors
from common.error_budgets import SIMULATED, Simulation
from stickiness import datasets, dmt
from stickiness.accuracy.error_models import read_models
from stickiness.error_budget import ENDINGS, ErrorComponent, with_budget

PER_DECADE = 64  # ranges at which a traction law is integrated
SMALLEST = 1e-300  # area: none at ranges that a coarse grid does not see

QUANTITIES = {
    "attraction": "attractive pressure over E* q0 h_rms",
    "attraction_weak": "fall of the pressure at equal mean gap in the weak limit over E* q0 h_rms",
    "inverse_kappa": "1/kappa = p_ext A_nom/(A_rep E* h'_rms)",
    "inverse_kappa_ad": "1/kappa_ad = p_ad/(2 p_rep)",
    "inverse_kappa_fit": "1/kappa fitted through the origin over the loads up to 30 % area",
    "inverse_kappa_ad_fit": "1/kappa_ad, from the fall of the fitted 1/kappa",
}
FEW = "fewer than two loads to fit, fewer than three in all, or a single seed"
VARIABLES = describe_errors(QUANTITIES, plain=True, discretisation=grid_limits.INHERITED)
VARIABLES |= {n: (*t[:2], FEW) for n, t in VARIABLES.items() if "fit" in n or "weak" in n}
VARIABLES["dmt_error"] = ("1", "measured relative error of this 1/kappa_ad", OUTSIDE)
MODEL = "of the DMT sum against full simulation, as measured"
# Relative error of a slope between loads over the logarithm of their step, see `weak_attraction`.
SLOPE = 0.05


def find_linear(adhesion, ensemble):
    """By pressure of a set, whether the mean area is one that a slope is fitted to."""
    area = ensemble.area_fraction_mean.sel(pressure=axes(adhesion)[0])
    return (area <= LINEAR_UP_TO).drop_vars(set(area.coords) - {"pressure"})


def quantities_of(adhesion, linear, solved):
    """`QUANTITIES` of a set, of an ensemble, of its coarse solutions or of its means."""
    weak, solved = weak_attraction(adhesion, solved), solved.sel(pressure=axes(adhesion)[0])
    attraction = integrate_law(adhesion, solved.attractive_area)
    external, area = solved.pressure - attraction, solved.area_fraction * solved.rms_slope
    fall = fit_slope(attraction, area, linear)
    return xr.Dataset(
        {
            "attraction": attraction,
            "attraction_weak": weak.sel(pressure=solved.pressure),
            "inverse_kappa": external / area,
            "inverse_kappa_ad": attraction / attraction.pressure / 2,
            "inverse_kappa_fit": fit_slope(external, area, linear),
            "inverse_kappa_ad_fit": fall / fit_slope(solved.pressure, area, linear) / 2,
        }
    )


def weak_attraction(adhesion, solved):
    """Attraction at equal mean gap in the weak limit, at all loads; NaN for fewer than three."""
    _, lengths, ranges = axes(adhesion)
    potential = integrate_law(adhesion, solved.attractive_area, "potential")
    # Where surfaces touch it is the work of adhesion.
    potential = potential - lengths * ranges / roughness(adhesion) * solved.area_fraction
    if solved.sizes["pressure"] < 3:
        return potential * np.nan
    given, load = (solved.pressure, solved.mean_gap, potential), ["pressure"]
    loads = {"input_core_dims": [load] * 3, "output_core_dims": [load]}
    return xr.apply_ufunc(dmt.weak_attraction, *given, **loads)


def integrate_law(adhesion, areas, name="traction"):
    """Mean traction, or what else the law has, over the gaps."""
    _, lengths, ranges = axes(adhesion)
    logs = np.log(np.maximum(areas, SMALLEST))
    known = logs["range"].values
    count = round(np.log10(known[-1] / known[0]) * PER_DECADE) + 1
    logs = logs.assign_coords(range=np.log(known))
    parts = []
    for range_ in ranges.values:
        # In proportion to the adhesion length: once for the smallest of them.
        law = scaled_law(adhesion, adhesion["law"], float(lengths[0]), range_)
        nodes = np.union1d(np.geomspace(known[0], known[-1], count), [range_])
        area = np.exp(logs.interp(range=np.log(nodes).clip(*np.log(known[[0, -1]]))))
        given, along = (area, nodes, getattr(law, name)), [["range"], [], []]
        parts.append(xr.apply_ufunc(dmt.sum_over_gaps, *given, input_core_dims=along))
    return xr.concat(parts, ranges) * (lengths / lengths[0])


def fit_slope(external, area, linear):
    """Fitted slope of pressure against area through the origin; NaN for fewer than two loads."""
    inside = linear & (linear.sum("pressure") > 1)
    product, square = (external * area).where(inside), (area**2).where(inside)
    slope = product.sum("pressure") / square.sum("pressure")
    # Where a load is missing there is no slope: the others alone would have another.
    return slope.where((product.notnull() | ~inside).all("pressure") & inside.any("pressure"))


def linearity_error(values, linear):
    """Half the range over the loads of a fit: what its straight line leaves out."""
    inside = values.where(linear)
    return (inside.max("pressure") - inside.min("pressure")) / 2


def write_limit(adhesion, ensemble, laws, errors, output):
    """Write sum and weak limit of a set; `errors` are ``dmt_valid`` and ``dmt_error`` by point."""
    pressures, lengths, ranges = axes(adhesion)
    dataset = xr.Dataset(
        {
            "area_fraction": ensemble.area_fraction_mean.sel(pressure=pressures),
            "dmt_valid": (AXES, np.asarray(errors["dmt_valid"], dtype="i1")),
            "dmt_error": (AXES, np.asarray(errors["dmt_error"], dtype=float)),
            "q0_h_rms": roughness(adhesion),
        },
        coords={one.name: one for one in (pressures, lengths, ranges)},
    )
    linear = find_linear(adhesion, ensemble)
    quantities = partial(quantities_of, adhesion, linear)
    known = ["area_fraction", "attractive_area", "mean_gap"]
    left = grid_limits.inherit(ensemble, quantities, known)
    values, more = quantities(ensemble), coarse(ensemble, quantities)
    for name in QUANTITIES:
        controls = more and replace(more, values=more.values[name])
        limit = grid_limits.Limit(left.shift[name], left.error[name])
        dataset = add_errors(dataset, name, values[name], controls, plain=True, limit=limit)
    simulation = Simulation(read_models(laws), datasets.parameters(ensemble))
    steps = np.diff(np.log(ensemble.pressure), prepend=np.nan, append=np.nan)
    slope = SLOPE * ensemble.pressure.copy(data=np.fmax(steps[:-1], steps[1:]))
    dataset = add_budgets(conventions.annotate(dataset, **VARIABLES), simulation, linear, slope)
    for ending in ENDINGS:
        known = ensemble[f"area_fraction_mean{ending}"]
        dataset[f"area_fraction{ending}"] = known.sel(pressure=pressures)
    title = f"DMT sum and weak limit of adhesion, {adhesion['law']} traction"
    parameters = {**datasets.parameters(ensemble), **adhesion}
    datasets.write(dataset, output, title=title, parameters=parameters)


def add_budgets(dataset, simulation, linear, slope):
    """Add the errors of every quantity, for fits those at the least certain of their loads."""
    like = dataset.attraction.rename(range_over_h_rms="range")
    area = simulation.solver("area_fraction", dataset.area_fraction)
    gaps = simulation.solver("attractive_area", like).rename(range="range_over_h_rms")
    factor = simulation.factors("attractive_area", like).rename(range="range_over_h_rms")
    at_loads = np.hypot(area, gaps), factor, dataset.dmt_error
    of_fits = [one.where(linear).max("pressure") for one in at_loads]
    for name in QUANTITIES:
        solver, factor, model = of_fits if "fit" in name else at_loads
        pull, text = dataset[name], MODEL
        if name == "attraction_weak":
            model, text = slope.sel(pressure=pull.pressure), "of slopes between loads, as measured"
        if name.startswith("inverse_kappa") and "ad" not in name.split("_"):
            # The fall by attraction from what is left without.
            fall = dataset[name.replace("kappa", "kappa_ad")]
            pull = 2 * fall * pull / (1 - 2 * fall)
        error = model * abs(pull)
        if "fit" in name:
            error = np.hypot(error, linearity_error(dataset[name.removesuffix("_fit")], linear))
            text = f"{MODEL}, and what the straight line leaves out"
        solver = solver * (abs(dataset[name]) + abs(pull))
        left = dataset[f"{name}_discretisation_error"]
        dataset = with_budget(
            dataset,
            name,
            discretisation=ErrorComponent(left, grid_limits.INHERITED),
            solver=ErrorComponent(solver, "by the tolerance, as measured"),
            sampling=ErrorComponent(factor * dataset[f"{name}_standard_error"], "Student's t"),
            bandwidth=SIMULATED["bandwidth"],
            model=ErrorComponent(error, text),
        )
    return dataset.drop_vars(f"{name}_discretisation_error" for name in QUANTITIES)
