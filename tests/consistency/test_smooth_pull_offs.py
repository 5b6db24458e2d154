"""Pull-off stresses of maps of all families, in small steps of the modulus and the adhesion."""

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


def find_pull_offs(surface, modulus, work):
    """Low limit, value and high limit [Pa]."""
    material = Material(modulus=modulus, poisson=0.5, work_of_adhesion=work, range=3e-10)
    meeting = meet(material, surface, DEFAULT_SHARE)
    return meeting.limit(meeting.pair.pull_off, meeting.pair)


@pytest.mark.parametrize("family", FAMILIES)
def test_softer_solids_and_stronger_adhesion_hold_no_less(family):
    heights = 1e-6 * make_topography(family, points=64, waves=3, seed=11)
    surface = Surface.from_heights(heights, 1e-3, extend_to=5e-5)
    energy = float(surface.data.simulated_full_contact[0])
    for ratio in ENERGY_RATIOS:
        modulus = 0.75 * WORK / (ratio * energy)
        steps = STEP ** np.arange(STEPS)
        softer = np.array([find_pull_offs(surface, modulus / step, WORK) for step in steps])
        stronger = np.array([find_pull_offs(surface, modulus, WORK * step) for step in steps])
        assert np.all(softer > 0)
        assert np.all(softer[1:] >= softer[:-1] * (1 - 1e-9))
        assert np.all(stronger[1:] >= stronger[:-1] * (1 - 1e-9))
