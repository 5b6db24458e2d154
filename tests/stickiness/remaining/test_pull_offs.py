"""Pull-off of contact on given heights: how it is simulated, and what it says of other pairs."""

from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest

from common.topographies import make_topography
from stickiness.measured.periodic import periodise
from stickiness.remaining import height_simulation
from stickiness.remaining.height_simulation import CLOSE, STEEP, SUMMITS_AREA, find_pull_offs
from stickiness.remaining.measurement import measure
from stickiness.remaining.pull_offs import PullOffs
from stickiness.solids import HALF_SPACE
from stickiness.traction_laws import Exponential

pytestmark = pytest.mark.filterwarnings("ignore::stickiness.plausibility.PlausibilityWarning")

SIDE = 4 * np.pi
FAMILIES = ("gaussian", "skewed_up", "tops_cut")


def make_heights(family):
    return make_topography(family, points=32, waves=2, seed=3)


@cache
def simulate(family):
    return find_pull_offs(make_heights(family), SIDE)


@pytest.fixture(params=FAMILIES)
def pull_offs(request):
    return simulate(request.param)


@pytest.mark.parametrize("place", np.geomspace(0.06, 4.0, 40))
def test_the_top_of_a_curve_of_tension_is_found_to_3_percent(monkeypatch, place):
    """Wherever on the way the tension is largest; before, the surfaces may press."""
    pressing = 0.3

    def descend(cell, law, start, mean_gap):
        opening = (mean_gap - state.mean_gap) / law.range
        tension = np.exp(-(np.log(opening / place) ** 2)) - pressing * np.exp(-20 * opening / place)
        return SimpleNamespace(mean_pressure=-tension)

    monkeypatch.setattr(height_simulation._Cell, "descend", descend)
    state = SimpleNamespace(law=Exponential(1.0, 2.0), mean_gap=0.3)
    found = height_simulation._Cell(None, None, None).pull_off(state)
    assert found == pytest.approx(1.0, rel=0.03)


def test_the_top_is_found_before_an_opening_that_tears_contact(monkeypatch):
    """Contact that is nearly lost holds up to a small opening; then summits press, and attract."""

    def descend(cell, law, start, mean_gap):
        opening = (mean_gap - state.mean_gap) / law.range
        if opening < 0.4:
            tension = 1 - (opening / 0.2 - 1) ** 2
        else:
            tension = 0.01 - 0.3 * np.exp(-opening) if opening < 20 else 0.001
        return SimpleNamespace(mean_pressure=-tension)

    monkeypatch.setattr(height_simulation._Cell, "descend", descend)
    state = SimpleNamespace(law=Exponential(1.0, 2.0), mean_gap=0.3)
    found = height_simulation._Cell(None, None, None).pull_off(state)
    assert found == pytest.approx(1.0, rel=0.03)


@pytest.mark.parametrize("family", FAMILIES)
def test_last_bits_of_heights_move_no_pull_off(family):
    rng = np.random.default_rng(1)
    heights = make_heights(family)
    exact = simulate(family)
    rounded = find_pull_offs(heights * (1 + 1e-13 * rng.standard_normal(heights.shape)), SIDE)
    np.testing.assert_allclose(rounded.length, exact.length, rtol=1e-9)
    np.testing.assert_allclose(rounded.tension, exact.tension, rtol=1e-3)


def test_rigid_surfaces_hold_what_attracts_them():
    law = Exponential(1e-9, 1.0)
    heights = make_heights("gaussian")
    cell = height_simulation._Cell(heights, (SIDE, SIDE), HALF_SPACE)
    state = cell.adhere(law, "approach")
    attraction = 1e-9 * np.mean(np.exp(heights - heights.max()))
    # The first state on the way is open by a twentieth of the range.
    assert 0.95 * attraction < cell.pull_off(state) < attraction


@pytest.mark.parametrize("family", ["skewed_down", "exponential"])
def test_a_mirrored_map_holds_what_its_period_does(family):
    heights = make_topography(family, points=96, waves=6, seed=3)[:48, :48]
    quarter = find_pull_offs(heights, 1.0, mirrored=True)
    whole = find_pull_offs(periodise(heights, "mirror"), 2.0)
    lengths = np.geomspace(whole.length[1], whole.length[-1], 8)
    ranges = np.full(8, 0.2 * heights.std())
    held = [each.find_held(lengths, ranges) for each in (quarter, whole)]
    np.testing.assert_allclose(*held, rtol=0.06)


