"""Errors of adhesion and of means, tabulated from measurements with known answers."""

import math
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from stickiness.accuracy.error_models import Settings
from tradeoff import seed_pool, summary
from tradeoff.adhesion_table import find_threshold, list_variations, measure_scatter

ROOT = Path(__file__).parents[2]


def make_pool(seeds=64, many=512):
    """Two quantities at two loads: linear in one long wave, with more scatter on the fine grid."""
    rng = np.random.default_rng(4)
    x, more, elsewhere = rng.normal(size=seeds), rng.normal(size=many), rng.normal(size=4096)
    mean = np.array([1.0, 2.0, 3.0, 4.0])

    def solved(wave):
        return mean * (1 + 0.1 * wave[:, None] + 0.05 * rng.normal(size=(len(wave), 4)))

    coarse, others = solved(x), solved(more)
    fine = {2: coarse, 4: 1.02 * coarse + mean * 0.01 * rng.normal(size=(seeds, 4))}
    return seed_pool.SeedPool(
        fine=fine,
        coarse=others,
        controls=np.stack([more] * 7, axis=1) * np.arange(1, 8),
        elsewhere=np.stack([elsewhere] * 7, axis=1) * np.arange(1, 8),
        pressure=np.tile([0.01, 0.1], 2),
        quantity=np.repeat(["area", "mean_gap"], 2),
        truth=fine[4].mean(0) * others.mean(0) / coarse.mean(0),
        truth_error=0.0 * mean,
        fine_mean=fine[4].mean(0),
        grid_errors={},
    )


@pytest.mark.parametrize("settings", [Settings(4, 1e-8, 12, 0), Settings(4, 1e-8, 4, 64)])
def test_standard_errors_are_the_scatter_of_resampled_means(settings):
    resampling = seed_pool.Resampling(make_pool(), 400, 1024)
    errors, claimed = resampling.draw(settings)
    np.testing.assert_allclose(np.sqrt((claimed**2).mean(0)), errors.std(0), rtol=0.2)
    plain, multilevel = (resampling.draw(Settings(4, 1e-8, 4, more))[0].std() for more in (0, 256))
    assert multilevel < 0.3 * plain


def test_threshold_between_adhesion_lengths():
    """A pressure that falls by 0.1 for every factor e vanishes at e^2 times the first length."""
    lengths = 0.01 * np.exp([9.0, 1.0, 0.0, 3.0, 4.0])
    external = xr.DataArray(
        0.2 - 0.1 * np.log(lengths / 0.01),
        dims="point",
        coords={
            "range_over_h_rms": ("point", [1.0, 0.1, 0.1, 0.1, 0.1]),
            "adhesion_length_over_range": ("point", lengths),
        },
    )
    assert float(find_threshold(external)) == pytest.approx(0.01 * math.exp(2))
    closed = external.where(lengths < 0.01 * math.exp(3.5))  # windows that close, beyond
    assert float(find_threshold(closed)) == pytest.approx(0.01 * math.exp(2))
    assert np.isnan(float(find_threshold(external + 1)))


def test_every_setting_has_its_reference():
    names = "knob", "pixels", "tolerance"
    rows = [("pixels", pixels, 1e-5) for pixels in (4, 8, 16)]
    rows += [("tolerance", 8, tolerance) for tolerance in (1e-3, 1e-7)]
    measured = xr.Dataset(
        {name: ("setting", [row[k] for row in rows]) for k, name in enumerate(names)}
    )
    assert list(list_variations(measured)) == [
        ("pixels", 0, 2),
        ("pixels", 1, 2),
        ("tolerance", 1, 4),
        ("tolerance", 3, 4),
    ]


def test_what_a_control_leaves():
    twin, noise = np.random.default_rng(3).standard_normal((2, 4000))
    full = 10 + 4 * twin + 3 * noise
    scatter, share = measure_scatter(
        xr.DataArray(full, dims="seed"), xr.DataArray(twin, dims="seed")
    )
    assert float(scatter) == pytest.approx(0.5, rel=0.05)
    assert float(share) == pytest.approx(0.6, rel=0.05)


def test_committed_table_survives_writing(tmp_path):
    medians = summary.read(ROOT / "config/tradeoff.csv")
    summary.write(tmp_path / "again.csv", medians)
    assert summary.read(tmp_path / "again.csv").equals(medians)
    with pytest.raises(ValueError, match="no such file"):
        summary.read(tmp_path / "nowhere.csv")
