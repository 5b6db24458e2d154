"""Error models from noisy measurements whose models are known."""

import numpy as np
import pytest

from stickiness.accuracy.error_models import Surface
from tradeoff import fit_models
from tradeoff.fit_models import Conditions, Points


def points_of(noise, seed=1, surfaces=24):
    """Errors of either sign, 0.3/pixels^2 in standard deviation, known to `noise`."""
    rng, points = np.random.default_rng(seed), Points()
    for k in range(surfaces):
        surface = Surface(0.5 + 0.4 * k / surfaces, 16.0 + 2 * k)
        for pixels in (4.0, 8.0, 16.0):
            value = rng.normal(scale=np.hypot(0.3 / pixels**2, noise))
            at = Conditions(surface, pixels=pixels)
            points.add("discretisation", "area", at, value, noise)
    return points


@pytest.mark.parametrize("noise", [1e-6, 3e-3])
def test_noise_is_not_taken_for_error(noise):
    """On 16 pixels 3e-3 is two and a half times the error itself."""
    model = points_of(noise).fit()["discretisation", "area"]
    assert model.pixels == pytest.approx(-2, abs=0.5)
    for pixels in (4.0, 8.0, 16.0):
        found = model(Surface(0.7, 32.0), pixels=pixels)
        assert found == pytest.approx(0.3 / pixels**2, rel=0.5), pixels
    assert model.spread == pytest.approx(1.645, rel=0.2)
    # Least squares take noise for error: errors seem to fall more slowly.
    rows = points_of(3e-3).rows["discretisation", "area"]
    plain = fit_models.fit_least_squares([(row, abs(value), 0.0) for row, value, _ in rows])
    assert plain.pixels > -1.6


def test_spread_is_that_of_surfaces_left_out():
    """Surfaces that differ by more than they share cannot be predicted: the spread must show it."""
    rng, points = np.random.default_rng(2), Points()
    for k in range(8):
        size = np.exp(rng.normal(scale=1.0))
        for value in size * rng.normal(size=6):
            at = Conditions(Surface(0.5 + 0.05 * k, 32.0))
            points.add("theory", "area", at, float(value), noise=1e-3)
    assert points.fit()["theory", "area"].spread > 1.8


def test_powers_are_found_from_exact_values():
    points = Points()
    for hurst in (0.5, 0.7, 0.9):
        for magnification in (16.0, 64.0):
            for load in (0.01, 0.3):
                value = np.exp(0.5 * hurst) * magnification**-0.2 * load**0.1
                points.add(
                    "scatter", "area", Conditions(Surface(hurst, magnification), load), value
                )
    model = points.fit()["scatter", "area"]
    assert (model.hurst, model.magnification, model.pressure) == pytest.approx((0.5, -0.2, 0.1))
    assert (model.window, model.pixels, model.tolerance) == (0, 0, 0)
    assert model.spread == pytest.approx(1)
