"""Pull-off at the ranges of simulated states and at shorter ones, simulated on finer grids."""

import logging

import numpy as np

from common.conventions import Q0
from common.job import start
from common.topographies import make_set
from limits.measure_ranges import at_work, refine
from limits.measuring import write_rows
from stickiness.remaining.height_simulation import ADHESION_TOLERANCE, find_trial_states
from stickiness.remaining.measurement import measure as follow_path
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.trial_states import SimulatedHeights
from stickiness.repulsive.solver import ConvergenceError


def main(job):
    write_rows(job, measure)


def measure(setting, seed, campaign):
    """Rows of all works of adhesion and ranges: states pulled off on a grid, paths on finer ones.

    States are pulled by a growing tension, paths part at given mean gaps.
    """
    heights = make_set(setting, seed)
    length = setting["waves"] * 2 * np.pi / Q0
    states = find_trial_states(heights, length)
    rough = judge_states(states, length / setting["points"])
    for law, fine, row in refine(heights, states, setting, campaign):
        work = law.adhesion_length
        path_share, pull_off = part(fine, length, law, campaign)
        yield {
            **row,
            "share": rough.share(work, law.range),
            "distance": at_work(states, states.simulated_distance, work),
            "path_share": path_share,
            "pull_off": pull_off,
        }


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


def part(heights, length, law, campaign):
    """Share gained and largest tension where surfaces are pressed and part at given mean gaps."""
    try:
        found = follow_path(
            heights,
            length,
            law,
            squeeze=campaign["squeeze"],
            tol=ADHESION_TOLERANCE,
            half_grid=False,
            steps=campaign["steps"],
        )
    except ConvergenceError as error:
        logging.info("%s: %s", law, error)
        return np.nan, np.nan
    return found.bound, found.pull_off


if __name__ == "__main__":
    main(start(globals()))
