"""Stickiness criteria, which say whether a rough contact sustains tension.

Every length is in one unit of the caller's choice, wave numbers in its inverse; the adhesion
length is l_a = (work of adhesion)/E*. Arguments broadcast as numpy arrays do; ValueError if one is
not positive. A `Verdict` has a margin, the ratio of the criterion's threshold to the actual value
in the form the criterion is usually written in: above 1 means sticky. Margins of different criteria
are different powers of the same physics: compare only on which side of 1 they lie.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy  # its parts are loaded when first used, which reading a configuration does not
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import finite, plain, positive, takes_positive
from stickiness.spectrum.kinds import Spectrum

__all__ = [  # noqa: PLE0604
    *("CRYSTAL_RANGE_RATIO", "DAHLQUIST_LIMIT", "PRINTED_A_V", "PR_CONSTANT", "DmtValidity"),
    *("Verdict", "bearing_area", "dahlquist", "dmt_validity"),
    *("fuller_tabor", "h_rms_threshold", "inverse_kappa", "inverse_kappa_ad", "jtb_limit"),
    *("modulus_threshold", "pastewka_robbins", "pastewka_robbins_a_v"),
    *("pastewka_robbins_a_v_power_law", "persson_tosatti", "slope_angle"),
    *("traction_ratio", "violano", "violano_printed"),
]

PRINTED_A_V = 1.5  #: the coefficient 9/4 printed in the paper is (3/2) a_V with this a_V
PR_CONSTANT = np.pi * (3 / 16) ** (2 / 3)  #: Pastewka & Robbins (2014), 1.03
JTB_CONSTANT = 4 / 75
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


# --- Area-load relation of an adhesive contact by the DMT sum --------------------------------
# Attraction is proportional to repulsion whatever the load; all that follows rearranges the ratio.
# Source: Violano, Afferrante, Papangelo & Ciavarella, J. Adhesion (2019).


@takes_positive
def traction_ratio(
    h_rms: ArrayLike, q0: ArrayLike, adhesion_length: ArrayLike, range: ArrayLike, a_v: ArrayLike
) -> float | NDArray:
    """Ratio p_ad/p_rep of attraction to repulsion by the DMT sum, independent of the load.

    (3 a_V/2) (l_a/range) (range/h_rms)^(2/3)/(q0 h_rms); the contact is sticky above 1.

    Parameters
    ----------
    h_rms, q0 : array_like
        Root mean square height [length] and lowest wave number of the roughness [1/length].
    adhesion_length, range : array_like
        Work of adhesion over E* and range of attraction [length].
    a_v : array_like
        Prefactor of the attractive area, see `dmt.fit_a_v`.

    References
    ----------
    Violano et al., J. Adhesion (2019), doi:10.1080/00218464.2019.1685384.
    """
    ratio = 1.5 * a_v * (adhesion_length / range) * (range / h_rms) ** (2 / 3) / (q0 * h_rms)
    return plain(ratio)


@takes_positive
def inverse_kappa_ad(
    h_rms: ArrayLike,
    q0: ArrayLike,
    adhesion_length: ArrayLike,
    range: ArrayLike,
    a_v: ArrayLike,
    kappa_rep: ArrayLike = 2.0,
) -> float | NDArray:
    """Adhesive part 1/kappa_ad of the inverse area-load slope, `traction_ratio` over `kappa_rep`.

    With the paper's kappa_rep = 2 it is (3 a_V/4) (l_a/range) (range/h_rms)^(2/3)/(q0 h_rms).
    """
    return plain(traction_ratio(h_rms, q0, adhesion_length, range, a_v) / kappa_rep)


def inverse_kappa(inverse_kappa_ad: ArrayLike, kappa_rep: ArrayLike = 2.0) -> float | NDArray:
    """Inverse area-load slope 1/kappa = 1/kappa_rep - 1/kappa_ad; negative when sticky.

    kappa is the slope of A_rep/A_nom against p/(E* h'_rms), p the external pressure.
    """
    (kappa_rep,) = positive(kappa_rep=kappa_rep)
    (inverse_kappa_ad,) = finite(inverse_kappa_ad=inverse_kappa_ad)
    return plain(1 / kappa_rep - inverse_kappa_ad)


def slope_angle(inverse_kappa: ArrayLike) -> float | NDArray:
    """Angle [rad] of the area-load line against the load axis, arctan(kappa) made continuous.

    With adhesion the line turns from arctan(kappa_rep) (63 degrees for 2) through the vertical
    at the threshold (pi/2) towards the negative load axis (pi), so the angle lies in (0, pi) and
    the contact is sticky above pi/2.
    """
    (inverse_kappa,) = finite(inverse_kappa=inverse_kappa)
    return plain(np.pi / 2 - np.arctan(inverse_kappa))


@takes_positive
def h_rms_threshold(
    q0: ArrayLike, adhesion_length: ArrayLike, range: ArrayLike, a_v: ArrayLike
) -> float | NDArray:
    """Largest h_rms [length] that sticks: range [(3 a_V/2) (l_a/range)/(range q0)]^(3/5).

    Parameters as in `traction_ratio`.
    """
    return plain(range * (1.5 * a_v * (adhesion_length / range) / (range * q0)) ** 0.6)


@takes_positive
def modulus_threshold(
    h_rms: ArrayLike, q0: ArrayLike, work_of_adhesion: ArrayLike, range: ArrayLike, a_v: ArrayLike
) -> float | NDArray:
    """Plane-strain modulus E* [Pa] below which the contact is sticky; all arguments in SI.

    (3 a_V/2) (work_of_adhesion/range) (range/h_rms)^(2/3)/(q0 h_rms).
    """
    return plain(traction_ratio(h_rms, q0, work_of_adhesion, range, a_v))


@takes_positive
def jtb_limit(q0: ArrayLike, adhesion_length: ArrayLike, range: ArrayLike) -> float | NDArray:
    """Smallest h_rms [length] at which the DMT assumption holds.

    h_rms/range > (4/75) (l_a/range)/(range q0), drawn by Violano et al. (2019) from the
    hysteresis limit of Joe, Thouless & Barber (J. Mech. Phys. Solids 118, 365, 2018).
    """
    return plain(JTB_CONSTANT * (adhesion_length / range) / q0)


@takes_positive
def violano(
    h_rms: ArrayLike, q0: ArrayLike, adhesion_length: ArrayLike, range: ArrayLike, a_v: ArrayLike
) -> Verdict:
    """Violano et al. (2019): sticky when h_rms/range < [(3 a_V/2)(l_a/range)/(range q0)]^(3/5).

    The margin is `h_rms_threshold` over h_rms. Parameters as in `traction_ratio`. The criterion
    rests on DMT gaps; `dmt_validity` tells where these are valid.

    Examples
    --------
    >>> violano(h_rms=100.0, q0=1e-6, adhesion_length=0.05, range=1.0, a_v=3.0).sticky
    True
    """
    return _verdict("violano", h_rms_threshold(q0, adhesion_length, range, a_v) / h_rms)


@takes_positive
def violano_printed(
    h_rms: ArrayLike, q0: ArrayLike, adhesion_length: ArrayLike, range: ArrayLike
) -> Verdict:
    """`violano` with the coefficient 9/4 as printed, that is with a_V = 3/2."""
    limit = h_rms_threshold(q0, adhesion_length, range, PRINTED_A_V)
    return _verdict("violano_printed", limit / h_rms)


@takes_positive
def dmt_validity(
    h_rms: ArrayLike, q0: ArrayLike, adhesion_length: ArrayLike, range: ArrayLike
) -> DmtValidity:
    """Whether h_rms exceeds `jtb_limit`, so that the repulsive gaps describe the attraction."""
    margin = h_rms / jtb_limit(q0, adhesion_length, range)
    return DmtValidity(plain(margin > 1), plain(margin))


# --- Other criteria --------------------------------------------------------------------------


@takes_positive
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
    delta = interaction_range
    if delta is None:
        delta = np.sqrt(24 * adhesion_length * range)
    diameter = 4 * rms_slope / rms_curvature
    actual = rms_slope * delta / (2 * adhesion_length)
    actual = actual * (rms_slope * diameter / (4 * delta)) ** (2 / 3)
    return _verdict("pastewka_robbins", PR_CONSTANT / actual)


@takes_positive
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
    shape = (rms_curvature**2 / rms_slope**7) ** (1 / 3)
    return plain(4 / 3 * PR_CONSTANT * range_ratio ** (2 / 3) * q0 * h_rms ** (5 / 3) * shape)


@takes_positive
def pastewka_robbins_a_v_power_law(
    hurst: ArrayLike, magnification: ArrayLike, range_ratio: ArrayLike = CRYSTAL_RANGE_RATIO
) -> float | NDArray:
    """`pastewka_robbins_a_v` of a broad power law, proportional to zeta^((5H - 3)/3).

    h'^2 = H/(1-H) (q0 h_rms)^2 zeta^(2-2H) and h''^2 = H/(2-H) (q0^2 h_rms)^2 zeta^(4-2H)
    inserted, which is the limit zeta >> 1 for H < 1.
    """
    if not np.all(hurst < 1):
        raise ValueError(f"hurst must be below 1 for this limit, got {hurst!r}")
    if not np.all(magnification >= 1):
        raise ValueError(f"magnification must be at least 1, got {magnification!r}")
    slope = np.sqrt(hurst / (1 - hurst)) * magnification ** (1 - hurst)
    curvature = np.sqrt(hurst / (2 - hurst)) * magnification ** (2 - hurst)
    return pastewka_robbins_a_v(1.0, 1.0, slope, curvature, range_ratio)


@takes_positive
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
    radius = 2 / rms_curvature if radius is None else radius
    return _verdict("fuller_tabor", 10.0 * np.sqrt(radius) * adhesion_length / h_rms**1.5)


@takes_positive
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
    scale = np.log(adhesion_length / range / (q0 * h_rms))
    # Ranges of hundreds of h_rms stick without bound; the infinite margin says so.
    with np.errstate(over="ignore"):
        return _verdict("bearing_area", np.exp(scale + _log_maximum(range / h_rms)))


def _bearing_fraction(x: float, width: float) -> float:
    """Fraction of standard normal heights in (x - width, x), without cancellation."""
    if width > 0.5:
        return float(scipy.special.ndtr(width - x) - scipy.special.ndtr(-x))
    z = x - width / 2 * (1 - _GAUSS_NODES)
    density = np.exp(-(z**2) / 2) / np.sqrt(2 * np.pi)
    return float(width / 2 * np.sum(_GAUSS_WEIGHTS * density))


@np.vectorize
def _log_maximum(width: float) -> float:
    """Maximum over x of 2 x + ln(fraction of normal heights in (x - width, x)).

    The fraction is log-concave, and the slope 2 - E[z | x - width < z < x] changes sign between
    x = 2 and x = 2 + width: one maximum, bracketed.
    """
    minimum = scipy.optimize.minimize_scalar(
        lambda x: -2 * x - np.log(_bearing_fraction(x, width)),
        bounds=(2.0, 2.0 + width),
        method="bounded",
        options={"xatol": 1e-9},
    )
    return -float(minimum.fun)


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


@takes_positive
def dahlquist(modulus_pa: ArrayLike) -> Verdict:
    """Dahlquist's empirical rule: sticky when the modulus [Pa] is below about 1 MPa.

    The margin is limit over modulus. Forms of the rule for adhesive tapes ask 0.1 to 0.3 MPa
    (Creton 2003, doi:10.1557/mrs2003.124).
    """
    return _verdict("dahlquist", DAHLQUIST_LIMIT / modulus_pa)
