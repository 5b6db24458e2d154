"""Points x y z in any order as heights on a regular grid."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

_SLACK = 0.01  # of a step, by which positions may be off the grid
_MOST_EMPTY = 0.5  # share of the grid that may have no point; more are scattered points
FEWEST_POINTS = 16  #: fewer rows of three numbers are a map
#: Of a step, by which measured positions may scatter about a grid: rms and largest.
SNAPPED_RMS = 0.05
SNAPPED_MOST = 0.25
RESAMPLE = (
    "resample them to a regular grid, e.g. by scipy.interpolate.griddata or Gwyddion's import of "
    "XYZ data"
)


class Gridded(NamedTuple):
    """Points on a grid."""

    heights: NDArray  #: (nx, ny), NaN where there is no point; of a profile (n,)
    places: NDArray | None  #: steps along both axes, or positions on a line
    remarks: tuple[str, ...] = ()


def read_columns(columns: NDArray) -> Gridded:
    """Heights of a table (columns, rows): of points x y z, a profile or, otherwise, a map."""
    count = columns.shape[1]
    if len(columns) == 3 and count >= FEWEST_POINTS:
        return map_points(columns)
    if len(columns) == 1 or (len(columns) == 2 and count > 2):
        return Gridded(columns[-1], columns[0] if len(columns) == 2 else None)
    return Gridded(columns, None)


def map_points(points: NDArray) -> Gridded:
    """Heights of points (3, n) in any order on their grid.

    Raises
    ------
    ValueError
        If the points are on no grid, leave most of one empty or have two heights at one place.
    """
    points = points[:, np.isfinite(points[:2]).all(axis=0)]
    count = points.shape[1]
    i, dx, off_x = _index(points[0], "x")
    j, dy, off_y = _index(points[1], "y")
    heights = np.full((int(i.max()) + 1, int(j.max()) + 1), np.nan)
    if count < (1 - _MOST_EMPTY) * heights.size:
        raise ValueError(
            f"three columns, which as x y z leave most of a grid of {heights.shape[0]} x "
            f"{heights.shape[1]} points empty; {RESAMPLE}, or export a matrix"
        )
    numbers = i * heights.shape[1] + j
    places, first, repeats = np.unique(numbers, return_index=True, return_counts=True)
    if len(places) < count:
        x, y = points[:2, first[np.argmax(repeats > 1)]]
        raise ValueError(
            f"as x y z it has {count} points at {len(places)} places, and several of them at "
            f"x = {x:g}, y = {y:g}: export positions with more digits, or leave one point each"
        )
    heights[i, j] = points[2]
    off = max(off_x, off_y)
    remark = (
        f"the points were taken for those of the nearest grid of {heights.shape[0]} x "
        f"{heights.shape[1]} points, off which they are by up to {off:.2g} of a step"
    )
    return Gridded(heights, np.array([dx, dy]), (remark,) if off > 2 * _SLACK else ())


def _index(positions: NDArray, name: str) -> tuple[NDArray, float, float]:
    """Index of every position on an even grid, its step, and how far positions are off it."""
    levels = np.unique(positions)
    gaps = np.diff(levels)
    if gaps.size == 0:
        raise ValueError(f"three columns, which as x y z all have one {name}")
    # Positions that differ by rounding only; else measured ones, which scatter about the grid.
    for least, most, rms in ((_SLACK, 10 * _SLACK, 1.0), (0.3, SNAPPED_MOST, SNAPPED_RMS)):
        index, step = _fit_grid(positions, levels, least * gaps.max())
        off = index - np.rint(index)
        if np.abs(off).max() <= most and np.sqrt(np.mean(off**2)) <= rms:
            index = np.rint(index).astype(int)
            return index - index.min(), step, float(np.abs(off).max())
    raise ValueError(
        f"three columns, which as x y z are on no even grid along {name}; {RESAMPLE}, or export a "
        "matrix"
    )


def _fit_grid(positions: NDArray, levels: NDArray, least: float) -> tuple[NDArray, float]:
    """Places of positions in steps of the grid whose lines are at least so far apart."""
    groups = np.split(levels, np.flatnonzero(np.diff(levels) > least) + 1)
    lines = np.array([group.mean() for group in groups])
    gaps = np.diff(lines)
    # Gaps of rounded positions differ: one step is the mean of the short ones, and then what
    # fits the whole side.
    step = gaps[gaps < 1.5 * gaps.min()].mean()
    numbers = np.concatenate([[0], np.cumsum(np.rint(gaps / step))])
    step = float((lines[-1] - lines[0]) / numbers[-1])
    origin = float(np.mean(lines - step * numbers))
    return (positions - origin) / step, step
