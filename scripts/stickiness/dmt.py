"""Adhesion in the DMT limit, from the gaps of a repulsive solution, and the fit of a_V to it.

The attraction does not deform the surfaces: every quantity is an integral over the gap distribution
P(u) of the contact without adhesion. Gaps and ranges share one unit of length, pressures are in
units of E*, areas are fractions of the nominal area. Malformed arguments, negative gaps among them,
raise a ValueError.
"""

from __future__ import annotations

from importlib import import_module

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import numbers, positive
from stickiness.repulsive import subpixel as subpixel_edges
from stickiness.repulsive.subpixel import STRIP_WIDTH, boundary_strip, edge_gap, gap_and_contact
from stickiness.traction_laws import TractionLaw, check_law

_FIT = ("AvFit", "fit_a_v", "local_exponent")

__all__ = [  # noqa: PLE0604
    "STRIP_WIDTH",
    "adhesive_pressure",
    "attraction_of_areas",
    "attractive_area",
    "boundary_strip",
    "edge_gap",
    *_FIT,
]


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
        `repulsive.subpixel`). Needs the gap's two axes, periodic. Counting whole pixels misses a
        strip of 0.15 pixels along the edge at every range, and all ranges below the `edge_gap`. At
        8 pixels per shortest wavelength the edge law leaves errors of 10 % at a tenth of the edge
        gap, 4 % below it, 1.8 % up to 3 and 0.2 % beyond 10 times it (33, 15 and 2 % by counting).

    Returns
    -------
    float or array of the shape of `eps`
        A_ad/A_nom, the fraction with 0 < gap <= eps, contact points excluded.

    Examples
    --------
    >>> float(attractive_area([[0.0, 0.1], [0.2, 0.9]], 0.2))
    0.5
    """
    if subpixel:
        return subpixel_edges.attractive_area(gap, eps, contact)
    gap, contact = gap_and_contact(gap, contact)
    (eps,) = positive(eps=eps)
    # A mask may hold gaps of rounding size on either side of zero; the open ones still count.
    gaps = np.sort(gap[~contact])
    area = np.searchsorted(gaps, eps, side="right") / gap.size
    return area if eps.ndim else float(area)


def adhesive_pressure(gap: ArrayLike, law: TractionLaw, contact: ArrayLike | None = None) -> float:
    """Mean attraction p_ad [E*], the integral of sigma(u) P(u) over the open gaps.

    For the Maugis law (adhesion_length/range) times `attractive_area`, whose `gap` and `contact`
    these are. Contact points carry no attraction in this bookkeeping: theirs is part of the
    repulsive solution.
    """
    gap, contact = gap_and_contact(gap, contact)
    check_law(law)
    return float(np.sum(law.traction(gap[~contact]))) / gap.size


def attraction_of_areas(area: ArrayLike, ranges: ArrayLike, law: TractionLaw) -> NDArray:
    """Mean attraction p_ad [E*] from attractive areas, the integral of sigma over them.

    Gaps up to the smallest range count with the traction at half of it, those beyond the largest
    not at all. NaN where an area is.

    Parameters
    ----------
    area : (..., k) array
        A_ad/A_nom within each of the ranges.
    ranges : (k,) array
        Ranges [length] in increasing order, close to each other on a log scale; where the law is
        discontinuous one of them.
    law : TractionLaw
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


def __getattr__(name: str):
    # An import at the top would make every simulation depend on the code of the fit.
    if name in _FIT:
        return getattr(import_module("stickiness.criteria.a_v_fit"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
