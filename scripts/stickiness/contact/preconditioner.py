"""Preconditioner of the repulsive contact problem: an approximate inverse of the compliance.

The exact inverse is the stiffness, ``|q| / 2`` of a half-space, between an extension of the
displacement beyond the edge of contact and the transpose of that extension: that of least energy,
under which the free surface holds nothing. Next to a straight edge it weights what the contact does
by the inverse square of the distance (Poisson's kernel of the root of the Laplacian; Landkof,
*Foundations of Modern Potential Theory*, 1972). A mean with such weights stands for it, taken on a
grid of a sixteenth of the points.
"""

import numpy as np
from scipy import sparse

from stickiness.contact import convolution, half_space

_SPACING = 4  # of the grid of the extension, in pixels
_OWN = 8.0  # weight of a point of that grid beside its next one: 2 to 16 do about equally well
_REST = 0.3  # weight of rest: far from all contact the extension vanishes


class Preconditioner:
    """Stiffness between an extension of the residual beyond contact and its transpose."""

    def __init__(self, grid, points):
        self.grid, self.quick = grid, grid.quick
        self.points = points
        self.rows = grid.rows(points)
        self.mean = None
        if points.size < grid.heights.size:
            self.mean = _kept_mean(tuple(grid.shape), tuple(grid.sides))
            self.quick.field[points] = 1
            self.weights = self.mean.apply(self.quick.field.reshape(grid.shape))
            self.quick.field[points] = 0
            self.weights += np.float32(_REST)
            np.divide(1, self.weights, out=self.weights)
            self.weights.ravel()[points] = 0
            grid.spent += 1 / _SPACING**2

    def __call__(self, residual):
        """Approximate pressure for a displacement of the points, both in single precision."""
        quick, points = self.quick, self.points
        stiffness = quick.operator.stiffness
        if self.mean is None:
            return quick.apply(stiffness, points, residual, self.rows, self.rows)[points]
        field, image = quick.field.reshape(quick.shape), quick.image.reshape(quick.shape)
        quick.field[points] = residual
        np.multiply(self.mean.apply(field), self.weights, out=image)
        quick.image[points] = residual
        stiffness(image, field)
        np.multiply(field, self.weights, out=image)
        pressure = self.mean.apply(image).ravel()[points]
        pressure += quick.field[points]
        quick.field[:] = 0
        self.grid.spent += 2 / _SPACING**2
        return pressure

    def compliance(self, values):
        """Displacement of the points under a pressure on them, both in single precision."""
        quick, rows = self.quick, self.rows
        return quick.apply(quick.operator.compliance, self.points, values, rows, rows)[self.points]


class _Mean:
    """Sums weighted by the inverse square of the distance, smooth over a few pixels."""

    def __init__(self, shape, sides):
        self.coarse = tuple(-(-n // _SPACING) for n in shape)
        self._spread = [_interpolation(n, m) for n, m in zip(shape, self.coarse, strict=True)]
        self._gather = [matrix.T.tocsr() for matrix in self._spread]
        steps = [a / m for a, m in zip(sides, self.coarse, strict=True)]
        axes = [np.fft.fftfreq(m, 1 / m) * step for m, step in zip(self.coarse, steps, strict=True)]
        square = np.add.outer(axes[0] ** 2, axes[1] ** 2) / (steps[0] * steps[1])
        square[0, 0] = 1 / _OWN
        symbol = np.fft.rfft2(1 / square).real / square.size / _SPACING**2
        self._convolution = convolution.choose(self.coarse, np.float32)
        self._symbol = self._convolution.symbol(symbol.T)
        self._image = np.zeros(self.coarse, np.float32)
        self._every = np.arange(self.coarse[0])

    def apply(self, field):
        """Sums at all points of a grid, in single precision."""
        coarse = np.ascontiguousarray((self._gather[1] @ (self._gather[0] @ field).T).T)
        self._convolution.apply(self._symbol, coarse, self._image, self._every, self._every)
        return self._spread[0] @ np.ascontiguousarray((self._spread[1] @ self._image.T).T)


_kept_mean = half_space.keep_per_thread(12)(_Mean)


def _interpolation(n, m):
    """Matrix of linear interpolation along a periodic axis, from m points to n."""
    position = (np.arange(n) + 0.5) * (m / n) - 0.5
    left = np.floor(position).astype(np.int32)
    t = (position - left).astype(np.float32)
    columns = np.stack([left % m, (left + 1) % m], axis=1)
    weights = np.stack([1 - t, t], axis=1)
    starts = np.arange(0, 2 * n + 1, 2)
    return sparse.csr_array((weights.ravel(), columns.ravel(), starts), shape=(n, m))
