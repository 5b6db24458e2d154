"""Spectra against SurfaceTopography's own, C_ce = 4 pi^2 C, on files and on synthetic surfaces."""

import os
import warnings
from pathlib import Path

import numpy as np
import pytest

from stickiness import levelling, profiles, psd, readers, resolution, surface, topography
from stickiness.spectrum import SelfAffine

SAMPLES = Path(
    os.environ.get("STICKINESS_SAMPLES", Path(__file__).parents[2] / "shared" / "surfaces")
)
FILES = ["al3d-1.al3d", "di-3.di", "matrix-3.txt", "tmd-1.tmd", "frt-2.frt"]
PER_DECADE = 10


def reference():
    if not readers.can_read_instruments():
        pytest.skip("SurfaceTopography is not installed (envs/instruments.txt)")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import SurfaceTopography.IO  # the package's own imports warn
    return SurfaceTopography


def edges(plane):
    """Edges of the rings of `psd.radial_average` that lie below the Nyquist wave number."""
    lowest = min(plane.dqx, plane.dqy)
    count = int(np.log10(plane.q_nyquist / lowest) * PER_DECADE + 0.5)
    return lowest * 10 ** ((np.arange(count + 1) - 0.5) / PER_DECADE)


def both(ours, theirs):
    """Ratio of both spectra in every ring with modes, and the wave numbers over the step."""
    plane = psd.power_spectrum(ours.heights, ours.dx, ours.dy, "hann_radial")
    rings = psd.radial_average(plane, bins_per_decade=PER_DECADE)
    limits = edges(plane)
    _, c = theirs.power_spectrum_from_area(window="hann", collocation=limits, reliable=False)
    c = np.ma.compressed(c) / (4 * np.pi**2)
    rings = rings.between(0, limits[-1])
    assert len(rings) == len(c)
    return rings.psd / c, rings.q / max(plane.dqx, plane.dqy)


def synthetic(seed=1, n=96):
    s = SelfAffine(hurst=0.8, q0=1.0, q1=0.45 * n, h_rms=1.0)
    return surface.synthesise(s, n=n, length=2 * np.pi, seed=seed), 2 * np.pi / n


def test_convention_from_its_definition():
    # C_ce = |dx dy sum h exp(-iqx)|^2/(Lx Ly): contact.engineering's, written out.
    h, dx = synthetic()
    h, dy = h[:64, :48], 2 * dx
    plane = psd.power_spectrum(h, dx, dy)
    centred = h - h.mean()
    theirs = np.abs(dx * dy * np.fft.rfft2(centred)) ** 2 / (64 * dx * 48 * dy)
    np.testing.assert_allclose(4 * np.pi**2 * plane.psd, theirs, rtol=1e-9, atol=1e-18)
    line = profiles.profile_spectrum(h[:, 3], dx, "none")
    theirs = np.abs(dx * np.fft.rfft(h[:, 3] - h[:, 3].mean())) ** 2 / (64 * dx)
    np.testing.assert_allclose(2 * np.pi * line.psd, theirs[1:], rtol=1e-9, atol=1e-18)


@pytest.mark.parametrize("steps", [(1.0, 1.0), (1.0, 1.7)])
def test_spectrum_of_a_synthetic_surface_is_theirs(steps):
    Topography = reference().Topography
    # With odd numbers of points both windows have the same centre, half a pixel apart otherwise.
    h, _ = synthetic()
    h = h[:81, :95]
    size = h.shape[0] * steps[0], h.shape[1] * steps[1]
    ours = topography.Topography(h, *steps, "synthetic").detrended()
    w = psd._window("hann_radial", h.shape, steps)[0]
    # Their window leaves a constant behind, which leaks into the lowest waves; ours takes it off.
    level = np.sum(w * ours.heights) / np.sum(w)
    ratio, _ = both(ours, Topography(ours.heights - level, size))
    np.testing.assert_allclose(ratio, 1, rtol=1e-9)


def test_profile_of_a_synthetic_surface_is_theirs():
    UniformLineScan = reference().UniformLineScan
    h, dx = synthetic()
    line = profiles.profile_spectrum(h[:, 5], dx, "none")
    theirs = UniformLineScan(h[:, 5], 2 * np.pi, periodic=True)
    q, c = theirs.power_spectrum_from_profile(window=None, resampling_method=None, reliable=False)
    np.testing.assert_allclose(line.q[:40], q[1:41], rtol=1e-12)
    np.testing.assert_allclose(2 * np.pi * line.psd[:40], c[1:41], rtol=1e-9)


def test_tip_cutoff_is_theirs():
    Topography = reference().Topography
    h, dx = synthetic(n=128)
    found = resolution.tip_cutoff(h, (dx,), radius=0.02)
    theirs = Topography(h, (2 * np.pi, 2 * np.pi)).scanning_probe_reliability_cutoff(0.02)
    # Theirs is sought between pixels, ours between few distances of whole pixels.
    assert found == pytest.approx(theirs, rel=0.15)


@pytest.mark.parametrize("file", FILES)
def test_spectrum_of_a_sample_file_is_theirs_within_five_per_cent(file):
    package = reference()
    path = SAMPLES / file
    if not path.is_file():
        pytest.skip(f"no sample file {path} (STICKINESS_SAMPLES names their folder)")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        theirs = package.IO.open_topography(str(path)).topography().to_unit("m")
        heights = theirs.heights()
    ours = topography.read(path, missing="crop").detrended()
    kept = levelling.complete_rectangle(~np.ma.getmaskarray(heights))
    heights = np.ma.getdata(heights)[kept]
    size = [n * step for n, step in zip(heights.shape, theirs.pixel_size, strict=True)]
    levelled = package.Topography(heights, tuple(size)).detrend("height")
    np.testing.assert_allclose(ours.heights, levelled.heights(), atol=1e-8 * ours.h_rms)
    ratio, modes = both(ours, levelled)
    # Below four steps of the lattice the constant that their window leaves decides.
    np.testing.assert_allclose(ratio[modes >= 4], 1, rtol=0.05)


def test_filled_points_are_theirs():
    reference()
    path = SAMPLES / "frt-2.frt"
    if not path.is_file():
        pytest.skip(f"no sample file {path} (STICKINESS_SAMPLES names their folder)")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        theirs = reference().IO.open_topography(str(path)).topography()
        filled = theirs.interpolate_undefined_data().heights()
    ours = topography.read(path, max_missing=0.3)
    assert ours.missing == 12314
    np.testing.assert_allclose(ours.heights, filled, atol=1e-9 * ours.h_rms)
