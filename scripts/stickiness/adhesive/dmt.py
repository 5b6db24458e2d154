"""DMT post-processing: attraction evaluated on the gaps of a repulsive solution.

The attraction does not deform the surfaces, so every quantity is an integral over the gap
distribution P(u) of the contact without adhesion. Gaps and ranges share one unit of length,
pressures are in units of E*; areas are fractions of the nominal area.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.adhesive.laws import TractionLaw
from stickiness.arguments import numbers, positive
from stickiness.repulsive import subpixel as edges_of_contact
from stickiness.repulsive.subpixel import gap_and_contact

_PER_DECADE = 64  # ranges at which a traction law is integrated over sub-pixel areas
_SMALLEST = 1e-6  # of them, over the largest gap


def adhesive_pressure(
    gap: ArrayLike, law: TractionLaw, contact: ArrayLike | None = None, *, subpixel: bool = False
) -> float:
    """Mean attraction p_ad [E*], the integral of sigma(u) P(u) over the open gaps.

    For the Maugis law (adhesion_length/range) times `attractive_area`. Contact points carry no
    attraction in this bookkeeping: theirs is part of the repulsive solution.

    Parameters
    ----------
    gap : (..., n, n) array
        Gap [length] of the repulsive solution; any shape without `subpixel`.
    law : object with ``traction(gap)``
        Traction law, tension positive [E*].
    contact : bool array of the gap's shape, optional
        True where the surfaces touch; by default where the gap is exactly zero.
    subpixel : bool
        Integrate the law over the sub-pixel `attractive_area`, at 64 ranges per decade.

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
    law : object with ``traction(gap)``
        Traction law, tension positive [E*].

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
