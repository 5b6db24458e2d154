"""Synthetic topographies: normalised, periodic, limited to their band, and of the shape named."""

import numpy as np
import pytest
from scipy import fft, stats

from common.topographies import FAMILIES, Cell, make_topography

POINTS = 64
WAVES = 2
SHORTEST = 4
LEANING_DOWN = {"skewed_down", "plateau_honed", "dimpled", "scratched", "cobbled", "printed"}
LEANING_DOWN |= {"squared_down", "exponential_down", "tops_cut"}
LEANING_UP = {"skewed_up", "beaded", "turned", "squared", "exponential", "valleys_cut"}


@pytest.fixture(scope="module", params=FAMILIES)
def family(request):
    return request.param


def make(family, seed=5, **changes):
    return make_topography(family, POINTS, WAVES, seed, **{"shortest": SHORTEST} | changes)


def test_is_normalised_and_the_same_for_one_seed_only(family):
    heights = make(family)
    assert heights.shape == (POINTS, POINTS)
    assert heights.mean() == pytest.approx(0, abs=1e-12)
    assert heights.std() == pytest.approx(1)
    np.testing.assert_array_equal(heights, make(family))
    assert np.corrcoef(heights.ravel(), make(family, seed=6).ravel())[0, 1] < 0.95


@pytest.mark.parametrize("shortest", [2, 4, 7.5])
def test_band_ends_at_the_shortest_wave(family, shortest):
    i = fft.fftfreq(POINTS, 1 / POINTS)
    radius = np.hypot(i[:, None], i)
    power = np.abs(fft.fft2(make(family, shortest=shortest))) ** 2
    band = POINTS / shortest
    last_octave = (radius > band / 2) & (radius <= band)
    assert power[radius > band * (1 + 1e-6)].max() < 1e-20 * power.max()
    assert power[last_octave].sum() > 1e-5 * power.sum()


def test_finer_grids_sample_the_same_surface_nearly(family):
    fine = make_topography(family, 4 * POINTS, WAVES, 5, shortest=4 * SHORTEST)
    assert np.corrcoef(fine[::4, ::4].ravel(), make(family).ravel())[0, 1] > 0.97


def test_heights_lean_as_their_family_does(family):
    seeds = range(4)
    skewness = np.mean([stats.skew(make(family, seed=seed), axis=None) for seed in seeds])
    if family in LEANING_DOWN:
        assert skewness < -0.2
    elif family in LEANING_UP:
        assert skewness > 0.2
    else:
        assert abs(skewness) < 0.35


def test_cut_heights_end_at_half_an_rms_height():
    cell = Cell(POINTS, WAVES, POINTS / SHORTEST, seed=5)
    assert FAMILIES["tops_cut"](cell).max() == 0.5
    assert FAMILIES["valleys_cut"](cell).min() == -0.5


def test_ground_surfaces_are_steeper_across():
    along, across = (np.std(np.diff(make("ground"), axis=axis)) for axis in (0, 1))
    assert max(along, across) > 2 * min(along, across)


@pytest.mark.parametrize(
    ("change", "named"),
    [({"family": "knurled"}, "'knurled'"), ({"shortest": 1}, "1"), ({"shortest": 40}, "40")],
)
def test_what_cannot_be_made_is_named(change, named):
    with pytest.raises(ValueError, match=f"got {named}$"):
        make(**{"family": "gaussian"} | change)
