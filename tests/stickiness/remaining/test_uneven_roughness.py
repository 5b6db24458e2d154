"""How much roughness differs from place to place: nothing by chance, and what modulation makes."""

import numpy as np
import pytest

from stickiness.remaining.uneven_roughness import find_unevenness
from stickiness.spectrum import SelfAffine
from stickiness.surface import synthesise

SIDE = 2 * np.pi


def make_patch(seed, hurst=0.8):
    """A quarter of the side of a Gaussian surface, whose waves go on to longer ones."""
    band = SelfAffine(hurst=hurst, q0=1.0, q1=64.0, h_rms=1.0)
    return synthesise(band, n=256, length=SIDE, seed=seed)[:64, :64]


@pytest.mark.parametrize("hurst", [0.55, 0.9])
def test_gaussian_heights_are_even(hurst):
    found = [find_unevenness(make_patch(seed, hurst), (2, 2)) for seed in range(40)]
    # Chance is taken off in the mean, and half have less.
    assert 0.4 < np.mean(np.equal(found, 0)) < 0.8
    assert np.mean(np.less(found, 0.2)) > 0.9


def test_roughness_that_grows_across_a_map_is_uneven():
    """A factor of 4 between both halves, in the mean square."""
    heights = np.random.default_rng(1).normal(size=(128, 128))
    heights[64:] *= 2
    assert find_unevenness(heights, (1, 1)) == pytest.approx(np.log(4) / np.sqrt(3), rel=0.05)


@pytest.mark.parametrize("points", [512, 4096])
def test_a_profile_has_halves(points):
    heights = np.random.default_rng(2).normal(size=points)
    assert find_unevenness(heights, (2,)) < 0.1
    heights[points // 2 :] *= 3
    assert find_unevenness(heights, (2,)) == pytest.approx(np.log(9) / np.sqrt(2), rel=0.15)


def test_the_unit_of_the_heights_does_not_matter():
    heights = np.exp(make_patch(3))
    found = find_unevenness(heights, (2, 2))
    assert found > 0.1
    assert find_unevenness(1e-9 * heights, (2, 2)) == pytest.approx(found)


def test_grooves_have_the_roughness_across_them():
    """Along them slopes are nothing but rounding, which says nothing."""
    profile = np.random.default_rng(4).normal(size=128)
    profile[64:] *= 2
    grooves = np.tile(profile[:, None], 96)
    rounded = grooves + 1e-15 * np.random.default_rng(5).normal(size=grooves.shape)
    found = find_unevenness(grooves, (1, 1))
    assert found > 0.4
    assert find_unevenness(rounded, (1, 1)) == pytest.approx(found)


def test_a_part_without_slope_is_as_uneven_as_can_be():
    heights = np.zeros((64, 64))
    heights[:32] = np.random.default_rng(6).normal(size=(32, 64))
    assert 5 < find_unevenness(heights, (1, 1)) < 30
