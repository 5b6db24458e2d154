"""Lists of points x y z as a map: text exports of instruments that have three columns."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

FEWEST_POINTS = 16  #: rows of three numbers, from which they are a list of points and no matrix
_SLACK = 0.01  # of a step, by which positions may be off the grid
_ONE_STEP = 1.5  # times the shortest distance of positions, below which they are one step apart
_MOST_EMPTY = 0.5  # share of the grid that may have no point; more are scattered points


def is_list(values: NDArray) -> bool:
    """Whether a matrix (rows, columns) is a list of points."""
    return values.shape[1] == 3 and len(values) >= FEWEST_POINTS


def to_map(path: Path, points: NDArray) -> tuple[NDArray, tuple[float, float]]:
    """Heights (nx, ny), NaN where there is no point, and grid steps in the unit of the positions.

    `points` (n, 3) may be in any order. A ValueError names `path` if they are on no even grid,
    or two are at one place.
    """
    points = points[np.isfinite(points[:, :2]).all(axis=1)]
    (i, dx), (j, dy) = (_index(path, points[:, axis], "xy"[axis]) for axis in (0, 1))
    shape = int(i.max()) + 1, int(j.max()) + 1
    if len(points) < (1 - _MOST_EMPTY) * shape[0] * shape[1]:
        raise ValueError(
            f"{path}: three columns, which as x y z leave most of a grid of {shape[0]} x "
            f"{shape[1]} points empty; resample them on a grid, or export a matrix"
        )
    if len(np.unique(i * shape[1] + j)) < len(points):
        raise ValueError(f"{path}: as x y z it has two points at one place; remove one")
    heights = np.full(shape, np.nan)
    heights[i, j] = points[:, 2]
    return heights, (dx, dy)


def _index(path: Path, positions: NDArray, name: str) -> tuple[NDArray, float]:
    """Index of every position on an even grid, and its step."""
    levels = np.unique(positions)
    gaps = np.diff(levels)
    if gaps.size == 0:
        raise ValueError(f"{path}: three columns, which as x y z all have one {name}")
    gaps = gaps[gaps > _SLACK * gaps.max()]  # positions that differ by rounding only
    # Gaps of rounded positions differ: one step is the mean of the short ones, and then what
    # fits the whole side.
    step = gaps[gaps < _ONE_STEP * gaps.min()].mean()
    step = float((levels[-1] - levels[0]) / np.rint(gaps / step).sum())
    index = (positions - levels[0]) / step
    if np.abs(index - np.rint(index)).max() > 10 * _SLACK:
        raise ValueError(
            f"{path}: three columns, which as x y z are on no even grid along {name}; resample "
            "them on a grid, or export a matrix"
        )
    return np.rint(index).astype(int), step
