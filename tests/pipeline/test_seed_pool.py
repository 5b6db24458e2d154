"""Laws from noisy measurements, and means drawn from banks of solved seeds, with known answers."""

import numpy as np
import pytest

from pipeline.tradeoff import fit_laws, seed_pool
from stickiness.accuracy.error_models import Settings, Surface
from stickiness.accuracy.quantities import MODELLED, columns_of

LOADS = np.array([0.01, 0.1])


def points_of(noise, seed=1, surfaces=24):
    """Errors of either sign, 0.3/pixels^2 in standard deviation, known to `noise`."""
    rng, points = np.random.default_rng(seed), fit_laws.Points()
    for k in range(surfaces):
        surface = Surface(0.5 + 0.4 * k / surfaces, 16.0 + 2 * k)
        for pixels in (4.0, 8.0, 16.0):
            value = rng.normal(scale=np.hypot(0.3 / pixels**2, noise))
            points.add("discretisation", "area", surface, value, pixels=pixels, noise=noise)
    return points


@pytest.mark.parametrize("noise", [1e-6, 3e-3])
def test_noise_is_not_taken_for_error(noise):
    """On 16 pixels 3e-3 is two and a half times the error itself."""
    law = points_of(noise).laws()["discretisation", "area"]
    assert law.pixels == pytest.approx(-2, abs=0.5)
    for pixels in (4.0, 8.0, 16.0):
        found = law(Surface(0.7, 32.0), pixels=pixels)
        assert found == pytest.approx(0.3 / pixels**2, rel=0.5), pixels
    assert law.spread == pytest.approx(1.645, rel=0.2)


def test_least_squares_take_noise_for_error():
    """What the likeliest law is for: noise in, errors seem to fall more slowly than they do."""
    rows = points_of(3e-3).rows["discretisation", "area"]
    law = fit_laws.fitted([(row, abs(value), 0.0) for row, value, _ in rows])
    assert law.pixels > -1.6


def test_spread_is_that_of_surfaces_left_out():
    """Surfaces that differ by more than they share are not foretold: the spread must say so."""
    rng, points = np.random.default_rng(2), fit_laws.Points()
    for k in range(8):
        size = np.exp(rng.normal(scale=1.0))
        for value in size * rng.normal(size=6):
            surface = Surface(0.5 + 0.05 * k, 32.0)
            points.add("theory", "area", surface, float(value), noise=1e-3)
    law = points.laws()["theory", "area"]
    assert law.spread > 1.8


def bank(seeds=64, many=512):
    """Two quantities at two loads: linear in one long wave, with more scatter on the fine grids."""
    rng = np.random.default_rng(4)
    x, more, elsewhere = rng.normal(size=seeds), rng.normal(size=many), rng.normal(size=4096)
    mean = np.array([1.0, 2.0, 3.0, 4.0])

    def solved(wave, scatter):
        return mean * (1 + 0.1 * wave[:, None] + scatter * rng.normal(size=(len(wave), 4)))

    coarse = solved(x, 0.05)
    fine = {2: coarse, 4: 1.02 * coarse + mean * 0.01 * rng.normal(size=(seeds, 4))}
    others = solved(more, 0.05)
    exact = fine[4].mean(0) * others.mean(0) / coarse.mean(0)
    return seed_pool.Bank(
        fine=fine,
        coarse=others,
        fixed=others[:2],
        controls=np.stack([more] * 7, axis=1) * np.arange(1, 8),
        elsewhere=np.stack([elsewhere] * 7, axis=1) * np.arange(1, 8),
        pressure=np.tile(LOADS, 2),
        quantity=np.repeat(["area", "mean_gap"], 2),
        truth=exact,
        truth_error=0.0 * mean,
        pool=fine[4].mean(0),
        offsets={},
    )


@pytest.mark.parametrize("settings", [Settings(4, 1e-8, 12, 0), Settings(4, 1e-8, 4, 64)])
def test_standard_errors_of_draws_are_what_they_scatter_by(settings):
    draws = seed_pool.Draws(bank(), 400, 1024)
    errors, claimed = draws(settings)
    np.testing.assert_allclose(np.sqrt((claimed**2).mean(0)), errors.std(0), rtol=0.2)


def test_coarse_seeds_reduce_what_draws_scatter_by():
    draws = seed_pool.Draws(bank(), 200, 1024)
    plain, multilevel = (draws(Settings(4, 1e-8, 4, more))[0].std() for more in (0, 256))
    assert multilevel < 0.3 * plain


def test_more_seeds_of_a_repetition_hold_those_of_fewer():
    draws = seed_pool.Draws(bank(), 5, 64)
    plain = draws.bank.fine[4][draws.fine]
    means = {n: draws(Settings(4, 1e-8, n, 0))[0] for n in (4, 8)}
    want = plain[:8].mean(0) / draws.bank.pool - 1
    np.testing.assert_allclose(means[8], want)
    rest = plain[4:8].mean(0) / draws.bank.pool - 1
    np.testing.assert_allclose(means[8], (means[4] + rest) / 2)


def test_quantities_are_those_of_the_table():
    names = set(columns_of(MODELLED))
    found = bank().by_quantity(np.ones(4))
    assert {name for name, _ in found} <= names
    assert set(found.values()) == {1.0}
