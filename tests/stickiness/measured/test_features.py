"""Single features are found, named and placed; roughness that is spread over a map is none."""

from itertools import product

import numpy as np
import pytest
from helpers.rough import periodic
from scipy import ndimage

from common.topographies import FAMILIES, make_topography
from stickiness.measured.features import CELLS, find_feature
from stickiness.measured.levelling import detrend
from stickiness.measured.periodic import periodise

N = 96
SIDE = 1e-4  # [m]
HEIGHT = 1e-6  # of a feature [m]
X, Y = (np.indices((N, N)) + 0.5) / N
ROUGHNESS = (0.02, 0.05, 0.1)  # rms, over the height of a feature, of the variants
EXPONENTIAL = {"exponential", "exponential_down"}


def rough(seed, n=N, hurst=0.8):
    """Part of a periodic map without a roll-off, of unit rms."""
    heights = periodic((2 * n, 2 * n), modes=0.8 * n, hurst=hurst, seed=seed)[:n, :n]
    return heights / heights.std()


def random(seed):
    return np.random.default_rng([seed, 1])


def coordinates(seed):
    """Coordinates across and along a line through a place near the middle, at any angle."""
    x, y, turn = random(seed).uniform((0.35, 0.35, 0.0), (0.65, 0.65, np.pi))
    return (
        (X - x) * np.cos(turn) + (Y - y) * np.sin(turn),
        (Y - y) * np.cos(turn) - (X - x) * np.sin(turn),
    )


# Features of unit height, in three variants of size; the seed gives place and direction.


def step_along_an_axis(variant, seed):
    return (X, Y, 1 - X)[variant] > random(seed).uniform(0.3, 0.7)


def step(variant, seed):
    return coordinates(seed)[0] > 0


def flake(variant, seed):
    """Edge of a peeled skin: a curved step."""
    across, along = coordinates(seed)
    bow = (0.1, 0.4, 0.7)[variant] * along**2
    return across > bow + 0.02 * np.sin(15 * along)


def scratch(variant, seed):
    across = coordinates(seed)[0] / (0.02, 0.035, 0.05)[variant]
    return -(1 - across**2) * np.exp(-0.5 * across**2)


def short_scratch(variant, seed):
    along = coordinates(seed)[1]
    return scratch(variant, seed) * np.clip((0.25 - abs(along)) / 0.05, 0, 1)


def weld(variant, seed):
    across, along = coordinates(seed)
    width = (0.06, 0.1, 0.14)[variant]
    ripples = 1 + 0.08 * np.cos(2 * np.pi * (along + across**2 / width) / 0.06)
    return np.maximum(1 - (across / width) ** 2, 0) * ripples


def indent(variant, seed):
    distance = np.abs(coordinates(seed)).max(axis=0) / (0.2, 0.14, 0.1)[variant]
    return 0.15 * np.exp(-(((distance - 1.15) / 0.15) ** 2)) - np.maximum(1 - distance, 0)


def particle(variant, seed):
    radius = (0.15, 0.1, 0.07)[variant]
    return np.sqrt(np.maximum(1 - np.square(coordinates(seed)).sum(axis=0) / radius**2, 0))


def letter(variant, seed):
    """A raised E."""
    x, y = np.array(coordinates(seed)) / (0.4, 0.32, 0.25)[variant] + 0.5
    is_bar = (abs(y - 0.1) < 0.1) | (abs(y - 0.5) < 0.1) | (abs(y - 0.9) < 0.1)
    return (x > 0) & (x < 1) & (y > 0) & (y < 1) & (is_bar | (x < 0.25))


def coin(variant, seed):
    """Raised discs and bars within a circle on a plain."""
    relief = np.zeros((N, N))
    shapes = (2, 3, 5)[variant]
    radius = (0.3, 0.25, 0.2)[variant]
    middle = random(seed).uniform(0.35, 0.65, 2)
    for number in range(shapes):
        turn = random(seed).uniform(0, np.pi) + 2 * np.pi * number / shapes
        x, y = middle + 0.6 * radius * np.array([np.cos(turn), np.sin(turn)])
        is_disc = np.hypot(X - x, Y - y) < 0.35 * radius
        is_bar = (abs(X - x) < 0.2 * radius) & (abs(Y - y) < 0.5 * radius)
        relief[is_bar if number % 2 else is_disc] = 1 - 0.1 * number
    return relief


# Features that are all over the map.


def fresnel(variant, seed):
    square = np.square(coordinates(seed)).sum(axis=0)
    return (4 * (3, 5, 12)[variant] * square) % 1


