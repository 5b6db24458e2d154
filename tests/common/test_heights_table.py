"""The table of heights of many shapes, and predictions of a few of its rows compared by hand."""

from pathlib import Path

import pytest

from common import heights_table
from stickiness.remaining.trial_states import DEFAULT_SHARE

TABLE = heights_table.read(Path(__file__).parents[2] / "config/heights.csv")


def test_kinds_of_heights_are_told_by_their_families():
    kinds = TABLE.drop_duplicates("set").groupby("kind").family.unique()
    assert set(kinds["Gaussian"]) == {"gaussian"}
    assert set(kinds["skewed"]) == {"skewed_up", "skewed_down"}
    assert len(kinds["transformed"]) == 6
    assert TABLE.magnification.isin([8, 16, 32]).all()


def test_comparison_counts_false_decisions():
    """One share predicted 10 % too high, three that are wrong by the wanted share."""
    rows = TABLE.head(4).assign(
        simulated=[0.2, 0.04, 0.3, 0.02],
        theory=[0.22, 0.15, 0.05, 0.02],
        theory_low=[0.15, 0.12, 0.02, 0.0],
        theory_high=[0.3, 0.2, 0.08, 0.12],
        bound=[0.1, 0.04, 0.2, 0.0],
    )
    result = heights_table.compare(rows, "theory", DEFAULT_SHARE)
    assert result["ratio"] == pytest.approx((1.1 + 1 / 6) / 2)
    assert result["within_quarter"] == 0.5
    assert result["small_error"] == pytest.approx(0.055)
    assert result["inside"] == 0.5
    assert result["decided"] == 0.75
    assert (result["false_sticks"], result["false_does_not_stick"]) == (1, 1)
    assert heights_table.compare(rows, "bound", DEFAULT_SHARE)["inside"] == 1
