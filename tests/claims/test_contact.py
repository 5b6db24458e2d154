"""Claims on contact without adhesion, on made-up files."""

import numpy as np
import pytest
import xarray as xr
from helpers.claim_files import LOADS, ensemble, fig3c, fit, kappa, sweep

from claims import contact_claims as contact
from claims.ledger import NOT, QUALIFIED, REPRODUCED
from common import conventions
from common.paper import LOAD


def test_kappa_is_that_of_the_load_and_not_of_the_fit(files):
    files["kappa_broad_band"] = kappa(128, fall=0.05, level=2.08)
    claim = contact.area_slope(files)
    assert claim.value == pytest.approx(2.08)
    assert claim.uncertainty == pytest.approx(0.05 * 2.08)
    first = 2.08 * (1 - 0.05 * np.log(LOADS[0] / LOAD))
    assert claim.facts["simulations"][0]["ends"][0][1] == pytest.approx(first)
    assert claim.verdict == QUALIFIED
    files["kappa_broad_band"] = kappa(128, level=2.3)
    assert contact.area_slope(files).verdict == NOT


LAW = contact.small_gap_exponent, contact.area_against_range


@pytest.mark.parametrize(
    ("shown", "largest", "verdict"),
    [(-1 / 3, -1 / 3, REPRODUCED), (-0.4, -0.55, QUALIFIED), (-0.55, -1 / 3, NOT)],
)
def test_a_law_and_its_integral_have_one_grade(files, shown, largest, verdict):
    """Each exponent is that of its magnification; the value is at the largest."""
    ends = sweep((1000.0,), exponent=shown), sweep((5e4,), exponent=largest)
    files["fig3a"] = xr.concat(ends, "magnification")
    files["fig3a"]["attractive_area"] = files["fig3a"].attractive_area.interp(
        magnification=[1000.0, 1e4, 5e4]
    )
    density, area = (claim(files) for claim in LAW)
    assert density.verdict == area.verdict == verdict
    assert density.value == pytest.approx(largest)
    assert area.value == pytest.approx(1 + largest)
    for found, more in ((density, 0), (area, 1)):
        (_, first), (_, last) = found.facts["exponents"]
        np.testing.assert_allclose(first, shown + more, rtol=1e-6)
        np.testing.assert_allclose(last, largest + more, rtol=1e-6)


def test_the_integral_alone_can_fail_both(files):
    area = files["fig3a"].attractive_area
    files["fig3a"]["attractive_area"] = area * area.range**-0.2
    assert [claim(files).verdict for claim in LAW] == [NOT, NOT]


@pytest.mark.parametrize(
    ("theory", "beyond", "verdict"),
    [(1.0, 9, REPRODUCED), (0.8, 9, QUALIFIED), (1.0, 3, QUALIFIED), (1.0, 2, NOT)],
)
def test_separation_is_graded_on_simulation(files, theory, beyond, verdict):
    """Gaps `beyond` one are 0.46 smaller than the law has them."""
    files["fig3d"] = files["fig3d"].assign(mean_gap=files["fig3d"].mean_gap / theory)
    bem = files["ensemble_wide_cell"]
    made = bem.mean_gap_mean
    gap = made.where(made <= beyond, made - 0.46).assign_attrs(made.attrs)
    files["ensemble_wide_cell"] = bem.assign(mean_gap_mean=gap)
    found = contact.load_separation(files)
    assert found.verdict == verdict
    assert found.value == pytest.approx(np.exp(-2 * 0.46) if beyond < 9 else 1)
    close = made[(made >= 1) & (made <= beyond) & (gap <= 3)]
    assert found.facts["until"] == pytest.approx(close.max().item())
    # 5 % of the mean gap that was made, by the made-up budget, count twice in the load.
    error = 0.05 * made.sel(pressure=found.facts["at"].pressure).item()
    assert found.uncertainty == pytest.approx(2 * found.value * error)


@pytest.mark.parametrize(
    ("theory", "simulation", "verdict"), [(1, 1, REPRODUCED), (1, 0.8, QUALIFIED), (0.8, 0.7, NOT)]
)
def test_load_is_graded_on_theory_and_simulation(files, theory, simulation, verdict):
    files["fig3b"] = sweep(loads=(0.0065, 0.03, 0.13, 0.52), power=theory)
    files["ensemble_wide_cell"] = ensemble(32, power=simulation, window=4)
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
    assert (claim.facts["about"], claim.facts["converges"]) == (QUALIFIED, NOT)


def test_continuous_a_v_is_taken_at_the_magnification_of_the_simulation(files):
    continuous = files["fit_fig3c"].isel(window=0, load=0).sel(variant=conventions.VARIANT).a_v
    continuous = continuous * np.log10(continuous.magnification)
    found = contact.interpolate_a_v(continuous, hurst=0.8, magnification=128)
    assert found == pytest.approx(3 * np.log10(128))
