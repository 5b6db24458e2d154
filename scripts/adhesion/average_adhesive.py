"""Adhesion of a set of parameters: by the DMT sum, and at every point by the chosen model.

Full simulations are averaged over the realisations. With kappa = 2 without adhesion, 1/kappa = 1/2
- 1/kappa_ad. 1/kappa_ad is half the relative fall by adhesion of the pressure that makes a given
area. The DMT sum gives the attraction directly, but not the area that it draws in.

Areas are those at a gap of zero; ``_net`` is the compressed part, which converges far more slowly.
"""

from dataclasses import replace
from functools import partial

import numpy as np
import xarray as xr
from scipy import special

from adhesion import compare_edges, dmt_sum
from adhesion.dmt_sum import FITS, fit_slope, linearity_error, quantities_of, weak_attraction
from common import adhesion_sets, conventions
from common.adhesion_sets import AXES, MISSING, OUTSIDE, STATE, pressure_at, solver_error
from common.conventions import LINEAR_UP_TO
from common.ensemble_means import add_errors, coarse, describe_errors, fine
from common.error_budgets import SIMULATED
from common.job import start
from common.model_surfaces import cell_size, read_block
from stickiness import datasets
from stickiness.error_budget import SOURCES, split, with_budget
from stickiness.statistics import students_t

AREAS = ("repulsive_area", "net_repulsive_area", "attractive_area")
STATES = {name: STATE[name] for name in ("external_pressure", *AREAS)}
SLOPES = {
    "inverse_kappa": "1/kappa = p_ext A_nom/(A_rep E* h'_rms)",
    "inverse_kappa_net": "1/kappa with the net repulsive area",
    "inverse_kappa_ad": "1/kappa_ad, from the fall of 1/kappa by adhesion",
    "inverse_kappa_ad_net": "1/kappa_ad with the net repulsive area",
    "inverse_kappa_ad_direct": "p_ad/(2 p_rep) of the adhesive contact",
}
RATIOS = {
    "dmt_ratio": "1/kappa_ad of the full simulation over the DMT sum",
    "dmt_ratio_at_gap": "fall of the pressure by adhesion at equal mean gap over the DMT sum",
    "weak_ratio": "fall of the pressure by adhesion at equal mean gap over its weak limit",
}
ALL = STATES | SLOPES | {name: dmt_sum.QUANTITIES[name] for name in FITS} | RATIOS
# Quantities of the DMT sum that slopes and fits have as their control.
CONTROLS = {
    "inverse_kappa": "inverse_kappa",
    "inverse_kappa_net": "inverse_kappa",
    "inverse_kappa_ad": "inverse_kappa_ad",
    "inverse_kappa_ad_net": "inverse_kappa_ad",
    "inverse_kappa_ad_direct": "inverse_kappa_ad",
    **{name: name for name in FITS},
}
# Averages of the compressed part, which leaves out a strip under tension at zero gap next to the
# edge. By theory the strip is second order in the strength for weak attraction, (sigma0/B)^2 where
# the pressure rises as B x^(1/2). Pixels make it first order, so that the difference falls as the
# root of the pixel only.
NET = ("net_repulsive_area", "inverse_kappa_net", "inverse_kappa_ad_net")
SLOW = 1 / (np.sqrt(2) - 1)  # over the change from half the resolution
# Pixels across the zone of attraction below which an attraction is a statement about the grid.
NARROWEST = 1.5
CONTACT_AREAS = AREAS[:2]  # those without adhesion, in the DMT sum
ERROR_TEXTS = {
    "discretisation": "change from half the resolution, or of the DMT sum what is left of it",
    "solver": "by the tolerance, as measured on the load; of strong attraction by the branch",
    "sampling": "Student's t of the standard error; of full simulation not less than what the "
    "count of turned pixels leaves open",
    "bandwidth": SIMULATED["bandwidth"].text,
    "model": "of the DMT sum as measured, of areas not known; of full simulation what comparing "
    "at equal area instead of equal mean gap changes, or what a straight line leaves out",
}
FEW = f"DMT sum, {MISSING}, a single seed, or too few loads"
AVERAGE_VARIABLES = {
    "model": (
        "1",
        "dmt: attraction over the gaps without adhesion; full: boundary elements with it",
        FEW,
    ),
    "residual": ("1", "largest residual of all realisations", FEW),
    "iterations": ("1", "mean iterations on the fine grid", FEW),
    "zone_strength": ("1", "width of the zone of attraction over range^2/adhesion length", FEW),
    **{name: (*text[:2], FEW) for name, text in describe_errors(ALL, plain=True).items()},
    "dmt_error": ("1", "measured relative error of the DMT sum in 1/kappa_ad", OUTSIDE),
}


