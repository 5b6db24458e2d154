"""Line profiles: their spectra, and the isotropic ones behind them."""

import numpy as np
import pytest
from scipy import integrate

from stickiness import surface
from stickiness.measured.instrument_spectrum import abel_ratio, isotropic
from stickiness.measured.psd import merge_rings, profile_spectrum, radial_average
from stickiness.measured.self_affine_fit import FINE
from stickiness.spectrum import SelfAffine

pytestmark = pytest.mark.processors


@pytest.mark.parametrize("window", ["none", "hann"])
@pytest.mark.parametrize("n", [128, 129])
def test_parseval(window, n):
    h = np.random.default_rng(1).normal(size=n)
    line = profile_spectrum(h, 0.3, window)
    both = np.full(len(line.q), 2.0)
    both[-1] = 1 + n % 2  # the Nyquist mode is its own conjugate
    assert both @ line.psd * line.q[0] == pytest.approx(line.variance, rel=1e-12)
    if window == "none":
        assert line.variance == pytest.approx(np.var(h), rel=1e-12)


@pytest.mark.parametrize(("hurst", "q_rolloff"), [(0.5, None), (0.8, None), (0.8, 2.0), (1.0, 1.0)])
@pytest.mark.parametrize("q", [0.3, 1.0, 3.0])
def test_ratio_of_both_spectra_is_abels_transform(hurst, q_rolloff, q):
    def c(k):
        return max(k, q_rolloff or 0.0) ** (-2 * (hurst + 1))

    corner = np.sqrt(max((q_rolloff or 0.0) ** 2 - q**2, 0.0))
    edges = [0.0, corner, 10.0, 1e3, np.inf]
    parts = [
        integrate.quad(lambda k: c(np.hypot(q, k)), a, b, epsabs=0, epsrel=1e-9)[0]
        for a, b in zip(edges, edges[1:], strict=False)
        if b > a
    ]
    ratio = abel_ratio(q, hurst, q_rolloff)
    assert ratio == pytest.approx(c(q) / (2 * sum(parts)), rel=1e-7)


@pytest.fixture(scope="module")
def lines():
    """Nine profiles across a surface with a roll-off, far enough apart to be independent.

    The plateau is asked for: its sixteen modes do not always betray it.
    """
    s = SelfAffine(hurst=0.7, q0=1.0, q1=100.0, h_rms=1.0, q_rolloff=4.0)
    n, length = 1024, 8 * np.pi
    found = []
    for seed in range(3):
        h = surface.synthesise(s, n=n, length=length, seed=seed)
        spectra = (profile_spectrum(h[:, j], length / n, "none") for j in (0, n // 3, 2 * n // 3))
        rings = (radial_average(line, FINE) for line in spectra)
        found += [isotropic(line, 0.25, 50, rolloff=True) for line in rings]
    return s, found


@pytest.mark.slow
def test_profiles_give_the_spectrum_of_their_surface(lines):
    s, found = lines
    ratios = []
    for rings, _ in found:
        inside = rings.between(4.0, 50.0)
        _, mean, dof = merge_rings(inside, inside.psd / s.psd(inside.q), 5)
        ratios.append(mean)
    # 9 profiles of dof modes a ring: the error of the mean is 1/sqrt(9 dof), and the fitted H
    # adds some 5 %, as the ratio C/C1 depends on it.
    error = np.sqrt(1 / (9 * dof) + 0.05**2)
    assert np.all(np.abs(np.mean(ratios, axis=0) - 1) < 3 * error)


@pytest.mark.slow
def test_errors_of_the_exponent_cover_it(lines):
    _, found = lines
    z = [(fit.hurst - 0.7) / fit.hurst_se for _, fit in found]
    # Nine values: a standard deviation within a factor of two of one, and no bias beyond 3 of
    # its standard errors of 1/3.
    assert 0.4 < np.std(z) < 2
    assert abs(np.mean(z)) < 1
