"""Areas of a discrete contact finer than its pixels: the edge of contact and the gap beside it.

The solution on a grid touches at whole pixels and is too large by a strip along its edge. The gap
grows from an edge as ``u = C x^(3/2)``: in ``s = u^(2/3)`` a straight line, whose slope the second
open pixel gives. The first one is where the discrete solution differs from the law; the ratio of
the two says how far the edge is. An area is the mean length of its intersections with the grid
lines along both axes (Cavalieri); on a line, s is interpolated linearly between neighbours.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import numbers, positive
from stickiness.compiled import compiled

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
    gaps = gap.reshape(-1, *gap.shape[-2:])
    contacts = contact.reshape(-1, *contact.shape[-2:])
    for field, touching in zip(gaps, contacts, strict=True):
        s = np.cbrt(np.maximum(field, 0.0)) ** 2
        edges_by_axis = [_edges(s, touching, axis) for axis in (0, 1)]
        # A point opens on the grid when the edge is still 0.2 pixels short of it, with next to no
        # gap: it gets the one that the edge law has there.
        for at_edges in edges_by_axis:
            np.maximum.at(s, at_edges.index, at_edges.lifted)
        node = np.searchsorted(levels, s)  # first level that s is within
        for axis, weight in enumerate(weights):
            length += weight * _between_open_points(s, touching, node, levels, axis)
            # Intervals between an edge and the first open point, of all grids together below.
            at_edges = edges_by_axis[axis]
            first = s[at_edges.index]
            line_weights = np.full(first.size, weight)
            edges.append([at_edges.distance, first, at_edges.second, line_weights])
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


def _between_open_points(
    s: NDArray, contact: NDArray, node: NDArray, levels: NDArray, axis: int
) -> NDArray:
    """Length up to every level of the intervals between open neighbours along an axis."""
    whole, rates, parts = np.zeros((3, levels.size + 1))
    _add_intervals(s, contact, node, axis, whole, rates, parts)
    crossed = levels * rates[:-1].cumsum() - parts[:-1].cumsum()
    return whole[:-1].cumsum() + crossed


@compiled
def _add_intervals(s, contact, node, axis, whole, rates, parts):
    """Add every interval where it changes the sums over those up to a level, and over those across.

    From its first level on, an interval holds (level - low) rate, and from its last one on all of
    it. `node` gives the first level that a point is within.
    """
    rows, columns = s.shape
    for i in range(rows):
        below = (i + 1 - axis) % rows
        for j in range(columns):
            beside = (j + axis) % columns
            if contact[i, j] or contact[below, beside]:
                continue
            first = min(node[i, j], node[below, beside])
            last = max(node[i, j], node[below, beside])
            whole[last] += 1
            if first < last:
                low = min(s[i, j], s[below, beside])
                high = max(s[i, j], s[below, beside])
                # A step of rounding size has no length below its top that could matter.
                if high - low > _LEVEL * high:
                    rate = 1 / (high - low)
                    rates[first] += rate
                    rates[last] -= rate
                    parts[first] += low * rate
                    parts[last] -= low * rate


@dataclass(frozen=True, eq=False)
class _Edges:
    """Edges of contact on the lines along one axis, each at its first open point."""

    index: tuple  #: rows and columns of the first open points
    distance: NDArray  #: of these from the edge, in pixels
    second: NDArray  #: s of the points beyond, NaN where the gap closes again
    lifted: NDArray  #: s of the first points by the edge law, zero where the solution's is as good


def _edges(s: NDArray, contact: NDArray, axis: int) -> _Edges:
    """Find the edges on lines along an axis and how far they are from the first open points."""
    rows = []
    columns = []
    seconds = []
    for step in (1, -1):
        # The last point in contact, and the two points beyond it.
        last = np.nonzero(contact & ~np.roll(contact, -step, axis))
        near = list(last)
        near[axis] = (last[axis] + step) % s.shape[axis]
        far = list(last)
        far[axis] = (last[axis] + 2 * step) % s.shape[axis]
        rows.append(near[0])
        columns.append(near[1])
        seconds.append(np.where(contact[tuple(far)], 0.0, s[tuple(far)]))
    index = (np.concatenate(rows), np.concatenate(columns))
    first = s[index]
    second = np.concatenate(seconds)
    rises = second > first
    ratio = np.divide(first, second, out=np.zeros_like(first), where=rises)
    distance = np.where(rises, np.interp(ratio, _RATIO, _DISTANCE), _MEAN_DISTANCE)
    low = rises & (ratio < _LOW)
    return _Edges(
        index=index,
        distance=distance,
        # Where the gap closes again there is no second point to tell the slope.
        second=np.where(rises, second, np.nan),
        lifted=np.where(low, second * distance / (1 + distance), 0.0),
    )


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
