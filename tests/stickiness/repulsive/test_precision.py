"""The precision of the repulsive solver's last iterations."""

import numpy as np
import pytest

from stickiness import repulsive, spectrum, surface

LENGTH, LOAD = 2 * np.pi, 0.1


def rough():
    s = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=8.0, h_rms=1.0)
    return surface.synthesise(s, 64, LENGTH, 3)


def test_single_precision_meets_a_loose_tolerance():
    """Both solutions have gaps within their tolerances of the exact one."""
    double = repulsive.solve(rough(), LENGTH, LOAD, tol=1e-8)
    single = repulsive.solve(rough(), LENGTH, LOAD, tol=1e-4, precision="single")
    assert single.residual <= 1e-4
    assert single.gap.dtype == single.pressure.dtype == np.float64
    assert single.pressure.mean() == pytest.approx(LOAD, rel=1e-5)
    assert single.area_fraction == pytest.approx(double.area_fraction, abs=2 / 64**2)
    np.testing.assert_allclose(single.gap, double.gap, atol=1e-3)


def test_an_unknown_precision_is_named():
    with pytest.raises(ValueError, match="precision must be 'double' or 'single', got 'half'"):
        repulsive.solve(rough(), LENGTH, LOAD, precision="half")