def knurl(variant, seed):
    across, along = np.array(coordinates(seed)) * (3, 5, 8)[variant]
    return np.minimum(abs((across + along) % 1 - 0.5), abs((across - along) % 1 - 0.5))


def weave(variant, seed):
    across, along = np.pi * np.array(coordinates(seed)) * (3, 5, 8)[variant]
    warp = abs(np.sin(across)) * (1 + 0.5 * np.sin(along))
    return np.maximum(warp, abs(np.cos(along)) * (1 - 0.5 * np.cos(across)))


def grating(variant, seed):
    return (coordinates(seed)[0] * (3, 5, 10)[variant]) % 1 < 0.5


def lenses(variant, seed):
    across, along = (np.array(coordinates(seed)) * (3, 4, 6)[variant]) % 1 - 0.5
    return np.sqrt(0.6 - across**2 - along**2)


def relief_all_over(variant, seed):
    """Ten or more raised discs."""
    heights = np.zeros((N, N))
    for x, y, radius in random(seed).uniform((0, 0, 0.06), (1, 1, 0.12), (10 + 5 * variant, 3)):
        heights[np.hypot(X - x, Y - y) < radius] = 1.0
    return heights


#: Names that are right.
SINGLE = {
    step_along_an_axis: {"step"},
    step: {"step"},
    flake: {"step", "ridge"},
    scratch: {"groove"},
    short_scratch: {"groove", "hollow"},
    weld: {"ridge"},
    indent: {"hollow"},
    particle: {"raised patch"},
    letter: {"raised patch"},
    coin: {"raised patch", "ridge"},
}
SPREAD = (fresnel, knurl, weave, grating, lenses, relief_all_over)


def soften(heights):
    """Heights with edges over about two points."""
    return ndimage.gaussian_filter(heights.astype(float), 0.7, mode="nearest")


def make(feature, variant, seed):
    """Levelled map of a feature with roughness [m]."""
    heights = soften(feature(variant, seed)) + ROUGHNESS[variant] * rough(seed)
    return HEIGHT * detrend(heights)


def make_clean(family, waves, seed, n=64):
    """Levelled quarters of a map of a family, each with so many of the longest waves a side."""
    heights = make_topography(family, 2 * n, 2 * waves, seed)
    return [detrend(heights[i : i + n, j : j + n]) for i in (0, n) for j in (0, n)]


def find(heights):
    return find_feature(heights, (SIDE, SIDE))


def randomise_phases(heights, seed):
    """Heights with the spectrum of these and of their mirror images, levelled."""
    spectrum = np.abs(np.fft.fft2(periodise(heights, "mirror")))
    noise = np.fft.fft2(random(seed).standard_normal(spectrum.shape))
    mixed = np.fft.ifft2(spectrum * noise / np.abs(noise)).real
    return detrend(mixed[: len(heights), : len(heights)])


@pytest.mark.parametrize("feature", SINGLE, ids=lambda feature: feature.__name__)
def test_single_features_are_found_named_and_placed(feature):
    for variant in range(3):
        for seed in range(2):
            number = 10 * seed + variant
            found = find(make(feature, variant, number))
            assert found is not None, number
            assert found.shape in SINGLE[feature], number
            # Where the bare feature is steepest is in the box around the place.
            steep = np.hypot(*np.gradient(soften(feature(variant, number))[2:-2, 2:-2]))
            steepest = (np.unravel_index(steep.argmax(), steep.shape) + np.array(2.5)) / N * SIDE
            assert np.all(steepest > np.min(found.outline, axis=0) - SIDE / CELLS)
            assert np.all(steepest < np.max(found.outline, axis=0) + SIDE / CELLS)


@pytest.mark.parametrize("feature", SPREAD, ids=lambda feature: feature.__name__)
def test_features_all_over_a_map_are_roughness(feature):
    for variant in range(3):
        assert find(make(feature, variant, variant)) is None, variant


@pytest.mark.parametrize("family", sorted(set(FAMILIES) - EXPONENTIAL))
def test_clean_maps_have_none(family):
    for waves in (3, 6):
        assert not any(map(find, make_clean(family, waves, waves))), waves


@pytest.mark.slow
def test_rates_of_single_features():
    """All of 360 single features, and few of the same spectra with random phases."""
    cases = list(product(SINGLE, range(3), range(12)))
    maps = [make(feature, variant, 100 * seed + variant + 7) for feature, variant, seed in cases]
    found = [find(heights) for heights in maps]
    assert None not in found
    are_named = [each.shape in SINGLE[case[0]] for each, case in zip(found, cases, strict=True)]
    assert np.mean(are_named) > 0.98
    randomised = [find(randomise_phases(heights, seed)) for seed, heights in enumerate(maps)]
    assert np.mean([each is not None for each in randomised]) < 0.02


