"""Spectra: closed forms against quadrature and multiprecision, inverses, limits, errors."""

import pickle
from copy import deepcopy

import mpmath
import numpy as np
import pytest
from scipy import integrate

from stickiness.spectrum import SelfAffine, Shells, Tabulated, combine

pytestmark = pytest.mark.processors


def by_quadrature(s, a, b, power, breaks=()):
    """2 pi int q^(1 + power) C dq over ln q, split where C has kinks."""
    ends = np.unique(np.clip([a, b, *breaks], a, b))
    parts = [
        integrate.quad(
            lambda t: 2 * np.pi * np.exp((2 + power) * t) * float(s.psd(np.exp(t))),
            *np.log(pair),
            epsabs=0,
            epsrel=1e-11,
            limit=200,
        )[0]
        for pair in zip(ends[:-1], ends[1:], strict=True)
    ]
    return sum(parts)


@pytest.mark.parametrize("hurst", [1e-10, 0.3, 0.8, 1.0])
@pytest.mark.parametrize(
    ("q1", "q_rolloff"), [(2.002, None), (3.0, None), (128.0, None), (2e4, 40.0), (2e10, None)]
)
@pytest.mark.parametrize("power", [0, 1, 2, 4])
def test_moments_of_self_affine_spectra_agree_with_quadrature(hurst, q1, q_rolloff, power):
    s = SelfAffine(hurst=hurst, q0=2.0, q1=q1, C0=0.3, q_rolloff=q_rolloff)
    breaks = () if q_rolloff is None else (q_rolloff,)
    for q in (2.0 * (q1 / 2.0) ** 0.2, 2.0 * (q1 / 2.0) ** 0.9):
        below, above = (by_quadrature(s, *ends, power, breaks) for ends in ((2.0, q), (q, q1)))
        # quad asks for 1e-11; C at the very ends is a matter of rounding
        assert s.variance_below(q, power) == pytest.approx(below, rel=1e-9)
        assert s.variance_above(q, power) == pytest.approx(above, rel=1e-9)
    assert s.variance_below(q1, power) == pytest.approx(s.variance_above(2.0, power), rel=1e-14)


@pytest.mark.parametrize("q_rolloff", [None, 30.0])
@pytest.mark.parametrize("zeta", [1.001, 64.0, 1e10])
def test_prescribed_height(q_rolloff, zeta):
    if q_rolloff is not None and zeta < 30:
        q_rolloff = 1 + 0.5 * (zeta - 1)
    s = SelfAffine(hurst=0.8, q0=1.0, q1=zeta, h_rms=2.5, q_rolloff=q_rolloff)
    assert s.h_rms == pytest.approx(2.5, rel=1e-14)
    same = SelfAffine(hurst=0.8, q0=1.0, q1=zeta, C0=s.C0, q_rolloff=q_rolloff)
    assert same.h_rms == pytest.approx(2.5, rel=1e-14)
    assert s.magnification == zeta
    q = np.sqrt(zeta) if q_rolloff is None else np.sqrt(zeta * q_rolloff)
    assert s.psd(q) == pytest.approx(s.C0 * q**-3.6, rel=1e-12)


@pytest.mark.parametrize("hurst", [0.3, 0.8, 1.0])
@pytest.mark.parametrize("distance", [1e-3, 1e-7, 1e-11])
def test_no_cancellation_at_the_ends(hurst, distance):
    s = SelfAffine(hurst=hurst, q0=1.0, q1=1e8, C0=1.0)
    with mpmath.workdps(50):
        for power in (0, 2):
            e = mpmath.mpf(power) - 2 * mpmath.mpf(hurst)

            def exact(a, b, e=e):
                a, b = mpmath.mpf(a), mpmath.mpf(b)
                return 2 * mpmath.pi * (mpmath.log(b / a) if e == 0 else (b**e - a**e) / e)

            low, high = 1 + distance, 1e8 * (1 - distance)
            # what is left is the rounding of q itself, 1e-16 in 1/distance
            tolerance = 1e-13 + 4e-16 / distance
            below, above = s.variance_below(low, power), s.variance_above(high, power)
            assert float(below / exact(1, low) - 1) == pytest.approx(0, abs=tolerance)
            assert float(above / exact(high, 1e8) - 1) == pytest.approx(0, abs=tolerance)


SPECTRA = [
    SelfAffine(hurst=0.8, q0=1.0, q1=1e4, h_rms=1.0),
    SelfAffine(hurst=1.0, q0=1.0, q1=1e6, h_rms=1.0),
    SelfAffine(hurst=0.3, q0=1.0, q1=1e4, C0=2.0, q_rolloff=10.0),
    Tabulated([1.0, 2.0, 7.0, 500.0], [3.0, 1.0, 0.9, 1e-9]),
]


