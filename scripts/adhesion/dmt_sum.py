"""DMT sum and weak limit of adhesion, from the attractive areas of contact without adhesion."""

from dataclasses import replace
from functools import partial

import numpy as np
import xarray as xr

from common import continuum_values, conventions
from common.adhesion_sets import AXES, OUTSIDE, axes, scaled_law
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
# Fitted slopes, and the slopes load by load that they are fitted to.
FITS = {"inverse_kappa_fit": "inverse_kappa", "inverse_kappa_ad_fit": "inverse_kappa_ad"}
# Slopes with the attraction, and by how much it lowers them.
FALLS = {"inverse_kappa": "inverse_kappa_ad", "inverse_kappa_fit": "inverse_kappa_ad_fit"}
FEW = "fewer than two loads to fit, fewer than three in all, or a single seed"
describe = partial(describe_errors, plain=True, discretisation=continuum_values.INHERITED)
of_loads = describe({name: QUANTITIES[name] for name in (*FITS, "attraction_weak")})
DMT_SUM_VARIABLES = describe(QUANTITIES)
DMT_SUM_VARIABLES |= {name: (*text[:2], FEW) for name, text in of_loads.items()}
DMT_SUM_VARIABLES["dmt_error"] = ("1", "measured relative error of this 1/kappa_ad", OUTSIDE)
MODEL = "of the DMT sum against full simulation, as measured"
# Relative error of a slope between loads over the logarithm of their step, see `weak_attraction`.
SLOPE = 0.05


def find_linear(adhesion, ensemble):
    """Find the pressures of a set whose mean area is small enough for the fit of a slope."""
    area = ensemble.area_fraction_mean.sel(pressure=axes(adhesion)[0])
    return (area <= LINEAR_UP_TO).drop_vars(set(area.coords) - {"pressure"})


def quantities_of(adhesion, linear, solved):
    """Compute the `QUANTITIES` of a set from an ensemble, its coarse solutions or its means."""
    weak = weak_attraction(adhesion, solved)
    solved = solved.sel(pressure=axes(adhesion)[0])
    attraction = integrate_law(adhesion, solved.attractive_area)
    external = solved.pressure - attraction
    area = solved.area_fraction * solved.rms_slope
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
    potential = potential - lengths * ranges / adhesion["q0_h_rms"] * solved.area_fraction
    if solved.sizes["pressure"] < 3:
        return potential * np.nan
    return xr.apply_ufunc(
        dmt.weak_attraction,
        solved.pressure,
        solved.mean_gap,
        potential,
        input_core_dims=[["pressure"]] * 3,
        output_core_dims=[["pressure"]],
    )


def integrate_law(adhesion, areas, name="traction"):
    """Average the traction, or another method of the law, over the distribution of gaps."""
    _, lengths, ranges = axes(adhesion)
    tabulated = areas["range"].values
    smallest = tabulated[0]
    largest = tabulated[-1]
    count = round(np.log10(largest / smallest) * PER_DECADE) + 1
    logs = np.log(np.maximum(areas, SMALLEST)).assign_coords(range=np.log(tabulated))
    parts = []
    for range_ in ranges.values:
        # In proportion to the adhesion length: once for the smallest of them.
        law = scaled_law(adhesion, adhesion["law"], float(lengths[0]), range_)
        nodes = np.union1d(np.geomspace(smallest, largest, count), [range_])
        log_nodes = np.log(nodes).clip(np.log(smallest), np.log(largest))
        area = np.exp(logs.interp(range=log_nodes))
        total = xr.apply_ufunc(
            dmt.sum_over_gaps,
            area,
            nodes,
            getattr(law, name),
            input_core_dims=[["range"], [], []],
        )
        parts.append(total)
    return xr.concat(parts, ranges) * (lengths / lengths[0])


def fit_slope(external, area, linear):
    """Fitted slope of pressure against area through the origin; NaN for fewer than two loads."""
    inside = linear & (linear.sum("pressure") > 1)
    product = (external * area).where(inside)
    square = (area**2).where(inside)
    slope = product.sum("pressure") / square.sum("pressure")
    # Where a load is missing there is no slope: the others alone would have another.
    return slope.where((product.notnull() | ~inside).all("pressure") & inside.any("pressure"))