@pytest.mark.slow
def test_rates_of_clean_maps():
    """At most 2 % of 2000 maps, all but a few of which have the exponential of Gaussian heights."""
    rates = {}
    for family in FAMILIES:
        maps = [make_clean(family, waves, seed) for waves in (2, 3, 4, 6, 8) for seed in range(5)]
        rates[family] = np.mean([find(heights) is not None for part in maps for heights in part])
    assert np.mean(list(rates.values())) <= 0.02
    assert max(rate for family, rate in rates.items() if family not in EXPONENTIAL) <= 0.02
    assert 0 < min(rates[family] for family in EXPONENTIAL) < 0.25


@pytest.mark.slow
@pytest.mark.parametrize("hurst", [0.5, 0.8, 1.0])
def test_self_affine_maps_without_a_rolloff_have_none(hurst):
    for seed in range(100):
        assert find(detrend(rough(seed, 64, hurst))) is None, seed


@pytest.mark.slow
@pytest.mark.parametrize("hurst", [0.5, 0.8, 1.0])
def test_few_random_profiles_in_all_rows_have_one(hurst):
    """They have few waves, of which chance may put most of the energy into one place."""
    found = 0
    for seed in range(100):
        waves = np.arange(65.0)
        amplitudes = np.append(0, np.maximum(waves, 2)[1:] ** (-0.5 - hurst))
        noise = np.fft.rfft(random(seed).standard_normal(128))
        profile = np.fft.irfft(amplitudes * noise)[:64]
        found += find(detrend(np.tile(profile[:, None], 64))) is not None
    assert found <= 14


def test_share_is_that_of_the_squared_amplitudes():
    """Short waves, of which a square of a sixteenth of the map has three times the amplitude."""
    waves = np.cos(2 * np.pi * 24 * X) * np.cos(2 * np.pi * 20 * Y)
    is_strong = (X > 0.25) & (X < 0.5) & (Y > 0.5) & (Y < 0.75)
    found = find(HEIGHT * np.where(is_strong, 4.0, 1.0) * waves)
    assert found.area == pytest.approx(1 / 16, rel=0.01)
    assert found.share == pytest.approx(16 / (16 + 15), rel=0.03)
    # Below it along y there is more room than on any other side.
    np.testing.assert_allclose(found.beside, ((0, SIDE), (0, 0.5 * SIDE)))
    np.testing.assert_allclose(found.centre, (0.375 * SIDE, 0.625 * SIDE), rtol=1e-9)
    assert found.angle is None


def test_share_goes_with_the_wave_number():
    """Waves of one amplitude, of which those in a quarter of the map are an eighth as long."""
    is_short = (X > 0.5) & (Y > 0.5)
    long, short = (np.cos(2 * np.pi * n * X) * np.cos(2 * np.pi * n * Y) for n in (4, 32))
    found = find(HEIGHT * np.where(is_short, short, long))
    assert found.area == pytest.approx(1 / 4, rel=0.01)
    assert found.share == pytest.approx(8 / (8 + 3), rel=0.03)


def test_turned_scaled_and_unlike_sides():
    heights = make(scratch, 1, 4)
    found = find(heights)
    across = find(np.ascontiguousarray(heights.T))
    assert across.angle == pytest.approx((np.pi / 2 - found.angle) % np.pi)
    assert across.share == pytest.approx(found.share)
    np.testing.assert_allclose(across.centre, found.centre[::-1])
    upside_down = find(-heights)
    assert (found.shape, upside_down.shape) == ("groove", "ridge")
    assert upside_down.outline == found.outline
    # Every second point along y of a map that is twice as long along x.
    line = np.exp(-(((X - Y) / 0.02) ** 2))
    longer = find_feature(HEIGHT * detrend(line)[:, ::2], (2 * SIDE, SIDE))
    assert longer.angle == pytest.approx(np.arctan(0.5), abs=0.01)
    larger = find_feature(1e3 * heights, (7 * SIDE, 7 * SIDE))
    np.testing.assert_allclose(larger.outline, 7 * np.array(found.outline))


def test_large_maps_are_thinned_and_small_ones_have_none():
    heights = make(indent, 1, 2)
    larger = np.kron(heights, np.ones((7, 7)))
    assert find(larger).share == pytest.approx(find(heights).share, abs=0.05)
    assert find(heights[:31]) is None
    assert find(np.zeros((64, 64))) is None


def test_words():
    assert str(find(make(step_along_an_axis, 1, 1))).startswith("a step along x at y = ")
    assert "° to x through x = " in str(find(make(scratch, 1, 4)))
    assert str(find(make(indent, 1, 2))).startswith("a hollow around x = ")
