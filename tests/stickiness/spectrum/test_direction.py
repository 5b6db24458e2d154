"""Spectra with a direction: 2D integrals, averages, moments by direction, surfaces, errors."""

import numpy as np
import pytest
from scipy import integrate

from stickiness import surface
from stickiness.measured.psd import power_spectrum
from stickiness.spectrum import SelfAffine, kinds
from stickiness.spectrum.direction import Ellipse

pytestmark = pytest.mark.processors

L = 2 * np.pi  # so that wave numbers are lattice indices
GOOD = {"hurst": 0.8, "q0": 1.0, "q1": 16.0, "h_rms": 1.0}


def made(**changes):
    return SelfAffine(**{**GOOD, **changes})


def by_direction(s, ratio, power):
    """Integral of |q|^power C over the plane: over ln q along each direction, then over these."""

    def along(phi):
        stretch = np.sqrt(ratio * np.cos(phi) ** 2 + np.sin(phi) ** 2 / ratio)
        knots = np.log(s.knots / stretch)

        def term(t):
            norm = min(max(np.exp(t) * stretch, s.q0), s.q1)
            return np.exp((2 + power) * t) * s.C0 * max(norm, s.q_longest) ** (-2 * (s.hurst + 1))

        parts = zip(knots[:-1], knots[1:], strict=True)
        return sum(integrate.quad(term, *ends, epsabs=0, epsrel=1e-11)[0] for ends in parts)

    whole = integrate.quad(along, 0, np.pi / 2, epsabs=0, epsrel=1e-10, limit=200)[0]
    return 4 * whole


@pytest.mark.parametrize("ratio", [1.0, 1.00005, 1.5, 8.0])
@pytest.mark.parametrize("rest", [{}, {"hurst": 0.4, "q1": 400.0, "q_rolloff": 5.0}])
def test_height_slope_and_energy_are_integrals_over_the_plane(ratio, rest):
    s = made(anisotropy=ratio, **rest)
    mean = s.averaged()
    for power, name in ((0, "h_rms"), (2, "rms_slope"), (1, "elastic_energy"), (4, None)):
        want = by_direction(s, ratio, power)
        assert s.total_variance(power) == pytest.approx(want, rel=2e-9)
        if name is not None:
            assert mean.total_variance(power) == pytest.approx(want, rel=1e-8)
    assert s.h_rms == pytest.approx(1.0, rel=1e-13)
    assert s.rms_slope == pytest.approx(np.sqrt(by_direction(s, ratio, 2)), rel=1e-9)
    assert s.elastic_energy() == pytest.approx(by_direction(s, ratio, 1) / 4, rel=1e-9)


@pytest.mark.parametrize("ratio", [20.0, 100.0, 1e4])
@pytest.mark.parametrize("q1", [2.0, 1e6])
def test_averages_of_long_ellipses(ratio, q1):
    s = made(anisotropy=ratio, q1=q1)
    mean = s.averaged()
    assert mean.h_rms == pytest.approx(s.h_rms, rel=1e-12)
    assert mean.rms_slope == pytest.approx(s.rms_slope, rel=1e-12)
    assert mean.elastic_energy() == pytest.approx(s.elastic_energy(), rel=1e-6)
    assert (mean.q0, mean.q1) == pytest.approx(s.band, rel=1e-12)
    # <g^2> and <g^4> of an ellipse
    iso = made(q1=q1)
    assert s.rms_slope**2 / iso.rms_slope**2 == pytest.approx((ratio + 1 / ratio) / 2, rel=1e-12)
    fourth = 3 / 8 * (ratio**2 + ratio**-2) + 1 / 4
    assert s.rms_curvature**2 / iso.rms_curvature**2 == pytest.approx(fourth, rel=1e-12)


@pytest.mark.parametrize("ratio", [1.3, 4.0, 30.0])  # 30: no circle lies in the band
def test_density_is_the_mean_over_directions(ratio):
    s = made(anisotropy=ratio, angle=0.4, q_rolloff=3.0)
    phi = (np.arange(200_000) + 0.5) / 200_000 * 2 * np.pi
    low, high = s.band
    for q in (low * 1.01, 1.0, 3.0, 5.0, 16.0, high * 0.99):
        want = s.psd_of_norm(s.ellipse.norm(q * np.cos(phi), q * np.sin(phi))).mean()
        # steps of the band's ends on 2e5 directions
        assert s.psd(q) == pytest.approx(want, rel=3e-3)
    assert list(s.psd([0.0, low * 0.99, high * 1.01])) == [0, 0, 0]
    assert s.psd([[1.0, 2.0]]).shape == (1, 2)


def test_ratio_one_is_isotropic_to_the_last_bit():
    plain, round_ = made(C0=0.1, h_rms=None), made(C0=0.1, h_rms=None, anisotropy=1, angle=0.7)
    for amplitudes in ("gaussian", "fixed"):
        pair = [surface.synthesise(s, 40, L, 3, amplitudes) for s in (plain, round_)]
        np.testing.assert_array_equal(*pair)
    q = np.geomspace(0.5, 20, 50)
    np.testing.assert_array_equal(plain.psd(q), round_.psd(q))
    np.testing.assert_array_equal(plain.variance_below(q, 1), round_.variance_below(q, 1))
    assert round_.averaged() is round_
    windows = [surface.lattice_spectrum(s, L) for s in (plain, round_)]
    np.testing.assert_array_equal(*(window.variance for window in windows))


