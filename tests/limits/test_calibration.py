"""Limits made of the committed tables: that they are those of the code, and hold what they say."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from helpers.campaigns import CAMPAIGNS, read
from helpers.entries import complete

from common import heights_table
from common.config import load
from common.config.campaigns import LimitCampaign
from limits import calibrate_limits
from stickiness import datasets
from stickiness.remaining import calibration

ROOT = Path(__file__).parents[2]
TABLE = ROOT / "scripts/stickiness/remaining/calibration.csv"
LEAST = 0.82  #: share of the unseen simulations of a kind within limits of 90 %
#: Median ratio of both limits of the threshold, on unseen surfaces, that limits may not exceed.
WIDEST = {
    "spectrum": 1.4,
    "two waves": 2.0,
    "one wave": 4.0,
    "skewness": 5.5,
    "layer": 1.8,
    "film": 7.0,
    "thin": 1.6,
    "coated": 8.5,  # skins on maps, at the end of waves that maps lack
    "skin": 1.8,
    "patch": 1.9,
    "larger": 10.0,
    "larger non-Gaussian": 60.0,
    "ball": 4.5,
}
WIDEST_BALL = {"hard": 6.0, "soft": 3.0}  #: median ratio of both limits of the force, the same
WIDEST_PULL_OFF = 3.1  #: ratio of both limits of a pull-off by states

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def calibrated(tmp_path_factory):
    folder = tmp_path_factory.mktemp("limits")
    output = SimpleNamespace(
        **{
            name: folder / f"limits{ending}"
            for name, ending in (("table", ".csv"), ("summary", ".md"), ("dataset", ".nc"))
        }
    )
    campaign = complete(LimitCampaign, **load.load(ROOT / load.CAMPAIGNS["limits"]))
    job = SimpleNamespace(
        input=[ROOT / f"config/{table}.csv" for table in CAMPAIGNS],
        output=output,
        params=SimpleNamespace(touching=campaign["touching"]),
    )
    calibrate_limits.main(job)
    return output


def test_the_committed_limits_are_those_of_the_committed_tables(calibrated):
    made = pd.read_csv(calibrated.table, comment="#").set_index(["kind", "quantity"])
    committed = pd.read_csv(TABLE, comment="#")
    committed = committed.set_index(["kind", "quantity"])
    assert made.index.equals(committed.index)
    numbers = ["value", "low", "high", "fitted", "unseen"]
    np.testing.assert_allclose(made[numbers], committed[numbers], rtol=1e-3, atol=1e-9)


def test_the_library_reads_the_committed_table():
    spread = calibration.find_spread("patch", "ln_work")
    committed = pd.read_csv(TABLE, comment="#")
    committed = committed.set_index(["kind", "quantity"]).loc[("patch", "ln_work")]
    assert tuple(spread) == tuple(committed[["value", "low", "high"]])
    with pytest.raises(KeyError):
        calibration.find_spread("patch", "nothing")


def test_limits_hold_nine_in_ten_of_what_nothing_was_fitted_to(calibrated):
    errors = datasets.read(calibrated.dataset, ["kind", "role", "needed", "limit"])
    unseen = errors.to_dataframe().query("role == 'unseen'")
    assert set(unseen.kind) == set(WIDEST)
    is_inside = unseen.needed <= unseen.limit
    # Too wide is as wrong as too narrow.
    assert 0.86 <= is_inside.mean() <= 0.96
    for kind, inside in is_inside.groupby(unseen.kind):
        assert inside.mean() >= LEAST, kind
    for kind, limits in unseen.groupby("kind").limit:
        assert np.exp(2 * limits.median()) <= WIDEST[kind], kind


@pytest.mark.parametrize("stiffness", WIDEST_BALL)
def test_limits_of_balls_hold_nine_in_ten_of_what_nothing_was_fitted_to(calibrated, stiffness):
    errors = datasets.read(calibrated.dataset, ["kind", "role", "needed", "limit", "tabor"])
    unseen = errors.to_dataframe().query("kind == 'ball' and role == 'unseen'")
    rows = unseen[(unseen.tabor < 1) == (stiffness == "hard")]
    assert 0.86 <= (rows.needed <= rows.limit).mean() <= 0.96
    assert np.exp(2 * rows.limit.median()) <= WIDEST_BALL[stiffness]


def test_states_tell_shares_within_their_limits_however_little_remains():
    heights = heights_table.read(ROOT / "config/heights.csv").dropna(subset="simulated")
    rows = heights[(heights.window == 4) & (heights.role == "unseen")]
    error = calibration.find_spread("states", "share").high
    is_inside = calibrate_limits.find_share_error(rows) <= error
    assert 0.86 <= is_inside.mean() <= 0.96
    # Where next to nothing remains, the limits do not end at what is lost on other surfaces.
    assert is_inside[rows.simulated.to_numpy() < 0.01].mean() > 0.9


def test_exponents_and_errors_of_pull_offs_are_found():
    """Distances that fall with the root of the range, but for 10 % at every second work."""
    rows = pd.DataFrame({"range_ratio": np.tile([1.0, 0.5, 0.25], 40), "distance": 2.0})
    rows = rows.assign(role="fitted", share=0.2, path_share=0.2, adhesion_length=0.1)
    rows = rows.assign(energy_ratio=0.5)
    factor = np.repeat([1.1, 1 / 1.1], 60)
    rows["pull_off"] = 0.1 * 0.2 / (2.0 * np.sqrt(rows.range_ratio)) * factor
    shortening, fitted = calibrate_limits.fit_pull_offs(rows)
    assert shortening[0] == pytest.approx(0.5, abs=0.01)
    assert abs(fitted.error) == pytest.approx(np.log(1.1), abs=0.02)
    full = rows.assign(energy_ratio=2.0)
    _, fitted = calibrate_limits.fit_pull_offs(pd.concat([rows, full]))
    assert len(fitted.rows) == len(rows)  # full contact is left out


def test_limits_of_pull_offs_hold_nine_in_ten_of_what_nothing_was_fitted_to():
    table = read("pull_offs")
    _, fitted = calibrate_limits.fit_pull_offs(table)
    unseen = fitted.rows.assign(error=fitted.error).query("role == 'unseen'")
    spread = calibration.find_spread("states", "ln_tension")
    is_inside = unseen.error.between(spread.low, spread.high)
    # Limits are those of shorter ranges than the states have.
    assert 0.86 <= is_inside[unseen.range_ratio < 1].mean() <= 0.96
    assert np.exp(spread.high - spread.low) <= WIDEST_PULL_OFF
    # Limits that hold too few at the shortest range hold all at that of the states, within 20 %.
    by_range = is_inside.groupby(unseen.range_ratio).mean()
    assert by_range[0.36] >= LEAST
    assert unseen.error[unseen.range_ratio == 1].abs().max() < 0.2
    # The middle is right at every range.
    assert unseen.groupby("range_ratio").error.median().abs().max() < 0.1
