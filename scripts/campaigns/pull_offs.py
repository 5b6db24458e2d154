"""Pull-off at the ranges of simulated states and at shorter ones, simulated on finer grids.

`points` and `shortest` are of the coarse grid of the states. Heights and ranges are over h_rms,
energies and adhesion lengths over q0 h_rms^2, shares over the work of adhesion.
"""

import logging

import numpy as np

from campaigns.columns import find_side
from campaigns.ranges import OF_REFINED, interpolate_at_work, refine
from common.conventions import Q0
from common.topographies import make_set
from stickiness.remaining.height_simulation import ADHESION_TOLERANCE, find_trial_states
from stickiness.remaining.measurement import measure as follow_path
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.trial_states import SimulatedHeights
from stickiness.repulsive.solver import ConvergenceError

COLUMNS = OF_REFINED | {
    "share": "that is predicted to remain at this range",
    "distance": "work that remains over the largest tension, of the states at their own range",
    "path_share": "largest gain of energy on a path at given mean gaps on the finer grid",
    "pull_off": "largest tension on that path over E*",
}


def measure(setting, seed, shared):
    """Rows of all works of adhesion and ranges: states pulled off on a grid, paths on finer ones.

    States are pulled by a growing tension, paths part at given mean gaps.
    """
    heights = make_set(setting, seed)
    length = find_side(setting)
    states = find_trial_states(heights, length)
    rough = make_roughness(states, length / setting["points"])
    for law, fine, row in refine(heights, states, setting, shared):
        work = law.adhesion_length
        path_share, pull_off = separate(fine, length, law, shared)
        yield {
            **row,
            "share": rough.share(work, law.range),
            "distance": interpolate_at_work(states, states.simulated_distance, work),
            "path_share": path_share,
            "pull_off": pull_off,
        }


def make_roughness(states, pixel):
    """`Roughness` of which a verdict tells by these states alone: no waves lack."""
    simulated = SimulatedHeights(
        whole=states,
        quarters=(states,),
        resolved_energy=states.full_contact_energy,
        pixel=pixel,
        independent_areas=1.0,
    )
    return Roughness(
        h_rms=1.0, q0=Q0, elastic_energy=states.full_contact_energy, simulated=simulated
    )


def separate(heights, length, law, shared):
    """Share gained and largest tension where surfaces are pressed and part at given mean gaps."""
    try:
        found = follow_path(
            heights,
            length,
            law,
            squeeze=shared["squeeze"],
            tol=ADHESION_TOLERANCE,
            half_grid=False,
            steps=shared["steps"],
        )
    except ConvergenceError as error:
        logging.info("%s: %s", law, error)
        return np.nan, np.nan
    return found.bound, found.pull_off
