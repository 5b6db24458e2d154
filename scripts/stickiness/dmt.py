"""DMT post-processing: attraction evaluated on the gaps of a repulsive solution.

The attraction does not deform the surfaces, so every quantity is an integral over the gap
distribution P(u) of the contact without adhesion. Gaps and ranges share one unit of length,
pressures are in units of E*; areas are fractions of the nominal area.

Counting pixels and what it costs
---------------------------------
The discrete contact is made of whole pixels, and its edge lies outside the true one by some 0.15
pixels on average. That strip is missing from the attractive area at *every* range, and ranges
below the gap's climb in the first pixel, the `edge_gap`, are not seen at all. ``subpixel=True``
places the edge between the pixels and lets the gap leave it by its 3/2 law, see `subpixel`. On 133
contacts (magnification 16 to 128, p/(E* q0 h_rms) = 0.001 to 0.5) at 8 pixels per shortest
wavelength the root mean square error of the attractive area, against up to 4096 points, is at

=============== ======== ======== ======== ======== ======== =========
range/edge gap  0.03-0.1 0.1-0.3  0.3-1    1-3      3-10     10-100
=============== ======== ======== ======== ======== ======== =========
counted         65 %     51 %     33 %     15 %     6.4 %    1.9 %
sub-pixel       10 %     7 %      4 %      1.8 %    0.7 %    0.16 %
=============== ======== ======== ======== ======== ======== =========

(``benchmarks/continuum.py``; a strip added at every range, after Yastrebov et al. 2017, leaves
125, 36, 8, 2.7, 1.4 and 0.4 %). `continuum` says how large the remaining error may be.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import subpixel as edges_of_contact
from ._arguments import numbers, positive
from .subpixel import STRIP_WIDTH, boundary_strip, edge_gap, gap_and_contact

__all__ = [
    "STRIP_WIDTH",
    "AvFit",
    "adhesive_pressure",
    "attraction_of_areas",
    "attractive_area",
    "boundary_strip",
    "edge_gap",
    "fit_a_v",
    "gap_density",
    "local_exponent",
    "window_sensitivity",
]

_PER_DECADE = 64  # ranges at which a traction law is integrated over sub-pixel areas
_SMALLEST = 1e-6  # of them, over the largest gap


class HasTraction(Protocol):
    """Anything that turns a gap into a traction, see `adhesive.TractionLaw`."""

    def traction(self, gap: ArrayLike) -> NDArray:
        """Traction [E*] at `gap` [length]."""


def attractive_area(
    gap: ArrayLike,
    eps: ArrayLike,
    contact: ArrayLike | None = None,
    *,
    subpixel: bool = False,
) -> float | NDArray:
    """Fraction of the nominal area that is out of contact but within the range of attraction.

    Parameters
    ----------
    gap : (..., n, n) array
        Gap [length] of the repulsive solution; any shape without `subpixel`.
    eps : float or array
        Range(s) of attraction [length].
    contact : bool array of the gap's shape, optional
        True where the surfaces touch; by default where the gap is exactly zero. Contact points
        do not count.
    subpixel : bool
        Place the edge of contact between the pixels, and the gap beside it by the edge law (see
        the module's notes). Needs the gap's two axes, periodic.

    Returns
    -------
    float or array of the shape of `eps`
        A_ad/A_nom, the fraction with 0 < gap <= eps.

    Raises
    ------
    ValueError
        On malformed or negative gaps, or ranges that are not positive.

    Examples
    --------
    >>> float(attractive_area([[0.0, 0.1], [0.2, 0.9]], 0.2))
    0.5
    """
    if subpixel:
        return edges_of_contact.attractive_area(gap, eps, contact)
    gap, contact = gap_and_contact(gap, contact)
    (eps,) = positive(eps=eps)
    # A mask may hold gaps of rounding size on either side of zero; the open ones still count.
    gaps = np.sort(gap[~contact])
    area = np.searchsorted(gaps, eps, side="right") / gap.size
    return area if eps.ndim else float(area)


def gap_density(
    gap: ArrayLike,
    edges: ArrayLike,
    contact: ArrayLike | None = None,
    *,
    subpixel: bool = False,
) -> NDArray:
    """Probability density P(u) of the open gaps.

    Parameters
    ----------
    gap : array
        Gap [length] of the repulsive solution, any shape.
    edges : (m + 1,) array
        Increasing bin edges [length].
    contact : bool array of the gap's shape, optional
        True where the surfaces touch; by default where the gap is exactly zero.
    subpixel : bool
        Take the slope of the sub-pixel `attractive_area` instead of counting pixels.

    Returns
    -------
    (m,) array
        P [1/length] averaged over each bin. Its integral is the area fraction of the gaps
        within the edges: 1 - A_rep/A_nom once they span all of them.

    Raises
    ------
    ValueError
        On malformed or negative gaps, or edges that do not increase.
    """
    gap, contact = gap_and_contact(gap, contact)
    edges = np.asarray(edges, dtype=float)
    if edges.ndim != 1 or edges.size < 2 or not np.all(np.diff(edges) > 0):
        raise ValueError(f"edges must be an increasing sequence of at least two, got {edges!r}")
    if subpixel:
        if edges[0] < 0:
            raise ValueError(f"edges must not be negative, got {edges[0]!r}")
        from_zero = np.maximum(edges, np.finfo(float).tiny)
        return np.diff(edges_of_contact.attractive_area(gap, from_zero, contact)) / np.diff(edges)
    counts, _ = np.histogram(gap[~contact], bins=edges)
    return counts / (gap.size * np.diff(edges))


def adhesive_pressure(
    gap: ArrayLike,
    law: HasTraction,
    contact: ArrayLike | None = None,
    *,
    subpixel: bool = False,
) -> float:
    """Mean attraction p_ad [E*], the integral of sigma(u) P(u) over the open gaps.

    Parameters
    ----------
    gap : (..., n, n) array
        Gap [length] of the repulsive solution; any shape without `subpixel`.
    law : object with ``traction(gap)``
        Traction law, tension positive [E*].
    contact : bool array of the gap's shape, optional
        True where the surfaces touch; by default where the gap is exactly zero. Contact points
        carry no attraction in this bookkeeping: theirs is part of the repulsive solution.
    subpixel : bool
        Integrate the law over the sub-pixel `attractive_area`, at 64 ranges per decade.

    Returns
    -------
    float
        For the Maugis law (adhesion_length/range) times `attractive_area`.

    Raises
    ------
    ValueError
        On malformed or negative gaps.
    """
    gap, contact = gap_and_contact(gap, contact)
    if not hasattr(law, "traction"):
        raise ValueError(f"law must be a traction law such as adhesive.Maugis(...), got {law!r}")
    if not subpixel:
        return float(np.sum(law.traction(gap[~contact]))) / gap.size
    largest = float(gap[~contact].max(initial=0.0))
    if largest <= 0:
        return 0.0
    number = int(-np.log10(_SMALLEST) * _PER_DECADE)
    ranges = np.geomspace(_SMALLEST * largest, largest, number + 1)
    jump = getattr(law, "range", None)  # where a law is discontinuous it is at its range
    if jump is not None and jump <= largest:
        ranges = np.union1d(ranges, [jump])
    area = edges_of_contact.attractive_area(gap, ranges, contact)
    return float(attraction_of_areas(area, ranges, law))


def attraction_of_areas(area: ArrayLike, ranges: ArrayLike, law: HasTraction) -> NDArray:
    """Mean attraction p_ad [E*] from attractive areas, the integral of sigma over them.

    Parameters
    ----------
    area : (..., k) array
        A_ad/A_nom within each of the ranges.
    ranges : (k,) array
        Ranges [length] in increasing order, close to each other on a log scale; where the law is
        discontinuous one of them.
    law : object with ``traction(gap)``
        Traction law, tension positive [E*].

    Returns
    -------
    (...) array
        Gaps up to the smallest range count with the traction at half of it, those beyond the
        largest not at all. NaN where an area is.

    Raises
    ------
    ValueError
        If the ranges are not positive and increasing, or not one for each area.
    """
    area, (ranges,) = numbers("area", area), positive(ranges=ranges)
    if ranges.ndim != 1 or not np.all(np.diff(ranges) > 0) or area.shape[-1:] != ranges.shape:
        raise ValueError(
            "ranges must be an increasing sequence with one area each, "
            f"got shapes {ranges.shape} and {area.shape}"
        )
    middle = np.sqrt(ranges[1:] * ranges[:-1])
    within = law.traction(ranges[0] / 2) * area[..., 0]
    return within + np.diff(area) @ law.traction(middle)


def local_exponent(eps: ArrayLike, area: ArrayLike) -> NDArray:
    """Local exponent d ln A_ad/d ln eps; 2/3 where the edges alone govern the small gaps.

    Parameters
    ----------
    eps, area : (m,) arrays
        Increasing ranges [length] and attractive area fractions, m >= 3.

    Raises
    ------
    ValueError
        If the arrays do not match, are too short or not positive.
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

    Attributes
    ----------
    value : float
        Fitted a_V, dimensionless.
    standard_error : float
        Of the fit. Areas at several ranges of one surface are strongly correlated: without
        `sigma` this measures how well the 2/3 law holds inside the window, not the scatter
        between surfaces, which only several surfaces give.
    window : (float, float)
        Limits of range/h_rms.
    n_points : int
        Number of points inside the window.
    relative_residual : float
        Root mean square residual over the root mean square area.
    """

    value: float
    standard_error: float
    window: tuple[float, float]
    n_points: int
    relative_residual: float


def fit_a_v(
    eps: ArrayLike,
    area: ArrayLike,
    pressure: ArrayLike,
    h_rms: float = 1.0,
    q0: float = 1.0,
    window: tuple[float, float] = (0.01, 0.1),
    sigma: ArrayLike | None = None,
) -> AvFit:
    """Fit a_V by least squares through the origin inside a window of ranges.

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
    sigma : (m,) array, optional
        Standard deviations of `area`. They weight the points and set the standard error;
        without them the residuals do.

    Raises
    ------
    ValueError
        On mismatched shapes, values that are not positive, or fewer than two points in the
        window.

    References
    ----------
    Violano et al., J. Adhesion (2019), doi:10.1080/00218464.2019.1685384.
    """
    eps, pressure, h_rms, q0 = positive(eps=eps, pressure=pressure, h_rms=h_rms, q0=q0)
    area = np.asarray(area, dtype=float)
    if sigma is not None:
        (sigma,) = positive(sigma=sigma)
    if eps.ndim != 1 or area.shape != eps.shape or not np.all(np.isfinite(area)):
        raise ValueError(
            f"area must be finite and match eps of shape {eps.shape}, got shape {area.shape}"
        )
    for name, values in (("pressure", pressure), ("sigma", sigma)):
        if values is not None and values.ndim and values.shape != eps.shape:
            raise ValueError(f"{name} must have the shape {eps.shape} of eps, got {values.shape}")
    low, high = _window(window)

    ratio = eps / h_rms
    # A limit that went through unit conversion must still include itself.
    inside = (ratio >= low * (1 - 1e-12)) & (ratio <= high * (1 + 1e-12))
    n = int(np.count_nonzero(inside))
    if n < 2:
        raise ValueError(f"window {window!r} must hold at least two of eps/h_rms, holds {n}")
    x = (1.5 * pressure / (q0 * h_rms) * ratio ** (2 / 3))[inside]
    y = area[inside]
    weight = 1.0 if sigma is None else 1 / np.broadcast_to(sigma, eps.shape)[inside]
    (value,), *_ = np.linalg.lstsq((weight * x)[:, None], weight * y)
    residual = y - value * x
    variance = 1 / np.sum((weight * x) ** 2)
    if sigma is None:
        variance *= np.sum(residual**2) / (n - 1)
    return AvFit(
        value=float(value),
        standard_error=float(np.sqrt(variance)),
        window=(low, high),
        n_points=n,
        relative_residual=float(np.sqrt(np.mean(residual**2) / np.mean(y**2))) if y.any() else 0.0,
    )


def window_sensitivity(
    eps: ArrayLike,
    area: ArrayLike,
    pressure: ArrayLike,
    windows: Iterable[tuple[float, float]],
    h_rms: float = 1.0,
    q0: float = 1.0,
    sigma: ArrayLike | None = None,
) -> tuple[AvFit, ...]:
    """Fit a_V in each of several windows; see `fit_a_v` for the parameters."""
    return tuple(fit_a_v(eps, area, pressure, h_rms, q0, window, sigma) for window in windows)


def _window(window: tuple[float, float]) -> tuple[float, float]:
    low, high = (float(limit) for limit in window)
    if not 0 <= low < high:
        raise ValueError(f"window must be two increasing limits of eps/h_rms, got {window!r}")
    return low, high
