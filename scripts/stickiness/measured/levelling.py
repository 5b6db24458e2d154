"""Levelling of measured heights; missing points, dropped, filled or cut off; spikes.

Spikes are single points far off their neighbours, as instruments write them where light is lost or
a loop slips, and converters where they take a marker of missing points for a height. One is enough
to set rms height, slope and energy of a map, because its spectrum is white.
"""

from __future__ import annotations

import warnings
from typing import Literal

import numpy as np
import scipy  # its parts are loaded when first used, which reading a configuration does not
from numpy.typing import NDArray

MAX_MISSING = 0.1  #: default largest share of missing points that are filled
#: Rms step at a rim over that elsewhere, above which the rim is dropped: 0.75 to 3.4 around holes
#: cut into measured surfaces, and 40 around those of an instrument that wrote outliers there.
OUTSTANDING = 5.0
LARGEST_RIM = 5  #: widest rim that "detect" drops [points]
OUTLYING = 30.0  #: distance of a spike from its neighbours over the distance of `TYPICAL` points
TYPICAL = 0.99  #: share of the points below that distance; more spikes than the rest are no spikes
MOST_TOUCHING = 4  #: spikes of a map in one group; longer groups are scratches and fibres

#: Share of the variance, after levelling by a plane, above which a second-order surface is the form
#: of the specimen; by dimension. Random surfaces without roll-off have up to 0.89 on 64 x 64 points
#: at H = 0.8 and 0.92 at H = 1 (360 each), profiles up to 0.96 and 0.975 (1280 each).
LEAST_FORM = {1: 0.99, 2: 0.95}
MOST_COPIES = 5  #: of one tile along a side that are looked for

Detrend = Literal["detect", "mean", "plane", "quadratic"]
Missing = Literal["fill", "crop", "refuse"]
Rim = int | Literal["detect"]
Spikes = Literal["mask", "keep"]


def detrend(heights: NDArray, kind: Detrend = "plane") -> NDArray:
    """Subtract the mean, plane or quadratic surface that fits a map or profile best."""
    heights = np.asarray(heights, dtype=float)
    if heights.ndim not in (1, 2) or not np.all(np.isfinite(heights)):
        raise ValueError(f"heights must be finite and 1D or 2D, got shape {heights.shape}")
    # Legendre polynomials of each axis: nearly orthogonal on the grid, so the normal equations
    # (small, whatever the grid) lose no digits.
    bases, powers = _polynomials(heights.shape, kind)
    if heights.ndim == 1:
        return heights - bases[0] @ np.linalg.lstsq(bases[0], heights, rcond=None)[0]
    px, py = bases
    i, j = powers
    gram = (px.T @ px)[np.ix_(i, i)] * (py.T @ py)[np.ix_(j, j)]
    trend = np.zeros((px.shape[1], py.shape[1]))
    trend[i, j] = np.linalg.lstsq(gram, (px.T @ heights @ py)[i, j], rcond=None)[0]
    return heights - px @ trend @ py.T


def find_form(heights: NDArray) -> float | None:
    """Share of the variance about a plane that a second-order surface explains, if it is a form.

    None below `LEAST_FORM`: random surfaces have much of it, too.
    """
    level = detrend(heights, "plane")
    variance = np.var(level)
    if not variance > 0:
        return None
    share = float(1 - np.var(detrend(level, "quadratic")) / variance)
    return share if share > LEAST_FORM[level.ndim] else None


def find_curvatures(heights: NDArray, steps: tuple[float, ...]) -> list[float]:
    """Curvatures [1/length] along every axis of the second-order surface that fits best."""
    form = detrend(heights, "plane") - detrend(heights, "quadratic")
    return [float(np.diff(form, 2, axis=axis).mean()) / step**2 for axis, step in enumerate(steps)]


