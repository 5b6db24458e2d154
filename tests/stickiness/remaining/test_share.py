"""Share of the work of adhesion that remains: limits, consistency, simulations."""

import numpy as np
import pytest
from scipy.integrate import quad

from common import remaining_table
from stickiness.remaining import share as module
from stickiness.remaining.share import (
    FIRST_TOUCH,
    ONSET,
    find_onset,
    remaining_share,
    tough_area,
    tough_share,
    weak_distance,
    weak_share,
)
from stickiness.traction_laws import LAWS

TABLE = "config/remaining.csv"


@pytest.mark.parametrize("onset", [0.2, ONSET, 0.6])
def test_energy_gained_grows_with_the_area_of_contact(onset):
    x = np.linspace(onset, 4, 4001)
    slope = np.gradient(x * tough_share(x, onset), x)
    assert slope[5:-5] == pytest.approx(tough_area(x, onset)[5:-5], abs=1e-3)


def test_attraction_of_long_range_needs_no_contact():
    # The mean gap at first touch is that of the heights' tail, far below the range.
    assert weak_share(1e-3, 100.0) == pytest.approx(1, abs=0.06)
    assert weak_share(1e-3, 0.04) < 1e-4


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("reach", [1e-6, 1e-3, 0.03, 1.0, 10.0])
def test_mean_attraction_is_that_of_gaussian_heights(law, reach):
    """Against adaptive quadrature over the gaps, decade by decade."""
    potential = LAWS[law](1.0, reach).potential
    ends = np.array([0, *np.geomspace(1e-9, 10, 11), 30])
    ends = np.unique([*ends, reach])  # where the law of Maugis ends
    for place in (0, 20, -1):
        mean_gap = module._GAPS[place]

        def density(gap, mean_gap=mean_gap):
            return -potential(gap) * np.exp(-((mean_gap - gap) ** 2) / 2) / np.sqrt(2 * np.pi)

        parts = [quad(density, *each, epsrel=1e-9) for each in zip(ends, ends[1:], strict=False)]
        expected = sum(value for value, _ in parts)
        found = module._follow(1e300, reach, law)[place] - module._CONTACT[place]
        # evenly spaced points see the kink of the law of Maugis to second order
        assert found == pytest.approx(expected, rel=5e-3 if law == "maugis" else 1e-5)


def test_hard_surfaces_keep_the_attraction_of_their_gaps_at_first_touch():
    """Nothing is deformed: range^2 times the mean inverse square of the gap, and summits near."""
    reach = np.array([0.01, 0.03, 0.1])
    share = weak_share(1e-8, reach, "van_der_waals")
    away = share / reach**2 * FIRST_TOUCH**2
    assert np.all((away > 1) & (away < 2))
    assert share[2] == pytest.approx(module._follow(1e300, 0.1, "van_der_waals")[-2])
    # an exponential law has next to nothing there
    assert weak_share(1e-8, 0.1) < 0.1 * share[2]


def test_tension_of_a_tail_is_the_slope_of_its_energy():
    """Twice the attraction over the separation, if the range is long; no more than rigid bodies."""
    far = 30.0
    slope = 2 / (far + FIRST_TOUCH)
    distance = weak_distance(1e-8, far, "van_der_waals")
    assert distance == pytest.approx(1 / slope, rel=0.02)


def test_the_larger_of_both_with_a_rounded_corner():
    x, e = np.geomspace(0.05, 3, 30)[:, None], np.geomspace(0.05, 3, 30)
    zone = e**2 / x
    larger = np.maximum(tough_share(x, find_onset(zone)), weak_share(x, e))
    share = remaining_share(x, e, zone)
    assert np.all(share >= larger)
    assert np.all(share <= 2 ** (1 / 8) * larger + 1e-15)


@pytest.mark.parametrize("bad", [0.0, -1.0, np.nan, np.inf])
def test_bad_ratios_are_refused(bad):
    with pytest.raises(ValueError, match="energy_ratio"):
        tough_share(bad)


def test_simulated_works_where_more_than_a_little_remains():
    table = remaining_table.read(TABLE)
    table = table[table.window >= 4]
    for name in ("approach", "separation"):
        rows = table[table[name] > 0.05]
        assert len(rows) > 50
        within = np.abs(rows.predicted / rows[name] - 1) < 0.25
        assert within.mean() > 0.9, rows[~within]


def test_surfaces_that_nothing_was_fitted_to():
    table = remaining_table.read(TABLE)
    held = table[table.held]
    for name in ("approach", "separation"):
        rows = held[held[name] > 0.05]
        assert len(rows) >= 10
        assert np.all(np.abs(rows.predicted / rows[name] - 1) < 0.25)


def test_limits_cover_what_was_simulated():
    table = remaining_table.read(TABLE)
    rows = table[table.wide]
    inside = (rows.predicted_low <= rows.bound) & (rows.bound <= rows.predicted_high)
    assert inside.mean() >= 0.9


def test_the_committed_predictions_are_those_of_the_code():
    table = remaining_table.read(TABLE)
    share = remaining_share(table.energy_ratio, table.range, table.zone)
    plain = table[~table["set"].str.contains("rolloff")]
    assert share[plain.index] == pytest.approx(plain.predicted, rel=1e-3, abs=1e-5)