def main(job):
    # The DMT sum of every point.
    ensemble = datasets.read(job.input.ensemble, ["attractive_area", "area_fraction", "rms_slope"])
    errors = {"dmt_valid": job.params.jtb, "dmt_error": job.params.dmt_error}
    dmt_sum.write_limit(job.params.adhesion, ensemble, job.input.laws, errors, job.output.limit)
    dmt = datasets.read(job.output.limit)
    dataset = take_dmt_sum(dmt)

    # Full simulations at the points that ask for them.
    full = xr.DataArray(np.array(job.params.full), dims=AXES)
    origin = datasets.parameters(ensemble)
    seeds = []
    states = None
    if job.input.realisations:
        states = read_block(job.input.realisations, ["external_pressure"], job.params.seeds)
        origin = datasets.parameters(states)
        seeds = job.params.seeds
        solved = average(states, full, ensemble, dmt, origin)
        for name in dataset.keys() & solved.keys():
            chosen = full if "pressure" in dataset[name].dims else full.any("pressure")
            solved[name] = solved[name].where(chosen, dataset[name])
        dataset = dataset.assign(solved)

    dataset = dataset.drop_vars(n for n in dataset if n.endswith("_discretisation_error"))
    dataset["model"] = (AXES, np.where(full, "full", "dmt"))
    strength = dmt.adhesion_length_over_range / dmt.q0_h_rms
    dataset["zone_strength"] = zone_width(ensemble, dmt) * strength / dmt.range_over_h_rms
    dataset = conventions.annotate(dataset, **AVERAGE_VARIABLES)
    for name in [name for name in ALL if name in dataset]:
        dataset = with_budget(dataset, name, **split(dataset[f"{name}_error"], ERROR_TEXTS))
    title = "adhesive contact averaged over realisations, by the model chosen"
    parameters = {**origin, **datasets.parameters(dmt), "seeds": seeds}
    datasets.write(dataset, job.output.averages, title=title, parameters=parameters)

    # The edges of contact, compared with the model that verdicts use.
    edges = xr.Dataset()
    if states:
        kept = ["pixel_area_fraction", "attractive_area"]
        alone = read_block(job.input.alone, kept, seeds, job.params.pressures)
        edges = compare_edges.compare_seeds(states, alone, dataset, parameters)
    title = "attraction at equal area of contact, simulation and model of the edges"
    datasets.write(edges, job.output.edges, title=title, parameters=parameters)


def take_dmt_sum(dmt):
    """Take the averages from the DMT sum: every area is the one without adhesion."""
    none = xr.zeros_like(dmt.inverse_kappa)
    dataset = dmt[["q0_h_rms", "dmt_valid", "dmt_error"]]
    dataset = dataset.assign(external_pressure=dmt.pressure - dmt.attraction)
    for name, source in CONTROLS.items():
        dataset[name] = dmt[source]
        dataset[f"{name}_error"] = dmt[f"{source}_error"]
    dataset["external_pressure_error"] = dmt.attraction_error
    for name in CONTACT_AREAS:
        dataset[name] = dmt.area_fraction + none
        dataset[f"{name}_error"] = dmt.area_fraction_error.where(dmt.source != "model") + none
    return dataset


