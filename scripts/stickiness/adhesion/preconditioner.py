"""Preconditioner of the descents: an approximate inverse of the stiffness of the free points.

Most of the inverse is in long waves, so that it is applied on a grid half as fine: its transforms
are four times smaller. At the edge of contact the wall takes a share of a force.
"""

import numpy as np
from scipy import sparse

from stickiness.contact import convolution, half_space
from stickiness.solids import HALF_SPACE

LONGEST = np.pi  # |q| / 2 of the longest wave across a side of 1
# Yield of short waves over that of the shortest on its own; 1 to 2 do about equally well.
_SHORT = 1.6
_SHARE = 0.5  # of a force beside the wall that the wall takes
_DIAGONAL = 0.6  # weight of a diagonal neighbour beside a direct one


class Smoother:
    """Convolution with about ``1 / (|q| / 2 + shift)`` in single precision; counts its `pairs`.

    The shift is the stiffness of the longest wave, of a layer that of its softest (long waves of a
    thin incompressible one are the stiffest): it stands for the grip of what touches on the mean
    gap, which no elasticity holds. On an even grid this is ``constant + B apply B^T``, where B is
    the incidence of its points and the four coarse points around each (some may coincide).
    """

    def __init__(self, shape, sides, solid):
        stiffness = half_space.effective_wavenumbers(shape, sides, solid).T / 2
        self.shift = LONGEST
        if solid != HALF_SPACE and stiffness.any():
            self.shift = float(stiffness[stiffness > 0].min())
        self._halved = min(shape) >= 4 and shape[0] % 2 == 0 and shape[1] % 2 == 0
        if self._halved:
            self._constant = np.float32(_SHORT / (stiffness.max() + self.shift))
            shape = tuple(n // 2 for n in shape)
            stiffness = half_space.effective_wavenumbers(shape, sides, solid).T / 2
        symbol = 1 / (stiffness + self.shift)
        if self._halved:
            # Squared transfer of full weighting, summed over the aliases along each axis; that is
            # B^T / 16, and interpolation is B / 4.
            weights = [(1 + np.cos(np.pi * np.fft.fftfreq(n)) ** 2) / 2 for n in shape]
            symbol -= self._constant
            symbol /= 64 * np.outer(weights[1][: symbol.shape[0]], weights[0])
        self._convolution = convolution.choose(shape, np.float32)
        self._every = np.arange(shape[0])
        self._symbol = self._convolution.symbol(symbol / (shape[0] * shape[1]))
        self.pairs = 0.0  # in units of the grid of the fields

    def apply(self, field):
        """Convolve a field in single precision."""
        values = _gather(field) if self._halved else field
        out = np.empty_like(values)
        self._convolution.apply(self._symbol, values, out, self._every, self._every)
        self.pairs += out.size / field.size
        if self._halved:
            out = _spread(out)
            out += self._constant * field
        return out


class Preconditioner:
    """Approximate inverse of the stiffness of the free points."""

    def __init__(self, surface, free):
        self.smooth, self.edge = surface.smoother.apply, None
        if not free.all() and free.any():
            self.band, columns, weights = average_neighbours(free.ravel(), free.shape)
            self.edge = build_neighbour_matrix(weights * np.float32(-_SHARE), columns, free.size)
            self.transpose = self.edge.T

    def __call__(self, force):
        """Step for a force that is zero on all but free points."""
        if self.edge is None:
            return self.smooth(force)
        force = force.copy()
        flat = force.ravel()
        flat[self.band] += self.edge @ flat
        step = self.smooth(force)
        flat = step.ravel()
        flat += self.transpose @ flat[self.band]
        return step


def _gather(field):
    """Sums over the points around each coarse one, ``B^T field``."""
    for axis in (0, 1):
        even, odd = _split(field, axis)
        field = np.roll(odd, 1, axis)
        field += odd
        field += even
        field += even
    return field


def _spread(coarse):
    """Sums over the coarse points around each point, ``B coarse``."""
    for axis in (1, 0):
        shape = list(coarse.shape)
        shape[axis] *= 2
        out = np.empty(shape, coarse.dtype)
        even, odd = _split(out, axis)
        np.add(coarse, coarse, out=even)
        np.add(coarse, np.roll(coarse, -1, axis), out=odd)
        coarse = out
    return coarse


def _split(field, axis):
    """Views of every second row or column, and of those between."""
    return (field[::2], field[1::2]) if axis == 0 else (field[:, ::2], field[:, 1::2])


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
