"""Adhesion of a set of parameters: by the DMT sum, and at every point by the chosen model.

Full simulations are averaged over the realisations. With kappa = 2 without adhesion, 1/kappa = 1/2
- 1/kappa_ad. 1/kappa_ad is half the relative reduction by adhesion of the pressure that belongs to
an area. The sum of the tractions gives it directly, but misses the area that they pull into
contact. Areas are those at a gap of zero; ``_net`` is the compressed part, which converges far more
slowly.
"""

from dataclasses import replace
from functools import partial

import numpy as np
import xarray as xr
from scipy import special

from adhesion import compare_edges, dmt_sum
from adhesion.dmt_sum import fit_slope, linearity_error, quantities_of, weak_attraction
from common import adhesion_sets, conventions
from common.adhesion_sets import AXES, MISSING, OUTSIDE, STATE, pressure_at, solver_error
from common.conventions import LINEAR_UP_TO
from common.ensemble_means import add_errors, coarse, describe_errors, fine
from common.error_budgets import SIMULATED
from common.job import start
from common.model_surfaces import cell_size, read_all
from stickiness import datasets
from stickiness.error_budget import SOURCES, split, with_budget
from stickiness.statistics import students_t

STATES = {n: text for n, text in STATE.items() if "area" in n or n == "external_pressure"}
SLOPES = {
    "inverse_kappa": "1/kappa = p_ext A_nom/(A_rep E* h'_rms)",
    "inverse_kappa_net": "1/kappa with the net repulsive area",
    "inverse_kappa_ad": "1/kappa_ad, from the fall of 1/kappa by adhesion",
    "inverse_kappa_ad_net": "1/kappa_ad with the net repulsive area",
    "inverse_kappa_ad_direct": "p_ad/(2 p_rep) of the adhesive contact",
}
FITS = {n: text for n, text in dmt_sum.QUANTITIES.items() if n.endswith("_fit")}
RATIOS = {
    "dmt_ratio": "1/kappa_ad of the full simulation over the DMT sum",
    "dmt_ratio_at_gap": "fall of the pressure by adhesion at equal mean gap over the DMT sum",
    "weak_ratio": "fall of the pressure by adhesion at equal mean gap over its weak limit",
}
# Slopes and fits have as their control the quantity of the DMT sum of the same name.
CONTROLS = {n: n.removesuffix("_net").removesuffix("_direct") for n in SLOPES | FITS}
ALL = STATES | SLOPES | FITS | RATIOS
NET = [name for name in ALL if "net" in name.split("_")]
# Along the edge a strip at zero gap is under tension. Next to a smooth edge and for weak attraction
# it is second order in the strength, (sigma0/B)^2 where the pressure rises as B x^(1/2), but the
# pixels make it first order: what is left of the difference falls as the root of the pixel only.
SLOW = 1 / (np.sqrt(2) - 1)  # over the change from half the resolution
# Pixels across the zone of attraction below which an attraction is a statement about the grid.
NARROWEST = 1.5
AREAS = ("repulsive_area", "net_repulsive_area")  # in the DMT sum that without adhesion
COVERED = 0.9  # confidence of the upper limit of a count of pixels
LEFT = {
    "discretisation": "change from half the resolution, or of the DMT sum what is left of it",
    "solver": "by the tolerance, as measured on the load; of strong attraction by the branch",
    "sampling": "Student's t of the standard error; of full simulation not less than what the "
    "count of turned pixels leaves open",
    "bandwidth": SIMULATED["bandwidth"].text,
    "model": "of the DMT sum as measured, of areas not known; of full simulation what comparing "
    "at equal area instead of equal mean gap changes, or what a straight line leaves out",
}
FEW = f"DMT sum, {MISSING}, a single seed, or too few loads"
OTHERS = {
    "model": "dmt: attraction over the gaps without adhesion; full: boundary elements with it",
    "residual": "largest residual of all realisations",
    "iterations": "mean iterations on the fine grid",
    "zone_strength": "width of the zone of attraction over range^2/adhesion length",
}
VARIABLES = {name: ("1", text, FEW) for name, text in OTHERS.items()}
VARIABLES |= {name: (*text[:2], FEW) for name, text in describe_errors(ALL, plain=True).items()}
VARIABLES["dmt_error"] = ("1", "measured relative error of the DMT sum in 1/kappa_ad", OUTSIDE)


