"""a_V by theory, where the edges of contact are not resolved, and of self-affine surfaces."""

import numpy as np
import pytest

from criteria.map_criterion import MapSurfaces
from criteria.self_affine_a_v import find_a_v
from stickiness.criteria.a_v_theory import PARTED, THEORY_ERROR, edge_range, local_a_v
from stickiness.criteria.formulas import pastewka_robbins_a_v
from stickiness.persson import Persson
from stickiness.spectrum import SelfAffine

LOAD = 0.05


def find_directly(hurst, magnification, ranges, variant="afferrante2018"):
    """a_V by theory itself."""
    spectrum = SelfAffine(hurst=hurst, q0=1.0, q1=magnification, h_rms=1.0)
    area = Persson(spectrum, variant).gap_cumulative(ranges, LOAD)
    return local_a_v(area, LOAD, ranges)


def test_a_v_of_several_surfaces_is_that_of_theory():
    ranges = np.array([[0.012, 0.2], [0.1, 0.9]])
    magnifications = np.array([[2e4], [30.0]])
    value, low, high = find_a_v(0.8, LOAD, ranges, magnifications)
    for row, zeta in enumerate(magnifications[:, 0]):
        expected = find_directly(0.8, zeta, ranges[row])
        np.testing.assert_allclose(value[row], expected, rtol=0.01)
        other = find_directly(0.8, zeta, ranges[row], "almqvist2011")
        least, most = np.sort([expected, other], axis=0)
        np.testing.assert_allclose(low[row], (1 - THEORY_ERROR) * least, rtol=0.01)
        np.testing.assert_allclose(high[row], (1 + THEORY_ERROR) * most, rtol=0.01)


def test_the_map_asks_for_a_v_at_the_range_over_the_rms_height():
    """The range is the unit of length, and the shortest wave is four ranges long."""
    settings = {"hurst": 0.8, "shortest_over_range": 4.0}
    surfaces = MapSurfaces(settings, LOAD)
    found = surfaces.a_v(np.array([50.0]), np.array([1e-4]), "value")
    expected, _, _ = find_a_v(0.8, LOAD, [1 / 50], np.pi / 2 / 1e-4)
    assert found == pytest.approx(expected)


def test_below_the_edge_range_a_v_is_constant():
    value, low, high = find_a_v(0.8, LOAD, [1e-8, 1e-6, 1e-5], 1e3)
    np.testing.assert_allclose(value, value[0], rtol=1e-12)
    ranges = np.geomspace(1e-8, 1, 65)
    pair = [find_directly(0.8, 1e3, ranges, each) for each in ("afferrante2018", "almqvist2011")]
    edge = edge_range(ranges, *pair)
    expected = find_directly(0.8, 1e3, np.array([edge]))[0]
    assert value[0] == pytest.approx(expected, rel=0.03)
    # What edges give by another estimate is a limit.
    spectrum = SelfAffine(hurst=0.8, q0=1.0, q1=1e3, h_rms=1.0)
    by_edges = pastewka_robbins_a_v(1.0, 1.0, spectrum.rms_slope, spectrum.rms_curvature)
    assert low[0] == pytest.approx((1 - THEORY_ERROR) * min(by_edges, value[0]))
    assert high[0] == pytest.approx((1 + THEORY_ERROR) * max(by_edges, value[0]))


def test_edge_range_of_power_laws():
    ranges = np.geomspace(1e-6, 1, 25)
    ratio = (ranges / 1e-3) ** -0.5  # of the variants: PARTED at 1e-3/PARTED^2
    assert edge_range(ranges, ratio, np.ones(25)) == pytest.approx(1e-3 / PARTED**2, rel=1e-9)
    assert edge_range(ranges, np.ones(25), np.ones(25)) == ranges[0]