def find_tile(heights: NDArray) -> tuple[int, ...]:
    """Points along both axes of the tile of which a map consists; its shape if it has none.

    Copies, or mirror images, agree to 1e-9 of the range. A map that does not vary along an axis is
    no tiling.
    """
    tile = list(heights.shape)
    tolerance = 1e-9 * float(np.nanmax(heights) - np.nanmin(heights))

    def agrees(points: int, axis: int) -> bool:
        shifted = np.roll(heights, points, axis)
        return np.allclose(shifted, heights, rtol=0, atol=tolerance, equal_nan=True)

    for axis in (0, 1):
        if agrees(1, axis):
            return heights.shape
        for copies in range(2, MOST_COPIES + 1):
            while tile[axis] % copies == 0 and agrees(tile[axis] // copies, axis):
                tile[axis] //= copies
        lines = np.moveaxis(heights, axis, 0)[: tile[axis]]
        if np.allclose(lines, lines[::-1], rtol=0, atol=tolerance, equal_nan=True):
            tile[axis] = (tile[axis] + 1) // 2  # the other half is a mirror image
    return tuple(tile)


def find_repeats(heights: NDArray) -> tuple[int, ...]:
    """How often every point is repeated along both axes, as by enlarging a picture; 1 if not."""
    repeats = [1, 1]
    for axis, points in enumerate(heights.shape):
        lines = np.moveaxis(heights, axis, 0)
        for count in range(MOST_COPIES, 1, -1):
            if points % count or points == count:
                continue
            blocks = lines.reshape(points // count, count, -1)
            is_repeated = np.array_equal(blocks, np.repeat(blocks[:, :1], count, 1), equal_nan=True)
            if is_repeated and not np.array_equal(blocks[0], blocks[-1], equal_nan=True):
                repeats[axis] = count
                break
    return tuple(repeats)


def rms_of_known(heights: NDArray, kind: Detrend = "plane") -> float:
    """Root mean square of the finite points of a map or profile about the trend that fits them."""
    heights = heights if heights.ndim == 2 else heights[:, None]
    is_finite = np.isfinite(heights)
    (px, py), powers = _polynomials(heights.shape, kind)
    design = np.array([np.outer(px[:, i], py[:, j])[is_finite] for i, j in powers.T])
    known = heights[is_finite]
    trend = np.linalg.lstsq(design @ design.T, design @ known, rcond=None)[0]
    return float(np.sqrt(np.mean((known - trend @ design) ** 2)))


def _polynomials(shape: tuple[int, ...], kind: Detrend) -> tuple[list[NDArray], NDArray]:
    """Legendre polynomials along every axis, and their powers (2, m) up to the total degree."""
    degrees = {"mean": 0, "plane": 1, "quadratic": 2}
    if kind not in degrees:
        raise ValueError(f"detrend must be detect or one of {sorted(degrees)}, got {kind!r}")
    degree = degrees[kind]
    axes = [np.linspace(-1, 1, n) if n > 1 else np.zeros(1) for n in shape]
    powers = [(i, j) for i in range(degree + 1) for j in range(degree + 1 - i)]
    return [np.polynomial.legendre.legvander(t, degree) for t in axes], np.array(powers).T


def without_rims(heights: NDArray, rim: Rim = "detect") -> tuple[NDArray, int]:
    """Heights, NaN where missing or beside missing ones, and how many points this drops."""
    hole = ~np.isfinite(heights)
    wide = _widen(hole, outstanding_rim(heights) if rim == "detect" else rim)
    return np.where(wide, np.nan, heights), int(np.count_nonzero(wide & ~hole))


def outstanding_rim(heights: NDArray) -> int:
    """Width of the rim around missing points with much larger steps of height than elsewhere."""
    hole = ~np.isfinite(heights)
    steps = [np.diff(heights, axis=axis) for axis in range(heights.ndim)]
    for rim in range(LARGEST_RIM if hole.any() else 0, 0, -1):
        # 0 within, 1 the last of the rim, 2 beyond; so a step has 2 to the rim, 4 beyond it.
        zone = 2 - _widen(hole, rim - 1).astype(int) - _widen(hole, rim)
        axes = range(heights.ndim)
        pairs = [np.delete(zone, 0, axis) * np.delete(zone, -1, axis) for axis in axes]
        steps_to_rim = np.concatenate([steps[axis][pairs[axis] == 2] for axis in axes])
        steps_beyond = np.concatenate([steps[axis][pairs[axis] == 4] for axis in axes])
        if steps_to_rim.size and steps_beyond.size:
            elsewhere = np.sqrt(np.mean(steps_beyond**2))
            if np.sqrt(np.mean(steps_to_rim**2)) > OUTSTANDING * elsewhere > 0:
                return rim
    return 0


def _widen(hole: NDArray, rim: int) -> NDArray:
    return scipy.ndimage.maximum_filter(hole, size=2 * rim + 1, mode="constant", cval=False)


def fill_missing(
    heights: NDArray, max_missing=MAX_MISSING, source="heights", positions=None
) -> tuple[NDArray, int]:
    """Fill points that are not finite from their neighbours; returns a copy, and how many."""
    hole = ~np.isfinite(heights)
    missing = int(np.count_nonzero(hole))
    told = f"{source}: {missing} of {hole.size} points"
    if missing == hole.size:
        raise ValueError(
            f"{told}, which are all, are missing: give a map or profile of which some points were "
            "measured"
        )
    if missing / hole.size > max_missing:
        raise ValueError(
            f"{told} ({100 * missing / hole.size:.1f} %) are missing, more than the "
            f"{100 * max_missing:.1f} % that are filled; cut them off with missing: crop, measure "
            "again or raise max_missing"
        )
    if not missing:
        return np.array(heights, dtype=float), 0
    if heights.ndim == 1:
        return np.interp(positions, positions[~hole], heights[~hole]), missing
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of what SurfaceTopography imports
        from SurfaceTopography import Topography  # takes two seconds

    # Each is the mean of its neighbours: there are no new extremes, and a plane stays a plane.
    masked = Topography(np.ma.array(heights, mask=hole), physical_sizes=heights.shape)
    filled = np.array(masked.interpolate_undefined_data().heights())
    return np.where(hole, filled, heights), missing


def complete_rectangle(known: NDArray, source: str = "heights") -> tuple[slice, ...]:
    """Return the largest rectangle of a map, or run of a profile, in which every point is known."""
    if known.ndim == 1:
        return complete_rectangle(known[None, :], source)[1:]
    # For every row the largest rectangle under the histogram of known points that end in it.
    largest = 0
    rectangle = (slice(0), slice(0))
    bars = np.zeros(known.shape[1], dtype=int)
    for row, line in enumerate(known):
        bars = np.where(line, bars + 1, 0)
        # Bars that may still extend to the right: (start, height), of increasing height.
        open_bars: list[tuple[int, int]] = []
        for column, height in enumerate([*bars.tolist(), 0]):
            start = column
            while open_bars and open_bars[-1][1] >= height:
                start, ended = open_bars.pop()
                if ended * (column - start) > largest:
                    largest = ended * (column - start)
                    rectangle = (slice(row + 1 - ended, row + 1), slice(start, column))
            open_bars.append((start, height))
    if not largest:
        raise ValueError(f"{source}: every point is missing")
    return rectangle


def find_spikes(heights: NDArray) -> NDArray:
    """Mask of points more than `OUTLYING` times as far off their neighbours as 99 % of points."""
    level = np.where(np.isfinite(heights), heights, np.nan)
    # Slopes are taken out by the medians of the steps.
    for axis, n in enumerate(level.shape):
        steps = np.diff(level, axis=axis)
        steps = steps[np.isfinite(steps)]
        if steps.size:
            along = np.expand_dims(np.arange(n), [i for i in range(level.ndim) if i != axis])
            level = level - np.median(steps) * along
    distance = _neighbour_distance(level)
    known = distance[np.isfinite(distance)]
    if not known.size or not known.max() > 0:
        return np.zeros(level.shape, dtype=bool)
    # Coarse steps of an instrument's converter: many points equal their neighbours.
    typical = max(np.quantile(known, TYPICAL, method="lower"), known[known > 0].min())
    distance = np.nan_to_num(distance, nan=0.0, posinf=0.0)
    spikes = distance > OUTLYING * typical
    if level.ndim == 2 and spikes.any():
        # Points of a scratch or fibre one point wide are as far off, but not alone. By a third of
        # the limit, or a scratch of varying depth would fall to pieces as small as spikes.
        marked = distance > 1 / 3 * OUTLYING * typical
        by_side_or_corner = np.ones((3, 3))
        groups, _ = scipy.ndimage.label(marked, structure=by_side_or_corner)
        spikes &= (np.bincount(groups.ravel()) <= MOST_TOUCHING)[groups]
    return spikes


def _neighbour_distance(heights: NDArray) -> NDArray:
    """Difference in height of every point to its third closest neighbour of eight.

    So points of an edge, a corner or a ridge two points wide are close to each other, and up to
    three spikes may touch. On a line it is the second closest of four.
    """
    is_line = heights.ndim == 1
    reach = 2 if is_line else 1
    rank = 2 if is_line else 3
    padded = np.pad(heights, reach, constant_values=np.nan)
    around = np.lib.stride_tricks.sliding_window_view(padded, (2 * reach + 1,) * heights.ndim)
    ranked = np.empty(heights.shape)
    for start in range(0, len(heights), 256):  # rows that are worked on at a time
        rows = slice(start, start + 256)
        here = heights[rows]
        distance = np.abs(around[rows].reshape(*here.shape, -1) - here[..., None])
        # The point itself is the closest; NaN comes last.
        ranked[rows] = np.partition(distance, rank, axis=-1)[..., rank]
    return ranked