@pytest.mark.parametrize("s", SPECTRA)
@pytest.mark.parametrize("q1", [1.5, 10.0, 300.0])
def test_truncation_keeps_the_rest(s, q1):
    cut = s.truncated(q1)
    q = np.geomspace(1.0, q1, 9)
    np.testing.assert_allclose(cut.psd(q), s.psd(q), rtol=1e-12)
    for power in (0, 2, 4):
        assert cut.variance_below(q1, power) == pytest.approx(
            s.variance_below(q1, power), rel=1e-12
        )
    assert (cut.q0, cut.q1) == (s.q0, q1)
    assert cut.psd(q1 * 1.01) == 0
    assert cut.prescribed != "h_rms"  # the part keeps C, not the whole's height


def test_shells_sum_up():
    q, variance = np.array([1.0, 2.0, 5.0]), np.array([3.0, 0.5, 0.25])
    s = Shells(q, variance)
    for power in (0, 1, 2, 4):
        terms = variance * q**power
        at = [0.5, 1.0, 1.5, 2.0, 4.9, 5.0]
        np.testing.assert_allclose(
            s.variance_below(at, power), [terms[q <= a].sum() for a in at], rtol=1e-14
        )
        np.testing.assert_allclose(
            s.variance_above(at, power), [terms[q > a].sum() for a in at], rtol=1e-14
        )
    # one wave a cos(kx) has h^2 = a^2/2, h'^2 = k^2 a^2/2, h''^2 = k^4 a^2/2
    assert s.h_rms**2 == pytest.approx(3.75)
    assert s.rms_slope**2 == pytest.approx(3 + 2 + 6.25)
    assert s.rms_curvature**2 == pytest.approx(3 + 8 + 156.25)


def test_density_of_shells_holds_their_variance():
    rng = np.random.default_rng(1)
    q, variance = np.cumsum(rng.uniform(0.5, 2, 7)) + 1, rng.uniform(0.1, 1, 7)
    s = Shells(q, variance)
    at = np.linspace(0, q[-1] + 2, 400001)
    total = integrate.trapezoid(2 * np.pi * at * s.psd(at), at)
    # steps of C on a grid: first order, 4e5 points
    assert total == pytest.approx(variance.sum(), rel=1e-4)


def test_shells_leave_out_empty_ones_and_truncate():
    s = Shells([1.0, 2.0, 3.0], [1.0, 0.0, 0.5])
    np.testing.assert_array_equal(s.q, [1, 3])
    assert s.truncated(2.5).variance.sum() == 1.0
    # a cut at a shell keeps it whatever the last bit says
    assert s.truncated(3.0 * (1 - 1e-15)).q1 == 3.0


def test_elastic_energy():
    # one wave of amplitude a under full contact: E* k a^2/8 (U = E* q <h^2>/4)
    a, k = 0.3, 5.0
    assert Shells([k], [a**2 / 2]).elastic_energy() == pytest.approx(k * a**2 / 8)
    s = SelfAffine(hurst=0.8, q0=1.0, q1=64.0, C0=1.0)
    want = np.pi / 2 * (1 - 64**-0.6) / 0.6  # (pi/2) int q^(2 - 3.6) dq
    assert s.elastic_energy() == pytest.approx(want, rel=1e-12)


def test_spectra_are_equal_to_their_copies_and_to_no_others():
    wall = SelfAffine(hurst=0.8, q0=1.0, q1=64.0, h_rms=1.0)
    ground = SelfAffine(hurst=0.8, q0=1.0, q1=64.0, h_rms=1.0, anisotropy=4.0)
    kinds_of_spectra = [
        wall,
        ground,
        SelfAffine(hurst=0.8, q0=1.0, q1=64.0, C0=wall.C0),
        Tabulated([1.0, 2.0, 4.0], [3.0, 2.0, 1.0]),
        Tabulated([1.0, 2.0, 4.0], [3.0, 2.0, 1.5]),
        Shells([1.0, 2.0], [3.0, 2.0]),
        combine(wall, ground),
    ]
    ground.averaged()  # kept, and no part of what the spectrum is
    for i, rough in enumerate(kinds_of_spectra):
        for copied in (deepcopy(rough), pickle.loads(pickle.dumps(rough))):
            assert copied == rough
            assert hash(copied) == hash(rough)
        assert [other == rough for other in kinds_of_spectra].count(True) == 1, i
    assert wall != "wall"
