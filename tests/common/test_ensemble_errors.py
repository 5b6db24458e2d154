"""Glue between the files of the ensembles and the estimators of their means."""

from operator import attrgetter, itemgetter

import numpy as np
import pytest
import xarray as xr

from common import ensemble_means
from stickiness.accuracy import multilevel

FINE, COARSE, DESCRIBED = 3, 40, 200
LOADS = [0.01, 0.1]


def surfaces(rng, count):
    """Areas and slopes of one long wave's height, by load, and that height."""
    x = rng.exponential(size=count)
    area = 0.2 + x[:, None] * np.array(LOADS) + 0.01 * rng.standard_normal((count, 2))
    return area, 1 + 0.1 * x, x[:, None]


@pytest.fixture
def ensemble():
    """Fine areas are 0.8 times the coarse ones with a little noise, halfway 0.9 times."""
    rng = np.random.default_rng(1)
    area, slope, _ = surfaces(rng, FINE)
    more, more_slope, x = surfaces(rng, COARSE)
    noise = 0.001 * rng.standard_normal((FINE, 2))
    return xr.Dataset(
        {
            "area": (
                ("seed", "resolution", "pressure"),
                np.stack([area, 0.9 * area, 0.8 * area + noise], axis=1),
            ),
            "rms_slope": ("seed", slope),
            "coarse_area": (("coarse_seed", "pressure"), more),
            "coarse_rms_slope": ("coarse_seed", more_slope),
            "long_waves": (("coarse_seed", "descriptor"), x),
            "other_long_waves": (("other", "descriptor"), surfaces(rng, DESCRIBED)[2]),
        },
        coords={
            "seed": [1, 2, 3],
            "resolution": [2.0, 4.0, 8.0],
            "pressure": LOADS,
            "coarse_seed": 100 + np.arange(COARSE),
        },
    )


def product(solved):
    return solved.area * solved.rms_slope / solved.pressure


def test_multilevel_mean_of_a_derived_quantity(ensemble):
    found = ensemble_means.add_errors(
        xr.Dataset(), "k", product(ensemble), ensemble_means.coarse(ensemble, product)
    )
    e = ensemble
    fine, twin = (
        (e.area.isel(resolution=k) * e.rms_slope / e.pressure).transpose("seed", "pressure").values
        for k in (-1, 0)
    )
    many = e.coarse_area.values * e.coarse_rms_slope.values[:, None] / np.array(LOADS)
    waves = e.long_waves.values, e.other_long_waves.values
    want = multilevel.multilevel_mean(fine, twin, many, *waves)
    np.testing.assert_allclose(found.k_mean, want.mean, rtol=1e-13)
    np.testing.assert_allclose(found.k_standard_error, want.standard_error, rtol=1e-13)
    assert found.k_mean.dims == ("pressure",)
    # much closer than three plain seeds, or the levels were mixed up
    assert np.all(found.k_standard_error < 0.5 * ensemble_means.standard_error(product(ensemble)))


def test_discretisation_error_does_not_depend_on_the_estimator(ensemble):
    more = ensemble_means.coarse(ensemble, itemgetter("area"))
    for chosen in (None, more):
        found = ensemble_means.add_errors(xr.Dataset(), "area", ensemble.area, chosen)
        change = (ensemble.area[:, 2] - ensemble.area[:, 1]).values
        want = np.hypot(change.mean(0), change.std(0, ddof=1) / np.sqrt(FINE))
        np.testing.assert_allclose(found.area_discretisation_error, want, rtol=1e-12)


def test_a_single_seed_has_no_standard_error(ensemble):
    one = ensemble.isel(seed=[0])
    found = ensemble_means.add_errors(
        xr.Dataset(), "area", one.area, ensemble_means.coarse(one, attrgetter("area"))
    )
    np.testing.assert_array_equal(found.area_mean, one.area[0, -1])
    assert np.isnan(found.area_standard_error).all()


def test_entries_that_are_not_finite_everywhere_are_plain(ensemble):
    ensemble["coarse_area"][3, 0] = -np.inf
    more = ensemble_means.coarse(ensemble, attrgetter("area"))
    best, error = ensemble_means.ensemble_mean(ensemble.area, more)
    plain = ensemble_means.mean(ensemble.area)
    assert best[0] == plain[0]
    assert error[0] == ensemble_means.standard_error(ensemble.area)[0]
    assert np.isfinite(best).all()
    assert best[1] != plain[1]


def test_seeds_on_half_the_grid_correct_a_mean_where_they_go_with_it():
    """Fine values are 0.8 times those of half the grid, or have nothing to do with them."""
    half, noise = np.random.default_rng(2).exponential(size=(2, 8, 2))
    both = np.stack([half, 0.8 * half + noise * [1e-6, 1.0]], axis=1)
    both[4:, 1] = np.nan
    values = xr.DataArray(both, dims=("seed", "resolution", "pressure"))
    best, error = ensemble_means.ensemble_mean(values)
    want, plain = 0.8 * half.mean(0), values[:4, 1].mean("seed")
    np.testing.assert_allclose(best, [want[0], plain[1]], rtol=1e-5)
    scatter = 0.8 * half[:, 0].std(ddof=1) / np.sqrt(8), both[:4, 1, 1].std(ddof=1) / 2
    np.testing.assert_allclose(error, scatter, rtol=1e-5)
