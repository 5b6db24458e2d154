"""Preconditioned conjugate gradients on a given set of contact points.

The inverse of the compliance on these points is the stiffness, ``|q| / 2`` for a half-space,
between an extension of the displacement beyond the edge of contact and its transpose. The extension
is the one of least energy, under which the free surface carries no pressure. At a straight edge it
weights the displacement in contact by the inverse square of the distance (Landkof, *Foundations of
Modern Potential Theory*, 1972). A mean with such weights on a coarser grid approximates it.
"""

import numpy as np

from stickiness.repulsive import convolution, half_space, halving, sharing

_SPACING = 4  # of the grid of the extension, in pixels: a grid halved twice
_SELF_WEIGHT = 8.0  # of a point of that grid; 1 is the weight of its neighbour, 2 to 16 do as well
_FAR_WEIGHT = 0.3  # of a zero at infinity: far from all contact the extension vanishes
_SMALLEST_REDUCTION = 1e-4  # of the gap, by a correction in single precision


def close_gap(precondition, compliance, residual, goal, largest, limit):
    """Change of pressure, of zero sum, that closes the gap on a set of points; and iterations.

    In single precision until the rms residual (or the `largest`) is down to `goal`. Both operators
    are on these points. Overwrites `residual`.
    """
    change = np.zeros(residual.size, np.float32)
    count = 1
    if residual.size == 1 or not residual.any():
        return change, count
    goal = max(goal, _SMALLEST_REDUCTION)
    direction = None
    product = 1.0
    while True:
        # Preconditioned residual, without the mean that would change the load.
        z = precondition(residual)
        z -= z.mean()
        last_product = product
        product = float(residual @ z)
        if not product > 0:  # nothing but rounding is left
            break
        # Conjugate direction, and the step along it that minimises the energy.
        if direction is None:
            direction = z
        else:
            direction *= np.float32(product / last_product)
            direction += z
        image = compliance(direction)
        step = np.float32(product / float(direction @ image))
        change += step * direction
        image *= step
        residual -= image
        residual -= residual.mean()
        norm = np.abs(residual).max() if largest else np.sqrt(np.mean(residual**2))
        if norm <= goal or count >= limit:
            break
        count += 1
    return change, count


class Preconditioner:
    """Stiffness between an extension of the residual beyond contact and its transpose."""

    def __init__(self, grid, points):
        self.grid = grid
        self.quick = grid.quick
        self.points = points
        self.rows = grid.rows(points)
        self.mean = None
        if points.size < grid.heights.size:
            self.mean = half_space.keep(_Mean, tuple(grid.shape), tuple(grid.sides))
            sharing.evaluate(lambda: 0, grid.scratch)
            sharing.put(grid.scratch, points, 1)
            self.mean.gather(grid.scratch.reshape(grid.shape))
            self.weights = np.empty(grid.shape, np.float32)
            self.mean.spread(self.weights)
            flat = self.weights.ravel()
            sharing.evaluate(lambda w: 1 / (w + np.float32(_FAR_WEIGHT)), flat, flat)
            sharing.put(flat, points, 0)
            grid.spent += 1 / _SPACING**2

    def __call__(self, residual):
        """Approximate pressure for a displacement of the points, both in single precision."""
        quick = self.quick
        points = self.points
        stiffness = quick.operator.stiffness
        if self.mean is None:
            image = quick.apply(stiffness, points, residual, self.rows, self.rows)
            return sharing.take(image, points)
        scratch = self.grid.scratch
        field = scratch.reshape(quick.shape)
        image = quick.image.reshape(quick.shape)
        # Extend the displacement beyond contact by weighted means.
        sharing.evaluate(lambda: 0, scratch)
        sharing.put(scratch, points, residual)
        self.mean.gather(field)
        self.mean.spread(image)
        sharing.evaluate(np.multiply, quick.image, quick.image, self.weights.ravel())
        sharing.put(quick.image, points, residual)
        # Stiffness, and the transpose of the extension.
        stiffness(image, field)
        pressure = sharing.take(scratch, points)
        sharing.evaluate(np.multiply, scratch, scratch, self.weights.ravel())
        self.mean.gather(field)
        self.mean.spread(image)
        pressure += sharing.take(quick.image, points)
        self.grid.spent += 2 / _SPACING**2
        return pressure

    def compliance(self, values):
        """Displacement of the points under a pressure on them, both in single precision."""
        compliance = self.quick.operator.compliance
        image = self.quick.apply(compliance, self.points, values, self.rows, self.rows)
        return sharing.take(image, self.points)


class _Mean:
    """Sums weighted by the inverse square of the distance, smooth over a few pixels."""

    def __init__(self, shape, sides):
        self._half = tuple(map(half_space.coarsen, shape))
        coarse = tuple(map(half_space.coarsen, self._half))
        # Inverse square of the distance on the coarse grid, over the square of its spacing.
        steps = [_SPACING * side / n for n, side in zip(shape, sides, strict=True)]
        axes = [np.fft.fftfreq(m, 1 / m) * step for m, step in zip(coarse, steps, strict=True)]
        square = np.add.outer(axes[0] ** 2, axes[1] ** 2) / (steps[0] * steps[1])
        square[0, 0] = 1 / _SELF_WEIGHT
        symbol = np.fft.rfft2(1 / square).real / square.size
        # Halved twice, sums are 16 times those of linear interpolation and of its transpose.
        symbol /= 16**2 * _SPACING**2
        self._convolution = convolution.convolution(coarse, np.float32)
        self._symbol = self._convolution.symbol(symbol[: coarse[0] // 2 + 1].T)
        self._image = np.zeros(coarse, np.float32)

    def gather(self, field):
        """Take the sums of a field in single precision."""
        coarse = halving.gather(halving.gather(field))
        self._convolution.apply(self._symbol, coarse, self._image)

    def spread(self, out):
        """Fill in the sums at all points of a grid."""
        half = np.zeros(self._half, np.float32)
        halving.spread(self._image, half)
        out[...] = 0
        halving.spread(half, out)
