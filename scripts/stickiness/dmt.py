"""DMT post-processing: attraction evaluated on the gaps of a repulsive solution.

The attraction does not deform the surfaces, so every quantity is an integral over the gap
distribution P(u) of the contact without adhesion. Gaps and ranges share one unit of length,
pressures are in units of E*; areas are fractions of the nominal area.

Counting pixels and what it costs
---------------------------------
The discrete contact is made of whole pixels, and its edge lies outside the true one by some 0.15
pixels on average. That strip is missing from the attractive area at *every* range,
which makes the error of a count first order in the pixel and constant in the range. Yastrebov,
Anciaux & Molinari (2017, arXiv:1701.02727) find the width of the strip for
the contact area of rough surfaces; the same strip, moved from the contact to the attractive
area, is what ``subpixel=True`` does. For H = 0.8, a magnification of 32, p/(E* q0 h_rms) =
0.065 and 8 pixels per shortest wavelength the error of the attractive area at range/h_rms =
0.01, 0.03 and 0.1 falls from -22, -12 and -5 % to +4, +0.6 and +0.4 %; at magnification 64 the
fitted a_V on 4, 8 and 16 pixels is 2.89, 2.88 and 2.88 in place of 2.53, 2.70 and 2.79. The
strip is wholly within the range only if the range exceeds the `edge_gap`; below, the corrected
area is too large.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arguments import positive

# Width of the strip in pixels, per pixel side of boundary (Yastrebov et al. 2017).
STRIP_WIDTH = (np.pi - 1 + np.log(2)) / 24


class HasTraction(Protocol):
    """Anything that turns a gap into a traction, see `adhesive.TractionLaw`."""

    def traction(self, gap: ArrayLike) -> NDArray:
        """Traction [E*] at `gap` [length]."""


def _gap_and_contact(gap: ArrayLike, contact: ArrayLike | None) -> tuple[NDArray, NDArray]:
    gap = np.asarray(gap, dtype=float)
    if gap.size == 0 or not np.all(np.isfinite(gap)):
        raise ValueError(f"gap must be a non-empty array of finite numbers, got shape {gap.shape}")
    if contact is None:
        if gap.min() < 0:
            raise ValueError(
                f"gap must not be negative, got {gap.min()!r}; "
                "pass the contact mask of a solution that interpenetrates within its tolerance"
            )
        return gap, gap == 0
    contact = np.asarray(contact)
    if contact.shape != gap.shape or contact.dtype != bool:
        raise ValueError(
            f"contact must be a boolean array of the gap's shape {gap.shape}, "
            f"got {contact.dtype} of shape {contact.shape}"
        )
    return gap, contact


def boundary_strip(contact: ArrayLike) -> float:
    """Area fraction by which a contact made of whole pixels exceeds the true one.

    Parameters
    ----------
    contact : (..., n, n) bool array
        True where the surfaces touch; periodic in the last two axes.

    Returns
    -------
    float
        `STRIP_WIDTH` times the number of pixel sides between contact and gap, per pixel.
        Subtract it from the contact's area fraction, add it to the attractive one.

    Raises
    ------
    ValueError
        If `contact` has fewer than two dimensions.

    References
    ----------
    Yastrebov, Anciaux & Molinari, Tribol. Int. 114, 161 (2017), arXiv:1701.02727.
    """
    contact = np.asarray(contact, dtype=bool)
    if contact.ndim < 2:
        raise ValueError(f"contact must be at least two-dimensional, got shape {contact.shape}")
    sides = sum(np.count_nonzero(contact ^ np.roll(contact, 1, axis)) for axis in (-1, -2))
    return float(STRIP_WIDTH * sides / contact.size)


def edge_gap(gap: ArrayLike, contact: ArrayLike | None = None) -> float:
    """Median gap of the open pixels that share a side with the contact [length].

    The smallest range that the grid resolves: below it the attractive zone is narrower than a
    pixel and `attractive_area` a statement about the grid.

    Parameters
    ----------
    gap : (..., n, n) array
        Gap [length], periodic in the last two axes.
    contact : bool array of the same shape, optional
        True where the surfaces touch; by default where the gap is exactly zero.

    Raises
    ------
    ValueError
        On malformed arrays, or if nothing or everything touches.
    """
    gap, contact = _gap_and_contact(gap, contact)
    if gap.ndim < 2:
        raise ValueError(f"gap must be at least two-dimensional, got shape {gap.shape}")
    near = np.zeros_like(contact)
    for axis in (-1, -2):
        near |= np.roll(contact, 1, axis) | np.roll(contact, -1, axis)
    near &= ~contact
    if not near.any():
        raise ValueError("gap: the contact has no edge, it is empty or covers everything")
    return float(np.median(gap[near]))


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
        Add the strip of gap that the discrete contact covers (see the module's notes).

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
    gap, contact = _gap_and_contact(gap, contact)
    (eps,) = positive(eps=eps)
    # A mask may hold gaps of rounding size on either side of zero; the open ones still count.
    gaps = np.sort(gap[~contact])
    area = np.searchsorted(gaps, eps, side="right") / gap.size
    if subpixel:
        area = area + boundary_strip(contact)
    return area if eps.ndim else float(area)


def gap_density(gap: ArrayLike, edges: ArrayLike, contact: ArrayLike | None = None) -> NDArray:
    """Probability density P(u) of the open gaps.

    Parameters
    ----------
    gap : array
        Gap [length] of the repulsive solution, any shape.
    edges : (m + 1,) array
        Increasing bin edges [length].
    contact : bool array of the gap's shape, optional
        True where the surfaces touch; by default where the gap is exactly zero.

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
    gap, contact = _gap_and_contact(gap, contact)
    edges = np.asarray(edges, dtype=float)
    if edges.ndim != 1 or edges.size < 2 or not np.all(np.diff(edges) > 0):
        raise ValueError(f"edges must be an increasing sequence of at least two, got {edges!r}")
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
        Let the strip of gap that the discrete contact covers attract with the traction at gap
        zero. First order for laws that are finite there; without effect on Lennard-Jones.

    Returns
    -------
    float
        For the Maugis law (adhesion_length/range) times `attractive_area`.

    Raises
    ------
    ValueError
        On malformed or negative gaps.
    """
    gap, contact = _gap_and_contact(gap, contact)
    pressure = float(np.sum(law.traction(gap[~contact]))) / gap.size
    if subpixel:
        pressure += boundary_strip(contact) * float(law.traction(0.0))
    return pressure


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
