"""Area-load relation of an adhesive contact in the DMT limit.

Attraction is proportional to repulsion whatever the load; all that follows rearranges this ratio,
see `traction_ratio`. Lengths are in one unit, wave numbers in its inverse, l_a = (work of
adhesion)/E*. Arguments broadcast; ValueError if a length, a wave number or a_V is not positive.
Source: Violano, Afferrante, Papangelo & Ciavarella, J. Adhesion (2019),
doi:10.1080/00218464.2019.1685384.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import finite, plain, positive

JTB_CONSTANT = 4 / 75


def traction_ratio(
    h_rms: ArrayLike, q0: ArrayLike, adhesion_length: ArrayLike, range: ArrayLike, a_v: ArrayLike
) -> float | NDArray:
    """Ratio p_ad/p_rep of attraction to repulsion in the DMT limit, independent of the load.

    (3 a_V/2) (l_a/range) (range/h_rms)^(2/3)/(q0 h_rms); the contact is sticky above 1.

    Parameters
    ----------
    h_rms, q0 : array_like
        Root mean square height [length] and lowest wave number of the roughness [1/length].
    adhesion_length, range : array_like
        Work of adhesion over E* and range of attraction [length].
    a_v : array_like
        Prefactor of the attractive area, see `dmt.fit_a_v`.
    """
    h_rms, q0, adhesion_length, range, a_v = positive(
        h_rms=h_rms, q0=q0, adhesion_length=adhesion_length, range=range, a_v=a_v
    )
    ratio = 1.5 * a_v * (adhesion_length / range) * (range / h_rms) ** (2 / 3) / (q0 * h_rms)
    return plain(ratio)


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
    (kappa_rep,) = positive(kappa_rep=kappa_rep)
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


def h_rms_limit(
    q0: ArrayLike, adhesion_length: ArrayLike, range: ArrayLike, a_v: ArrayLike
) -> float | NDArray:
    """Largest h_rms [length] that sticks: range [(3 a_V/2) (l_a/range)/(range q0)]^(3/5).

    Parameters as in `traction_ratio`.
    """
    q0, adhesion_length, range, a_v = positive(
        q0=q0, adhesion_length=adhesion_length, range=range, a_v=a_v
    )
    return plain(range * (1.5 * a_v * (adhesion_length / range) / (range * q0)) ** 0.6)


def modulus_threshold(
    h_rms: ArrayLike, q0: ArrayLike, work_of_adhesion: ArrayLike, range: ArrayLike, a_v: ArrayLike
) -> float | NDArray:
    """Plane-strain modulus E* [Pa] below which the contact is sticky; all arguments in SI.

    (3 a_V/2) (work_of_adhesion/range) (range/h_rms)^(2/3)/(q0 h_rms).
    """
    (work_of_adhesion,) = positive(work_of_adhesion=work_of_adhesion)
    return plain(traction_ratio(h_rms, q0, work_of_adhesion, range, a_v))


def jtb_limit(q0: ArrayLike, adhesion_length: ArrayLike, range: ArrayLike) -> float | NDArray:
    """Smallest h_rms [length] at which the DMT assumption holds.

    h_rms/range > (4/75) (l_a/range)/(range q0), drawn by Violano et al. (2019) from the
    hysteresis limit of Joe, Thouless & Barber (J. Mech. Phys. Solids 118, 365, 2018).
    """
    q0, adhesion_length, range = positive(q0=q0, adhesion_length=adhesion_length, range=range)
    return plain(JTB_CONSTANT * (adhesion_length / range) / q0)
