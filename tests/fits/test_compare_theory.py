"""Theory against simulation: distance of distributions, gamma, and ensembles of one job."""

import numpy as np
import pytest
import xarray as xr

from fits import compare_theory, fit_gamma
from persson import persson_lattice
from stickiness.persson import Persson
from stickiness.spectrum import SelfAffine
from stickiness.statistics import COVERS
from stickiness.surface import lattice_spectrum

RANGES = np.geomspace(1e-4, 10, 161)


def exponential(contact, mean):
    """Share of gaps up to a range: contact, the others exponentially distributed."""
    return (1 - contact) * (1 - np.exp(-RANGES / mean))


def ensemble(contacts, means):
    """Realisations whose gaps are exponential."""
    areas = [[[exponential(*pair)]] for pair in zip(contacts, means, strict=True)]
    data = {
        "area_fraction": (("seed", "resolution", "pressure"), [[[c]] for c in contacts]),
        "attractive_area": (("seed", "resolution", "pressure", "range"), areas),
    }
    simulated = xr.Dataset(data, coords={"range": RANGES, "pressure": [0.1]})
    for name in data:
        fine = simulated[name].isel(resolution=-1)
        simulated[f"{name}_mean"] = fine.mean("seed")
        simulated[f"{name}_standard_error"] = fine.std("seed", ddof=1) / np.sqrt(len(contacts))
        simulated[f"{name}_discretisation_error"] = 0 * fine.mean("seed")
    return simulated


def theory(contact, mean):
    data = {
        "area_fraction": (("variant", "pressure"), [[contact]]),
        "attractive_area": (("variant", "pressure", "range"), [[exponential(contact, mean)]]),
    }
    return xr.Dataset(data, coords={"range": RANGES, "pressure": [0.1], "variant": ["a"]})


def test_distance_of_exponential_distributions():
    # Of one sign everywhere: the difference of the means, 0.9 (1 - 0.8)
    found = compare_theory.distance(ensemble([0.1, 0.1], [1.0, 1.0]), theory(0.1, 0.8))
    assert float(found.distance.squeeze()) == pytest.approx(0.18, rel=2e-3)
    assert float(found.distance_standard_error.squeeze()) == pytest.approx(0, abs=1e-12)


def test_distance_knows_contact():
    # Equal mean gaps, so that only the distance tells them apart.
    found = compare_theory.distance(ensemble([0.0, 0.0], [1.0, 1.0]), theory(0.5, 2.0))
    # int |exp(-u) - exp(-u/2)/2| du = 1/2, less exp(-5) beyond the largest gap of 10
    assert float(found.distance.squeeze()) == pytest.approx(0.5 - np.exp(-5), rel=2e-3)


def test_distance_has_the_sampling_error_of_the_mean():
    means = [0.9, 1.0, 1.1, 1.2]
    found = compare_theory.distance(ensemble([0.0] * 4, means), theory(0.0, 0.5))
    # all on one side of theory: the standard error of the mean gap
    want = np.std(means, ddof=1) / 2
    assert float(found.distance_standard_error.squeeze()) == pytest.approx(want, rel=5e-3)
    floor = float(found.distance_floor.squeeze())
    assert floor == pytest.approx(np.sqrt(2 / np.pi) * want, rel=0.02)


def test_contact_that_trades_with_gaps_next_to_it_is_no_distance():
    # Contact differs by seed, but the gaps it gives up are next to zero: W1 of mean and seeds is
    # that of the gaps below 1e-3, though either area scatters at every range.
    contacts, gap = [0.1, 0.2, 0.3, 0.4], 1e-3
    small = ensemble(contacts, [gap] * 4)
    found = compare_theory.distance(small, theory(0.25, gap))
    # 1 - (1 - c) exp(-u/gap): the deviation of c times exp(-u/gap)
    error = np.std(contacts, ddof=1) / 2
    want = np.sqrt(2 / np.pi) * error * gap
    assert float(found.distance_floor.squeeze()) == pytest.approx(want, rel=0.01)


def test_grid_errors_of_contact_and_gaps_cancel_in_the_distance():
    # Halving the grid moves 0.1 from contact to gaps of mean 1e-3, alike in both seeds.
    gap, fine = 1e-3, ensemble([0.3, 0.3], [1e-3] * 2)
    rough = ensemble([0.2, 0.2], [gap] * 2)
    both = fine.drop_vars(compare_theory.PARTS)
    for name in compare_theory.PARTS:
        both[name] = xr.concat([rough[name], fine[name]], "resolution")
        both[f"{name}_discretisation_error"] = abs(fine[name] - rough[name]).isel(
            seed=0, resolution=0
        )
    found = compare_theory.distance(both, theory(0.3, gap))
    error = float(found.distance_discretisation_error.squeeze())
    assert error == pytest.approx(0.1 * gap, rel=0.01)


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
        attrs={"parameters": '{"hurst": 0.8, "magnification": 16}'},
    )
    return fit_gamma.case(made, xr.Dataset({"window_holds": ("pressure", [1, 1])}))


@pytest.mark.slow
@pytest.mark.parametrize("quantity", ["area_fraction", "mean_gap", "attractive_area", "all"])
def test_gamma_of_the_theory_itself_is_found(made_by_theory, quantity):
    draws = fit_gamma.sample(np.random.default_rng(1), 200, [1])
    best, low, high, spread, misfit, own = fit_gamma.fit([made_by_theory], draws, 0, quantity)
    assert best == pytest.approx(GAMMA, rel=0.01)
    assert low < GAMMA < high
    assert 0 < spread < high - low
    assert misfit < 0.01 < own


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
        persson_lattice.highest_summit({"hurst": 0.8, "magnification": 8, "window": window})
        for window in (1, 4)
    )
    assert 2.3 < small < 2.8
    assert 3.3 < large < 4.0
