"""Gaps of a repulsive solution: the area within a range of the wall, and the distribution P(u).

Gaps and ranges share one unit of length; areas are fractions of the nominal area.

The discrete contact is made of whole pixels, and its edge lies some 0.15 pixels outside the true
one. Counting pixels misses that strip of the attractive area at *every* range. Ranges below the gap
that one pixel spans at the edge, the `edge_gap`, are not seen at all. ``subpixel=True`` places the
edge between the pixels, with a gap that grows from it by the 3/2 law (see `subpixel`). On 133
contacts (magnification 16 to 128, p/(E* q0 h_rms) = 0.001 to 0.5) at 8 pixels per shortest
wavelength the rms error of the attractive area, against up to 4096 points, is at

=============== ======== ======== ======== ======== ======== =========
range/edge gap  0.03-0.1 0.1-0.3  0.3-1    1-3      3-10     10-100
counted         65 %     51 %     33 %     15 %     6.4 %    1.9 %
sub-pixel       10 %     7 %      4 %      1.8 %    0.7 %    0.16 %
=============== ======== ======== ======== ======== ======== =========

(``benchmarks/continuum.py``; a strip added at every range, after Yastrebov et al. 2017, leaves
125, 36, 8, 2.7, 1.4 and 0.4 %). `grid_limit` says how large the remaining error may be.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import positive
from stickiness.repulsive import subpixel as edges_of_contact
from stickiness.repulsive.subpixel import gap_and_contact


def attractive_area(
    gap: ArrayLike, eps: ArrayLike, contact: ArrayLike | None = None, *, subpixel: bool = False
) -> float | NDArray:
    """Fraction of the nominal area that is out of contact but within the range of attraction.

    Parameters
    ----------
    gap : (..., n, n) array
        Gap [length] of the repulsive solution; any shape without `subpixel`.
    eps : float or array
        Range(s) of attraction [length].
    contact : bool array of the gap's shape, optional
        True where the surfaces touch; by default where the gap is exactly zero.
    subpixel : bool
        Place the edge of contact between the pixels, and the gap beside it by the edge law (see
        the module's notes). Needs the gap's two axes, periodic.

    Returns
    -------
    float or array of the shape of `eps`
        A_ad/A_nom, the fraction with 0 < gap <= eps, contact points excluded.

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
    gap: ArrayLike, edges: ArrayLike, contact: ArrayLike | None = None, *, subpixel: bool = False
) -> NDArray:
    """Probability density P(u) [1/length] of the open gaps, averaged over each bin, ``(m,)``.

    Its integral is the area fraction of the gaps within the edges: 1 - A_rep/A_nom once they span
    all of them.

    Parameters
    ----------
    gap, contact
        As for `attractive_area`.
    edges : (m + 1,) array
        Increasing bin edges [length].
    subpixel : bool
        Take the slope of the sub-pixel `attractive_area` instead of counting pixels.

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
