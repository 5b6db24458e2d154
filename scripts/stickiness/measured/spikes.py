"""Spikes: single points far off their neighbours, as errors of instruments are.

White-light and focus-variation instruments write them where light is lost, scanning probes where
the loop slips, converters where a marker of missing points was taken for a height. One is enough
to set rms height, slope and energy of a map, because its spectrum is white.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

Spikes = Literal["mask", "keep"]

OUTLYING = 30.0  #: distance of a spike from its neighbours over that of the `TYPICAL` points
TYPICAL = 0.99  #: share of the points below that distance; more spikes than the rest are no spikes
MOST_TOUCHING = 4  #: spikes of a map in one group; longer groups are scratches and fibres

_CONNECTS = 1 / 3  # share of the distance of a spike from which points count to its group
_ROWS = 256  # worked on at a time


def find_spikes(heights: NDArray) -> NDArray:
    """Mark points that are far off their neighbours.

    The distance of a point of a map (nx, ny) is that to the third closest in height of its eight
    neighbours, so that an edge, a corner or a ridge of two points' width is close to its own, and
    up to three spikes may touch. On a line profile (n,) it is that to the second closest of four.
    A spike is more than `OUTLYING` times as far off as 99 % of the points are. A scratch or fibre
    of one point's width is so too, but not alone: groups of more than `MOST_TOUCHING`
    such points that touch are no spikes. An island of one point is taken for a spike.
    Slopes are taken out by the medians of the steps. Points that are not finite are none, and no
    neighbours.

    Returns a mask of the shape of the heights.
    """
    level = _without_slope(np.asarray(heights, dtype=float))
    distance = _map_distance(level) if level.ndim == 2 else _line_distance(level)
    known = distance[np.isfinite(distance)]
    if not known.size or not known.max() > 0:
        return np.zeros(level.shape, dtype=bool)
    typical = np.quantile(known, TYPICAL, method="lower")
    # Coarse steps of an instrument's converter: many points equal their neighbours.
    typical = max(typical, known[known > 0].min())
    distance = np.nan_to_num(distance, nan=0.0, posinf=0.0)
    spikes = distance > OUTLYING * typical
    if level.ndim == 2 and spikes.any():
        # By a lower limit, or a scratch of varying depth would fall to pieces as small as spikes.
        spikes &= _in_small_groups(distance > _CONNECTS * OUTLYING * typical)
    return spikes


def _in_small_groups(marked: NDArray) -> NDArray:
    """Marked points in groups of at most `MOST_TOUCHING` that touch, by side or corner."""
    groups, _ = ndimage.label(marked, structure=np.ones((3, 3)))
    sizes = np.bincount(groups.ravel())
    return marked & (sizes <= MOST_TOUCHING)[groups]


def _without_slope(heights: NDArray) -> NDArray:
    level = np.where(np.isfinite(heights), heights, np.nan)
    for axis, n in enumerate(level.shape):
        steps = np.diff(level, axis=axis)
        steps = steps[np.isfinite(steps)]
        if steps.size:
            along = np.expand_dims(np.arange(n), [i for i in range(level.ndim) if i != axis])
            level = level - np.median(steps) * along
    return level


def _map_distance(heights: NDArray) -> NDArray:
    """Distance of every point of a map to the third closest neighbour; NaN where there is none."""
    padded = np.pad(heights, 1, constant_values=np.nan)
    nx, ny = heights.shape
    shifts = [(i, j) for i in range(3) for j in range(3) if (i, j) != (1, 1)]
    found = np.empty(heights.shape)
    for start in range(0, nx, _ROWS):
        stop = min(start + _ROWS, nx)
        here = heights[start:stop]
        around = [np.abs(padded[start + i : stop + i, j : j + ny] - here) for i, j in shifts]
        found[start:stop] = np.partition(around, 2, axis=0)[2]  # NaN comes last
    return found


def _line_distance(heights: NDArray) -> NDArray:
    """Distance of every point of a profile to the second closest of four neighbours."""
    padded = np.pad(heights, 2, constant_values=np.nan)
    n = len(heights)
    around = [np.abs(padded[i : i + n] - heights) for i in (0, 1, 3, 4)]
    return np.partition(around, 1, axis=0)[1]
