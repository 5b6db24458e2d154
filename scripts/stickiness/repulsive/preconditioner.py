"""Preconditioned conjugate gradients on a given set of contact points.

The inverse of the compliance on these points is the stiffness, ``|q| / 2`` for a half-space,
between an extension of the displacement beyond the edge of contact and its transpose. The extension
is the one of least energy, under which the free surface carries no pressure. At a straight edge it
weights the displacement in contact by the inverse square of the distance (Landkof, *Foundations of
Modern Potential Theory*, 1972). A mean with such weights on a coarser grid approximates it.
"""

import numpy as np

from stickiness.compiled import compiled
from stickiness.repulsive import convolution, half_space, sharing

_SPACING = 4  # of the grid of the extension, in pixels
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
            self.mean.spread(None, self.weights)
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
        self.mean.spread(self.weights, image)
        sharing.put(quick.image, points, residual)
        # Stiffness, and the transpose of the extension.
        stiffness(image, field)
        self.mean.gather(field, self.weights)
        pressure = self.mean.at(points)
        pressure += sharing.take(scratch, points)
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
        coarse = tuple(-(-n // _SPACING) for n in shape)
        self._axes = [_interpolation(n, m) for n, m in zip(shape, coarse, strict=True)]
        self._transposed = [
            _transpose(left, right, t, m)
            for (left, right, t), m in zip(self._axes, coarse, strict=True)
        ]
        # Inverse square of the distance on the coarse grid.
        steps = [side / m for side, m in zip(sides, coarse, strict=True)]
        axes = [np.fft.fftfreq(m, 1 / m) * step for m, step in zip(coarse, steps, strict=True)]
        square = np.add.outer(axes[0] ** 2, axes[1] ** 2) / (steps[0] * steps[1])
        square[0, 0] = 1 / _SELF_WEIGHT
        symbol = np.fft.rfft2(1 / square).real / square.size / _SPACING**2
        self._convolution = convolution.convolution(coarse, np.float32)
        self._symbol = self._convolution.symbol(symbol[: coarse[0] // 2 + 1].T)
        self._field = np.zeros(coarse, np.float32)
        self._image = np.zeros(coarse, np.float32)

    def gather(self, field, weights=None):
        """Take the sums of a field in single precision, or of its product with weights."""
        axis0, axis1 = self._transposed

        def add(rows):
            _add_to_coarse(rows.start, field, weights, axis0, axis1, self._field[rows])

        sharing.spread(add, size=len(self._field), width=_SPACING * field.shape[1])
        self._convolution.apply(self._symbol, self._field, self._image)

    def spread(self, weights, out):
        """Sums at all points of a grid, times weights if any."""
        axis0, axis1 = self._axes

        def fill(rows):
            _interpolate(rows.start, self._image, axis0, axis1, weights, out[rows])

        sharing.spread(fill, size=out.shape[0], width=out.shape[1])

    def at(self, points):
        """Sums at some points, given by flat indices."""
        axis0, axis1 = self._axes
        out = np.empty(points.size, np.float32)

        def fill(chunk):
            _interpolate_at(points[chunk], self._image, axis0, axis1, out[chunk])

        sharing.spread(fill, points.size)
        return out


def _interpolation(n, m):
    """Linear interpolation along a periodic axis from m points to n: both neighbours, a weight."""
    position = (np.arange(n) + 0.5) * (m / n) - 0.5
    left = np.floor(position).astype(np.int64)
    return left % m, (left + 1) % m, (position - left).astype(np.float32)


def _transpose(left, right, t, m):
    """For each of m points those interpolated from it, and with what weights; a row each."""
    source = np.concatenate([left, right])
    weights = np.concatenate([1 - t, t])
    # Sorted by the point that they come from; `place` counts within each of these.
    order = np.argsort(source, kind="stable")
    count = np.bincount(source, minlength=m)
    place = np.arange(source.size) - np.repeat(np.cumsum(count) - count, count)
    points = np.zeros((m, count.max()), np.int64)
    shares = np.zeros(points.shape, np.float32)
    points[source[order], place] = order % left.size
    shares[source[order], place] = weights[order]
    return points, shares


@compiled
def _add_to_coarse(first, field, weights, axis0, axis1, coarse):
    """Transpose of an interpolation of a field, or times weights: rows from a first one on."""
    points0, shares0 = axis0
    points1, shares1 = axis1
    row = np.empty(field.shape[1], field.dtype)
    for a in range(coarse.shape[0]):
        row[:] = 0
        for k in range(points0.shape[1]):
            i = points0[first + a, k]
            share = shares0[first + a, k]
            for j in range(row.size):
                row[j] += share * (field[i, j] if weights is None else field[i, j] * weights[i, j])
        for b in range(coarse.shape[1]):
            total = np.float32(0)
            for k in range(points1.shape[1]):
                total += shares1[b, k] * row[points1[b, k]]
            coarse[a, b] = total


@compiled
def _interpolate(first, coarse, axis0, axis1, weights, out):
    """Interpolate rows, from a first one on; times weights of the whole grid if any."""
    left0, right0, t0 = axis0
    left1, right1, t1 = axis1
    beside = np.empty((2, left1.size), coarse.dtype)
    before = -1
    for i in range(out.shape[0]):
        if left0[first + i] != before:  # the next coarse row, stretched, or at first two of them
            for k in range(-1 if i == 0 else 0, 1):
                row = coarse[left0[first] if k < 0 else right0[first + i]]
                beside[0] = beside[1]
                for j in range(left1.size):
                    a = row[left1[j]]
                    beside[1, j] = a + t1[j] * (row[right1[j]] - a)
            before = left0[first + i]
        for j in range(left1.size):
            value = beside[0, j] + t0[first + i] * (beside[1, j] - beside[0, j])
            out[i, j] = value if weights is None else value * weights[first + i, j]


@compiled
def _interpolate_at(points, coarse, axis0, axis1, out):
    """Interpolate at some points, given by flat and increasing indices."""
    left0, right0, t0 = axis0
    left1, right1, t1 = axis1
    i = 0
    begin = 0
    for k in range(points.size):
        if points[k] >= begin + left1.size:
            i = points[k] // left1.size
            begin = i * left1.size
        j = points[k] - begin
        a = left1[j]
        b = right1[j]
        upper = coarse[left0[i], a] + t1[j] * (coarse[left0[i], b] - coarse[left0[i], a])
        lower = coarse[right0[i], a] + t1[j] * (coarse[right0[i], b] - coarse[right0[i], a])
        out[k] = upper + t0[i] * (lower - upper)