def average(states, full, ensemble, dmt, parameters):
    """Average the realisations: full simulations, or the DMT sum where there are none.

    Every average ``NAME`` comes with its errors by source, ``NAME_error``. `dmt` is the DMT sum
    of the set, `parameters` are those of the file of the states.
    """
    adhesion = datasets.parameters(dmt)
    seeds = adhesion_sets.seeds_on_both(states)
    reported = find_reported(states, full, ensemble, parameters)

    # Where no full simulation is wanted, the DMT sum stands in its place.
    states = add_dmt(states, full)
    linear_alone = dmt_sum.find_linear(adhesion, ensemble)
    linear = linear_alone & ~(fine(states.repulsive_area).mean("seed") > LINEAR_UP_TO)
    chosen = dict.fromkeys(ALL, reported)
    chosen |= dict.fromkeys(RATIOS, reported & full)
    chosen |= dict.fromkeys(FITS, (reported | ~linear).all("pressure"))

    # What is compared with the contact without adhesion: at equal area and at equal mean gap.
    states = add_slopes(states, ensemble, linear)
    states = add_ratios_at_gap(states, ensemble, adhesion)

    # The same with the largest area that turned pixels may hide.
    enlarged = add_slopes(add_pixels(states, parameters), ensemble, linear)

    controls = find_controls(ensemble, states.seed, adhesion, linear_alone)
    solver = solver_error(states)
    source = xr.DataArray(list(SOURCES), dims="source", name="source")
    dataset = xr.Dataset()
    for name in ALL:
        values = states[name].where(chosen[name])
        # Only the fall by adhesion is in proportion to the control.
        fixed = values.pressure if name == "external_pressure" else 0.0
        dataset = add_errors(dataset, name, values - fixed, controls.get(name), plain=True)
        dataset[name] = dataset[name] + fixed
        value = dataset[name]
        grid_factor = SLOW if name in NET else 1.0
        # The largest along dimensions that the value lacks.
        relative_solver = solver.max(set(solver.dims) - set(value.dims))
        unseen = abs(fine(enlarged[name] - states[name]).mean("seed"))
        errors = {
            "discretisation": dataset[f"{name}_discretisation_error"] * grid_factor,
            "solver": relative_solver * (abs(value) + fixed),
            "sampling": sampling_error(dataset, name, seeds, unseen),
            "bandwidth": 0.0,
            "model": abs(model_error(dataset, name, states, seeds, dmt, linear)),
        }
        parts = [(xr.zeros_like(value) + errors[s]).transpose(*value.dims) for s in SOURCES]
        dataset[f"{name}_error"] = xr.concat(parts, source)
    residual = states.residual.max(["seed", "resolution"])
    return dataset.assign(residual=residual, iterations=fine(states.iterations).mean("seed"))


def find_reported(states, full, ensemble, parameters):
    """Points whose average is reported: solved for all seeds, on a grid that resolves the edge."""
    # A mean over the seeds that happen to be solved would leave out the stickiest ones.
    missing = states.external_pressure.isnull() & states.area_alone.notnull()
    solved = ~missing.any(["seed", "resolution"]) | ~full
    pixel = xr.DataArray(parameters["pixel"], dims=AXES[2])
    wide = zone_width(ensemble, states) >= NARROWEST * pixel
    return solved & (wide | ~full)


def find_controls(ensemble, seeds, adhesion, linear):
    """Control variates by name: the DMT sum of coarse solutions, of these seeds and of many more.

    Empty if the ensemble has no coarse solutions.
    """
    quantities = partial(controls_of, adhesion, linear)
    controls = coarse(ensemble, quantities)
    if controls is None:
        return {}
    twins = quantities(ensemble.sel(seed=seeds)).isel(resolution=0, drop=True)
    return {
        name: replace(controls, values=controls.values[name], twin=twins[name]) for name in twins
    }


def sampling_error(dataset, name, seeds, unseen):
    """Error that covers 90 %: Student's t, and at least what the turned pixels leave open."""
    # t for the few seeds solved in full, which is conservative for multilevel means.
    sampling = students_t(seeds.size) * dataset[f"{name}_standard_error"]
    return np.maximum(sampling, unseen)


def model_error(dataset, name, states, seeds, dmt, linear):
    """Change of a quantity by another way of comparing with contact without adhesion; 0 if none."""
    if f"{name}_equal_area" in states:
        # Equal area in place of equal mean gap.
        change = fine(states[f"{name}_equal_area"] - states[name]).sel(seed=seeds)
        return change.mean("seed", skipna=False)
    if name == "weak_ratio":
        error = dmt.attraction_weak_error.sel(source="model", drop=True)
        return error / dmt.attraction_weak * dataset[name]
    if name in FITS:
        return linearity_error(dataset[FITS[name]], linear)
    return 0.0


def controls_of(adhesion, linear, solved):
    """The DMT sum of states and slopes, from an ensemble or from its coarse solutions."""
    pressures, _, ranges = adhesion_sets.axes(adhesion)
    sums = quantities_of(adhesion, linear, solved)
    alone = solved.sel(pressure=pressures)
    zero = xr.zeros_like(sums.attraction)
    within = alone.attractive_area.rename(range=ranges.name).interp({ranges.name: ranges})
    controls = {
        "external_pressure": -sums.attraction,
        "attractive_area": within + zero,
        **dict.fromkeys(CONTACT_AREAS, alone.area_fraction + zero),
        **{name: sums[control] for name, control in CONTROLS.items()},
    }
    return xr.Dataset(controls)


