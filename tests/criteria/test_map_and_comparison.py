"""Limits of roughness on the map, and the adhesion that each criterion requires."""

import numpy as np
import pytest

from criteria import compare_criteria, map_criterion
from stickiness import criteria
from stickiness.criteria import equivalent_sphere
from stickiness.remaining import Roughness
from stickiness.spectrum import SelfAffine

LENGTHS = {"minimum": 1e-3, "maximum": 10, "per_decade": 2}
WAVE_NUMBERS = {"minimum": 1e-7, "maximum": 1e-2, "per_decade": 2}
ASKED_MAP = {"hurst": 0.8, "shortest_over_range": 4, "slope_parameter": [1, 0.1], "slope_a_v": 3.0}
ASKED_MAP |= {"range_times_q0": WAVE_NUMBERS, "adhesion_length_over_range": LENGTHS}
COMPARED = {"hurst": 0.8, "range_times_q0": 1e-6}
COMPARED |= {"h_rms_over_range": {"minimum": 10, "maximum": 1e4, "per_decade": 2}}
COMPARED |= {"magnification": {"minimum": 10, "maximum": 1e5, "per_decade": 2}}
COMPARED |= {"quoted_h_rms_over_range": 1000, "quoted_magnification": 1e4}


@pytest.fixture(autouse=True)
def constant_a_v(monkeypatch):
    """One a_V for all surfaces and ranges, with limits 20 % below and 30 % above it."""

    def find_a_v(hurst, load, range_over_h_rms, magnification):
        value = np.full(np.broadcast(range_over_h_rms, magnification).shape, 3.0)
        return value, 0.8 * value, 1.3 * value

    for module in (map_criterion, compare_criteria):
        monkeypatch.setattr(module, "find_a_v", find_a_v)


def made_map():
    surfaces = map_criterion.MapSurfaces(ASKED_MAP, 0.065)
    return map_criterion.find_limits(ASKED_MAP, 3.0, surfaces)


def test_map_with_constant_a_v_has_the_closed_form():
    made = made_map()
    low, value, high = made.h_rms_threshold.transpose("limit", ...)
    inside = value.notnull()
    ratio = (value / made.h_rms_threshold_constant).where(inside)
    np.testing.assert_allclose(ratio.values[inside.values], 1, rtol=1e-5)
    for limit, share in ((low, 0.8), (high, 1.3)):
        ratio = limit.drop_vars("limit") / value.drop_vars("limit")
        there = ratio.notnull().values
        np.testing.assert_allclose(ratio.values[there], share**0.6, rtol=1e-5)


def test_the_rule_of_thumb_is_where_the_share_remains():
    """On a surface of another size, at w/E* = h_rms^2/(c lambda_L)."""
    rule = map_criterion.find_rule()
    assert rule.sizes == {"limit": 3, "share": 3, "hurst": 5}
    assert (rule.rule.diff("share") < 0).all()
    for hurst, share in ((0.5, 0.1), (0.8, 0.01), (0.9, 0.3)):
        spectrum = SelfAffine(hurst=hurst, q0=0.5, q1=0.5e4, h_rms=3.0)
        energy = spectrum.elastic_energy()
        rough = Roughness(h_rms=3.0, q0=0.5, elastic_energy=energy, q1=spectrum.q1)
        for name, sign in map_criterion.SIGNS.items():
            c = float(rule.rule.sel(hurst=hurst, share=share, limit=name))
            remains = rough.deviating(sign).share(3.0**2 / (c * 2 * np.pi / 0.5), 3e-6)
            assert remains == pytest.approx(share, rel=1e-3), (hurst, name)


def test_the_rule_of_others_has_closed_forms():
    rule = map_criterion.find_rule()
    # U_full = H/(2 (2H - 1)) q0 h_rms^2 of all waves, and its power law up to those of the rule.
    for hurst in (0.7, 0.8, 0.9):
        all_waves = 2 * (2 * hurst - 1) / hurst / (2 * np.pi)
        cut = (1 - 1e4 ** (-2 * hurst)) / (1 - 1e4 ** (1 - 2 * hurst))
        found = float(rule.rule_full_contact.sel(hurst=hurst))
        assert found == pytest.approx(all_waves * cut, rel=1e-9)
    # Attraction w exp(-u^2/2)/sqrt(2 pi) over repulsion 3/4 q0 h_rms^2 E* exp(-2u) is largest at
    # u = 2; Ciavarella rounds it to 0.6.
    bearing = 4 / 3 * np.exp(2) / (2 * np.pi) ** 1.5
    assert float(rule.rule_bearing_area) == pytest.approx(bearing, rel=1e-4)
    assert bearing == pytest.approx(0.6, abs=0.05)


@pytest.mark.slow
def test_edges_of_the_map_are_weak_above_its_line_and_balance_on_the_threshold():
    made = made_map()
    roughness = map_criterion.MapSurfaces(ASKED_MAP, 0.065)
    q0, length = 1e-4, 0.1
    at = {"range_times_q0": q0, "adhesion_length_over_range": length}
    one = made.sel(at, method="nearest")

    def edges(h):
        slope = roughness.slope(h, np.array(q0))
        return equivalent_sphere.attraction(h, q0, slope, length, 1.0, 3.0)

    assert edges(float(one.weak_limit)).strength == pytest.approx(equivalent_sphere.WEAK, rel=1e-4)
    low, value, high = one.h_rms_threshold_edges.values
    assert edges(value).ratio == pytest.approx(1, rel=1e-4)
    assert low < value < high


@pytest.mark.slow
def test_which_criteria_know_the_finest_waves():
    data = compare_criteria.compare(COMPARED, 0.065, 3.0).against_magnification
    change = data.isel(magnification=-1) / data.isel(magnification=0)
    unmoved = ["violano_constant", "violano_printed", "bearing_area"]
    np.testing.assert_allclose(change.sel(criterion=unmoved), 1, rtol=1e-12)
    assert change.sel(criterion="fuller_tabor") > 10
    assert change.sel(criterion="pastewka_robbins") < 0.1
    # every threshold is where its criterion's margin is 1
    at = float(data.sel(criterion="pastewka_robbins", magnification=10))
    s = SelfAffine(hurst=0.8, q0=1e-6, q1=1e-5, h_rms=1000.0)
    found = criteria.pastewka_robbins(s.rms_slope, s.rms_curvature, at, 1.0)
    assert found.margin == pytest.approx(1, rel=1e-12)
