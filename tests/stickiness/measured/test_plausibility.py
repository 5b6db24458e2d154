"""Doubts about measurements: what no surface has is named, and good surfaces raise none."""

from pathlib import Path

import numpy as np
import pytest

from stickiness import surface
from stickiness.measured import instrument_spectrum, plausibility, readers, topography
from stickiness.spectrum import SelfAffine

SHARED = Path("/work/shared/surfaces")
# Whose heights lack what the law needs: C falls as q^-6.6, the blur of focus variation.
BLURRED = {"al3d-1.al3d"}


def rough(hurst=0.8, n=128):
    spectrum = SelfAffine(hurst=hurst, q0=1.0, q1=n / 2, h_rms=1.0)
    return surface.synthesise(spectrum, n, 2 * np.pi, 3)


def with_zeros(heights, share):
    heights = heights + 0.0
    chosen = np.random.default_rng(0).random(heights.shape) < share
    heights[chosen] = 0.0
    return heights


def with_block(heights):
    heights = heights + 0.0
    heights[:20, :30] = heights.max()  # saturated
    return heights


@pytest.mark.parametrize(
    ("values", "words"),
    [
        (with_zeros(rough(), 0.05), "0.051 of the points have the one value 0, as where nothing"),
        (with_zeros(rough() + 7, 0.004), "give missing_value: 0"),
        (with_zeros(np.round(50 * rough()) + 1000, 0.05), "give missing_value: 0"),
        (with_block(rough()), "0.037 of the points have the one value"),
        (with_zeros(np.round(1000 * rough()), 0.05), "the one value 0"),
        (np.round(3 * rough()), "different heights: their range is below what the numbers"),
        (with_zeros(rough()[0], 0.05), "give missing_value: 0"),
    ],
)
def test_numbers_that_were_not_measured_are_doubted(values, words):
    assert words in " ".join(plausibility.doubt_values(values))


@pytest.mark.parametrize(
    "values",
    [
        rough(),
        rough(0.2),
        np.round(10 * rough()),  # about eighty levels
        np.round(200 * rough()),
        rough()[0],
        np.where(rough() > 2, np.nan, rough()),
        with_zeros(rough(), 0.0005),  # spikes, if they stand out
    ],
)
def test_numbers_of_surfaces_are_not(values):
    assert not list(plausibility.doubt_values(values))


@pytest.mark.parametrize(
    ("factor", "step", "words"),
    [
        (1e-6, 1.25, "the side of 160 m is longer than 0.5 m"),
        (1e-6, 2.0 / 128, "the side of 2 m is longer than 0.5 m"),
        (1e-13, 1e-12, "the side of 1.28e-10 m is shorter than 1e-09 m"),
        (8.3e-3, 1e-6, "the heights range over"),
        (1e-4, 1e-6, "more than the side of 0.000128 m: correct height_unit or length"),
        (1e-14, 1e-6, "the rms slope between points is"),
    ],
)
def test_sizes_that_cannot_be_are_doubted(factor, step, words):
    assert words in " ".join(plausibility.doubt_sizes(factor * rough(), (step, step)))


def test_sizes_of_scans_and_profiles_are_not():
    assert not list(plausibility.doubt_sizes(1e-6 * rough(), (1e-5, 2e-5)))
    assert not list(plausibility.doubt_sizes(1e-10 * rough(), (1e-9, 1e-9)))
    assert not list(plausibility.doubt_sizes(1e-5 * rough()[0], (1e-4,)))


def fit_of(heights, step=1e-6):
    map_ = topography.Topography(heights, step, step, "here").detrended()
    return instrument_spectrum.analyse(map_).fit


def test_spectra_that_no_law_describes_are_doubted():
    noise = np.random.default_rng(0).standard_normal((128, 128))
    assert "H = -0.96 ± 0.09, outside" in " ".join(plausibility.doubt_fit(fit_of(noise)))
    blurred = surface.synthesise(SelfAffine(hurst=0.8, q0=1, q1=12, h_rms=1), 128, 2 * np.pi, 1)
    assert "it falls as blur does" in " ".join(plausibility.doubt_fit(fit_of(blurred)))
    assert "departs from a power law" in " ".join(plausibility.doubt_fit(fit_of(blurred)))


@pytest.mark.parametrize("hurst", [0.1, 0.5, 0.8, 1.0])
def test_spectra_of_self_affine_surfaces_are_not(hurst):
    assert not list(plausibility.doubt_fit(fit_of(1e-7 * rough(hurst, 256))))


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["al3d-1.al3d", "di-3.di", "frt-2.frt", "matrix-3.txt", "tmd-1.tmd"]
)
def test_files_of_instruments_are_not(name):
    if not (SHARED / name).is_file() or not readers.can_read_instruments():
        pytest.skip("needs the files of /work/shared/surfaces and SurfaceTopography")
    found = topography.read(SHARED / name, max_missing=0.3)
    assert found.doubts == ()
    assert found.spikes == 0
    doubts = list(plausibility.doubt_fit(instrument_spectrum.analyse(found.detrended()).fit))
    assert bool(doubts) == (name in BLURRED)