@pytest.mark.parametrize("angle", [0.0, 0.3])
def test_modes_lie_in_the_ellipse_and_hold_its_variances(angle):
    s = made(q0=2.0, C0=1.0, h_rms=None, anisotropy=4.0, angle=angle)
    power = np.abs(np.fft.fft2(surface.synthesise(s, 72, L, 0, amplitudes="fixed")) / 72**2) ** 2
    k = np.fft.fftfreq(72, 1 / 72)
    want = s.psd_of_norm(s.ellipse.norm(k[:, None], k[None, :]))
    np.testing.assert_allclose(power, want, rtol=1e-9, atol=1e-25)
    window = surface.lattice_spectrum(s, L)
    assert window.h_rms**2 == pytest.approx(want.sum(), rel=1e-12)
    realised = surface.realised_spectrum(np.fft.ifft2(np.sqrt(power)).real * 72**2, L)
    np.testing.assert_allclose(realised.q, window.q, rtol=1e-12)
    np.testing.assert_allclose(realised.variance, window.variance, rtol=1e-9)


def test_truncation_cuts_the_norm_and_keeps_the_direction():
    s = made(anisotropy=4.0, angle=0.3, q_rolloff=3.0)
    qx, qy = np.random.default_rng(0).uniform(-5, 5, (2, 200))
    for q1 in (8.0, 2.5):
        cut = s.truncated(q1)
        inside = s.ellipse.norm(qx, qy) <= q1
        want = np.where(inside, s.psd_of_norm(s.ellipse.norm(qx, qy)), 0)
        np.testing.assert_allclose(cut.psd_of_norm(cut.ellipse.norm(qx, qy)), want, rtol=1e-12)
        assert (cut.q0, cut.q1) == (1.0, q1)
        assert cut.band == pytest.approx((0.5, 2 * q1))
        again = eval(repr(cut), {**vars(kinds)})
        np.testing.assert_allclose(again.psd([1.5, 2.4]), cut.psd([1.5, 2.4]), rtol=1e-5)
    assert "anisotropy=4, angle=0.3" in repr(s)


def test_cells_and_grids_that_do_not_hold_the_waves_are_named():
    s = made(q0=3.0, q1=12.0, anisotropy=16.0)  # longest along: 4 times 2 pi/3
    with pytest.raises(ValueError, match="longest wavelength 8.37758.*or lower anisotropy"):
        surface.synthesise(s, 128, L, 0)
    with pytest.raises(ValueError, match="n >= 192 or lower q1 or anisotropy"):
        surface.synthesise(s, 128, 2 * L, 0)
    assert surface.synthesise(s, 192, 2 * L, 0).std() == pytest.approx(1, rel=1e-3)
    long = made(q0=10.0, q1=20.0, anisotropy=100.0)
    assert surface.lattice_spectrum(long, L).h_rms == pytest.approx(1.0, rel=1e-12)


@pytest.mark.parametrize("ratio", [1.5, 4.0])
def test_measured_dependence_on_direction(ratio):
    # C ~ 1 + A cos 2(phi - phi0), phi0 across the long correlation length
    angle = 0.3
    s = made(q1=10.0, anisotropy=ratio, angle=angle)
    phi = (np.arange(2000) + 0.5) / 2000 * np.pi
    density = (ratio * np.cos(phi) ** 2 + np.sin(phi) ** 2 / ratio) ** -1.8
    want = -2 * np.mean(np.cos(2 * phi) * density) / density.mean()
    ends = np.sqrt(ratio), 10 / np.sqrt(ratio)  # where ellipses fill whole circles
    found = [
        power_spectrum(surface.synthesise(s, 200, 4 * L, seed), L / 50).anisotropy(*ends)
        for seed in range(4)
    ]
    amplitude, direction = np.mean(found, axis=0)
    assert amplitude == pytest.approx(want, abs=0.03)
    assert direction == pytest.approx(angle - np.pi / 2, abs=0.03)


def test_bands_with_a_gap_between_them_are_averaged_one_by_one():
    ellipse = Ellipse(1.5, 0.3)
    whole = kinds.PowerLawSegments(
        [1.0, 2.0, 8.0, 16.0], [1.0, 0.0, 0.1], [-3.0, 0.0, -3.0], ellipse
    )
    low = kinds.PowerLawSegments([1.0, 2.0], [1.0], [-3.0], ellipse)
    high = kinds.PowerLawSegments([8.0, 16.0], [0.1], [-3.0], ellipse)
    for q in (1.5, 4.0, 9.0):
        expected = low.variance_below(q) + high.variance_below(q)
        assert whole.variance_below(q) == pytest.approx(expected, rel=1e-7)
    assert whole.averaged().psd(4.0) == 0.0
