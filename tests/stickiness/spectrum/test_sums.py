"""Sums of spectra: additive integrals, the inverse, one doubled spectrum, surfaces, errors."""

import numpy as np
import pytest

from stickiness import surface
from stickiness.persson import Persson
from stickiness.spectrum import SelfAffine, Tabulated, combine

pytestmark = pytest.mark.processors

L = 2 * np.pi
ONE = SelfAffine(hurst=0.8, q0=1.0, q1=64.0, h_rms=1.0)
OTHER = SelfAffine(hurst=0.5, q0=2.0, q1=500.0, C0=0.3, q_rolloff=6.0)
TURNED = SelfAffine(hurst=0.7, q0=3.0, q1=40.0, h_rms=0.5, anisotropy=4.0, angle=0.3)
APART = SelfAffine(hurst=0.8, q0=100.0, q1=800.0, h_rms=0.1)
PAIRS = [(ONE, OTHER), (ONE, TURNED), (ONE, APART), (OTHER, Tabulated([1.0, 2.0, 9.0], [3, 1, 1]))]


@pytest.mark.parametrize("pair", PAIRS)
def test_integrals_add(pair):
    both = combine(*pair)
    q = np.geomspace(0.4, 900, 40)
    for power in (0, 1, 2, 4):
        for name in ("variance_below", "variance_above"):
            want = sum(getattr(s, name)(q, power) for s in pair)
            np.testing.assert_array_equal(getattr(both, name)(q, power), want)
    for order in (0, 2, 4):
        assert both.moment(order) == pytest.approx(sum(s.moment(order) for s in pair), rel=1e-14)
    assert both.elastic_energy() == pytest.approx(sum(s.elastic_energy() for s in pair), rel=1e-14)
    assert both.h_rms == pytest.approx(np.hypot(*(s.h_rms for s in pair)), rel=1e-14)
    np.testing.assert_allclose(both.psd(q), sum(s.psd(q) for s in pair), rtol=1e-14)
    energies = [s.elastic_energy() for s in pair]
    longest = np.average(np.log([s.q_longest for s in pair]), weights=energies)
    assert both.q_longest == pytest.approx(np.exp(longest), rel=1e-14)


SPECTRA = [
    *(combine(*pair).averaged() for pair in PAIRS),
    ONE,
    SelfAffine(hurst=1.0, q0=1.0, q1=1e6, h_rms=1.0),
    SelfAffine(hurst=0.3, q0=1.0, q1=1e4, C0=2.0, q_rolloff=10.0),
    Tabulated([1.0, 2.0, 7.0, 500.0], [3.0, 1.0, 0.9, 1e-9]),
]


@pytest.mark.parametrize("s", SPECTRA)
def test_inverse_of_the_gradient_variance(s):
    q = s.q0 * s.magnification ** np.linspace(0, 1, 37)
    gradient = s.variance_below(q, 2)
    back, above = s.at_gradient_variance(gradient)
    np.testing.assert_allclose(
        s.variance_below(back, 2), gradient, rtol=1e-13, atol=1e-15 * gradient[-1]
    )
    if s is not SPECTRA[2]:  # of bands apart, between which nothing grows
        np.testing.assert_allclose(back, q, rtol=1e-10)
    np.testing.assert_allclose(above, s.variance_above(q), rtol=1e-9, atol=1e-13 * s.h_rms**2)
    np.testing.assert_allclose(s.at_gradient_variance(gradient[-1] * 2)[0], s.q1, rtol=1e-15)
    assert s.at_gradient_variance(gradient.reshape(1, -1))[0].shape == (1, 37)


def test_surfaces_of_a_sum_hold_what_those_of_its_parts_do():
    one = SelfAffine(hurst=0.8, q0=1.0, q1=8.0, h_rms=1.0)
    other = SelfAffine(hurst=0.5, q0=2.0, q1=12.0, C0=0.1, anisotropy=2.0, angle=0.4)
    both = combine(one, other)
    got = surface.lattice_spectrum(both, L)
    want = combine(*(surface.lattice_spectrum(s, L) for s in (one, other)))
    np.testing.assert_allclose(got.q, want.q, rtol=1e-12)
    np.testing.assert_allclose(got.variance, want.variance, rtol=1e-12)
    m = surface.moments(surface.synthesise(both, 48, L, 3, amplitudes="fixed"), L)
    assert m.m00 == pytest.approx(want.moment(0), rel=1e-12)
    assert m.m20 + m.m02 == pytest.approx(2 * want.moment(2), rel=1e-12)
    power = np.zeros((48, 48))
    for s in (one, other):
        made = surface.synthesise(s, 48, L, 3, amplitudes="fixed")
        power += np.abs(np.fft.fft2(made)) ** 2
    got = np.abs(np.fft.fft2(surface.synthesise(both, 48, L, 3, amplitudes="fixed"))) ** 2
    np.testing.assert_allclose(got, power, rtol=1e-9, atol=1e-20 * power.max())


def test_knots_apart_by_rounding_are_one():
    """Else the steps of ln C between them are over nothing."""
    one = SelfAffine(hurst=0.8, q0=1.0, q1=64.0, h_rms=1.0)
    other = SelfAffine(hurst=0.8, q0=np.nextafter(1, 2), q1=np.nextafter(64, 0), h_rms=1e-5)
    both = combine(one, other)
    assert both.knots.tolist() == [1.0, 64.0]
    directed = SelfAffine(hurst=0.8, q0=1.0, q1=64.0, h_rms=1.0, anisotropy=4.0)
    assert np.diff(np.log(combine(one, directed).averaged().knots)).min() > 1e-9
    theory = Persson(combine(one, directed))
    with np.errstate(all="raise", under="ignore"):
        assert theory.gap_cumulative(np.inf, 0.1) + theory.area_fraction(0.1) == pytest.approx(1)


def test_truncation():
    both = combine(ONE, OTHER)
    assert repr(both) == f"Sum({ONE!r}, {OTHER!r})"
    cut = both.truncated(30.0)
    assert cut.h_rms**2 == pytest.approx(float(both.variance_below(30.0)), rel=1e-12)
    assert cut.truncated(1.5).h_rms ** 2 == pytest.approx(ONE.variance_below(1.5), rel=1e-12)
