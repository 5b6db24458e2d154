"""Closed forms and limits that the components are compared with, in units of E*."""

from decimal import Decimal, localcontext
from functools import cache

import numpy as np
from scipy.integrate import quad
from scipy.special import erf, erfinv

THICK = 40.0  # thickness times wave number from which a layer is a half-space to 1e-30


def integrate_band(hurst, magnification, power):
    """Integral of x^(1 + power - 2 (1 + H)) over the band, x = q/q0 up to the magnification."""
    exponent = power - 2 * hurst
    return float(np.expm1(exponent * np.log(magnification)) / exponent)


def hertz_attraction(t):
    """Attraction on a sphere without its own effect on the gap, over that of DMT.

    Work of Hertz' pressure on an unit traction, with t the ratio of attractive to contact area.
    """
    root = np.sqrt(t)
    return float(2 / np.pi * ((1 + 1 / t) * np.arctan(root) + 1 / root))


def law_of_traction(kind, x):
    """Traction at a gap x over the range, over the work of adhesion per range."""
    if kind == "maugis":
        return np.where(x <= 1, 1.0, 0.0)
    if kind == "exponential":
        return np.exp(-x)
    return 8 / 3 * (np.exp(-3 * np.log1p(x)) - np.exp(-9 * np.log1p(x)))


_GAMMA = 0.45  # of Yang and Persson (2008)


def persson_area_error(pressure, area, m2):
    """Relative error of the variance m2 at which Persson's theory gives an area.

    The diffusion of pressure is integrated anew, with the suppression S = g + (1 - g) A^2 of Yang
    and Persson, J. Phys.: Condens. Matter 20, 215214 (2008), doi:10.1088/0953-8984/20/21/215214.
    """
    if area > 1 - 1e-9 or area < 1e-12:  # erf leaves no digits to invert
        return 0.0
    y = float(erfinv(area))
    # dV/p^2 = dy/(y^3 S); in t = ln(y'/y), from y to where the contact is full.
    scale = 2 / y**2 * quad(
        lambda t: np.exp(-2 * t) / (_GAMMA + (1 - _GAMMA) * erf(y * np.exp(t)) ** 2),
        0, 20, points=[max(np.log(1 / y), 0.1)] if y < 1 else None, limit=400, epsrel=1e-10,
    )[0]  # fmt: skip
    # Near full contact the area hardly depends on the variance: errors weigh as in the area.
    return abs(scale * pressure**2 / m2 - 1) * y * np.exp(-(y**2)) / area


@cache
def layer_response(k, poisson, backing):
    """Compliance of a layer on a rigid base over that of a half-space, at k = |q| d, in 150 digits.

    Johnson, Contact Mechanics (1985), section 5.8: the base is bonded, or slips without friction.
    """
    if k > THICK:
        return 1.0
    with localcontext(prec=150):
        x, nu = Decimal(k), Decimal(poisson)
        up, down = (2 * x).exp(), (-2 * x).exp()
        sinh, cosh = (up - down) / 2, (up + down) / 2
        if backing == "slip":
            return float((cosh - 1) / (sinh + 2 * x))
        kappa = 3 - 4 * nu
        return float((kappa * sinh - 2 * x) / (kappa * cosh + 2 * x * x + (1 + kappa * kappa) / 2))


def filter_waves(field, factor):
    """Field on a side of 2 pi with each wave multiplied by a factor of its wave number, no mean."""
    index = np.fft.fftfreq(len(field), 1 / len(field))
    q = np.hypot(index[:, None], index[None, :])
    q[0, 0] = 1.0
    waves = np.fft.fft2(field) * factor(q)
    waves[0, 0] = 0
    return np.fft.ifft2(waves).real
