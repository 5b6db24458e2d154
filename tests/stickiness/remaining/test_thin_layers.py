"""Thin incompressible layers: how material flows along them, and what they keep in simulation."""

import numpy as np
import pytest

from stickiness.remaining.roughness import Roughness
from stickiness.remaining.thin_layers import find_flow, find_gain
from stickiness.solids import HALF_SPACE, Layer

# Largest energy gained at zero load over the work of adhesion by L-BFGS-B over all gaps, on
# 64 x 64 points in cells of 4 by 4 longest waves, magnification 8, q0 = h_rms = 1.
# thickness, energy ratio, range, energy of full contact, that of a half-space, share
MINIMISED = [
    (0.1, 0.2, 0.05, 218.12, 0.4491, 0.2366),
    (0.1, 0.8, 0.1, 218.12, 0.4491, 0.5501),
    (0.2, 0.2, 0.05, 29.785, 0.4491, 0.1746),
    (0.2, 0.8, 0.1, 29.785, 0.4491, 0.4669),
    (0.3, 0.2, 0.05, 10.067, 0.4491, 0.1279),
    (0.3, 0.8, 0.1, 10.067, 0.4491, 0.4089),
    (0.6, 0.2, 0.05, 2.1129, 0.4491, 0.0507),
    (0.6, 0.8, 0.1, 2.1129, 0.4491, 0.2844),
    (1, 0.2, 0.05, 0.93993, 0.4491, 0.0215),
    (1, 0.8, 0.1, 0.93993, 0.4491, 0.2228),
    (0.1, 0.2, 0.05, 181.12, 0.54995, 0.2416),
    (0.1, 0.8, 0.1, 181.12, 0.54995, 0.5172),
    (0.2, 0.2, 0.05, 25.156, 0.54995, 0.1680),
    (0.2, 0.8, 0.1, 25.156, 0.54995, 0.4714),
    (0.3, 0.2, 0.05, 8.6958, 0.54995, 0.1175),
    (0.3, 0.8, 0.1, 8.6958, 0.54995, 0.4061),
    (0.6, 0.2, 0.05, 1.9656, 0.54995, 0.0387),
    (0.6, 0.8, 0.1, 1.9656, 0.54995, 0.2794),
    (1, 0.2, 0.05, 0.95859, 0.54995, 0.0174),
    (1, 0.8, 0.1, 0.95859, 0.54995, 0.2207),
]


def predict_share(thickness, ratio, reach, energy, half_space_energy, sign):
    layer = Layer(thickness, 0.5)
    rough = Roughness(
        h_rms=1.0,
        q0=1.0,
        elastic_energy=energy,
        relative_compliance=layer.factor(1.0),
        flow=find_flow(layer, 1.0),
        half_space_energy=half_space_energy,
        solid="layer",
        eta=sign,
    )
    return rough.share(ratio * energy, reach)


def test_limits_hold_what_an_independent_minimiser_finds():
    """Limits of 90 %, which nothing here was fitted to: 18 of 20, and not by being wide."""
    inside = []
    widths = []
    for *inputs, share in MINIMISED:
        low, high = (predict_share(*inputs, sign) for sign in (-1, 1))
        inside.append(low <= share <= high)
        widths.append(high - low)
    assert 0.85 <= np.mean(inside) <= 0.95
    assert np.mean(widths) < 0.19


def test_the_flow_by_the_limits_of_the_compliance():
    """S tends to (2/3) k^3 on thin incompressible layers, and to a multiple of k on others."""
    assert find_flow(Layer(1e-3, 0.5), 1.0) == pytest.approx(1.0, abs=1e-4)
    assert find_flow(Layer(1e-3, 0.3), 1.0) == pytest.approx(0.0, abs=1e-4)
    assert find_flow(Layer(1e-3, 0.5, "slip"), 1.0) == 0.0
    assert find_flow(Layer(20.0, 0.5), 1.0) == 0.0
    assert find_flow(HALF_SPACE, 1.0) == 0.0


def test_without_flow_layers_are_springs():
    ratios = np.geomspace(0.01, 10, 7)
    assert (find_gain(ratios, relative_compliance=0.1, flow=0.0) == 1).all()


def test_gain_grows_as_layers_thin_and_adhesion_weakens():
    gains = find_gain(np.array([[0.1], [1.0]]), np.array([1e-2, 1e-4]), flow=1.0)
    assert (np.diff(gains, axis=0) < 0).all()
    assert (np.diff(gains, axis=1) > 0).all()
