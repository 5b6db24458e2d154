"""Full simulation against the model of the edges of contact, at equal area of contact.

Adhesive states are compared, seed by seed, with the contact without adhesion that has the same
area. The reduction of the load by adhesion, over the attraction by the DMT sum, is the effect
that the equivalent sphere models.
"""

import numpy as np
import xarray as xr

from adhesion.dmt_sum import integrate_law
from common import conventions
from common.adhesion_sets import count_points, pressure_at, seeds_on_both, solver_error
from common.ensemble_means import ensemble_mean, fine
from common.error_budgets import SIMULATED
from stickiness.criteria import equivalent_sphere
from stickiness.error_budget import ErrorComponent, with_budget
from stickiness.statistics import students_t

# Points of the grid that adhesion must draw into contact for their number to tell an area to 10 %.
FEWEST_POINTS = 100
MISSING = (
    f"not resolved, fewer than {FEWEST_POINTS} points of the grid drawn into contact, a window "
    "closes, or the area is beyond the curve without adhesion"
)
EFFECT = "attraction at equal area of contact over the DMT sum"
EDGE_VARIABLES = {
    "attractive_over_contact": ("1", "attractive over contact area without adhesion", MISSING),
    "edge_strength": ("1", "Tabor's parameter of the edges", MISSING),
    "effect": ("1", EFFECT, MISSING),
    "effect_model": ("1", f"{EFFECT}, by the equivalent sphere", MISSING),
    "over_model": ("1", "simulation over model, mean over realisations", MISSING),
}


def compare_seeds(adhesive, alone, averages, adhesion):
    """Compare all realisations with the model, and average where averages are reported."""
    by_grid = []
    for grid in (0, -1):
        by_seed = [
            compare(adhesive.sel(seed=seed), alone.sel(seed=seed), adhesion, grid)
            for seed in adhesive.seed
        ]
        by_grid.append(xr.concat(by_seed, "seed"))
    states = xr.concat(by_grid, adhesive.resolution)
    both = seeds_on_both(adhesive)
    resolved = fine(states.effect).sel(seed=both).notnull().all("seed")
    resolved &= averages.dmt_ratio.notnull()
    averaged = {name: ensemble_mean(states[name].where(resolved)) for name in states}
    dataset = xr.Dataset({name: mean.value for name, mean in averaged.items()})
    dataset = conventions.annotate(dataset.assign(q0_h_rms=averages.q0_h_rms), **EDGE_VARIABLES)
    for name in ("effect", "over_model"):
        change = abs(states[name].diff("resolution").mean(["seed", "resolution"]))
        solver = solver_error(adhesive) * dataset[name]
        error = students_t(both.size) * averaged[name].standard_error
        dataset = with_budget(
            dataset,
            name,
            discretisation=ErrorComponent(change, "change from half the resolution"),
            solver=ErrorComponent(solver, "by tolerance and branch, as measured"),
            sampling=ErrorComponent(error, "Student's t"),
            **SIMULATED,
        )
    return dataset


def compare(adhesive, alone, adhesion, grid):
    """Measure and model the effect of attraction for one realisation on one of its grids."""
    adhesive = adhesive.isel(resolution=grid, drop=True)
    strength = adhesive.adhesion_length_over_range / adhesion["q0_h_rms"]
    alone = alone.isel(resolution=-1, drop=True)
    load = pressure_at(adhesive, alone.pixel_area_fraction)
    pressure = adhesive.pressure
    areas = integrate_law(adhesion, alone.attractive_area)
    # In proportion to the adhesion length: all have the same growth.
    areas = np.log(areas.isel(adhesion_length_over_range=0, drop=True))
    of_loads = areas.assign_coords(pressure=np.log(areas.pressure))
    # Where the load is unknown, any will do: xarray warns of coordinates that are all missing.
    reached = of_loads.interp(pressure=np.log(load.fillna(pressure))).where(load.notnull())
    growth = reached - of_loads.interp(pressure=np.log(pressure))
    growth = np.exp(growth.drop_vars("pressure", errors="ignore"))
    attractive = adhesive.attraction_dmt / strength * growth
    area_ratio = attractive / adhesive.repulsive_area
    resolved = (area_ratio * load).notnull() & (area_ratio > 0)
    # The model refuses what is not known.
    over_mean_pressure = (strength * adhesive.repulsive_area / load).where(resolved, 1.0)
    known_ratio = area_ratio.where(resolved, 1.0)
    tau = xr.apply_ufunc(equivalent_sphere.edge_strength, known_ratio, over_mean_pressure)
    model = xr.apply_ufunc(equivalent_sphere.effect, known_ratio, tau).where(resolved)
    effect = (load - adhesive.external_pressure) / (strength * attractive)
    drawn_in = (adhesive.repulsive_area - adhesive.area_alone) * count_points(adhesion)
    reported = drawn_in >= FEWEST_POINTS if grid else drawn_in > 0
    return xr.Dataset(
        {
            "attractive_over_contact": area_ratio,
            "edge_strength": tau.where(resolved),
            "effect": effect.where(reported),
            "effect_model": model,
            "over_model": (effect / model).where(reported),
        }
    )
