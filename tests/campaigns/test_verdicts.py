"""What verdicts cost and leave open: rows by hand, a small map, and the committed table."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from helpers.entries import complete

from campaigns import verdicts
from campaigns.verdicts import CONTACT, SPECTRUM, STATES
from common import tradeoff_table as summary
from common.config.campaigns import VerdictSet
from tradeoff.verdict_table import condense_verdicts

ROOT = Path(__file__).parents[2]
pytestmark = pytest.mark.filterwarnings("ignore::stickiness.plausibility.PlausibilityWarning")
SMALL = complete(VerdictSet, family="gaussian", points=64, waves=2, shortest=4.0, seeds=[3])


def test_rows_of_verdicts_by_hand():
    """Four pairs of which one is outside, one open and one wrong, and one without a truth."""
    columns = ("remaining", "low", "high", "simulated", "seconds")
    pairs = [
        (0.20, 0.15, 0.25, 0.21, 1.0),  # decided
        (0.10, 0.05, 0.20, 0.13, 2.0),  # open
        (0.02, 0.00, 0.05, 0.12, 4.0),  # outside, and wrong
        (0.01, 0.00, 0.03, 0.01, 5.0),
        (0.01, 0.00, 0.03, np.nan, 9.0),
    ]
    rows = pd.DataFrame(pairs, columns=columns).assign(way=STATES, grid=64)
    medians = condense_verdicts(rows)
    assert list(medians) == [*summary.KEYS, "error", "cost"]
    (row,) = summary.list_verdicts(medians)
    assert row == pytest.approx(
        {
            "way": STATES,
            "points": 64,
            "seconds": 3.0,
            "pairs": 4,
            "share": 0.02,
            "width": 0.075,
            "outside": 0.25,
            "undecided": 0.25,
            "wrong": 0.25,
        }
    )


@pytest.fixture(scope="module")
def judged():
    shared = {"grids": [32, 64], "energies": [0.3, 1.0], "law": "exponential"}
    rows = pd.DataFrame(verdicts.measure(SMALL, 3, shared))
    return rows.set_index(["way", "grid", "energy_ratio"]).sort_index()


def test_every_way_and_grid_is_judged(judged):
    assert set(judged.index.droplevel("energy_ratio")) == {
        (SPECTRUM, 64),
        *((way, points) for way in (CONTACT, STATES) for points in (32, 64)),
    }
    assert (judged.seconds > 0).all()
    assert judged.groupby("energy_ratio").simulated.nunique().tolist() == [1, 1]
    assert (judged.low <= judged.remaining).all()
    assert (judged.remaining <= judged.high).all()


def test_contact_without_adhesion_bounds_what_states_find(judged):
    bound = judged.loc[CONTACT]
    assert (bound.remaining <= judged.loc[STATES].remaining + 1e-6).all()
    assert (bound.remaining <= bound.simulated + 5e-3).all()
    assert (bound.high == 1).all()


def test_states_on_the_whole_map_find_the_truth(judged):
    """The map is periodic, and simulated beside its mirror images."""
    whole = judged.loc[STATES].xs(64, level="grid")
    assert whole.remaining.values == pytest.approx(whole.simulated.values, abs=0.05)
    assert whole.simulated.between(whole.low, whole.high).all()


def test_committed_verdicts_gain_from_time():
    verdicts = pd.DataFrame(
        summary.list_verdicts(summary.read(ROOT / "config/tradeoff.csv"))
    ).set_index(["way", "points"])
    for way in (CONTACT, STATES):
        assert verdicts.loc[way].index.tolist() == [64, 128, 256, 512]
        assert (np.diff(verdicts.loc[way].seconds) > 0).all()
    # Grids of 512 points are on other maps than the rest.
    assert (verdicts.drop(512, level="points").pairs >= 30).all()
    states = verdicts.loc[STATES].loc[:256]
    contact = verdicts.loc[CONTACT].loc[:256]
    (by_spectrum,) = verdicts.loc[SPECTRUM].share
    assert (states.share < by_spectrum / 5).all()
    assert states.share[256] < states.share[128] / 3
    assert (np.diff(states.width) < 0).all()
    assert (contact.seconds < states.seconds).all()
    assert (contact.undecided > states.undecided).all()
    # The default grid, and finer ones, hold nine in ten, and are narrow.
    assert (states.outside[[128, 256]] <= 0.14).all()
    assert (states.width[[128, 256]] < 0.1).all()
    assert (states.wrong == 0).all()
