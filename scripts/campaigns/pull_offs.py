"""Pull-off at the ranges of simulated states and at shorter ones, simulated on finer grids.

`points` and `shortest` are of the coarse grid of the states. Heights and ranges are over h_rms,
energies and adhesion lengths over q0 h_rms^2, shares over the work of adhesion.
"""

import logging

import numpy as np

from campaigns.columns import find_side
from campaigns.ranges import OF_REFINED, refine
from common.topographies import make_set
from stickiness.remaining.height_simulation import (
    ADHESION_TOLERANCE,
    find_pull_offs,
    find_trial_states,
)
from stickiness.remaining.measurement import measure as follow_path
from stickiness.repulsive.solver import ConvergenceError

COLUMNS = OF_REFINED | {
    "lost_ratio": "energy ratio at which contact is nearly lost, by the states",
    "predicted": "largest tension over E*, by the states",
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
    pull_offs = find_pull_offs(heights, length)
    for law, fine, row in refine(heights, states, setting, shared):
        path_share, pull_off = separate(fine, length, law, shared)
        held = pull_offs.find_held(np.array([law.adhesion_length]), np.array([law.range]))
        yield {
            **row,
            "lost_ratio": pull_offs.lost_length / states.full_contact_energy,
            "predicted": law.adhesion_length * held[0],
            "path_share": path_share,
            "pull_off": pull_off,
        }


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
