"""Claims on contact without adhesion, on made-up files."""

import numpy as np
import pytest
import xarray as xr
from helpers.claim_files import LOADS, ensemble, fig3c, fit, kappa, sweep

from claims import contact_claims as contact
from claims.ledger import NOT, QUALIFIED, REPRODUCED
from common import conventions
from common.conventions import LOAD


def test_the_longest_range_with_the_exponent_of_edges_is_found():
    gap = np.arange(1.0, 9.0)
    values = -1 / 3 + np.array([0.04, 0.2, 0.04, -0.04, 0.0, 0.3, 0.01, 0.3])
    exponent = xr.DataArray(values, dims="gap", coords={"gap": gap})
    assert contact.find_third(exponent) == (3.0, 5.0)
    assert contact.find_third(exponent + 1) == (1.0, 1.0)


def test_kappa_is_that_of_the_load_and_not_of_the_fit(files):
    files["kappa_128"] = kappa(128, fall=0.05, level=2.08)
    claim = contact.area_slope(files)
    assert claim.value == pytest.approx(2.08)
    assert claim.uncertainty == pytest.approx(0.05 * 2.08)
    first = 2.08 * (1 - 0.05 * np.log(LOADS[0] / LOAD))
    assert claim.facts["simulations"][0]["ends"][0][1] == pytest.approx(first)
    assert claim.verdict == QUALIFIED
    files["kappa_128"] = kappa(128, level=2.3)
    assert contact.area_slope(files).verdict == NOT


def test_exponent_is_that_of_the_density(files):
    files["fig3a"] = sweep((1000.0, 5e4), exponent=-0.55)
    claim = contact.small_gap_exponent(files)
    assert claim.value == pytest.approx(-0.55)
    assert claim.errors["model"] == pytest.approx(0, abs=1e-9)
    assert claim.verdict == NOT


def test_exponent_that_holds_where_the_paper_shows_it_alone_is_qualified(files):
    steep = sweep((5e4,), exponent=-0.55)
    files["fig3a"] = xr.concat([sweep((1000.0,)), steep], "magnification")
    claim = contact.small_gap_exponent(files)
    assert claim.verdict == QUALIFIED
    assert claim.value == pytest.approx(-1 / 3)
    (_, shown), (_, broad) = claim.facts["exponents"]
    np.testing.assert_allclose(shown, -1 / 3, rtol=1e-6)
    np.testing.assert_allclose(broad, -0.55, rtol=1e-6)


@pytest.mark.parametrize(
    ("theory", "simulation", "verdict"),
    [(1.0, 1.0, REPRODUCED), (1.0, 0.8, QUALIFIED), (0.8, 1.0, NOT)],
)
def test_separation_is_graded_on_theory_and_simulation(files, theory, simulation, verdict):
    files["fig3d"] = files["fig3d"].assign(mean_gap=files["fig3d"].mean_gap / theory)
    files["ensemble_wide"] = ensemble(32, separation=simulation, window=4)
    claim = contact.load_separation(files)
    assert claim.verdict == verdict
    assert (claim.uncertainty > 1e-9) == (simulation != 1)  # theory is at 1 on the same spectrum
    assert claim.facts["agrees"] == (simulation == 1)


@pytest.mark.parametrize(
    ("slopes", "verdict"),
    [((3, 3, 3), REPRODUCED), ((3, 3.3, 3), QUALIFIED), ((3.4, 4.4, 2.9), NOT)],
)
def test_linearity_is_graded(files, slopes, verdict):
    files["fit_fig3a"] = fit(files["fig3a"], *slopes)
    claim = contact.area_against_range(files)
    assert claim.verdict == verdict
    assert claim.value == pytest.approx(max(slopes) / min(slopes))


def test_growth_with_magnification_is_graded_though_the_area_is_linear(files):
    area = files["fig3a"].attractive_area
    files["fig3a"]["attractive_area"] = area * (area.magnification / 1e4) ** 0.1
    assert contact.area_against_range(files).verdict == NOT


@pytest.mark.parametrize(
    ("theory", "simulation", "verdict"), [(1, 1, REPRODUCED), (1, 0.8, QUALIFIED), (0.8, 0.7, NOT)]
)
def test_load_is_graded_on_theory_and_simulation(files, theory, simulation, verdict):
    files["fig3b"] = sweep(loads=(0.0065, 0.03, 0.13, 0.52), power=theory)
    files["ensemble_wide"] = ensemble(32, power=simulation, window=4)
    claim = contact.area_against_load(files)
    assert claim.value == pytest.approx(theory)
    assert np.isnan(claim.uncertainty)
    assert claim.verdict == verdict


@pytest.mark.parametrize(
    ("slopes", "verdict"),
    [((3.0, 2.9, 3.2), REPRODUCED), ((3.7, 5.1, 3.1), QUALIFIED), ((4.0, 4.2, 3.9), NOT)],
)
def test_a_v_is_graded_with_its_uncertainty(files, slopes, verdict):
    files["fit_fig3c"] = fit(fig3c(), *slopes)
    claim = contact.a_v_against_magnification(files)
    parts = np.array([0.04, 0.03, 0.0]) * slopes[0]  # grid, sampling, growth
    expected = np.linalg.norm([*parts, np.ptp(slopes) / 2])
    assert claim.uncertainty == pytest.approx(expected)
    assert claim.verdict == verdict


def test_a_v_is_about_3_at_the_middle_magnifications(files):
    """It may grow beyond them, but then it has not converged."""
    fitted = files["fit_fig3c"]
    grown = fitted.a_v * (fitted.magnification / 1e4) ** np.log10(1.06)
    files["fit_fig3c"] = fitted.assign(a_v=grown)
    claim = contact.a_v_against_magnification(files)
    assert claim.verdict == QUALIFIED
    assert np.array(claim.facts["middle"]) == pytest.approx([3.0, 3.18])
    assert claim.facts["about"]
    assert not claim.facts["steady"]


def test_continuous_a_v_is_taken_at_the_magnification_of_the_simulation(files):
    continuous = files["fit_fig3c"].isel(window=0, load=0).sel(variant=conventions.VARIANT).a_v
    continuous = continuous * np.log10(continuous.magnification)
    found = contact.interpolate_a_v(continuous, hurst=0.8, magnification=128)
    assert found == pytest.approx(3 * np.log10(128))
