"""Theory against simulation: gamma, and ensembles of one job."""

import json

import numpy as np
import pytest
import xarray as xr
from helpers.entries import model_surface

from fits import fit_gamma
from persson import persson_lattice
from stickiness.persson import Persson
from stickiness.spectrum import SelfAffine
from stickiness.statistics import COVERS
from stickiness.surface import lattice_spectrum

GAMMA = 0.52


@pytest.fixture(scope="module")
def made_by_theory():
    """What theory itself has at another gamma, in place of simulation."""
    lattice = lattice_spectrum(SelfAffine(hurst=0.8, q0=1.0, q1=16.0, h_rms=1.0), 2 * np.pi)
    loads, ranges = [0.03, 0.2], np.array([0.01, 0.03, 0.1, 0.3, 1.0])
    at = Persson(lattice, gamma=GAMMA)
    data = {
        "area_fraction": ("pressure", at.area_fraction(loads)),
        "mean_gap": ("pressure", at.mean_gap(loads)),
        "attractive_area": (("pressure", "range"), at.gap_cumulative(ranges, loads)),
    }
    made = xr.Dataset(
        {
            f"{name}_{kind}": (dims, values * factor)
            for name, (dims, values) in data.items()
            for kind, factor in (("mean", 1), ("mean_total_error", 0.02 * COVERS))
        },
        coords={"pressure": loads, "range": ranges},
        attrs={"parameters": json.dumps(model_surface(magnification=16))},
    )
    return fit_gamma.compare_gammas(made, xr.Dataset({"window_holds": ("pressure", [1, 1])}))


@pytest.mark.slow
@pytest.mark.parametrize("quantity", ["area_fraction", "mean_gap", "attractive_area", "all"])
def test_gamma_of_the_theory_itself_is_found(made_by_theory, quantity):
    draws = fit_gamma.sample(np.random.default_rng(1), 200, [1])
    best, low, high, spread, misfit, _ = fit_gamma.fit([made_by_theory], draws, 0, quantity)
    assert best == pytest.approx(GAMMA, rel=0.01)
    assert low < GAMMA < high
    assert 0 < spread < high - low
    assert misfit < 0.01


def test_cases_of_one_window_do_not_average_their_errors_out(made_by_theory):
    rng = np.random.default_rng
    width = {}
    for windows in ([1] * 8, list(range(8))):
        draws = fit_gamma.sample(rng(1), 400, windows)
        _, low, high, *_ = fit_gamma.fit([made_by_theory] * 8, draws, 0, "area_fraction")
        width[len(set(windows))] = np.log(high / low)
    draws = fit_gamma.sample(rng(1), 400, [1])
    _, low, high, *_ = fit_gamma.fit([made_by_theory], draws, 0, "area_fraction")
    assert width[1] == pytest.approx(np.log(high / low), rel=0.15)  # eight copies know no more
    # Of 8 windows, some are drawn more than once: errors average out by less than sqrt(8).
    assert 0.35 * width[1] < width[8] < 0.75 * width[1]


def test_highest_summit_is_that_of_the_window():
    # Gaussian heights of n independent summits reach about sqrt(2 ln n) h_rms.
    small, large = (
        persson_lattice.highest_summit(model_surface(magnification=8, window=window))
        for window in (1, 4)
    )
    assert 2.3 < small < 2.8
    assert 3.3 < large < 4.0
