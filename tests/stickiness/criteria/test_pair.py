"""What is said of a pair of material and surface."""

import numpy as np
import pytest

from stickiness.criteria import equivalent_sphere
from stickiness.criteria.pair import MOST_STRAIN, REGIMES, Pair, find_quantities
from stickiness.remaining.roughness import Roughness

ENERGY = 0.6e-6  # of full contact over E* [m]: with tough contact at adhesion lengths of as much


def test_a_pair_knows_whether_a_layer_takes_the_heights():
    rough = Roughness(h_rms=1e-6, q0=1e6, elastic_energy=ENERGY, rms_slope=1.0)
    values = {"modulus": 1e6, "work_of_adhesion": 2e6 * ENERGY, "range": 1e-9}
    usual, strained = (
        Pair(rough=rough, **values, layer_strain=factor * MOST_STRAIN) for factor in (1, 1.01)
    )
    assert usual.withstands
    assert not strained.withstands
    assert not usual.scaled(1.1).withstands


@pytest.mark.parametrize(
    ("modulus", "reach", "regime"),
    [(1e11, 1e-9, 0), (1e5, 1e-10, 2), (1e5, 1e-9, 2), (1e3, 1e-6, 3)],
)
def test_edges_are_classified_by_strength_and_zone(modulus, reach, regime):
    rough = Roughness(h_rms=1e-6, q0=1e5, elastic_energy=ENERGY, rms_slope=0.8)
    pair = Pair(rough=rough, modulus=modulus, work_of_adhesion=0.05, range=reach, a_v=4.0)
    zone, strength = pair.edges.attractive_over_contact, pair.edges.strength
    limit, within = equivalent_sphere.tough_effect(zone, strength), 0.1
    if REGIMES[regime] == "DMT-like":
        limit, within = equivalent_sphere.weak_effect(zone), 0.02
    found = find_quantities(pair)
    assert found["regime"] == regime
    is_near = found["over_dmt"] == pytest.approx(limit, rel=within)
    assert is_near == (REGIMES[regime] != REGIMES[-1])


def test_edges_are_tough_from_the_least_strength_on(monkeypatch):
    rough = Roughness(h_rms=1e-6, q0=1e5, elastic_energy=ENERGY, rms_slope=1.0)
    pair = Pair(rough=rough, modulus=1e5, work_of_adhesion=0.05, range=1e-9, a_v=4.0)
    monkeypatch.setattr(equivalent_sphere, "TOUGH", float(pair.edges.strength))
    assert REGIMES[find_quantities(pair)["regime"]] == "JKR-like"


def test_rows_of_a_pair_are_pairs():
    h_rms = np.array([1e-6, 2e-6, 3e-6])
    energy = ENERGY * (h_rms / 1e-6) ** 2
    rough = Roughness(h_rms=h_rms, q0=1e6, elastic_energy=energy, eta=np.array([-1.0, 0.0, 1.0]))
    pair = Pair(rough=rough, modulus=1e6, work_of_adhesion=2e6 * ENERGY, range=1e-9)
    one = pair.take(1)
    assert one.rough.q0 == 1e6
    assert one.remaining == pair.remaining[1]
    assert one.remaining_threshold == pytest.approx(pair.remaining_threshold[1], rel=1e-8)
    stiffer = pair.at_modulus(2e6)
    assert (stiffer.adhesion_length, stiffer.modulus) == (ENERGY, 2e6)
