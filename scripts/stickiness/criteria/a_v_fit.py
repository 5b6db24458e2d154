"""The prefactor a_V of the attractive area, fitted within an interval of ranges."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import positive


def local_exponent(eps: ArrayLike, area: ArrayLike) -> NDArray:
    """Local exponent d ln A_ad/d ln eps; 2/3 where the edges alone govern the small gaps.

    Parameters
    ----------
    eps, area : (m,) arrays
        Increasing ranges [length] and attractive area fractions, m >= 3; else a ValueError is
        raised.
    """
    eps, area = positive(eps=eps, area=area)
    if eps.ndim != 1 or eps.shape != area.shape or eps.size < 3 or not np.all(np.diff(eps) > 0):
        raise ValueError(
            "eps must be an increasing sequence of at least 3 and area match it, "
            f"got shapes {eps.shape} and {area.shape}"
        )
    return np.gradient(np.log(area), np.log(eps))


@dataclass(frozen=True)
class AvFit:
    """Prefactor a_V of A_ad/A_nom = (3/2) a_V p/(E* q0 h_rms) (range/h_rms)^(2/3).

    Areas at several ranges of one surface are strongly correlated: the standard error says how well
    the 2/3 law holds in the fit interval, not how surfaces scatter.
    """

    value: float
    standard_error: float
    window: tuple[float, float]  #: fit interval, limits of range/h_rms


def fit_a_v(
    eps: ArrayLike,
    area: ArrayLike,
    pressure: ArrayLike,
    h_rms: float = 1.0,
    q0: float = 1.0,
    window: tuple[float, float] = (0.01, 0.1),
) -> AvFit:
    """Fit a_V by least squares through the origin within an interval of ranges.

    Parameters
    ----------
    eps, area : (m,) arrays
        Ranges [length] and attractive area fractions, in any order; points of several loads or
        surfaces may be pooled.
    pressure : float or (m,) array
        Mean repulsive pressure [E*].
    h_rms, q0 : float
        Root mean square height [length] and lowest wave number [1/length].
    window : (float, float)
        Limits of eps/h_rms, both included.

    Raises
    ------
    ValueError
        On mismatched shapes, values that are not positive, or fewer than two points in the
        interval.

    References
    ----------
    Violano et al., J. Adhesion (2019), doi:10.1080/00218464.2019.1685384.
    """
    eps, pressure, height, q = positive(eps=eps, pressure=pressure, h_rms=h_rms, q0=q0)
    area = np.asarray(area, dtype=float)
    if eps.ndim != 1 or area.shape != eps.shape or not np.all(np.isfinite(area)):
        raise ValueError(
            f"area must be finite and match eps of shape {eps.shape}, got shape {area.shape}"
        )
    if pressure.ndim and pressure.shape != eps.shape:
        raise ValueError(f"pressure must have the shape {eps.shape} of eps, got {pressure.shape}")
    low, high = (float(limit) for limit in window)
    if not 0 <= low < high:
        raise ValueError(f"window must be two increasing limits of eps/h_rms, got {window!r}")

    ratio = eps / height
    # A limit that went through unit conversion must still include itself.
    inside = (ratio >= low * (1 - 1e-12)) & (ratio <= high * (1 + 1e-12))
    n = int(np.count_nonzero(inside))
    if n < 2:
        raise ValueError(f"window {window!r} must hold at least two of eps/h_rms, holds {n}")
    # The law is y = a_V x: least squares through the origin.
    x = (1.5 * pressure / (q * height) * ratio ** (2 / 3))[inside]
    y = area[inside]
    value = np.linalg.lstsq(x[:, None], y)[0][0]
    variance = np.sum((y - value * x) ** 2) / (n - 1) * (1 / np.sum(x**2))
    return AvFit(float(value), float(np.sqrt(variance)), (low, high))
