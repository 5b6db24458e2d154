"""Spectra against SurfaceTopography's, C_ce = 4 pi^2 C, on files and on synthetic surfaces."""

import os
import warnings
from pathlib import Path

import numpy as np
import pytest
from scipy import signal

from stickiness import surface
from stickiness.measured import instrument_spectrum, psd, topography
from stickiness.spectrum import SelfAffine

SAMPLES = Path(
    os.environ.get("STICKINESS_SAMPLES", Path(__file__).parents[4] / "shared" / "surfaces")
)
FILES = ["al3d-1.al3d", "di-3.di", "matrix-3.txt", "tmd-1.tmd", "frt-2.frt"]
PER_DECADE = 10


@pytest.fixture(scope="module")
def package():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import SurfaceTopography.IO  # the package's imports warn
    return SurfaceTopography


def compare(ours, theirs, window="hann_radial"):
    """Ratio of both spectra in every ring with modes below the Nyquist wave number.

    They multiply with their window, unless they take the heights for periodic.
    """
    plane = psd.power_spectrum(ours.heights, ours.dx, ours.dy, window)
    lowest = min(plane.steps)
    count = int(np.log10(plane.q_nyquist / lowest) * PER_DECADE + 0.5)
    edges = lowest * 10 ** ((np.arange(count + 1) - 0.5) / PER_DECADE)
    rings = psd.radial_average(plane, bins_per_decade=PER_DECADE).between(0, edges[-1])
    _, c = theirs.power_spectrum_from_area(
        window=None if theirs.is_periodic else "hann", collocation=edges, reliable=False
    )
    return rings.psd / (np.ma.compressed(c) / (4 * np.pi**2))


def middle_window(package, name, shape, size):
    """Hann windows, theirs and scipy's, about the middle of the area; mean square one.

    Theirs peaks on pixel n//2. On a grid of half the step that is the middle, and the odd points
    of that grid are the centres of the pixels.
    """
    if name == "hann":
        w = np.multiply.outer(*(signal.windows.hann(2 * n + 1)[1::2] for n in shape))
    else:
        fine = package.Topography(np.zeros([2 * n for n in shape]), size)
        w = fine.window(window="hann", direction="radial").window_data[1::2, 1::2]
    return w / np.sqrt(np.mean(w**2))


def without_level(heights, window):
    """Heights without the mean weighted by the window.

    Their window leaves a constant behind, which leaks into the lowest waves; ours takes it off.
    """
    return heights - np.sum(window * heights) / np.sum(window)


def open_sample(package, file):
    """Path of a sample file and what SurfaceTopography reads in it, in metres."""
    path = SAMPLES / file
    if not path.is_file():
        pytest.skip(f"no sample file {path} (STICKINESS_SAMPLES names their folder)")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return path, package.IO.open_topography(str(path)).topography().to_unit("m")


def synthetic(n=96):
    s = SelfAffine(hurst=0.8, q0=1.0, q1=0.45 * n, h_rms=1.0)
    return surface.synthesise(s, n=n, length=2 * np.pi, seed=1), 2 * np.pi / n


def test_convention_from_its_definition():
    # C_ce = |dx dy sum h exp(-iqx)|^2/(Lx Ly): contact.engineering's, written out.
    h, dx = synthetic()
    h, dy = h[:64, :48], 2 * dx
    plane = psd.power_spectrum(h, dx, dy)
    theirs = np.abs(dx * dy * np.fft.rfft2(h - h.mean())) ** 2 / (64 * dx * 48 * dy)
    np.testing.assert_allclose(4 * np.pi**2 * plane.psd, theirs, rtol=1e-9, atol=1e-18)
    line = psd.profile_spectrum(h[:, 3], dx, "none")
    theirs = np.abs(dx * np.fft.rfft(h[:, 3] - h[:, 3].mean())) ** 2 / (64 * dx)
    np.testing.assert_allclose(2 * np.pi * line.psd, theirs[1:], rtol=1e-9, atol=1e-18)


@pytest.mark.parametrize("steps", [(1.0, 1.0), (1.0, 1.7)])
def test_spectrum_of_a_synthetic_surface_is_theirs(package, steps):
    # With odd numbers of points both windows have the same centre, half a pixel apart otherwise.
    h = synthetic()[0][:81, :95]
    size = 81 * steps[0], 95 * steps[1]
    ours = topography.Topography(h, *steps, "synthetic").detrended()
    window = middle_window(package, "hann_radial", h.shape, size)
    theirs = package.Topography(without_level(ours.heights, window), size)
    np.testing.assert_allclose(compare(ours, theirs), 1, rtol=1e-9)


def test_tip_cutoff_is_theirs(package):
    h, dx = synthetic(n=128)
    found = instrument_spectrum.tip_cutoff(h, (dx,), radius=0.02)
    theirs = package.Topography(h, (2 * np.pi, 2 * np.pi)).scanning_probe_reliability_cutoff(0.02)
    # Theirs is sought between pixels, ours between few distances of whole pixels.
    assert found == pytest.approx(theirs, rel=0.15)


@pytest.mark.parametrize("window", ["hann", "hann_radial"])
@pytest.mark.parametrize("file", FILES)
def test_spectrum_of_a_whole_sample_file_is_theirs_in_the_same_window(package, file, window):
    path, theirs = open_sample(package, file)
    ours = topography.read(path, max_missing=0.3, missing_rim=0, spikes="keep").detrended()
    size = theirs.physical_sizes
    heights = theirs.interpolate_undefined_data().detrend("height").heights()
    w = middle_window(package, window, heights.shape, size)
    windowed = package.Topography(w * without_level(heights, w), size, periodic=True)
    np.testing.assert_allclose(compare(ours, windowed, window), 1, rtol=1e-6)
