"""What is said of a pair of material and surface."""

import numpy as np

from stickiness.criteria.pair import MOST_STRAIN, make_pair
from stickiness.remaining.prediction import Roughness

ENERGY = 0.6e-6  # of full contact over E* [m]: with tough contact at adhesion lengths of as much


def test_a_layer_that_cannot_take_the_heights_has_low_limits_of_nothing():
    rough = Roughness(h_rms=1e-6, q0=1e6, elastic_energy=ENERGY, rms_slope=1.0)
    values = {"modulus": 1e6, "work_of_adhesion": 2e6 * ENERGY, "range": 1e-9}
    usual, strained = (
        make_pair(rough, **values, layer_strain=factor * MOST_STRAIN) for factor in (0.99, 1.01)
    )
    for name, least in (("remaining", 0), ("pull_off", 0), ("remaining_threshold", np.inf)):
        assert getattr(strained, name)(-1) == least
        assert getattr(usual, name)(-1) != least
        for sign in (0, 1):
            assert getattr(strained, name)(sign) == getattr(usual, name)(sign) > 0
