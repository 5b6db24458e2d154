"""What is said of a pair of material and surface."""

import numpy as np
import pytest

from stickiness.criteria.pair import MOST_STRAIN, SPOT_INDENTATION, find_dissipation, make_pair
from stickiness.remaining.prediction import Roughness

ENERGY = 0.6e-6  # of full contact over E* [m]: with tough contact at adhesion lengths of as much


def put_on(range, adhesion_length=ENERGY, edge_path=0.0):
    """Factors of a pair on both ends of a surface, the rough one with twice the energy."""
    rough = Roughness(
        h_rms=np.array([1e-6, 1.4e-6]),
        q0=np.array([1e6, 1e6]),
        elastic_energy=np.array([ENERGY, 2 * ENERGY]),
        rms_slope=np.ones(2),
    )
    pair = make_pair(rough, modulus=1e6, work_of_adhesion=1e6 * adhesion_length, range=range)
    return pair, find_dissipation(pair, (3.0, 1.0, 9.0), edge_path)


def find_zone_of_sphere(indentation_ratio):
    """Cohesive zone over the radius of JKR contact at zero load, for indentation over range."""
    radius_of_sphere, adhesion_length = 1.0, 1e-4
    radius = np.cbrt(4.5 * np.pi * adhesion_length * radius_of_sphere**2)
    range_ = radius**2 / (3 * radius_of_sphere) / indentation_ratio
    return range_**2 / adhesion_length / radius


def test_pull_off_has_a_factor_where_spots_are_those_of_wide_spheres():
    near = 5.7e-8  # the area hardly changes with the range
    pair, _ = put_on(near)
    area = np.min(pair.area(pair.adhesion_length, near))
    assert 0.1 < area < 0.3
    # The area is that of one spot to every longest wave.
    radius = np.sqrt(area / np.pi) * 2 * np.pi / 1e6
    limit = np.sqrt(find_zone_of_sphere(SPOT_INDENTATION) * radius * pair.adhesion_length)
    assert limit == pytest.approx(near, rel=0.02)
    for factor, known in ((0.98, True), (1.02, False)):
        _, factors = put_on(factor * limit)
        value, low, high = factors["pull_off_factor"]
        np.testing.assert_equal(value, [3.0 if known else np.nan])
        assert (low, high) == (1, 9)


def test_work_has_a_factor_where_the_edge_moves_less_than_a_spot_in_the_dwell():
    pair, _ = put_on(1e-9)
    zone = 1e-18 / pair.adhesion_length
    radius = np.sqrt(np.min(pair.area(ENERGY, 1e-9)) / np.pi) * 2 * np.pi / 1e6
    for factor, expected in ((0.99, 3.0), (1.01, np.nan)):
        _, factors = put_on(1e-9, edge_path=factor * radius / zone)
        np.testing.assert_equal(factors["separation_factor"][0], [expected])
        np.testing.assert_equal(factors["pull_off_factor"][0], [3.0])


def test_contact_that_is_not_tough_has_no_factor_but_its_limits():
    _, factors = put_on(1e-9, adhesion_length=0.1 * ENERGY)
    for value, low, high in factors.values():
        assert np.isnan(value).all()
        assert (low, high) == (1, 9)


def test_elastic_pairs_have_a_factor_of_one():
    pair, _ = put_on(1e-9, adhesion_length=0.1 * ENERGY)
    for value, *_ in find_dissipation(pair, (1.0, 1.0, 1.0), 0.0).values():
        assert value == pytest.approx(1.0)


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
