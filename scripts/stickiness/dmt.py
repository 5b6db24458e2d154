"""Adhesion from the gaps of contact without it: DMT sum, weak limit, and the fit of a_V.

Every quantity is an integral over the gap distribution P(u) of the contact without adhesion. Weak
adhesion tends to `weak_attraction` and not to the sum of tractions (DMT sum). Gaps and ranges share
one unit of length, pressures are in units of E*, areas are fractions of the nominal area. Malformed
arguments, negative gaps among them, raise a ValueError.
"""

from __future__ import annotations

from collections.abc import Callable
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
    "attractive_area",
    "boundary_strip",
    "edge_gap",
    "sum_over_gaps",
    "weak_attraction",
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


def sum_over_gaps(area: ArrayLike, ranges: ArrayLike, function: Callable) -> NDArray:
    """Mean of a function of the gap over the open gaps, from attractive areas.

    Gaps up to the smallest range count with the function at half of it, those beyond the largest
    not at all. NaN where an area is.

    Parameters
    ----------
    area : (..., k) array
        A_ad/A_nom within each of the ranges.
    ranges : (k,) array
        Ranges [length] in increasing order, close to each other on a log scale; where the function
        is discontinuous one of them.
    function : callable
        ``law.traction`` gives the mean attraction p_ad [E*], ``law.potential`` the mean potential.
    """
    area = numbers("area", area)
    (ranges,) = positive(ranges=ranges)
    if ranges.ndim != 1 or not np.all(np.diff(ranges) > 0) or area.shape[-1:] != ranges.shape:
        raise ValueError(
            "ranges must be an increasing sequence with one area each, "
            f"got shapes {ranges.shape} and {area.shape}"
        )
    middle = np.sqrt(ranges[1:] * ranges[:-1])
    return function(ranges[0] / 2) * area[..., 0] + np.diff(area) @ function(middle)


def weak_attraction(pressure: ArrayLike, mean_gap: ArrayLike, potential: ArrayLike) -> NDArray:
    """Attraction [E*] to first order in the work of adhesion, at given mean gaps.

    That is the pressure without adhesion less the pressure with it. The energy of contact is
    stationary: to first order it changes by the mean potential of the gaps without adhesion, and
    the pressure by the slope of this potential against the mean gap (Feynman 1939,
    doi:10.1103/PhysRev.56.340). At a given pressure the mean gap falls by the slope of the same
    potential against the pressure. What adhesion adds to the area does not follow from these gaps.

    Parameters
    ----------
    pressure : (k,) array
        Mean pressures [E*] of three or more contacts without adhesion, increasing.
    mean_gap, potential : (..., k) arrays
        Their mean gaps [length] and their means of ``law.potential`` [length], contact points at
        gap 0 included. The law must have a hard wall.

    Returns
    -------
    array of the shape of `potential`, NaN where an argument is
        From logarithmic slopes between neighbours. Means over four surfaces have errors of 3 % if
        loads differ by a factor of 2, 6 % for 5 and 10 % for 9; one surface has 10 % for 2.
    """
    (pressure,) = positive(pressure=pressure)
    gap = numbers("mean_gap", mean_gap)
    potential = numbers("potential", potential)
    if pressure.ndim != 1 or pressure.size < 3 or not np.all(np.diff(pressure) > 0):
        raise ValueError(f"pressure must be three or more increasing numbers, got {pressure!r}")
    if not gap.shape[-1:] == potential.shape[-1:] == pressure.shape or np.any(potential >= 0):
        message = "mean_gap and potential must have a value, potential a negative one, for each of"
        raise ValueError(f"{message} {pressure.size} pressures, got {mean_gap!r} and {potential!r}")
    if np.any(np.diff(gap) >= 0):
        raise ValueError(f"mean_gap must fall as the pressure rises, got {mean_gap!r}")
    # dPhi/du by the chain rule, from slopes against the logarithm of the pressure.
    logs = np.log(pressure)
    growth = np.gradient(np.log(-potential), logs, axis=-1, edge_order=2)
    closing = np.gradient(gap, logs, axis=-1, edge_order=2)
    return potential * growth / closing


def __getattr__(name: str):
    # An import at the top would make every simulation depend on the code of the fit.
    if name in _FIT:
        return getattr(import_module("stickiness.criteria.a_v_fit"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
