"""Pull-off stresses of maps of all families, in small steps of the modulus and the adhesion."""

from dataclasses import replace

import numpy as np
import pytest

from common.topographies import FAMILIES, make_topography
from stickiness import Material, Surface
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.verdicts.meeting import meet

pytestmark = [
    pytest.mark.slow,
    pytest.mark.filterwarnings("ignore::stickiness.plausibility.PlausibilityWarning"),
    pytest.mark.usefixtures("coarse_simulation"),
]

STEPS = 60
STEP = 1.01
#: Works of adhesion over the energy of full contact from which steps go up.
ENERGY_RATIOS = (0.05, 0.6, 1.1)
WORK = 0.05


def let_meet(surface, modulus, work):
    material = Material(modulus=modulus, poisson=0.5, work_of_adhesion=work, range=3e-10)
    return meet(material, surface, DEFAULT_SHARE)


def find_pull_offs(meeting, pair):
    """Low limit, value and high limit [Pa]."""
    return meeting.limit(pair.pull_off, pair)


@pytest.mark.parametrize("family", FAMILIES)
def test_softer_solids_and_stronger_adhesion_hold_no_less(family):
    heights = 1e-6 * make_topography(family, points=64, waves=3, seed=11)
    surface = Surface.from_heights(heights, 1e-3, extend_to=5e-5)
    energy = float(surface.data.simulated_full_contact[0])
    for ratio in ENERGY_RATIOS:
        modulus = 0.75 * WORK / (ratio * energy)
        steps = STEP ** np.arange(STEPS)
        first = let_meet(surface, modulus, WORK)
        softer = [first.pair.at_modulus(first.pair.modulus / step) for step in steps]
        stronger = [replace(first.pair, work_of_adhesion=WORK * step) for step in steps]
        last = (modulus / steps[-1], WORK), (modulus, WORK * steps[-1])
        for pairs, material in zip((softer, stronger), last, strict=True):
            found = np.array([find_pull_offs(first, pair) for pair in pairs])
            # Materials that differ by nothing else meet the surface in the same way.
            met = let_meet(surface, *material)
            np.testing.assert_allclose(found[-1], find_pull_offs(met, met.pair), rtol=1e-12)
            assert np.all(found > 0)
            assert np.all(found[1:] >= found[:-1] * (1 - 1e-9))
