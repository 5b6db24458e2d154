"""Preconditioner of the repulsive contact problem: an approximate inverse of the compliance.

The inverse in full contact is the stiffness, ``|q| / 2`` of a half-space. On a contact set it acts
between an extension of the residual beyond the edge of contact and the transpose of that
extension. On an even grid `CoarseStiffness` stands for it: transforms are four times smaller, at
the price of one or two iterations more.
"""

import numpy as np
import pyfftw
from scipy import sparse

from stickiness.contact import convolution, half_space

_EXTENSION = 0.8  # weight of the residual extended beyond the edge of contact
_DIAGONAL = 0.6  # weight of a diagonal neighbour beside a direct one
_DENSE = 0.3  # share of contact above which the exact stiffness is as cheap
_SHORT = 0.9  # stiffness of all short waves over that of the shortest


class CoarseStiffness:
    """Approximate stiffness ``constant + B apply B^T``, most of it on a grid half as fine.

    B is the incidence of the points of the fine grid (of even sides) and the four coarse points
    around each (some may coincide). In single precision this is ``|q| / 2`` for long waves, but for
    aliases, and the constant, 0.9 of the stiffness of the shortest wave, for short ones; the
    stiffness of another solid likewise.
    """

    def __init__(self, shape, lengths, solid):
        self.shape = tuple(n // 2 for n in shape)
        self.applications = 0
        # Squared transfer of full weighting, summed over the aliases along each axis.
        weights = [(1 + np.cos(np.pi * np.fft.fftfreq(n)) ** 2) / 2 for n in self.shape]
        q = half_space.effective_wavenumbers(self.shape, lengths, solid)
        shortest = np.pi * np.hypot(shape[0] / lengths[0], shape[1] / lengths[1])
        shortest /= solid.factor(shortest)
        constant = _SHORT * shortest / 2
        symbol = (q / 2 - constant) / np.outer(weights[0], weights[1][: q.shape[1]])
        # full weighting is B^T / 16 and interpolation B / 4
        symbol /= 64 * self.shape[0] * self.shape[1]
        self.constant = np.float32(constant)
        self._convolution = convolution.choose(self.shape, np.float32)
        self._symbol = self._convolution.symbol(symbol.T)
        self._every = np.arange(self.shape[0])
        self._image = pyfftw.zeros_aligned(self.shape, np.float32)

    def apply(self, field):
        """Convolve values at all points of the coarse grid; the next call overwrites the result."""
        field = field.reshape(self.shape)
        self._convolution.apply(self._symbol, field, self._image, self._every, self._every)
        self.applications += 1
        return self._image.ravel()


def coarse_stiffness(shape, lengths, solid):
    """`CoarseStiffness` of a grid, kept for the next call; None for a grid it does not suit."""
    if min(shape) < 4 or shape[0] % 2 or shape[1] % 2:
        return None
    return _kept_coarse_stiffness(tuple(shape), tuple(lengths), solid)


_kept_coarse_stiffness = half_space.keep_per_thread(12)(CoarseStiffness)


class Preconditioner:
    """Stiffness between an extension of the residual beyond contact and its transpose.

    The exact inverse extends the residual by the displacement of least energy; a weighted mean
    over the neighbours in contact imitates that next to the edge, where it matters.
    """

    def __init__(self, grid, points):
        self.quick = grid.quick
        self.points = points
        self.inner_rows = grid.rows(points)
        self.extension = None
        self.every = points
        if points.size < grid.heights.size:
            self._extend(grid)
        self.coarse, self.corners = grid.coarse, None
        if self.coarse is None or points.size > _DENSE * grid.heights.size:
            self.rows = grid.rows(self.every)
        else:
            self.corners = _corners(self.every, grid.shape)
            self.restrict = self.corners.T

    def _extend(self, grid):
        points = self.points
        grid.active[points] = True
        band, columns, weights = average_neighbours(grid.active, grid.shape)
        grid.active[points] = False
        position = grid.quick.image.view(np.int32)  # scratch: not in use here
        position[points] = np.arange(points.size, dtype=np.int32)
        self.extension = build_neighbour_matrix(
            weights * np.float32(_EXTENSION), position[columns], points.size
        )
        self.transpose = self.extension.T
        self.every = np.concatenate([points, band])

    def __call__(self, residual):
        """Approximate pressure for a displacement of the points, both in single precision."""
        if self.extension is None:
            return self._stiffness(residual)
        image = self._stiffness(np.concatenate([residual, self.extension @ residual]))
        count = self.points.size
        return image[:count] + self.transpose @ image[count:]

    def compliance(self, values):
        """Displacement of the points under a pressure on them, both in single precision."""
        quick, rows = self.quick, self.inner_rows
        return quick.apply(quick.operator.compliance, self.points, values, rows, rows)[self.points]

    def _stiffness(self, values):
        if self.corners is None:
            stiffness = self.quick.operator.stiffness
            return self.quick.apply(stiffness, self.every, values, self.rows, self.rows)[self.every]
        image = self.corners @ self.coarse.apply(self.restrict @ values)
        image += self.coarse.constant * values
        return image


def average_neighbours(active, shape):
    """Points beside an active set (flat, periodic, not empty), and means over active neighbours.

    Returns their flat indices and, of shape ``(band.size, 8)``, flat indices of active points and
    their weights: zero for a neighbour that is not active, their sum below one.
    """
    band = np.flatnonzero(_surroundings(active.reshape(shape)))
    first = int(np.argmax(active))
    columns = np.zeros((band.size, 8), np.int32)
    weights = np.zeros((band.size, 8), np.float32)
    for i, (neighbour, weight) in enumerate(_neighbours(band, shape)):
        touching = active[neighbour]
        weights[:, i] = np.float32(weight) * touching
        columns[:, i] = np.where(touching, neighbour, first)
    weights /= 1 + weights.sum(axis=1, keepdims=True)
    return band, columns, weights


def build_neighbour_matrix(weights, columns, width):
    """Sparse matrix of eight entries a row, those of neighbours that do not count being zero."""
    starts = np.arange(0, weights.size + 1, 8, dtype=np.int32)
    shape = (weights.shape[0], width)
    return sparse.csr_array((weights.ravel(), columns.ravel(), starts), shape=shape)


def _surroundings(active):
    """Points of a periodic grid that are not active but next to one that is."""
    reached = active.copy()
    for axis in (0, 1):
        a, b = np.moveaxis(reached, axis, 0), np.moveaxis(reached.copy(), axis, 0)
        a[1:] |= b[:-1]
        a[:-1] |= b[1:]
        a[0] |= b[-1]
        a[-1] |= b[0]
    reached &= ~active
    return reached


def _corners(points, shape):
    """Incidence of points and the four (not always different) points of the coarse grid around."""
    m0, m1 = shape[0] // 2, shape[1] // 2
    row, column = np.divmod(points.astype(np.int32), np.int32(shape[1]))
    indices = np.empty((points.size, 4), np.int32)
    for i in (0, 1):
        start = (row + i) // 2 % m0 * m1
        for j in (0, 1):
            np.add(start, (column + j) // 2 % m1, out=indices[:, 2 * i + j])
    starts = np.arange(0, 4 * points.size + 1, 4, dtype=np.int32)
    ones = np.ones(4 * points.size, np.float32)
    return sparse.csr_array((ones, indices.ravel(), starts), shape=(points.size, m0 * m1))


def _neighbours(points, shape):
    """Flat indices of the eight periodic neighbours of points, each with its weight."""
    n0, n1 = shape
    column = points % n1
    first, last = np.flatnonzero(column == 0), np.flatnonzero(column == n1 - 1)
    for i in (-1, 0, 1):
        row = points + i * n1
        if i < 0:
            row[row < 0] += n0 * n1
        elif i > 0:
            row[row >= n0 * n1] -= n0 * n1
        left, right = row - 1, row + 1
        left[first] += n1
        right[last] -= n1
        if i:
            yield row, 1.0
        yield left, _DIAGONAL if i else 1.0
        yield right, _DIAGONAL if i else 1.0
