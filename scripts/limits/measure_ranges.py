"""What remains at ranges shorter than those of simulated states, simulated on finer grids."""

import logging

import numpy as np

from common.conventions import Q0
from common.job import start
from limits.measuring import write_rows
from stickiness import surface
from stickiness.remaining.height_simulation import ADHESION_TOLERANCE, find_trial_states
from stickiness.remaining.zero_load import share_at_zero_load
from stickiness.traction_laws import LAWS

RANGE_VARIABLES = {
    "row": "work of adhesion and range",
    "adhesion_length": "adhesion length over q0 h_rms^2",
    "energy_ratio": "work of adhesion over elastic energy of full contact",
    "is_between": "1 for a work between those simulated, 0 at one of them",
    "range_ratio": "range over that of the states at this work",
    "range": "range over h_rms",
    "finer": "points along a side over those of the states",
    "bound": "share in the deepest of the states, at this range",
    "chord": "chord between the shares of the states, at their ranges",
    "simulated": ("1", "share at zero load on the finer grid", "not converged"),
    "full_contact_energy": "elastic energy of full contact over E* q0 h_rms^2",
}


def main(job):
    write_rows(
        job,
        measure,
        RANGE_VARIABLES,
        title="what remains at ranges shorter than those of simulated states",
    )


def measure(heights, setting, params):
    """Rows of all works of adhesion and ranges, by states on a grid and by finer ones."""
    length = setting["waves"] * 2 * np.pi / Q0
    states = find_trial_states(heights, length, pull=False)
    nodes = states.simulated_length
    grids = {
        finer: surface.resample(heights, finer * heights.shape[0])
        for finer in {refinement["finer"] for refinement in setting["refinements"]}
    }
    for work, is_between in choose_works(states, params.shares, params.works):
        log_range = np.interp(np.log(work), np.log(nodes), np.log(states.simulated_range))
        for refinement in setting["refinements"]:
            range_ = refinement["ratio"] * np.exp(log_range)
            law = LAWS[params.law](work, range_)
            fine = grids[refinement["finer"]]
            row = {
                "adhesion_length": work,
                "energy_ratio": work / states.full_contact_energy,
                "is_between": is_between,
                "range_ratio": refinement["ratio"],
                "range": range_,
                "finer": refinement["finer"],
                "bound": states.share(np.array([work]), np.array([range_]), params.law)[0],
                "chord": np.interp(work, [0, *nodes], [0, *nodes * states.simulated_share]) / work,
                "simulated": share_at_zero_load(fine, length, law, tol=ADHESION_TOLERANCE),
                "full_contact_energy": states.full_contact_energy,
            }
            logging.info("%s", row)
            yield row


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


if __name__ == "__main__":
    main(start(globals()))