@pytest.mark.slow
@pytest.mark.parametrize("family", FAMILIES)
def test_tensions_are_those_of_paths_at_given_mean_gaps(family):
    heights = make_heights(family)
    pull_offs = simulate(family)
    law = Exponential(pull_offs.length[-2], pull_offs.range[-2])
    path = measure(heights, SIDE, law, squeeze=0.1, half_grid=False, steps=40, tol=1e-3)
    assert pull_offs.tension[-2] == pytest.approx(path.pull_off, rel=0.08)


def test_tensions_are_those_pulled_at_the_range_simulated(pull_offs):
    lengths = pull_offs.length[-5:]
    ranges = pull_offs.range[-5:]
    found = lengths * pull_offs.find_held(lengths, ranges)
    # What weaker adhesion holds at this range is no more.
    assert np.all(found >= pull_offs.tension[-5:] * (1 - 1e-9))
    np.testing.assert_allclose(found, pull_offs.tension[-5:], rtol=0.2)


def test_contact_is_followed_until_it_is_lost(pull_offs):
    """Where the area falls by more than half, both works are close."""
    step = pull_offs.length[1:] / pull_offs.length[:-1]
    is_steep = pull_offs.area[1:] > STEEP * pull_offs.area[:-1]
    assert np.all(step > 1)
    assert np.all(step[is_steep] < CLOSE)
    assert pull_offs.area[0] < SUMMITS_AREA < pull_offs.area[1]
    assert pull_offs.length[0] < pull_offs.lost_length < pull_offs.length[-1]


def test_peaks_hold_where_next_to_nothing_remains():
    """Closed contact of positive energy holds, and is lost at once at weaker adhesion."""
    heights = make_heights("skewed_up")
    pull_offs = simulate("skewed_up")
    states = height_simulation.find_trial_states(heights, SIDE)
    share = states.share(pull_offs.length, pull_offs.range)
    is_weak = share < 0.02
    own_strength = pull_offs.length / pull_offs.range
    assert (pull_offs.tension / own_strength)[is_weak].max() > 0.005


@pytest.mark.parametrize(("area", "exponent"), [(0.0, 0.5), (1.0, -0.7)])
def test_a_tension_changes_with_the_range_by_the_area_of_contact(area, exponent):
    one = np.ones(1)
    pull_offs = PullOffs(length=one, range=one, tension=0.1 * one, area=area * one)
    for factor, ratio in ((4.0, 4.0), (0.5, 0.5), (0.36, 0.36), (0.01, 0.36)):
        (held,) = pull_offs.find_held(one, factor * one)
        assert held == pytest.approx(0.1 * ratio**exponent)


def test_shorter_ranges_close_contact_at_weaker_adhesion():
    """Where the area is the same, all works of adhesion fall by the same factor."""
    length = np.geomspace(0.1, 1.0, 4)
    one = np.ones(4)
    pull_offs = PullOffs(length=length, range=one, tension=0.1 * length**2, area=0.5 * one)
    held = pull_offs.find_held(length * 0.5 ** (0.4 * 0.5), 0.5 * one)
    np.testing.assert_allclose(held, 0.1 * length * 0.5 ** (0.5 - 1.2 * 0.5))


@pytest.mark.parametrize("range_", [1e-3, 0.03, 0.1, 10.0])
def test_tensions_over_the_work_do_not_fall_with_it(pull_offs, range_):
    lengths = np.exp(np.arange(np.log(1e-4), np.log(3.0), 0.01))
    held = pull_offs.find_held(lengths, np.full(lengths.shape, range_))
    assert np.all(held[1:] >= held[:-1] * (1 - 1e-12))
    assert held[0] > 0
    assert held[-1] > 1.2 * held[0] or range_ > 1


def test_other_units_are_other_numbers_of_the_same(pull_offs):
    scaled = pull_offs.scaled(height_unit=3e-6, length_unit=2e-5)
    length = 0.7 * pull_offs.length
    range_ = 0.6 * pull_offs.range
    found = scaled.find_held(length * 3e-6**2 / 2e-5, range_ * 3e-6)
    expected = pull_offs.find_held(length, range_) / 3e-6
    np.testing.assert_allclose(found, expected)
