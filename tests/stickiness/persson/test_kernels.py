"""Corrections of Persson's theory, and how it scales where the surface is a fractal."""

import numpy as np
import pytest
from scipy import integrate, interpolate, optimize, special

from stickiness.persson import Persson
from stickiness.persson.kernels import EvenTable, correction_of
from stickiness.spectrum import SelfAffine, Shells

CORRECTIONS = ("yang2008", "wang2017", "xu2024")


def power_law(magnification=1000.0, hurst=0.8):
    return SelfAffine(hurst=hurst, q0=1.0, q1=magnification, h_rms=1.0)


@pytest.mark.parametrize("name", CORRECTIONS)
@pytest.mark.parametrize("gamma", [None, 0.3, 0.8])
def test_energy_kernel_is_the_derivative_of_the_energy(name, gamma):
    c = correction_of(name, gamma)
    y = np.array([0.02, 0.4, 1.0, 2.2])
    step = 1e-5 * y
    energy = [special.erf(t) * c.diffusion(t) for t in (y - step, y + step)]
    slope = (energy[1] - energy[0]) / (special.erf(y + step) - special.erf(y - step))
    # central differences of relative step 1e-5: their own error and rounding, 1e-10 each
    np.testing.assert_allclose(c.energy(y), slope, rtol=1e-8)


def test_area_of_the_closed_form():
    s, gamma = power_law(100.0), 0.42
    # Xu et al. 2024: A = erf(p/sqrt(2 [gamma + (1 - gamma) A] V)), V = m2/2
    p = np.array([1e-8, 1e-3, 0.3, 3.0])
    variance = s.moment(2) / 2

    def excess(area, load):
        return area - special.erf(load / np.sqrt(2 * (gamma + (1 - gamma) * area) * variance))

    want = [optimize.brentq(excess, 1e-12, 1, args=(x,), xtol=1e-22, rtol=1e-14) for x in p]
    area = Persson(s, gamma=gamma, correction="xu2024").area_fraction(p)
    np.testing.assert_allclose(area, want, rtol=1e-10)


def test_area_of_wang_and_mueser_step_by_step():
    s, gamma, p = power_law(100.0), 5 / 9, 0.2
    end = s.moment(2) / 2
    start = p**2 / 80  # where erf is still 1

    def diffusion(_, v):
        area = special.erf(p / np.sqrt(2 * v))
        return gamma - 2 / 9 * area**2 + (11 / 9 - gamma) * area**4

    grown = integrate.solve_ivp(
        diffusion, (start, end), [start], method="DOP853", rtol=1e-12, atol=0.0
    )
    want = special.erf(p / np.sqrt(2 * grown.y[0, -1]))
    assert Persson(s, correction="wang2017").area_fraction(p) == pytest.approx(want, rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "gamma"), [(name, None) for name in CORRECTIONS] + [("yang2008", 0.3), ("yang2008", 1)]
)
@pytest.mark.parametrize(
    "spectrum",
    [
        power_law(50.0),
        power_law(50.0, hurst=1.0),
        SelfAffine(hurst=0.3, q0=1.0, q1=1e4, h_rms=1.0, q_rolloff=20.0),
        SelfAffine(hurst=0.8, q0=1.0, q1=16.0, h_rms=1.0, anisotropy=6.0),
        Shells([1.0, 3.0, 4.0], [1.0, 0.2, 0.1]),
    ],
)
def test_work_of_squeezing_is_the_elastic_energy_of_full_contact(name, gamma, spectrum):
    # The correction delays the energy of partial contact; all of it is stored in the end.
    theory = Persson(spectrum, gamma=gamma, correction=name)
    top = 30 * spectrum.rms_slope
    log_p = np.linspace(np.log(1e-12 * top), np.log(top), 4001)
    p = np.exp(log_p)
    work = integrate.simpson(theory.mean_gap(p) * p, x=log_p)
    # below the first pressure lies less than 1e-11 of it, the rest is Simpson's error
    assert work == pytest.approx(spectrum.elastic_energy(), rel=1e-7)


def local_exponents(values, u):
    return np.gradient(np.log(values), np.log(u))


@pytest.mark.parametrize("hurst", [0.6, 0.7, 0.8, 0.9])
def test_exponent_between_the_finest_scale_and_the_rms_height(hurst):
    """P(u) goes to u^((1 - 2H)/H), and the area within u of contact to u^((1 - H)/H).

    Contact is lost at the magnification z at gaps u1 ~ h(z) ~ z^(-H), and the area is
    A ~ z^(H - 1); so the area with gaps below u, contact included, goes as u^((1 - H)/H).
    """
    law = (1 - 2 * hurst) / hurst
    steepest = []
    for magnification in (1e4, 1e6, 1e8):
        finest = magnification**-hurst
        u = np.geomspace(3 * finest, 0.1, 120)
        theory = Persson(power_law(magnification, hurst))
        exponent = local_exponents(theory.gap_density(u, 0.065), u)
        steepest.append(exponent.min())
    distance = np.array(steepest) - law
    assert np.all(np.diff(distance) < 0)
    assert 0 < distance[-1] < 0.05
    if hurst >= 0.7:
        assert abs(steepest[-1] + 1 / 3) > 0.2  # the edges' -1/3 it is not, except at H = 0.6
    near = theory.gap_cumulative(u, 0.065) + theory.area_fraction(0.065)
    middle = (u > 30 * finest) & (u < 1e-3)
    # the same law integrated, with what the ends of the range still leave
    np.testing.assert_allclose(local_exponents(near, u)[middle], (1 - hurst) / hurst, atol=0.08)


def test_even_tables_are_hermite_splines():
    x = np.linspace(-3.0, 2.0, 41)
    at = np.append(np.linspace(-3.4, 2.4, 999), x)
    found = EvenTable(x, np.sin(x), np.cos(x))(at)
    want = interpolate.CubicHermiteSpline(x, np.sin(x), np.cos(x))(at)
    np.testing.assert_allclose(found, want, rtol=0, atol=1e-13)
