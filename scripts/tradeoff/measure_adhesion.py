"""Solve full adhesion on the same realisations with every grid and tolerance, and time it.

A few realisations are solved with every setting, more on the usual grid and coarser ones alone:
those tell how the quantities scatter. A press that separates from a load gives the pull-off.
"""

from functools import partial
from itertools import product

import numpy as np
import xarray as xr

from common.adhesion_sets import LEAST, STRONGEST, scaled_law, solve_at_gap
from common.clock import time_task
from common.job import start
from common.model_surfaces import cell_size, grid_points
from stickiness import adhesive, dmt
from stickiness.repulsive import solver
from tradeoff import measuring

FINEST_TOLERANCE = 1e-10  # the reference of the other tolerances
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
    surface = job.params.case
    measure_states(surface, job.params.adhesion, job.output.states)
    measure_pull_offs(surface, job.params.adhesion, job.output.pull_off)


def measure_states(surface, adhesion, output):
    """Write the states of all seeds with every grid and tolerance."""
    usual_pixels = adhesion["at_pixels"]
    usual_tolerance = adhesion["at_tolerance"]
    most_points = adhesion["most_points"]
    grids = [p for p in adhesion["pixels"] if grid_points(surface, p) <= most_points]
    seeds = range(1, adhesion["seeds"] + 1)
    more = range(1, adhesion["more_seeds"] + 1)
    settings = [
        *product(grids, [usual_tolerance], seeds),
        *product([usual_pixels], [*adhesion["tolerances"], FINEST_TOLERANCE], seeds),
        *product([p for p in grids if p <= usual_pixels], [usual_tolerance], more),
    ]
    states = measuring.record(settings, partial(solve_states, surface, adhesion))
    title = "full adhesion of the same realisations with various settings"
    measuring.write(states, output, title, describe(surface, adhesion), **STATES)


def measure_pull_offs(surface, adhesion, output):
    """Write the pull-offs of all seeds with every grid and tolerance."""
    usual_pixels = adhesion["at_pixels"]
    adhesion = adhesion | adhesion["pull_off"]
    usual_tolerance = adhesion["at_tolerance"]
    seeds = range(1, adhesion["seeds"] + 1)
    settings = [
        *product(adhesion["pixels"], [usual_tolerance], seeds),
        *product([usual_pixels], adhesion["tolerances"], seeds),
    ]
    pull_offs = measuring.record(settings, partial(separate, surface, adhesion))
    title = "pull-off of the same realisations with various settings"
    parameters = describe(surface, adhesion) | {"pressure": adhesion["pressure"]}
    measuring.write(pull_offs, output, title, parameters, **PULL_OFFS)


def describe(surface, adhesion):
    """Parameters of a file: the surface, its roughness, and the usual grid and tolerance."""
    return {
        **surface,
        "q0_h_rms": adhesion["q0_h_rms"],
        "at_pixels": adhesion["at_pixels"],
        "tolerance": adhesion["at_tolerance"],
    }


def solve_states(surface, adhesion, pixels, tolerance, seed):
    """Solve one realisation at every load and point; NaN if a window closes."""
    heights = measuring.make_heights(surface, pixels, seed)[0]
    length = cell_size(surface)
    loads = np.array(adhesion["pressures"])
    laws, coordinates = list_laws(adhesion)
    values = {n: np.full((len(loads), len(laws)), np.nan) for n in STATES if n != "pressure"}
    for i, contact in enumerate(solver.load_path(heights, length, loads, tol=tolerance)):
        values["area_alone"][i] = contact.area_fraction
        for k, law in enumerate(laws):
            attraction = dmt.adhesive_pressure(contact.gap, law)
            values["attraction_dmt"][i, k] = attraction
            if attraction > STRONGEST * contact.mean_pressure:
                continue
            state, seconds = time_task(solve_at_gap, heights, length, law, contact, tolerance)
            values["seconds"][i, k] = seconds
            values["external_pressure"][i, k] = state.mean_pressure
            values["repulsive_area"][i, k] = state.repulsive_area_fraction
    variables = {name: (("pressure", "point"), value) for name, value in values.items()}
    return xr.Dataset(variables, {"pressure": loads} | coordinates)


def separate(surface, adhesion, pixels, tolerance, seed):
    """Find the lowest mean pressure on separation with every law, and the time it took."""
    heights = measuring.make_heights(surface, pixels, seed)[0]
    length = cell_size(surface)
    laws, coordinates = list_laws(adhesion)
    largest = adhesion["pressure"]

    def find_lowest(law):
        path = adhesive.path(
            heights,
            length,
            law,
            (largest, -2 * law.strength),
            tol=tolerance,
            balance=adhesion["at_balance"],
            smallest_jump=adhesion["at_balance"],
            steps=LEAST,
        )
        return min(point.state.mean_pressure for point in path if point.event != "pull-off")

    timed = [time_task(find_lowest, law) for law in laws]
    limit = np.full(len(laws), np.nan)
    per_decade = 10  # of these loads
    decades = 4  # of loads below the largest, for the pull-off by the DMT sum
    if pixels == adhesion["at_pixels"] and tolerance == adhesion["at_tolerance"]:
        # By the DMT sum: the lowest load less attraction on the way without adhesion.
        loads = np.geomspace(largest / 10**decades, largest, decades * per_decade + 1)
        contacts = list(solver.load_path(heights, length, loads, tol=tolerance))
        limit = [
            min(c.mean_pressure - dmt.adhesive_pressure(c.gap, law) for c in contacts)
            for law in laws
        ]
    variables = {
        "pull_off": ("point", [lowest for lowest, _ in timed]),
        "pull_off_dmt": ("point", list(limit)),
        "seconds": ("point", [seconds for _, seconds in timed]),
    }
    return xr.Dataset(variables, coordinates)


def list_laws(adhesion):
    """Traction laws of the points, and the coordinates of these."""
    points = np.array(adhesion["points"])
    laws = [scaled_law(adhesion, adhesion["law"], strength, range_) for range_, strength in points]
    coordinates = {
        "range_over_h_rms": ("point", points[:, 0]),
        "adhesion_length_over_range": ("point", points[:, 1]),
    }
    return laws, coordinates


if __name__ == "__main__":
    main(start(globals()))
