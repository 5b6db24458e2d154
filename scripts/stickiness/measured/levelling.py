"""Levelling of measured heights; missing points, filled or cut off."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, sparse
from scipy.sparse import linalg

MAX_MISSING = 0.1  #: default largest share of missing points that are filled
OUTSTANDING = 5.0  #: rms step at a rim over that elsewhere, above which the rim is dropped
LARGEST_RIM = 5  #: widest rim that "detect" drops [points]

Detrend = Literal["mean", "plane", "quadratic"]
Missing = Literal["fill", "crop", "refuse"]
Rim = int | Literal["detect"]

_DEGREES = {"mean": 0, "plane": 1, "quadratic": 2}


def detrend(heights: NDArray, kind: Detrend = "plane") -> NDArray:
    """Subtract the mean, plane or quadratic surface that fits heights (nx, ny) best.

    `kind` is a polynomial of total degree 0, 1 or 2 in x and y, fitted by least squares.
    """
    heights, degree = _check(heights, kind, 2)
    x, y = (np.linspace(-1, 1, n) if n > 1 else np.zeros(1) for n in heights.shape)
    # Legendre polynomials of each axis: nearly orthogonal on the grid, so the normal equations
    # (small, whatever the grid) lose no digits.
    px, py = (np.polynomial.legendre.legvander(t, degree) for t in (x, y))
    terms = [(i, j) for i in range(degree + 1) for j in range(degree + 1 - i)]
    i, j = np.array(terms).T
    gram = (px.T @ px)[np.ix_(i, i)] * (py.T @ py)[np.ix_(j, j)]
    coefficients = np.linalg.lstsq(gram, (px.T @ heights @ py)[i, j], rcond=None)[0]
    trend = np.zeros((degree + 1, degree + 1))
    trend[i, j] = coefficients
    return heights - px @ trend @ py.T


def detrend_profile(heights: NDArray, kind: Detrend = "plane") -> NDArray:
    """Subtract the mean, line ("plane") or parabola that fits a profile (n,) best."""
    heights, degree = _check(heights, kind, 1)
    basis = np.polynomial.legendre.legvander(np.linspace(-1, 1, len(heights)), degree)
    return heights - basis @ np.linalg.lstsq(basis, heights, rcond=None)[0]


def rms_of_known(heights: NDArray, kind: Detrend = "plane") -> float:
    """Root mean square of the finite points of a map or profile about the trend that fits them."""
    known = np.isfinite(heights)
    filled = np.where(known, heights, 0.0)
    if heights.ndim == 1:
        filled, known = filled[:, None], known[:, None]
    degree = _DEGREES[kind]
    x, y = (np.linspace(-1, 1, n) if n > 1 else np.zeros(1) for n in filled.shape)
    px, py = (np.polynomial.legendre.legvander(t, degree) for t in (x, y))
    terms = [(i, j) for i in range(degree + 1) for j in range(degree + 1 - i)]
    i, j = np.array(terms).T
    # Sums over known points of products of any two terms, and of terms and heights.
    both = [
        [(px[:, a] * px[:, c]) @ known @ (py[:, b] * py[:, d]) for c, d in terms] for a, b in terms
    ]
    beside = (px.T @ filled @ py)[i, j]
    trend = np.zeros((degree + 1, degree + 1))
    trend[i, j] = np.linalg.lstsq(np.array(both, dtype=float), beside, rcond=None)[0]
    return float(np.sqrt(np.mean((filled - px @ trend @ py.T)[known] ** 2)))


def _check(heights: NDArray, kind: str, dimensions: int) -> tuple[NDArray, int]:
    """Heights as floats and the degree of the polynomial."""
    if kind not in _DEGREES:
        raise ValueError(f"detrend must be one of {sorted(_DEGREES)}, got {kind!r}")
    heights = np.asarray(heights, dtype=float)
    if heights.ndim != dimensions or not np.all(np.isfinite(heights)):
        raise ValueError(f"heights must be {dimensions}D and finite, got shape {heights.shape}")
    return heights, _DEGREES[kind]


def without_rims(heights: NDArray, rim: Rim = "detect") -> tuple[NDArray, int]:
    """Drop the points beside missing ones, where instruments may write values that are far off.

    `rim` is their width [points], diagonals counted as one; "detect": as far as they stand out
    (`outstanding_rim`). Returns a copy, NaN where missing or dropped, and how many points were
    measured and are dropped.
    """
    hole = ~np.isfinite(heights)
    wide = _widen(hole, outstanding_rim(heights) if rim == "detect" else rim)
    return np.where(wide, np.nan, heights), int(np.count_nonzero(wide & ~hole))


def outstanding_rim(heights: NDArray) -> int:
    """Width of the rim around missing points with much larger steps of height than elsewhere.

    A rim stands out if the rms step from it to the points beyond is more than `OUTSTANDING` times
    that between neighbours beyond. The ratio is 0.75 to 3.4 around holes cut into three measured
    surfaces where these are steepest, sharpest, lowest, highest or at random. It is 40 around the
    holes of an instrument that wrote outliers there and, one point further out, 0.9.
    """
    hole = ~np.isfinite(heights)
    for rim in range(LARGEST_RIM if hole.any() else 0, 0, -1):
        # 0 within, 1 the last of the rim, 2 beyond.
        zone = 2 - _widen(hole, rim - 1).astype(int) - _widen(hole, rim)
        to_rim, beyond = [], []
        for axis in range(heights.ndim):
            step = np.diff(heights, axis=axis)
            pair = np.delete(zone, 0, axis) * np.delete(zone, -1, axis)
            to_rim.append(step[pair == 2])
            beyond.append(step[pair == 4])
        at_rim, elsewhere = (_rms(np.concatenate(steps)) for steps in (to_rim, beyond))
        if at_rim > OUTSTANDING * elsewhere > 0:
            return rim
    return 0


def _widen(hole: NDArray, rim: int) -> NDArray:
    return ndimage.maximum_filter(hole, size=2 * rim + 1, mode="constant", cval=False)


def _rms(values: NDArray) -> float:
    return float(np.sqrt(np.mean(values**2))) if values.size else 0.0


def fill_missing(
    heights: NDArray, max_missing: float = MAX_MISSING, source: str = "heights"
) -> tuple[NDArray, int]:
    """Fill points that are not finite with the harmonic function of their neighbours.

    Each filled point is the mean of its (up to four) neighbours: there are no new extremes, and a
    plane stays a plane. Returns a copy, and how many points were missing. A ValueError names
    `source` if that is more than the share `max_missing`.
    """
    hole = ~np.isfinite(heights)
    missing = _check_missing(hole, max_missing, source)
    if not missing:
        return np.array(heights, dtype=float), 0
    filled = np.where(hole, 0.0, heights)
    filled[hole] = _harmonic(filled, hole)
    return filled, missing


def fill_profile(
    x: NDArray, heights: NDArray, max_missing: float = MAX_MISSING, source: str = "heights"
) -> tuple[NDArray, int]:
    """Fill the points of a profile that are not finite by linear interpolation; see `fill_missing`.

    Heights are constant beyond the first and the last known one; `x` increases.
    """
    hole = ~np.isfinite(heights)
    missing = _check_missing(hole, max_missing, source)
    return np.interp(x, x[~hole], heights[~hole]), missing


def complete_rectangle(known: NDArray, source: str = "heights") -> tuple[slice, slice]:
    """Return the rectangle with most points of those in which every one is known (nx, ny)."""
    # For every row the largest rectangle under the histogram of known points that end in it.
    best, height = (0, slice(0), slice(0)), np.zeros(known.shape[1], dtype=int)
    for row, line in enumerate(known):
        height = np.where(line, height + 1, 0)
        open_: list[tuple[int, int]] = []  # (start, height), increasing
        for column, tall in enumerate([*height.tolist(), 0]):
            start = column
            while open_ and open_[-1][1] >= tall:
                start, ended = open_.pop()
                if ended * (column - start) > best[0]:
                    rows = slice(row + 1 - ended, row + 1)
                    best = ended * (column - start), rows, slice(start, column)
            open_.append((start, tall))
    if not best[0]:
        raise ValueError(f"{source}: every point is missing")
    return best[1], best[2]


def complete_run(known: NDArray, source: str = "heights") -> slice:
    """Return the longest stretch of a profile (n,) in which every point is known."""
    return complete_rectangle(np.asarray(known)[None, :], source)[1]


def _check_missing(hole: NDArray, max_missing: float, source: str) -> int:
    missing = int(np.count_nonzero(hole))
    share = missing / hole.size
    if missing == hole.size:
        raise ValueError(f"{source}: {missing} of {hole.size} points, which are all, are missing")
    if share > max_missing:
        raise ValueError(
            f"{source}: {missing} of {hole.size} points ({100 * share:.1f} %) are missing, more "
            f"than the {100 * max_missing:.1f} % that are filled; cut them off with missing: crop, "
            "measure again or raise max_missing"
        )
    return missing


def _harmonic(heights: NDArray, hole: NDArray) -> NDArray:
    """Solve Laplace's equation on the holes; there is no condition at the edge of the grid."""
    index = np.full(hole.shape, -1)
    index[hole] = np.arange(np.count_nonzero(hole))
    neighbours = ndimage.convolve(
        np.ones(hole.shape), np.array([[0, 1, 0], [1, 0, 1], [0, 1, 0]]), mode="constant"
    )
    known = np.zeros(np.count_nonzero(hole))
    rows, columns = [], []
    for along, value in ((index, heights), (index.T, heights.T)):
        for one, other in ((slice(-1), slice(1, None)), (slice(1, None), slice(-1))):
            here, there = along[one], along[other]
            both, edge = (here >= 0) & (there >= 0), (here >= 0) & (there < 0)
            rows.append(here[both])
            columns.append(there[both])
            np.add.at(known, here[edge], value[other][edge])
    rows, columns = np.concatenate(rows), np.concatenate(columns)
    coupling = sparse.csr_array((np.ones(len(rows)), (rows, columns)), shape=(len(known),) * 2)
    laplacian = sparse.csc_array(sparse.diags_array(neighbours[hole]) - coupling)
    return linalg.spsolve(laplacian, known)
