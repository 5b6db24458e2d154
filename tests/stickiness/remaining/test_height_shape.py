"""What the skewness of heights changes: limits, chance, and simulations kept back."""

import numpy as np
import pytest
from scipy import stats

from stickiness.remaining.height_shape import (
    find_height_shape,
    find_shape_of,
    find_skewness_error,
)
from stickiness.spectrum import SelfAffine
from stickiness.statistics import measure_shape
from stickiness.surface import synthesise

BAND = SelfAffine(hurst=0.8, q0=2 * np.pi, q1=32 * np.pi, h_rms=1.0)


def test_heights_without_skewness_are_gaussian():
    assert find_height_shape(0.0) == (0, 0)
    wave = np.sin(2 * np.pi * np.arange(64) / 64)
    assert find_shape_of(wave) == pytest.approx((0, 0), abs=1e-9)


def test_skewness_and_kurtosis_are_those_of_scipy():
    heights = np.random.default_rng(1).gamma(2.0, size=(40, 30))
    expected = stats.skew(heights, axis=None), stats.kurtosis(heights, axis=None, fisher=False)
    assert measure_shape(heights) == pytest.approx(expected, rel=1e-12)


def test_peaks_lower_and_plateaus_raise_what_remains():
    skewness = np.array([-7.0, -1.0, 1.0, 4.0])
    factor = np.exp([find_height_shape(s).shape for s in skewness])
    assert factor == pytest.approx(np.sqrt(1 + skewness**2) - skewness)
    assert find_height_shape(1.0).error == find_height_shape(-1.0).error > 0


@pytest.mark.parametrize("waves", [4, 16])
def test_chance_makes_profiles_skewed_as_far_as_is_told(waves):
    """Against the scatter over profiles of Gaussian surfaces."""
    length = 16 / waves
    profiles = [
        profile
        for seed in range(4)
        for profile in synthesise(BAND, n=512, length=16.0, seed=seed)[::64, : int(512 / length)]
    ]
    scatter = np.std([stats.skew(profile) for profile in profiles])
    told = np.mean([find_skewness_error(profile) for profile in profiles])
    assert told == pytest.approx(scatter, rel=0.25)


def test_gaussian_profiles_stay_so_and_skewed_ones_do_not():
    gaussian = synthesise(BAND, n=512, length=16.0, seed=11)[::32]
    changed = [find_shape_of(profile).shape for profile in gaussian]
    assert np.mean(np.equal(changed, 0)) > 0.8
    assert np.max(np.abs(changed)) < 0.3
    # A large map tells its skewness, whatever its scale.
    skewed = 1e-6 * synthesise(BAND, n=256, length=8.0, seed=11, skewness=-1.0)
    assert find_shape_of(skewed).shape == pytest.approx(find_height_shape(-1.0).shape, rel=0.03)
    assert find_shape_of(-skewed).shape == -find_shape_of(skewed).shape


def test_heights_of_which_chance_explains_nothing_have_the_error_of_their_shape():
    # An exponential distribution: a skewness of 2. The errors of 65536 points are 0.01.
    heights = np.random.default_rng(5).exponential(size=(256, 256))
    found = find_shape_of(heights)
    expected = find_height_shape(2.0)
    assert found.shape == pytest.approx(expected.shape, rel=0.03)
    assert found.error == pytest.approx(expected.error, rel=0.03)
