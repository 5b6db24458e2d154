"""Levelling of measured heights and interpolation of missing points."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, sparse
from scipy.sparse import linalg

MAX_MISSING = 0.1  # default largest share of missing points that are filled

Detrend = Literal["mean", "plane", "quadratic"]


def detrend(heights: NDArray, kind: Detrend = "plane") -> NDArray:
    """Subtract the mean, plane or quadratic surface that fits the heights best.

    Parameters
    ----------
    heights : (nx, ny) array
        Heights, any unit.
    kind : {"mean", "plane", "quadratic"}
        Polynomial of total degree 0, 1 or 2 in x and y, fitted by least squares.

    Raises
    ------
    ValueError
        If `kind` is unknown or the heights are not finite and 2D.
    """
    degrees = {"mean": 0, "plane": 1, "quadratic": 2}
    if kind not in degrees:
        raise ValueError(f"detrend must be one of {sorted(degrees)}, got {kind!r}")
    heights = np.asarray(heights, dtype=float)
    if heights.ndim != 2 or not np.all(np.isfinite(heights)):
        raise ValueError(f"heights must be 2D and finite, got shape {heights.shape}")
    degree = degrees[kind]
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


def fill_missing(
    heights: NDArray, max_missing: float = MAX_MISSING, source: str = "heights"
) -> tuple[NDArray, int]:
    """Fill points that are not finite with the harmonic function of their neighbours.

    Each filled point is the mean of its (up to four) neighbours: no new extremes, and a plane
    goes on as a plane.

    Returns
    -------
    filled : (nx, ny) array
        Copy without missing points.
    missing : int
        How many there were.

    Raises
    ------
    ValueError
        If more than the share `max_missing` of the points are missing; `source` is named.
    """
    hole = ~np.isfinite(heights)
    missing = int(np.count_nonzero(hole))
    share = missing / heights.size
    if missing == heights.size or share > max_missing:
        raise ValueError(
            f"{source}: {missing} of {heights.size} points ({share:.1%}) are missing, more than "
            f"the {max_missing:.1%} that are filled; crop the data, measure again or raise "
            "max_missing"
        )
    if not missing:
        return np.array(heights, dtype=float), 0
    filled = np.where(hole, 0.0, heights)
    filled[hole] = _harmonic(filled, hole)
    return filled, missing


def _harmonic(heights: NDArray, hole: NDArray) -> NDArray:
    """Solve Laplace's equation on the holes; the grid's edge carries no condition."""
    index = np.full(hole.shape, -1)
    index[hole] = np.arange(np.count_nonzero(hole))
    neighbours = ndimage.convolve(
        np.ones(hole.shape), np.array([[0, 1, 0], [1, 0, 1], [0, 1, 0]]), mode="constant"
    )
    known = np.zeros(np.count_nonzero(hole))
    rows, columns = [], []
    for axis in (0, 1):
        here, there = np.moveaxis(index, axis, 0)[:-1], np.moveaxis(index, axis, 0)[1:]
        value = np.moveaxis(heights, axis, 0)
        both = (here >= 0) & (there >= 0)
        rows += [here[both], there[both]]
        columns += [there[both], here[both]]
        edge = (here >= 0) & (there < 0)
        np.add.at(known, here[edge], value[1:][edge])
        edge = (here < 0) & (there >= 0)
        np.add.at(known, there[edge], value[:-1][edge])
    rows, columns = np.concatenate(rows), np.concatenate(columns)
    coupling = sparse.csr_array((np.ones(len(rows)), (rows, columns)), shape=(len(known),) * 2)
    laplacian = sparse.csc_array(sparse.diags_array(neighbours[hole]) - coupling)
    return linalg.spsolve(laplacian, known)
