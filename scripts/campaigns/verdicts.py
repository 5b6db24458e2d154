"""Verdicts on a map made in three ways on several grids, beside full simulation, with their times.

The spectrum alone, contact without adhesion, and states with adhesion tell more of what remains,
one after the other, and take longer. Grids thin the map before contact is simulated on it. Shares
are over the work of adhesion.
"""

import logging
import warnings
from dataclasses import replace

import numpy as np

import stickiness
from campaigns.columns import OF_TOPOGRAPHY
from common.clock import time_task
from common.topographies import make_set
from stickiness import surface
from stickiness.plausibility import PlausibilityWarning
from stickiness.remaining.height_simulation import ADHESION_TOLERANCE, press, simulate_standard
from stickiness.remaining.standard_heights import standardise
from stickiness.remaining.zero_load import share_at_zero_load
from stickiness.traction_laws import LAWS
from stickiness.verdicts.simulated_surface import tabulate_simulated

SIDE = 1e-4  # of every map [m]
H_RMS = 3e-7  # [m]
MODULUS = 1e6  # plane-strain modulus [Pa]; only works over it matter
PIXELS_IN_ZONE = 2  # width of the cohesive zone on the grid of the map, which sets the range
SPECTRUM = "spectrum"
CONTACT = "contact without adhesion"
STATES = "states with adhesion"
COLUMNS = OF_TOPOGRAPHY | {
    "way": "what the verdict rests on",
    "grid": "points along a side of the grid of the verdict, without its mirror images",
    "energy_ratio": "work of adhesion over elastic energy of full contact of the map",
    "range": ("m", "of the attraction"),
    "seconds": ("s", "processor time of what the verdict rests on, and of the verdict"),
    "remaining": "share that remains by the verdict",
    "low": "low limit of that share",
    "high": "high limit of that share",
    "simulated": "share that remains by simulation on the map",
}


def measure(setting, seed, shared):
    """Rows of all ways, grids and works of adhesion."""
    heights = H_RMS * make_set(setting, seed)
    with warnings.catch_warnings():
        # The heights are made up: their slopes and ranges are no concern.
        warnings.simplefilter("ignore", PlausibilityWarning)
        yield from judge_map(heights, setting, shared)


def judge_map(heights, setting, shared):
    """Judge a map in every way on every grid, at every work of adhesion."""
    points = heights.shape[0]
    spectrum = surface.realised_spectrum(heights, SIDE)
    pairs = [
        make_pair(ratio * spectrum.elastic_energy(), heights, shared["law"])
        for ratio in shared["energies"]
    ]
    # The end of the band is told: a map does not tell whether finer waves follow.
    shortest = setting["shortest"] * SIDE / points
    measured = stickiness.Surface.from_heights(heights, SIDE, extend_to=shortest, detrend="mean")
    stickiness.verdict(measured, pairs[0][0])  # from now on all is compiled

    of_pairs = [
        {"energy_ratio": ratio, "range": law.range, "simulated": simulate(heights, law)}
        for ratio, (_, law) in zip(shared["energies"], pairs, strict=True)
    ]
    spectrum, seconds_spectrum = time_task(surface.realised_spectrum, heights, SIDE)
    wall = stickiness.Surface.from_spectrum(spectrum)
    yield from judge_pairs(wall, pairs, of_pairs, SPECTRUM, points, seconds_spectrum)
    for grid in (*shared["grids"], *(setting["finest"] or ())):
        standard = standardise(heights, (SIDE, SIDE), most_points=grid)
        _, seconds_contact = time_task(press_parts, standard)
        simulated, seconds_states = time_task(simulate_standard, standard)
        logging.info(
            "%d points: contact %.3g s, states %.3g s", grid, seconds_contact, seconds_states
        )
        wall = replace_states(measured, keep_contact(simulated))
        for row in judge_pairs(wall, pairs, of_pairs, CONTACT, grid, seconds_contact):
            # Attraction may make any contact: only the low limit is known.
            yield row | {"high": 1.0}
        wall = replace_states(measured, simulated)
        yield from judge_pairs(wall, pairs, of_pairs, STATES, grid, seconds_states)


def make_pair(adhesion_length, heights, law):
    """Material of an adhesion length, and the law of its attraction; the grid sets the range."""
    pixel = SIDE / heights.shape[0]
    range_ = float(np.sqrt(PIXELS_IN_ZONE * pixel * adhesion_length))
    material = stickiness.Material(
        youngs_modulus=MODULUS,
        poisson_ratio=0.0,
        work_of_adhesion=adhesion_length * MODULUS,
        range=range_,
        law=law,
    )
    return material, LAWS[law](adhesion_length, range_)


def simulate(heights, law):
    """Share that remains by simulation on the whole grid of a map."""
    return share_at_zero_load(heights, SIDE, law, tol=ADHESION_TOLERANCE)


def judge_pairs(wall, pairs, of_pairs, way, grid, seconds):
    """Rows of one way and grid, whose surface took so many seconds."""
    for (material, _), known in zip(pairs, of_pairs, strict=True):
        verdict, seconds_verdict = time_task(stickiness.verdict, wall, material)
        low, high = verdict.remaining_limits
        yield {
            "way": way,
            "grid": grid,
            **known,
            "seconds": seconds + seconds_verdict,
            "remaining": verdict.remaining,
            "low": low,
            "high": high,
        }


def press_parts(standard):
    """Press the map and its quarters without adhesion, as their states do."""
    for part in (standard.whole, *standard.quarters):
        for _ in press(part.heights, part.sides, mirrored=True):
            pass


def keep_contact(simulated):
    """Contacts without adhesion of simulated heights, and nothing that adhesion has told."""

    def keep(states):
        none = np.zeros(1)
        return replace(
            states.without_adhesion(),
            simulated_length=np.array([states.full_contact_energy]),
            simulated_range=none + np.finfo(float).tiny,  # the bound stands at any longer range
            simulated_share=none,
        )

    quarters = tuple(keep(quarter) for quarter in simulated.quarters)
    return replace(simulated, whole=keep(simulated.whole), quarters=quarters)


def replace_states(measured, simulated):
    """The measured surface with other states of contact."""
    states = tabulate_simulated(simulated)
    others = measured.data.drop_vars([*states.data_vars, "trial_gap_bin"])
    return stickiness.Surface(others.merge(states))
