"""Pull-off at the ranges of simulated states and at shorter ones, simulated on finer grids."""

import logging

import numpy as np

from common.conventions import Q0
from common.job import start
from limits.measure_ranges import choose_works
from limits.measuring import write_rows
from stickiness import surface
from stickiness.remaining.height_simulation import ADHESION_TOLERANCE, find_trial_states
from stickiness.remaining.measurement import measure as follow_path
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.trial_states import SimulatedHeights
from stickiness.repulsive.solver import ConvergenceError
from stickiness.traction_laws import LAWS

PULL_OFF_VARIABLES = {
    "row": "work of adhesion and range",
    "adhesion_length": "adhesion length over q0 h_rms^2",
    "energy_ratio": "work of adhesion over elastic energy of full contact",
    "range_ratio": "range over that of the states at this work",
    "range": "range over h_rms",
    "finer": "points along a side over those of the states",
    "share": "share that a verdict predicts to remain, at this range",
    "distance": "work that remains over the largest tension, of the states at their range",
    "path_share": ("1", "share gained at most on the path, on the finer grid", "not converged"),
    "pull_off": ("1", "largest tension over E* on the path, on the finer grid", "not converged"),
    "full_contact_energy": "elastic energy of full contact over E* q0 h_rms^2",
}


def main(job):
    write_rows(
        job,
        measure,
        PULL_OFF_VARIABLES,
        title="pull-off at the ranges of simulated states and at shorter ones",
    )


def measure(heights, setting, params):
    """Rows of all works of adhesion and ranges: states pulled off on a grid, paths on finer ones.

    States are pulled by a growing tension, paths part at given mean gaps.
    """
    length = setting["waves"] * 2 * np.pi / Q0
    states = find_trial_states(heights, length)
    rough = judge_states(states, length / heights.shape[0])
    log_nodes = np.log(states.simulated_length)
    grids = {
        finer: surface.resample(heights, finer * heights.shape[0])
        for finer in {refinement["finer"] for refinement in setting["refinements"]}
    }
    for work, _ in choose_works(states, params.shares, params.works):
        own_range, own_distance = (
            np.exp(np.interp(np.log(work), log_nodes, np.log(values)))
            for values in (states.simulated_range, states.simulated_distance)
        )
        for refinement in setting["refinements"]:
            range_ = refinement["ratio"] * own_range
            law = LAWS[params.law](work, range_)
            path_share, pull_off = part(grids[refinement["finer"]], length, law, params)
            row = {
                "adhesion_length": work,
                "energy_ratio": work / states.full_contact_energy,
                "range_ratio": refinement["ratio"],
                "range": range_,
                "finer": refinement["finer"],
                "share": rough.share(work, range_),
                "distance": own_distance,
                "path_share": path_share,
                "pull_off": pull_off,
                "full_contact_energy": states.full_contact_energy,
            }
            logging.info("%s", row)
            yield row


def judge_states(states, pixel):
    """`Roughness` of which a verdict tells by these states alone: no waves lack."""
    simulated = SimulatedHeights(
        whole=states,
        quarters=(states,),
        resolved_energy=states.full_contact_energy,
        pixel=pixel,
    )
    return Roughness(
        h_rms=1.0, q0=Q0, elastic_energy=states.full_contact_energy, simulated=simulated
    )


def part(heights, length, law, params):
    """Share gained and largest tension where surfaces are pressed and part at given mean gaps."""
    try:
        found = follow_path(
            heights,
            length,
            law,
            squeeze=params.squeeze,
            tol=ADHESION_TOLERANCE,
            half_grid=False,
            steps=params.steps,
        )
    except ConvergenceError as error:
        logging.info("%s: %s", law, error)
        return np.nan, np.nan
    return found.bound, found.pull_off


if __name__ == "__main__":
    main(start(globals()))