def add_pixels(states, parameters):
    """Add to the states the area that the count of turned pixels cannot rule out.

    A pixel has turned if adhesion draws it into contact. The added area is the upper limit of a
    Poisson count: 2.3 pixels if none turned, which the scatter between seeds cannot show. Where
    pixels turn in strips along the edges, the scatter is larger than this.
    """
    covered = 0.9  # confidence of the limit
    pixels = fine(states.area_alone).count("seed") * adhesion_sets.count_points(parameters)
    turned = pixels * abs(fine(states.repulsive_area - states.area_alone)).mean("seed")
    unseen = xr.apply_ufunc(special.gammaincinv, turned + 1, covered) - turned
    return states.assign({name: states[name] + unseen / pixels for name in AREAS})


def add_dmt(states, full):
    """Replace states by the DMT sum where no full simulation is wanted."""
    dmt_states = {
        "external_pressure": states.pressure - states.attraction_dmt,
        "repulsive_area": states.area_alone,
        "net_repulsive_area": states.area_alone,
        "attraction": states.attraction_dmt,
        "repulsive_pressure": states.pressure,
    }
    return states.assign(
        {name: states[name].where(full, value) for name, value in dmt_states.items()}
    )


def add_slopes(states, ensemble, linear):
    """Add 1/kappa and 1/kappa_ad, from areas and loads with and without adhesion."""
    curve = fine(ensemble.area_fraction).sel(seed=states.seed)
    external = states.external_pressure

    # Load over area: without adhesion, with it, and with the compressed area alone.
    alone = states.pressure / states.area_alone
    adhesive = external / states.repulsive_area
    compressed = external / states.net_repulsive_area
    slopes = {
        "inverse_kappa": adhesive / states.rms_slope,
        "inverse_kappa_net": compressed / states.rms_slope,
        "inverse_kappa_ad": (1 - adhesive / alone) / 2,
        "inverse_kappa_ad_net": (1 - compressed / alone) / 2,
        "inverse_kappa_ad_direct": states.attraction / states.repulsive_pressure / 2,
        "inverse_kappa_ad_equal_area": (1 - external / pressure_at(states, curve)) / 2,
    }

    # The same from straight lines through the origin.
    fit = fit_slope(external, states.repulsive_area, linear)
    fit_alone = fit_slope(states.pressure, states.area_alone, linear)
    slopes["inverse_kappa_fit"] = fit / states.rms_slope
    slopes["inverse_kappa_ad_fit"] = (1 - fit / fit_alone) / 2

    dmt_slope = states.attraction_dmt / states.pressure / 2
    for ending in ("", "_equal_area"):
        slopes[f"dmt_ratio{ending}"] = ratio_of_means(
            slopes[f"inverse_kappa_ad{ending}"], dmt_slope
        )
    return states.assign(slopes)


def add_ratios_at_gap(states, ensemble, adhesion):
    """Add the fall of the pressure at equal mean gap, over its weak limit and the DMT sum."""
    alone = ensemble.sel(seed=states.seed).isel(resolution=[-2, -1])
    alone = alone.assign_coords(
        resolution=states.resolution
    )  # labels only: these may be finer grids
    weak = weak_attraction(adhesion, alone).sel(pressure=states.pressure)
    fall = states.pressure - states.external_pressure
    return states.assign(
        weak_ratio=ratio_of_means(fall, weak),
        dmt_ratio_at_gap=ratio_of_means(fall, states.attraction_dmt),
    )


def ratio_of_means(values, reference):
    """Ratio of two means over seeds, as one sample a seed.

    The samples average to the ratio, and scatter about it as the ratio does to first order.
    """
    mean_reference = reference.where(values.notnull()).mean("seed")
    best = values.mean("seed") / mean_reference
    return best + (values - best * reference) / mean_reference


def zone_width(ensemble, points):
    """Mean width, times q0, of the zone around contact without adhesion that is within range."""
    grid = datasets.parameters(ensemble)
    edge = ensemble.edge_gap_mean.sel(pressure=points.pressure)
    edge, range_ = xr.broadcast(edge, points.range_over_h_rms)
    # The gap beside an edge grows with the distance to the power 3/2.
    return cell_size(grid) / grid["grid_points"] * np.cbrt(range_ / edge) ** 2


if __name__ == "__main__":
    main(start(globals()))
