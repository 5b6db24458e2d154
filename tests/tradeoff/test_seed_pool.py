"""Means resampled from pools of solved seeds, with known answers."""

import numpy as np
import pytest

from stickiness.accuracy.error_models import Settings
from stickiness.accuracy.quantities import MODELLED, columns_of
from tradeoff import seed_pool

LOADS = np.array([0.01, 0.1])


def make_pool(seeds=64, many=512):
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
    return seed_pool.SeedPool(
        fine=fine,
        coarse=others,
        fixed=others[:2],
        controls=np.stack([more] * 7, axis=1) * np.arange(1, 8),
        elsewhere=np.stack([elsewhere] * 7, axis=1) * np.arange(1, 8),
        pressure=np.tile(LOADS, 2),
        quantity=np.repeat(["area", "mean_gap"], 2),
        truth=exact,
        truth_error=0.0 * mean,
        fine_mean=fine[4].mean(0),
        grid_errors={},
    )


@pytest.mark.parametrize("settings", [Settings(4, 1e-8, 12, 0), Settings(4, 1e-8, 4, 64)])
def test_standard_errors_are_the_scatter_of_resampled_means(settings):
    resampling = seed_pool.Resampling(make_pool(), 400, 1024)
    errors, claimed = resampling.draw(settings)
    np.testing.assert_allclose(np.sqrt((claimed**2).mean(0)), errors.std(0), rtol=0.2)


def test_coarse_seeds_reduce_the_scatter():
    resampling = seed_pool.Resampling(make_pool(), 200, 1024)
    plain, multilevel = (resampling.draw(Settings(4, 1e-8, 4, more))[0].std() for more in (0, 256))
    assert multilevel < 0.3 * plain


def test_more_seeds_of_a_repetition_hold_those_of_fewer():
    resampling = seed_pool.Resampling(make_pool(), 5, 64)
    plain = resampling.pool.fine[4][resampling.fine]
    means = {n: resampling.draw(Settings(4, 1e-8, n, 0))[0] for n in (4, 8)}
    want = plain[:8].mean(0) / resampling.pool.fine_mean - 1
    np.testing.assert_allclose(means[8], want)
    rest = plain[4:8].mean(0) / resampling.pool.fine_mean - 1
    np.testing.assert_allclose(means[8], (means[4] + rest) / 2)


def test_quantities_are_those_of_the_table():
    names = set(columns_of(MODELLED))
    found = make_pool().by_quantity(np.ones(4))
    assert {name for name, _ in found} <= names
    assert set(found.values()) == {1.0}