def linearity_error(values, linear):
    """Error of a straight line: half the range of the values over its loads."""
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
            "q0_h_rms": adhesion["q0_h_rms"],
        },
        coords={axis.name: axis for axis in (pressures, lengths, ranges)},
    )

    # Means over the seeds in the limit of fine grids, corrected by coarse solutions of many more.
    linear = find_linear(adhesion, ensemble)
    quantities = partial(quantities_of, adhesion, linear)
    inherited = continuum_values.inherit(
        ensemble, quantities, ["area_fraction", "attractive_area", "mean_gap"]
    )
    values = quantities(ensemble)
    more = coarse(ensemble, quantities)
    for name in QUANTITIES:
        controls = more and replace(more, values=more.values[name])
        correction = continuum_values.Correction(inherited.shift[name], inherited.error[name])
        dataset = add_errors(
            dataset, name, values[name], controls, plain=True, correction=correction
        )

    simulation = Simulation(read_models(laws), datasets.parameters(ensemble))
    steps = np.diff(np.log(ensemble.pressure), prepend=np.nan, append=np.nan)
    slope_error = SLOPE * ensemble.pressure.copy(data=np.fmax(steps[:-1], steps[1:]))
    dataset = conventions.annotate(dataset, **DMT_SUM_VARIABLES)
    dataset = add_budgets(dataset, simulation, linear, slope_error)
    for ending in ENDINGS:
        error = ensemble[f"area_fraction_mean{ending}"]
        dataset[f"area_fraction{ending}"] = error.sel(pressure=pressures)
    title = f"DMT sum and weak limit of adhesion, {adhesion['law']} traction"
    # Of both, `window` and `seeds` of the ensemble are meant.
    parameters = {**adhesion, **datasets.parameters(ensemble)}
    datasets.write(dataset, output, title=title, parameters=parameters)


def add_budgets(dataset, simulation, linear, slope_error):
    """Add the errors of every quantity, for fits those at the least certain of their loads."""
    like = dataset.attraction.rename(range_over_h_rms="range")
    of_area = simulation.solver("area_fraction", dataset.area_fraction)
    of_gaps = simulation.solver("attractive_area", like).rename(range="range_over_h_rms")
    relative = {
        "solver": np.hypot(of_area, of_gaps),
        "sampling": simulation.factors("attractive_area", like).rename(range="range_over_h_rms"),
        "model": dataset.dmt_error,
    }
    relative_of_fits = {
        source: error.where(linear).max("pressure") for source, error in relative.items()
    }
    for name in QUANTITIES:
        is_fit = name in FITS
        sources = relative_of_fits if is_fit else relative
        value = dataset[name]

        # The model errs in proportion to the attraction that a quantity contains.
        attraction = value
        model = sources["model"]
        model_text = MODEL
        if name == "attraction_weak":
            model = slope_error.sel(pressure=value.pressure)
            model_text = "of slopes between loads, as measured"
        if name in FALLS:
            # The fall by attraction from what is left without.
            fall = dataset[FALLS[name]]
            attraction = 2 * fall * value / (1 - 2 * fall)
        model_error = model * abs(attraction)
        if is_fit:
            left_out = linearity_error(dataset[FITS[name]], linear)
            model_error = np.hypot(model_error, left_out)
            model_text = f"{MODEL}, and what the straight line leaves out"

        solver = sources["solver"] * (abs(value) + abs(attraction))
        grid = dataset[f"{name}_discretisation_error"]
        sampling = sources["sampling"] * dataset[f"{name}_standard_error"]
        dataset = with_budget(
            dataset,
            name,
            discretisation=ErrorComponent(grid, continuum_values.INHERITED),
            solver=ErrorComponent(solver, "by the tolerance, as measured"),
            sampling=ErrorComponent(sampling, "Student's t"),
            bandwidth=SIMULATED["bandwidth"],
            model=ErrorComponent(model_error, model_text),
        )
    return dataset.drop_vars(f"{name}_discretisation_error" for name in QUANTITIES)
