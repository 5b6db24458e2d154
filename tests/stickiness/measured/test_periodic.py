"""Measured heights made periodic."""

import numpy as np
import pytest

from stickiness import surface
from stickiness.measured import periodic
from stickiness.spectrum import SelfAffine

pytestmark = pytest.mark.processors


@pytest.fixture
def heights():
    s = SelfAffine(hurst=0.8, q0=1.0, q1=20.0, h_rms=1.0)
    return surface.synthesise(s, n=64, length=2 * np.pi, seed=3)[:40, :32]


def jump(h):
    """Largest step across the seams over the largest inside."""
    inside = max(np.abs(np.diff(h, axis=0)).max(), np.abs(np.diff(h, axis=1)).max())
    return max(np.abs(h[0] - h[-1]).max(), np.abs(h[:, 0] - h[:, -1]).max()) / inside


def test_no_jump_is_left(heights):
    assert jump(heights + np.arange(40)[:, None]) > 2
    for kind in ("taper", "mirror", "smooth"):
        assert jump(periodic.periodise(heights, kind)) < 1


def test_a_mirror_keeps_every_height_and_a_taper_the_inner_ones(heights):
    mirrored = periodic.periodise(heights, "mirror")
    assert mirrored.shape == (80, 64)
    np.testing.assert_array_equal(mirrored[:40, :32], heights)
    assert np.std(mirrored) == pytest.approx(np.std(heights))
    tapered = periodic.periodise(heights, "taper")
    shift = heights[20, 16] - tapered[20, 16]
    np.testing.assert_allclose(tapered[5:35, 4:28], heights[5:35, 4:28] - shift)
    assert tapered.mean() == pytest.approx(0, abs=1e-12)


def test_a_smooth_correction_leaves_periodic_heights_and_inner_ones_alone(heights):
    x = 2 * np.pi * np.arange(40) / 40
    wave = np.cos(3 * x)[:, None] * np.ones(32)
    step = np.linspace(-0.5, 0.5, 40)[:, None]
    # A wave of whole periods has the step of two neighbours across its border, and no more.
    assert np.std(periodic.periodise(wave, "smooth") - wave) < 0.05
    corrected = periodic.periodise(heights + step, "smooth")
    change = corrected - heights - step
    assert corrected.mean() == pytest.approx(np.mean(heights))
    curvature = sum(np.roll(change, s, a) for s in (1, -1) for a in (0, 1)) - 4 * change
    np.testing.assert_allclose(curvature[1:-1, 1:-1], 0, atol=1e-12)
    assert np.abs(curvature[0]).max() > 0.1


def test_heights_given_as_periodic_stay_what_they_are(heights):
    np.testing.assert_array_equal(periodic.periodise(heights, "given"), heights)


def test_filtered_heights_keep_the_waves_up_to_a_wave_number():
    x, y = np.meshgrid(np.arange(48) / 48, np.arange(20) / 20, indexing="ij")
    long = np.cos(2 * np.pi * (3 * x + y)) + 7
    short = np.sin(2 * np.pi * 4 * y)
    # Sides of 6 and 2.5: wave numbers over 2 pi of 0.64 and 1.6.
    found = periodic.filter_waves(long + short, (6.0, 2.5), 2 * np.pi * 1.5)
    np.testing.assert_allclose(found, long, atol=1e-12)
    np.testing.assert_allclose(
        periodic.filter_waves(long + short, (6.0, 2.5), 2 * np.pi * 1.7), long + short, atol=1e-12
    )


def test_shells_of_an_oblong_period_keep_height_and_slope():
    x, y = np.meshgrid(np.arange(48) / 48, np.arange(20) / 20, indexing="ij")
    h = 2 * np.cos(2 * np.pi * 3 * x) + np.sin(2 * np.pi * 2 * y)
    found = periodic.shells(h, (6.0, 2.5))
    qx, qy = 2 * np.pi * 3 / 6, 2 * np.pi * 2 / 2.5
    assert found.h_rms**2 == pytest.approx(2 + 0.5)
    assert found.rms_slope**2 == pytest.approx(2 * qx**2 + 0.5 * qy**2)