def main(job):
    ensemble = datasets.read(job.input.ensemble, ["attractive_area", "area_fraction", "rms_slope"])
    errors = {"dmt_valid": job.params.jtb, "dmt_error": job.params.dmt_error}
    dmt_sum.write_limit(job.params.adhesion, ensemble, job.input.laws, errors, job.output.limit)
    limit = datasets.read(job.output.limit)
    full = xr.DataArray(np.array(job.params.full), dims=AXES)
    made, seeds, states = datasets.parameters(ensemble), [], None
    dataset = take_dmt_sum(limit)
    if job.input.realisations:
        states = read_all(job.input.realisations, ["external_pressure"])
        made, seeds = datasets.parameters(states), states.seed.values.tolist()
        solved = average(states, full, ensemble, limit, made)
        for name in dataset.keys() & solved.keys():
            chosen = full if "pressure" in dataset[name].dims else full.any("pressure")
            solved[name] = solved[name].where(chosen, dataset[name])
        dataset = dataset.assign(solved)
    dataset = dataset.drop_vars(n for n in dataset if n.endswith("_discretisation_error"))
    dataset["model"] = (AXES, np.where(full, "full", "dmt"))
    strength = limit.adhesion_length_over_range / limit.q0_h_rms
    dataset["zone_strength"] = zone_width(ensemble, limit) * strength / limit.range_over_h_rms
    dataset = conventions.annotate(dataset, **VARIABLES)
    for name in [name for name in ALL if name in dataset]:
        dataset = with_budget(dataset, name, **split(dataset[f"{name}_error"], LEFT))
    title = "adhesive contact averaged over realisations, by the model chosen"
    parameters = {**made, **datasets.parameters(limit), "seeds": seeds}
    datasets.write(dataset, job.output.averages, title=title, parameters=parameters)
    edges = xr.Dataset()
    if states:
        alone = read_all(job.input.alone, ["pixel_area_fraction", "attractive_area"])
        edges = compare_edges.compare_seeds(states, alone, dataset, parameters)
    title = "attraction at equal area of contact, simulation and model of the edges"
    datasets.write(edges, job.output.edges, title=title, parameters=parameters)


def take_dmt_sum(limit):
    """The averages by the DMT sum, in which all areas are that without adhesion."""
    none = xr.zeros_like(limit.inverse_kappa)
    dataset = limit[["q0_h_rms", "dmt_valid", "dmt_error"]]
    dataset = dataset.assign(external_pressure=limit.pressure - limit.attraction)
    for name, source in CONTROLS.items():
        dataset[name] = limit[source]
        dataset[f"{name}_error"] = limit[f"{source}_error"]
    dataset["external_pressure_error"] = limit.attraction_error
    for name in AREAS:
        dataset[name] = limit.area_fraction + none
        dataset[f"{name}_error"] = limit.area_fraction_error.where(limit.source != "model") + none
    return dataset


def average(states, full, ensemble, limit, made):
    """Means over the realisations: full simulations, or the DMT sum where there are none."""
    adhesion = datasets.parameters(limit)
    missing = states.external_pressure.isnull() & states.area_alone.notnull()
    whole = ~missing.any(["seed", "resolution"]) | ~full
    both = adhesion_sets.seeds_on_both(states)
    pixel = xr.DataArray(made["pixel"], dims=AXES[2])
    wide = zone_width(ensemble, states) >= NARROWEST * pixel
    states = add_dmt(states, full)
    in_limit = dmt_sum.find_linear(adhesion, ensemble)
    linear = in_limit & ~(fine(states.repulsive_area).mean("seed") > LINEAR_UP_TO)
    states = add_slopes(states, ensemble, linear)
    alone = ensemble.sel(seed=states.seed).isel(resolution=[-2, -1])
    alone = alone.assign_coords(resolution=states.resolution)  # the grids may be finer
    weak, fall = weak_attraction(adhesion, alone), states.pressure - states.external_pressure
    states["weak_ratio"] = ratio_of_means(fall, weak.sel(pressure=states.pressure))
    states["dmt_ratio_at_gap"] = ratio_of_means(fall, states.attraction_dmt)
    # A mean over the seeds that happen to be solved would leave out the stickiest ones.
    reported = whole & (wide | ~full)
    resolved = dict.fromkeys(STATES | SLOPES, reported) | dict.fromkeys(RATIOS, reported & full)
    resolved |= dict.fromkeys(FITS, (reported | ~linear).all("pressure"))
    # Of the coarsest solutions: of these seeds, and of many more.
    quantities = partial(controls_of, adhesion, in_limit)
    controls = coarse(ensemble, quantities)
    twins = controls and quantities(ensemble.sel(seed=states.seed)).isel(resolution=0, drop=True)
    solver = solver_error(states)
    fuller = add_slopes(add_pixels(states, made), ensemble, linear)
    dataset, source = xr.Dataset(), xr.DataArray(list(SOURCES), dims="source", name="source")
    for name in ALL:
        values, more = states[name].where(resolved[name]), None
        # What adhesion takes off the pressure is in proportion to the control.
        fixed = values.pressure if name == "external_pressure" else 0.0
        if controls and name in twins:
            more = replace(controls, values=controls.values[name], twin=twins[name])
        dataset = add_errors(dataset, name, values - fixed, more, plain=True)
        dataset[name] = dataset[name] + fixed
        value = dataset[name]
        at_worst = solver.max(set(solver.dims) - set(value.dims))
        unseen = abs(fine(fuller[name] - states[name]).mean("seed"))
        # For the seeds solved in full, which is more than enough for multilevel means.
        sampling = students_t(both.size) * dataset[f"{name}_standard_error"]
        model = 0.0
        if f"{name}_equal_area" in states:
            model = fine(states[f"{name}_equal_area"] - states[name]).sel(seed=both)
            model = model.mean("seed", skipna=False)
        elif name == "weak_ratio":
            error = limit.attraction_weak_error.sel(source="model", drop=True)
            model = error / limit.attraction_weak * value
        elif name in FITS:
            model = linearity_error(dataset[name.removesuffix("_fit")], linear)
        parts = {
            "discretisation": dataset[f"{name}_discretisation_error"]
            * (SLOW if name in NET else 1.0),
            "solver": at_worst * (abs(value) + fixed),
            "sampling": np.maximum(sampling, unseen),
            "bandwidth": 0.0,
            "model": abs(model),
        }
        parts = [(xr.zeros_like(value) + parts[s]).transpose(*value.dims) for s in SOURCES]
        dataset[f"{name}_error"] = xr.concat(parts, source)
    residual = states.residual.max(["seed", "resolution"])
    return dataset.assign(residual=residual, iterations=fine(states.iterations).mean("seed"))


