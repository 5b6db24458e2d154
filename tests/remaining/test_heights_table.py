"""Energies at zero load as files, and the table with what predicts them."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from helpers.entries import complete
from helpers.jobs import make_job
from scipy import stats

from common import heights_table
from common.config.campaigns import HeightSet
from common.model_surfaces import cell_size, make_heights
from remaining import measure_heights, tabulate_heights
from stickiness import surface
from stickiness.remaining.trial_states import DEFAULT_SHARE

SURFACE = {"hurst": 0.8, "magnification": 4, "window": 2, "points": 64, "seeds": [5]}
GAUSSIAN = complete(HeightSet, **SURFACE)
SKEWED = complete(HeightSet, **SURFACE, heights={"skewness": -1.0})
CAMPAIGN = {"law": "exponential", "energies": [0.5, 1.2], "pixels_in_zone": [2]}


@pytest.fixture(scope="module")
def measured(tmp_path_factory):
    """Files of both surfaces."""
    folder = tmp_path_factory.mktemp("heights")
    paths = []
    for name, setting in (("gaussian", GAUSSIAN), ("skewed", SKEWED)):
        paths.append(folder / name / "seed5.nc")
        params = {"surface": setting, **CAMPAIGN}
        measure_heights.main(make_job(paths[-1], params, {"seed": "5"}))
    return paths


@pytest.fixture(scope="module")
def table(measured, tmp_path_factory):
    path = tmp_path_factory.mktemp("table") / "heights.csv"
    job = SimpleNamespace(input=measured, output=[path, path.with_suffix(".md")])
    tabulate_heights.main(job)
    return heights_table.read(path)


def test_shares_and_ranges_of_a_file(measured):
    data = xr.open_dataset(measured[0]).isel(pixels_in_zone=0)
    ratio = data.adhesion_length / data.full_contact_energy
    assert ratio.values == pytest.approx(CAMPAIGN["energies"])
    pixel = cell_size(GAUSSIAN) / GAUSSIAN["points"]
    assert (data.range**2 / data.adhesion_length / pixel).values == pytest.approx(2)
    # Any other state, contact without adhesion or full contact, gains less.
    assert (data.simulated > data.bound).all()
    assert (data.simulated > 1 - 1 / data.energy).all()
    # A grid of 32 points shows 8 waves of 4 pixels: all but those at the very end of the band.
    assert 0 < float(data.lacking) < 0.02


@pytest.mark.parametrize("transform", measure_heights.TRANSFORMS)
def test_transforms_skew_heights_and_keep_the_band(transform):
    setting = GAUSSIAN | {"transform": transform}
    heights = measure_heights.transform_heights(setting, seed=5)
    assert heights.shape == (64, 64)
    assert heights.std() == pytest.approx(1)
    assert surface.realised_spectrum(heights, cell_size(setting)).q1 < 4.001
    is_upward = transform in ("squared", "exp", "valleys cut")
    assert np.sign(stats.skew(heights, axis=None)) == (1 if is_upward else -1)
    gaussian = make_heights(GAUSSIAN, 64, 5)
    assert np.corrcoef(heights.ravel(), measure_heights.TRANSFORMS[transform](gaussian).ravel())[
        0, 1
    ] == pytest.approx(1, abs=0.05)


def test_table_has_every_point_with_what_predicts_it(table):
    assert len(table) == 4
    assert table["set"].tolist() == ["gaussian"] * 2 + ["skewed"] * 2
    assert table.kind.tolist() == ["Gaussian"] * 2 + ["skewed"] * 2
    assert (table.theory_low < table.theory).all()
    assert (table.theory < table.theory_high).all()
    # A plateau with valleys keeps more than the spectrum tells.
    skewed = table[table.kind == "skewed"]
    assert (skewed.shaped > skewed.theory).all()
    assert (skewed.states > skewed.theory).all()
    assert (table.states_low < table.simulated).all()
    assert (table.simulated < table.states_high).all()


def test_comparison_counts_false_decisions(table):
    """By hand: one share predicted 10 % too high, three that are wrong by the wanted share."""
    rows = table.assign(
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
