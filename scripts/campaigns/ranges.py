"""What remains at ranges shorter than those of simulated states, simulated on finer grids.

`points` and `shortest` are of the coarse grid of the states. Heights and ranges are over h_rms,
energies and adhesion lengths over q0 h_rms^2, shares over the work of adhesion.
"""

import numpy as np

from campaigns.columns import OF_TOPOGRAPHY, find_side
from common.topographies import make_set
from stickiness import surface
from stickiness.remaining.height_simulation import ADHESION_TOLERANCE, find_trial_states
from stickiness.remaining.zero_load import share_at_zero_load
from stickiness.traction_laws import LAWS

#: Columns of what is simulated on finer grids, at the range of the states and at shorter ones.
OF_REFINED = OF_TOPOGRAPHY | {
    "full_contact_energy": "elastic energy of full contact on the coarse grid",
    "adhesion_length": "work of adhesion over the modulus",
    "energy_ratio": "work of adhesion over full_contact_energy",
    "range": "of the attraction",
    "range_ratio": "range over that of the states at this work",
    "finer": "points along a side of the finer grid over those of the coarse one",
}
COLUMNS = OF_REFINED | {
    "is_between": "1 for works of adhesion between two that were simulated",
    "bound": "share that remains in the deepest of the states at this range",
    "chord": "share between those of the states at their own ranges",
    "simulated": "share that remains on the finer grid",
}


def measure(setting, seed, shared):
    """Rows of all works of adhesion and ranges, by states on a grid and by finer ones."""
    heights = make_set(setting, seed)
    length = find_side(setting)
    states = find_trial_states(heights, length)
    lengths = [0, *states.simulated_length]
    gains = [0, *states.simulated_length * states.simulated_share]
    for law, fine, row in refine(heights, states, setting, shared):
        work = law.adhesion_length
        yield {
            **row,
            "bound": states.share(np.array([work]), np.array([law.range]), shared["law"])[0],
            "chord": np.interp(work, lengths, gains) / work,
            "simulated": share_at_zero_load(fine, length, law, tol=ADHESION_TOLERANCE),
        }


def refine(heights, states, setting, shared):
    """Laws at the ranges of states and at shorter ones, finer grids, and what rows tell of both."""
    grids = {
        finer: surface.resample(heights, finer * heights.shape[0])
        for finer in {refinement["finer"] for refinement in setting["refinements"]}
    }
    for work, is_between in choose_works(states, shared["shares"], shared["works"]):
        own_range = interpolate_at_work(states, states.simulated_range, work)
        for refinement in setting["refinements"]:
            law = LAWS[shared["law"]](work, refinement["ratio"] * own_range)
            row = {
                "full_contact_energy": states.full_contact_energy,
                "adhesion_length": work,
                "energy_ratio": work / states.full_contact_energy,
                "is_between": is_between,
                "range": law.range,
                "range_ratio": refinement["ratio"],
                "finer": refinement["finer"],
            }
            yield law, grids[refinement["finer"]], row


def interpolate_at_work(states, simulated, work):
    """What was simulated of states, at a work of adhesion between theirs."""
    log_lengths = np.log(states.simulated_length)
    return np.exp(np.interp(np.log(work), log_lengths, np.log(simulated)))


def choose_works(states, shares, most):
    """Works of adhesion at and between those simulated, evenly among those of such shares."""
    low, high = shares
    is_inside = (states.simulated_share >= low) & (states.simulated_share <= high)
    log_nodes = np.log(states.simulated_length[is_inside])
    # Every second one is between its neighbours.
    log_works = np.interp(
        np.arange(2 * log_nodes.size - 1) / 2, np.arange(log_nodes.size), log_nodes
    )
    chosen = np.unique(np.rint(np.linspace(0, log_works.size - 1, most)).astype(int))
    return [(float(np.exp(log_works[i])), int(i % 2)) for i in chosen]
