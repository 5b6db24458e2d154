"""Share of the work of adhesion that remains: limits, consistency, simulations."""

import numpy as np
import pytest

from common import remaining_table
from stickiness.remaining.share import (
    ONSET,
    find_onset,
    remaining_share,
    tough_area,
    tough_share,
    weak_share,
)

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
