"""Solve full adhesion on the same realisations with every grid and tolerance, and time it.

A few realisations are solved with every setting, more on the usual grid and coarser ones alone:
those tell how the quantities scatter. A press that separates from a load gives the pull-off.
"""

from itertools import product

import numpy as np
import xarray as xr

from common.adhesion_sets import LEAST, STRONGEST, scaled_law, solve_at_gap
from common.job import start
from common.model_surfaces import cell_size, grid_points
from stickiness import adhesive, dmt
from stickiness.repulsive import solver
from tradeoff import measuring

FINEST_TOLERANCE = 1e-10  # the reference of the other tolerances
DECADES, PER_DECADE = 4, 10  # of the loads below the largest, for the pull-off by the DMT sum
POINT = ("range_over_h_rms", "adhesion_length_over_range")
CLOSED = "a window closes"
STATES = {
    "pressure": "mean pressure without adhesion at the same mean gap over E* q0 h_rms",
    "external_pressure": ("1", "mean pressure over E* q0 h_rms", CLOSED),
    "repulsive_area": ("1", "area at a gap of zero over nominal area, by pixels", CLOSED),
    "attraction_dmt": "attraction over the gaps without adhesion over E* q0 h_rms",
    "area_alone": "contact area without adhesion over nominal area, by pixels",
    "seconds": ("s", "processor time of an adhesive state", CLOSED),
}
PULL_OFFS = {
    "pull_off": "lowest mean pressure over E* q0 h_rms",
    "pull_off_dmt": ("1", "the same by the DMT sum", "not with the usual grid and tolerance"),
    "seconds": ("s", "processor time of the separation"),
}


def main(job):
    surface, asked = job.params.case, job.params.adhesion
    usual = asked["at_pixels"], asked["at_tolerance"]
    made = {**surface, "q0_h_rms": asked["q0_h_rms"], "at_pixels": usual[0]}
    grids = [p for p in asked["pixels"] if grid_points(surface, p) <= asked["most_points"]]
    seeds, more = range(1, asked["seeds"] + 1), range(1, asked["more_seeds"] + 1)
    wanted = [
        *product(grids, usual[1:], seeds),
        *product(usual[:1], [*asked["tolerances"], FINEST_TOLERANCE], seeds),
        *product([p for p in grids if p <= usual[0]], usual[1:], more),
    ]
    states = measuring.record(wanted, lambda *setting: solve_states(surface, asked, *setting))
    title = "full adhesion of the same realisations with various settings"
    measuring.write(states, job.output.states, title, made | {"tolerance": usual[1]}, **STATES)

    asked = asked | asked["pull_off"]
    usual, seeds = (usual[0], asked["at_tolerance"]), range(1, asked["seeds"] + 1)
    wanted = [
        *product(asked["pixels"], usual[1:], seeds),
        *product(usual[:1], asked["tolerances"], seeds),
    ]
    found = measuring.record(wanted, lambda *setting: separate(surface, asked, *setting))
    made |= {"pressure": asked["pressure"], "tolerance": usual[1]}
    title = "pull-off of the same realisations with various settings"
    measuring.write(found, job.output.pull_off, title, made, **PULL_OFFS)


def solve_states(surface, asked, pixels, tolerance, seed):
    """Solve one realisation at every load and point; NaN if a window closes."""
    heights, length = measuring.make_heights(surface, pixels, seed)[0], cell_size(surface)
    loads, (laws, coordinates) = np.array(asked["pressures"]), list_laws(asked)
    values = {n: np.full((len(loads), len(laws)), np.nan) for n in STATES if n != "pressure"}
    for i, contact in enumerate(solver.load_path(heights, length, loads, tol=tolerance)):
        values["area_alone"][i] = contact.area_fraction
        for k, law in enumerate(laws):
            attraction = dmt.adhesive_pressure(contact.gap, law)
            values["attraction_dmt"][i, k] = attraction
            if attraction > STRONGEST * contact.mean_pressure:
                continue
            problem = heights, length, law, contact, tolerance
            state, values["seconds"][i, k] = measuring.time_task(solve_at_gap, *problem)
            values["external_pressure"][i, k] = state.mean_pressure
            values["repulsive_area"][i, k] = state.repulsive_area_fraction
    dims = "pressure", "point"
    return xr.Dataset({n: (dims, v) for n, v in values.items()}, {"pressure": loads} | coordinates)


def separate(surface, asked, pixels, tolerance, seed):
    """Find the lowest mean pressure on separation with every law, and the time it took."""
    heights, length = measuring.make_heights(surface, pixels, seed)[0], cell_size(surface)
    (laws, coordinates), largest = list_laws(asked), asked["pressure"]
    options = {"balance": asked["at_balance"], "smallest_jump": asked["at_balance"], "steps": LEAST}

    def lowest(law):
        turns = largest, -2 * law.strength
        path = adhesive.path(heights, length, law, turns, tol=tolerance, **options)
        return min(point.state.mean_pressure for point in path if point.event != "pull-off")

    found = [measuring.time_task(lowest, law) for law in laws]
    values, seconds = zip(*found, strict=True)
    limit = np.full(len(laws), np.nan)
    if (pixels, tolerance) == (asked["at_pixels"], asked["at_tolerance"]):
        loads = np.geomspace(largest / 10**DECADES, largest, DECADES * PER_DECADE + 1)
        path = list(solver.load_path(heights, length, loads, tol=tolerance))
        limit = [
            min(c.mean_pressure - dmt.adhesive_pressure(c.gap, law) for c in path) for law in laws
        ]
    found = {"pull_off": values, "pull_off_dmt": limit, "seconds": seconds}
    return xr.Dataset({name: ("point", list(one)) for name, one in found.items()}, coordinates)


def list_laws(asked):
    """Traction laws of the points, and the coordinates of these."""
    points = np.array(asked["points"])
    laws = [scaled_law(asked, asked["law"], strength, range_) for range_, strength in points]
    return laws, {name: ("point", of_point) for name, of_point in zip(POINT, points.T, strict=True)}


if __name__ == "__main__":
    main(start(globals(), "measure_adhesion", trade_case="H0.8_zeta16"))
