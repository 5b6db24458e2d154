"""Areas of a discrete contact finer than its pixels: the edge of contact and the gap beside it.

The solution on a grid touches at whole pixels and is too large by a strip along its edge. The gap
grows from an edge as ``u = C x^(3/2)``: in ``s = u^(2/3)`` a straight line, whose slope the second
open pixel gives. The first one is where the discrete solution differs from the law; the ratio of
the two says how far the edge is. An area is the mean length of its intersections with the grid
lines along both axes (Cavalieri); on a line, s is interpolated linearly between neighbours.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import numbers, positive

#: Width by which contact is too large, in pixels per pixel side of boundary (Yastrebov, Anciaux &
#: Molinari, Tribol. Int. 114, 161, 2017, arXiv:1701.02727, with 0.118 from geometry). Measured, it
#: is 0.096 +- 0.006 on straight edges of known position (Westergaard's waves in all directions),
#: 0.095 at 64 points per wavelength on rough surfaces and 0.103 at 8, against counts of 32 and 64
#: points extrapolated linearly.
STRIP_WIDTH = 0.100

# A straight edge along a grid axis, solved on the grid (a wave of 1024 pixels): distance in
# pixels of the first open point from the true edge, against the ratio of s = u^(2/3) at the first
# and second open points. A line through the two would give ratio/(1 - ratio).
_RATIO = np.array(
    [0.0995, 0.1682, 0.2185, 0.2922, 0.3455, 0.3865, 0.4193, 0.4463, 0.4689, 0.4881, 0.5159, 0.5290]
)
_DISTANCE = np.array(
    [0.2231, 0.2675, 0.3118, 0.4006, 0.4893, 0.5781, 0.6669, 0.7558, 0.8446, 0.9335, 1.0901, 1.1788]
)
_MEAN_DISTANCE = 0.5 + 2 * STRIP_WIDTH  # of first open points, along grid lines
_LOW = 0.1  # ratio below which the first point has hardly opened
_BLOCK = 1 << 18  # points treated at a time
_LEVEL = 1e-6  # relative difference of s below which neighbours count as equal


def boundary_strip(contact: ArrayLike) -> float:
    """Area fraction by which a contact ``(..., n, n)`` of whole pixels exceeds the true one.

    `STRIP_WIDTH` times the number of pixel sides between contact and gap, per pixel, for edges
    without preferred direction. Subtract it from the contact's area fraction, add it to the
    attractive one. ValueError if `contact` is not boolean, empty, or has fewer than two dimensions.
    """
    sides = _sides(contact)
    if not sides.any():
        return 0.0
    # For sides of both directions in equal number their sum; edges along one axis only, which a
    # wave has, are displaced by twice as much per side.
    effective = 2 * np.sum(sides**2) / np.sum(sides)
    return float(STRIP_WIDTH * effective / np.size(contact))


def edge_count(contact: ArrayLike) -> int:
    """Count the pixel sides between contact and gap, periodic in the last two axes."""
    return int(_sides(contact).sum())


def edge_gap(gap: ArrayLike, contact: ArrayLike | None = None) -> float:
    """Median gap [length] of the open pixels that share a side with the contact.

    The gap's climb in the first pixel. At smaller ranges the attractive zone is narrower than a
    pixel: a count of pixels is then a statement about the grid, `attractive_area` one about the
    edge law. Arguments as of `attractive_area`; ValueError, too, if nothing or everything touches.
    """
    gap, contact = gap_and_contact(gap, contact, grid=True)
    near = np.zeros_like(contact)
    for axis in (-1, -2):
        near |= np.roll(contact, 1, axis) | np.roll(contact, -1, axis)
    near &= ~contact
    if not near.any():
        raise ValueError("gap: the contact has no edge, it is empty or covers everything")
    return float(np.median(gap[near]))


def attractive_area(
    gap: ArrayLike, eps: ArrayLike, contact: ArrayLike | None = None
) -> float | NDArray:
    """Fraction of the nominal area with 0 < gap <= eps, down to ranges far below the `edge_gap`.

    Arguments and errors are those of `dmt.attractive_area`. With the contact's area less its
    `boundary_strip` the fractions for all ranges add up to one.
    """
    gap, contact = gap_and_contact(gap, contact, grid=True)
    (eps,) = positive(eps=eps)
    ranges, inverse = np.unique(eps, return_inverse=True)
    levels = np.cbrt(ranges) ** 2
    sides = _sides(contact)
    # Lines along an edge do not see it: each axis counts by the edges its lines cross.
    weights = sides / sides.sum() if sides.any() else np.array([0.5, 0.5])
    length = np.zeros(levels.size)
    edges = []
    grids = (array.reshape(-1, *array.shape[-2:]) for array in (gap, contact))
    for field, touching in zip(*grids, strict=True):
        s = np.cbrt(np.maximum(field, 0.0)) ** 2
        found = [_edges(s, touching, axis) for axis in (0, 1)]
        # A point opens on the grid when the edge is still 0.2 pixels short of it, with next to no
        # gap: it gets the one that the edge law has there.
        for index, _, _, lifted in found:
            np.maximum.at(s, index, lifted)
        for axis, weight in enumerate(weights):
            rows, mask = (s, touching) if axis == 1 else (s.T, touching.T)
            step = max(1, _BLOCK // rows.shape[1])
            for part in (slice(start, start + step) for start in range(0, rows.shape[0], step)):
                length += weight * _between_open_points(rows[part], mask[part], levels)
            index, distance, second, _ = found[axis]
            edges.append([distance, s[index], second, np.full(distance.size, weight)])
    length += _beside_edges(np.concatenate(edges, axis=1), levels)
    area = length[inverse].reshape(eps.shape) / gap.size
    return area if eps.ndim else float(area)


def gap_and_contact(
    gap: ArrayLike, contact: ArrayLike | None, grid: bool = False
) -> tuple[NDArray, NDArray]:
    """Return checked arrays, grids if need be, of the gap and of where it counts as contact."""
    gap = numbers("gap", gap)
    if grid and gap.ndim < 2:
        raise ValueError(f"gap must be at least two-dimensional, got shape {gap.shape}")
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


def _sides(contact: ArrayLike) -> NDArray:
    """Number of pixel sides between contact and gap that lines along axes -2 and -1 cross."""
    contact = np.asarray(contact)
    if contact.dtype != bool or contact.size == 0 or contact.ndim < 2:
        raise ValueError(
            "contact must be a non-empty boolean array of two dimensions at least, True where the "
            f"surfaces touch, got {contact.dtype} of shape {contact.shape}"
        )
    return np.array(
        [float(np.count_nonzero(contact ^ np.roll(contact, 1, axis))) for axis in (-2, -1)]
    )


def _between_open_points(s: NDArray, contact: NDArray, levels: NDArray) -> NDArray:
    """Length up to every level of the intervals between open neighbours, along the last axis."""
    end = levels.size
    node = np.searchsorted(levels, s.ravel()).reshape(s.shape)  # first level that s is within
    following = np.roll(contact, -1, axis=1)
    both = ~(contact | following)
    one, other = node[both], np.roll(node, -1, axis=1)[both]
    whole = np.bincount(np.maximum(one, other), minlength=end + 1)[:end].cumsum().astype(float)
    crossed = one != other
    low, high = s[both][crossed], np.roll(s, -1, axis=1)[both][crossed]
    low, high = np.minimum(low, high), np.maximum(low, high)
    first, last = np.minimum(one, other)[crossed], np.maximum(one, other)[crossed]
    # A step of rounding size has no length below its top that could matter.
    steep = high - low > _LEVEL * high
    low, rate, first, last = low[steep], 1 / (high - low)[steep], first[steep], last[steep]
    # Between `first` and `last` an interval holds (level - low) rate: sums of rates and offsets.
    rates, offsets = (
        (
            np.bincount(first, weights=w, minlength=end + 1)
            - np.bincount(last, weights=w, minlength=end + 1)
        )[:end].cumsum()
        for w in (rate, low * rate)
    )
    return whole + levels * rates - offsets


def _edges(s: NDArray, contact: NDArray, axis: int) -> tuple:
    """Find the edges on lines along an axis and how far they are from the first open points.

    Returns indices of the first open points, their distances from the edge in pixels, s of the
    points beyond (NaN where the gap closes again), and s of the first points by the edge law (zero
    where the solution's is as good), all of one length.
    """
    parts = []
    for step in (1, -1):
        index = np.nonzero(contact & ~np.roll(contact, -step, axis))
        beyond = [list(index), list(index)]
        for k in (0, 1):
            beyond[k][axis] = (index[axis] + (k + 1) * step) % s.shape[axis]
        near, far = (tuple(each) for each in beyond)
        parts.append((*near, s[near], np.where(contact[far], 0.0, s[far])))
    row, column, first, second = (np.concatenate(each) for each in zip(*parts, strict=True))
    rises = second > first
    ratio = np.divide(first, second, out=np.zeros_like(first), where=rises)
    distance = np.where(rises, np.interp(ratio, _RATIO, _DISTANCE), _MEAN_DISTANCE)
    low = rises & (ratio < _LOW)
    lifted = np.where(low, second * distance / (1 + distance), 0.0)
    # Where the gap closes again there is no second point to tell the slope.
    return (row, column), distance, np.where(rises, second, np.nan), lifted


def _beside_edges(edges: NDArray, levels: NDArray) -> NDArray:
    """Length up to every level of the intervals between an edge and the first open point.

    Rows of `edges`: distance, s of the first and of the second point, weight of the line.
    """
    distance, first, second, weight = edges
    if distance.size == 0:
        return np.zeros(levels.size)
    # Narrow spots and clefts bias the distances, for which the edge law is not meant: their mean
    # is set to that of the strip, so that areas of contact and gap add up to one.
    distance = distance * (_MEAN_DISTANCE / np.average(distance, weights=weight))
    slope = np.where(np.isfinite(second), second / (1 + distance), first / distance)
    slope = np.maximum(slope, np.finfo(float).tiny)  # a gap of zero may lie in a mask's open part
    end = levels.size
    last = np.searchsorted(levels, np.minimum(first, slope * distance))
    whole = np.bincount(last, weights=weight * distance, minlength=end + 1)[:end].cumsum()
    beyond = np.bincount(last, weights=weight / slope, minlength=end + 1)[::-1].cumsum()[::-1]
    return whole + levels * beyond[1:]
