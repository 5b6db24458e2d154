"""Stickiness criteria, which say whether a rough contact sustains tension.

Every length is in one unit of the caller's choice, wave numbers in its inverse; the adhesion
length is l_a = (work of adhesion)/E*. Arguments broadcast as numpy arrays do. A `Verdict` has a
margin, the ratio of the criterion's threshold to the actual value in the form the criterion is
usually written in: above 1 means sticky. Margins of different criteria are different powers of the
same physics: compare only on which side of 1 they lie.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import minimize_scalar
from scipy.special import ndtr

from stickiness.arguments import plain, positive
from stickiness.criteria.area_load import (  # noqa: F401
    h_rms_limit,
    inverse_kappa,
    inverse_kappa_ad,
    jtb_limit,
    modulus_threshold,
    slope_angle,
    traction_ratio,
)
from stickiness.spectrum.kinds import Spectrum

__all__ = [  # noqa: PLE0604
    *("CRYSTAL_RANGE_RATIO", "DAHLQUIST_LIMIT", "PRINTED_A_V", "PR_CONSTANT", "DmtValidity"),
    *("Verdict", "bearing_area", "dahlquist", "dmt_validity"),
    *("fuller_tabor", "h_rms_limit", "inverse_kappa", "inverse_kappa_ad", "jtb_limit"),
    *("modulus_threshold", "pastewka_robbins", "pastewka_robbins_a_v"),
    *("pastewka_robbins_a_v_power_law", "persson_tosatti", "slope_angle"),
    *("traction_ratio", "violano", "violano_printed"),
]

PRINTED_A_V = 1.5  #: the coefficient 9/4 printed in the paper is (3/2) a_V with this a_V
PR_CONSTANT = np.pi * (3 / 16) ** (2 / 3)  #: Pastewka & Robbins (2014), 1.03
DAHLQUIST_LIMIT = 1e6  #: Pa
_GAUSS_NODES, _GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(8)
CRYSTAL_RANGE_RATIO = float(np.sqrt(24 * 0.05))  #: Delta_r/range at l_a = 0.05 range


@dataclass(frozen=True)
class Verdict:
    """Answer of one criterion."""

    name: str  #: of the criterion
    sticky: bool | NDArray  #: whether the contact sustains tension, ``margin > 1``
    #: threshold over actual value; how the ratio is formed is in the criterion's docstring
    margin: float | NDArray


@dataclass(frozen=True)
class DmtValidity:
    """Whether adhesion is weak enough for the repulsive gaps to describe the attraction."""

    valid: bool | NDArray  #: whether ``margin > 1``
    margin: float | NDArray  #: h_rms over its lower limit `jtb_limit`


def _verdict(name: str, margin: ArrayLike) -> Verdict:
    margin = np.asarray(margin, dtype=float)
    return Verdict(name, plain(margin > 1), plain(margin))


def violano(
    h_rms: ArrayLike, q0: ArrayLike, adhesion_length: ArrayLike, range: ArrayLike, a_v: ArrayLike
) -> Verdict:
    """Violano et al. (2019): sticky when h_rms/range < [(3 a_V/2)(l_a/range)/(range q0)]^(3/5).

    The margin is `h_rms_limit` over h_rms. Parameters as in `traction_ratio`. The criterion
    rests on DMT gaps; `dmt_validity` tells where these hold.

    Examples
    --------
    >>> violano(h_rms=100.0, q0=1e-6, adhesion_length=0.05, range=1.0, a_v=3.0).sticky
    True
    """
    (h,) = positive(h_rms=h_rms)
    return _verdict("violano", h_rms_limit(q0, adhesion_length, range, a_v) / h)


def violano_printed(
    h_rms: ArrayLike, q0: ArrayLike, adhesion_length: ArrayLike, range: ArrayLike
) -> Verdict:
    """`violano` with the coefficient 9/4 as printed, that is with a_V = 3/2."""
    (h,) = positive(h_rms=h_rms)
    return _verdict("violano_printed", h_rms_limit(q0, adhesion_length, range, PRINTED_A_V) / h)


def dmt_validity(
    h_rms: ArrayLike, q0: ArrayLike, adhesion_length: ArrayLike, range: ArrayLike
) -> DmtValidity:
    """Whether h_rms exceeds `jtb_limit`, so that the repulsive gaps describe the attraction."""
    (h,) = positive(h_rms=h_rms)
    margin = h / jtb_limit(q0, adhesion_length, range)
    return DmtValidity(plain(margin > 1), plain(margin))


def pastewka_robbins(
    rms_slope: ArrayLike,
    rms_curvature: ArrayLike,
    adhesion_length: ArrayLike,
    range: ArrayLike,
    interaction_range: ArrayLike | None = None,
) -> Verdict:
    """Pastewka & Robbins (2014), on the small-scale roughness alone.

    Sticky when (h' Delta_r/2 l_a) (h' d_rep/4 Delta_r)^(2/3) < pi (3/16)^(2/3), with d_rep = 4
    h'/h''. The margin is the right over the left side.

    Parameters
    ----------
    rms_slope, rms_curvature : array_like
        Root mean square gradient h' [1] and Laplacian h'' [1/length].
    adhesion_length, range : array_like
        As in `traction_ratio`.
    interaction_range : array_like, optional
        Width Delta_r of the attraction [length]; by default sqrt(24 l_a range), as Violano et al.
        (2019) state it. For soft solids that grows far beyond the range.

    References
    ----------
    Pastewka & Robbins, PNAS 111, 3298 (2014), doi:10.1073/pnas.1320846111.
    """
    slope, curvature, adhesion_length, range = positive(
        rms_slope=rms_slope,
        rms_curvature=rms_curvature,
        adhesion_length=adhesion_length,
        range=range,
    )
    if interaction_range is None:
        interaction_range = np.sqrt(24 * adhesion_length * range)
    (delta,) = positive(interaction_range=interaction_range)
    diameter = 4 * slope / curvature
    actual = slope * delta / (2 * adhesion_length) * (slope * diameter / (4 * delta)) ** (2 / 3)
    return _verdict("pastewka_robbins", PR_CONSTANT / actual)


def pastewka_robbins_a_v(
    q0: ArrayLike,
    h_rms: ArrayLike,
    rms_slope: ArrayLike,
    rms_curvature: ArrayLike,
    range_ratio: ArrayLike = CRYSTAL_RANGE_RATIO,
) -> float | NDArray:
    """Return a_V of the attractive area that Pastewka & Robbins assume.

    (4 pi/3) (3/16)^(2/3) (Delta_r/range)^(2/3) q0 h_rms^(5/3) (h''^2/h'^7)^(1/3), with the
    arguments of `pastewka_robbins` and `range_ratio` = Delta_r/range, by default for l_a = 0.05
    range. With it over `range_ratio`, `violano` reproduces the verdict of `pastewka_robbins`.
    """
    q0, h, slope, curvature, ratio = positive(
        q0=q0,
        h_rms=h_rms,
        rms_slope=rms_slope,
        rms_curvature=rms_curvature,
        range_ratio=range_ratio,
    )
    shape = (curvature**2 / slope**7) ** (1 / 3)
    return plain(4 / 3 * PR_CONSTANT * ratio ** (2 / 3) * q0 * h ** (5 / 3) * shape)


def pastewka_robbins_a_v_power_law(
    hurst: ArrayLike, magnification: ArrayLike, range_ratio: ArrayLike = CRYSTAL_RANGE_RATIO
) -> float | NDArray:
    """`pastewka_robbins_a_v` of a broad power law, proportional to zeta^((5H - 3)/3).

    h'^2 = H/(1-H) (q0 h_rms)^2 zeta^(2-2H) and h''^2 = H/(2-H) (q0^2 h_rms)^2 zeta^(4-2H)
    inserted, which is the limit zeta >> 1 for H < 1.
    """
    hurst, magnification = positive(hurst=hurst, magnification=magnification)
    if not np.all(hurst < 1):
        raise ValueError(f"hurst must be below 1 for this limit, got {hurst!r}")
    if not np.all(magnification >= 1):
        raise ValueError(f"magnification must be at least 1, got {magnification!r}")
    slope = np.sqrt(hurst / (1 - hurst)) * magnification ** (1 - hurst)
    curvature = np.sqrt(hurst / (2 - hurst)) * magnification ** (2 - hurst)
    return pastewka_robbins_a_v(1.0, 1.0, slope, curvature, range_ratio)


def fuller_tabor(
    h_rms: ArrayLike,
    rms_curvature: ArrayLike,
    adhesion_length: ArrayLike,
    radius: ArrayLike | None = None,
) -> Verdict:
    """Fuller & Tabor (1975): sticky when theta = h_rms^(3/2)/(R^(1/2) l_a) is below 10.

    The margin is 10 over theta: at 10 the pull-off force has practically gone.

    Parameters
    ----------
    h_rms, rms_curvature, adhesion_length : array_like
        Root mean square height [length] and Laplacian h'' [1/length]; work of adhesion over E*
        [length].
    radius : array_like, optional
        Summit radius R [length], originally that of equal spheres. Default: 2/h'', the radius of
        the paraboloid whose Laplacian is the root mean square one. Nayak's mean summit curvature
        (8/3) sqrt(m4/pi) gives 1.085/h'', a theta larger by 1.36.

    References
    ----------
    Fuller & Tabor, Proc. R. Soc. A 345, 327 (1975), doi:10.1098/rspa.1975.0138.
    """
    h, curvature, length = positive(
        h_rms=h_rms, rms_curvature=rms_curvature, adhesion_length=adhesion_length
    )
    (radius,) = positive(radius=2 / curvature if radius is None else radius)
    return _verdict("fuller_tabor", 10.0 * np.sqrt(radius) * length / h**1.5)


def bearing_area(
    h_rms: ArrayLike, q0: ArrayLike, adhesion_length: ArrayLike, range: ArrayLike
) -> Verdict:
    """Bearing-area model (BAM, Ciavarella 2018).

    Repulsion p_rep = E* q0 h_rms exp(-2 u/h_rms) at the mean gap u, attraction (l_a/range) times
    the fraction of Gaussian heights between u - range and u. Sticky when the total is tensile at
    some u. The margin is the largest p_ad/p_rep over u; for range << h_rms it is e^2/sqrt(2 pi)
    l_a/(q0 h_rms^2). Later forms of the model multiply the repulsion by 3/4, after Papangelo,
    Hoffmann & Ciavarella (Sci. Rep. 7, 6900, 2017). Parameters as in `traction_ratio`.

    References
    ----------
    Ciavarella, Meccanica 53, 241 (2018), doi:10.1007/s11012-017-0701-6.
    """
    h, q0, adhesion_length, range = positive(
        h_rms=h_rms, q0=q0, adhesion_length=adhesion_length, range=range
    )
    scale = np.log(adhesion_length / range / (q0 * h))
    # Ranges of hundreds of h_rms stick without bound; the infinite margin says so.
    with np.errstate(over="ignore"):
        return _verdict("bearing_area", np.exp(scale + _log_maximum(range / h)))


def _bearing_fraction(x: float, width: float) -> float:
    """Fraction of standard normal heights in (x - width, x), without cancellation."""
    if width > 0.5:
        return float(ndtr(width - x) - ndtr(-x))
    z = x - width / 2 * (1 - _GAUSS_NODES)
    density = np.exp(-(z**2) / 2) / np.sqrt(2 * np.pi)
    return float(width / 2 * np.sum(_GAUSS_WEIGHTS * density))


@np.vectorize
def _log_maximum(width: float) -> float:
    """Maximum over x of 2 x + ln(fraction of normal heights in (x - width, x)).

    The fraction is log-concave, and the slope 2 - E[z | x - width < z < x] changes sign between
    x = 2 and x = 2 + width: one maximum, bracketed.
    """
    found = minimize_scalar(
        lambda x: -2 * x - np.log(_bearing_fraction(x, width)),
        bounds=(2.0, 2.0 + width),
        method="bounded",
        options={"xatol": 1e-9},
    )
    return -float(found.fun)


def persson_tosatti(elastic_energy: ArrayLike | Spectrum, adhesion_length: ArrayLike) -> Verdict:
    """Persson & Tosatti (2001): sticky when adhesion pays for full contact.

    The margin is l_a over the elastic energy of full contact per nominal area over E* [length],
    (pi/2) int q^2 C dq, which may be given by its spectrum.

    References
    ----------
    Persson & Tosatti, J. Chem. Phys. 115, 5597 (2001), doi:10.1063/1.1398300.
    """
    if hasattr(elastic_energy, "elastic_energy"):
        elastic_energy = elastic_energy.elastic_energy()
    energy, length = positive(elastic_energy=elastic_energy, adhesion_length=adhesion_length)
    return _verdict("persson_tosatti", length / energy)


def dahlquist(modulus_pa: ArrayLike) -> Verdict:
    """Dahlquist's empirical rule: sticky when the modulus [Pa] is below about 1 MPa.

    The margin is limit over modulus. Forms of the rule for adhesive tapes ask 0.1 to 0.3 MPa
    (Creton 2003, doi:10.1557/mrs2003.124).
    """
    (modulus,) = positive(modulus_pa=modulus_pa)
    return _verdict("dahlquist", DAHLQUIST_LIMIT / modulus)
