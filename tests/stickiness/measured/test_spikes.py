"""Spikes are found whatever the surface, and no surface has any."""

import numpy as np
import pytest

from stickiness import surface
from stickiness.measured.levelling import find_spikes
from stickiness.spectrum import SelfAffine

pytestmark = pytest.mark.processors


def rough(hurst=0.8, n=128, seed=1):
    spectrum = SelfAffine(hurst=hurst, q0=1.0, q1=n / 4, h_rms=1.0)
    return surface.synthesise(spectrum, n, 2 * np.pi, seed)


def pillars(noise):
    comb = np.arange(128) % 32 < 16
    step = np.logical_and.outer(comb, comb).astype(float)
    return step + noise * np.random.default_rng(0).standard_normal(step.shape)


def tilted(heights):
    return heights + np.add.outer(5.0 * np.arange(len(heights)), -3.0 * np.arange(len(heights)))


def scratched(depth, columns, n=256, varying=0.0):
    """A surface of 1 nm rms with a scratch one point wide; the row's column in `columns`."""
    heights = rough(n=n)
    along = np.arange(n)
    heights[along, columns(along)] -= depth * (1 + varying * np.sin(along / 3))
    return heights


GOOD = {
    "oblique scratch": scratched(40.0, lambda i: 20 + i // 3),
    "diagonal scratch": scratched(25.0, lambda i: i),
    "scratch of varying depth": scratched(6.0, lambda i: 20 + i // 3, varying=0.8),
    "rough": rough(0.3),
    "tilted": tilted(rough()),
    "white noise": np.random.default_rng(0).standard_normal((128, 128)),
    "eight bits": np.round(20 * rough()),
    "pillars": pillars(1e-3),
    "grooves of one point": np.tile(np.arange(128) % 8 == 0, (128, 1)) + pillars(1e-3),
    "heavy tails": np.random.default_rng(0).standard_t(4, (128, 128)),
    "ten by ten": rough(n=64)[:10, :10],
    "flat": np.zeros((9, 9)),
    "profile": rough()[0],
    "profile of grooves": (np.arange(512) % 64 < 2) + 0.01 * rough(n=512)[0],
}


@pytest.mark.parametrize("name", GOOD)
def test_no_surface_has_spikes(name):
    assert not find_spikes(GOOD[name]).any()


@pytest.mark.parametrize("height", [20.0, -20.0, 1e6, 1e300])
@pytest.mark.parametrize("name", ["rough", "tilted", "eight bits", "pillars", "profile"])
def test_a_spike_is_found_at_its_place(name, height):
    heights = GOOD[name] + 0.0
    height = height * np.ptp(heights) if abs(height) < 1e9 else height
    place = (60, 70)[: heights.ndim]
    heights[place] += height
    np.testing.assert_array_equal(np.argwhere(find_spikes(heights)), [place])


TOUCHING = {(0, 0), (0, 127), (30, 30), (30, 31), (31, 30), *((90, j) for j in range(0, 128, 4))}
BESIDE = {(30, 200), (31, 201), (200, 20)}


@pytest.mark.parametrize(("name", "places"), [("rough", TOUCHING), ("oblique scratch", BESIDE)])
def test_up_to_three_may_touch_and_a_scratch_stays(name, places):
    heights = GOOD[name] + 0.0
    for place in places:
        heights[place] += 1e3
    assert set(map(tuple, np.argwhere(find_spikes(heights)))) == places


def test_missing_points_are_no_spikes_and_no_neighbours():
    heights = rough()
    heights[40:44, 40:44] = np.nan
    heights[10, 10] = np.inf
    heights[41, 41] = 1e3  # alone amid missing points
    heights[44, 44] = 1e3
    assert set(map(tuple, np.argwhere(find_spikes(heights)))) == {(44, 44)}
    assert not find_spikes(np.full((4, 4), np.nan)).any()