def controls_of(adhesion, linear, solved):
    """What goes with states and slopes in the DMT sum, of an ensemble or its coarse solutions."""
    pressures, _, ranges = adhesion_sets.axes(adhesion)
    found = quantities_of(adhesion, linear, solved)
    alone, like = solved.sel(pressure=pressures), xr.zeros_like(found.attraction)
    within = alone.attractive_area.rename(range=ranges.name).interp({ranges.name: ranges})
    areas = dict.fromkeys(AREAS, alone.area_fraction) | {"attractive_area": within}
    states = {"external_pressure": -found.attraction} | {n: a + like for n, a in areas.items()}
    return xr.Dataset(states | {name: found[control] for name, control in CONTROLS.items()})


def add_pixels(states, made):
    """States with as much more area as the count of turned pixels cannot rule out.

    That is the upper limit of a Poisson count: 2.3 if no pixel turned, of which scatter knows
    nothing. Where pixels turn in strips along the edges, scatter is larger and is the error.
    """
    pixels = fine(states.area_alone).count("seed") * adhesion_sets.count_points(made)
    turned = pixels * abs(fine(states.repulsive_area - states.area_alone)).mean("seed")
    unseen = xr.apply_ufunc(special.gammaincinv, turned + 1, COVERED) - turned
    return states.assign({n: states[n] + unseen / pixels for n in STATES if "area" in n})


def add_dmt(states, full):
    """States, by the DMT sum where no full simulation is wanted."""
    limit = {
        "external_pressure": states.pressure - states.attraction_dmt,
        "repulsive_area": states.area_alone,
        "net_repulsive_area": states.area_alone,
        "attraction": states.attraction_dmt,
        "repulsive_pressure": states.pressure,
    }
    return states.assign({name: states[name].where(full, value) for name, value in limit.items()})


def add_slopes(states, ensemble, linear):
    """Add what compares area and load with and without adhesion."""
    curve = fine(ensemble.area_fraction).sel(seed=states.seed)
    alone = states.pressure / states.area_alone
    external, area = states.external_pressure, states.repulsive_area
    held, net = external / area, external / states.net_repulsive_area
    slopes = {
        "inverse_kappa": held / states.rms_slope,
        "inverse_kappa_net": net / states.rms_slope,
        "inverse_kappa_ad": (1 - held / alone) / 2,
        "inverse_kappa_ad_net": (1 - net / alone) / 2,
        "inverse_kappa_ad_direct": states.attraction / states.repulsive_pressure / 2,
        "inverse_kappa_ad_equal_area": (1 - external / pressure_at(states, curve)) / 2,
    }
    fit = fit_slope(external, area, linear)
    fit_alone = fit_slope(states.pressure, states.area_alone, linear)
    slopes["inverse_kappa_fit"] = fit / states.rms_slope
    slopes["inverse_kappa_ad_fit"] = (1 - fit / fit_alone) / 2
    limit = states.attraction_dmt / states.pressure / 2
    for ending in ("", "_equal_area"):
        slopes[f"dmt_ratio{ending}"] = ratio_of_means(slopes[f"inverse_kappa_ad{ending}"], limit)
    return states.assign(slopes)


def ratio_of_means(values, limit):
    """Ratio of the means over seeds, as samples that scatter about it to first order."""
    mean_limit = limit.where(values.notnull()).mean("seed")
    best = values.mean("seed") / mean_limit
    return best + (values - best * limit) / mean_limit


def zone_width(ensemble, at):
    """Mean width of the zone of attraction without adhesion, times q0."""
    made = datasets.parameters(ensemble)
    edge = ensemble.edge_gap_mean.sel(pressure=at.pressure)
    edge, range_ = xr.broadcast(edge, at.range_over_h_rms)
    # The gap beside an edge grows with the distance to the power 3/2.
    return cell_size(made) / made["grid_points"] * np.cbrt(range_ / edge) ** 2


if __name__ == "__main__":
    main(start(globals(), "average_adhesive", adhesion="fig4b_rough"))
