"""Periodic grids: sides of the cell, scale of the heights, fields on coarser and finer grids."""

import numpy as np

from stickiness.arguments import positive


def check_length(length, shape):
    """Sides of a cell of `shape` points from one (pixels are then square) or both, checked."""
    (sides,) = positive(length=length)
    if sides.size == 1:
        side = float(sides.ravel()[0])
        return side, side * shape[1] / shape[0]
    if sides.shape != (2,):
        raise ValueError(f"length must be one or two positive numbers, got {length!r}")
    return float(sides[0]), float(sides[1])


def measure_scale(heights):
    """Mean and root mean square about it, safe from overflow and underflow of the squares."""
    mean = float(heights.mean())
    deviation = heights - mean
    largest = max(float(deviation.max()), -float(deviation.min()))
    # Heights that differ by rounding only are flat.
    if largest <= 8 * np.finfo(float).eps * abs(mean):
        return mean, 0.0
    deviation /= largest
    deviation *= deviation
    return mean, largest * float(np.sqrt(np.mean(deviation)))


def measure_slope(heights, lengths):
    """Root mean square gradient of periodic heights, from differences of neighbours."""
    square = 0.0
    for axis, side in enumerate(lengths):
        step = np.diff(heights, axis=axis, append=np.take(heights, [0], axis))
        square += float(np.mean(step**2)) * (heights.shape[axis] / side) ** 2
    return float(np.sqrt(square))


def coarsen(n):
    """Points along an axis of the next coarser grid."""
    return (n + 1) // 2


def sample(field, shape):
    """Sample a periodic field on a grid about half as fine."""
    if all(n == 2 * m for n, m in zip(field.shape, shape, strict=True)):
        return np.ascontiguousarray(field[::2, ::2])
    return interpolate(field, shape)


def interpolate(field, shape):
    """Interpolate a periodic field by cubics along both axes, onto a grid of any shape."""
    for axis, n in enumerate(shape):
        if n == 2 * field.shape[axis]:
            field = _double(field, axis)
        elif n != field.shape[axis]:
            field = _resample(field, n, axis)
    return field


def _double(field, axis):
    """Put a point between any two, on the cubic through its four neighbours."""
    between = field + np.roll(field, -1, axis)
    between *= 9
    between -= np.roll(field, 1, axis)
    between -= np.roll(field, -2, axis)
    between /= 16
    shape = list(field.shape)
    shape[axis] *= 2
    fine = np.empty(shape, field.dtype)
    even, odd = [slice(None)] * 2, [slice(None)] * 2
    even[axis], odd[axis] = slice(0, None, 2), slice(1, None, 2)
    fine[tuple(even)] = field
    fine[tuple(odd)] = between
    return fine


def _resample(field, n, axis):
    """Sample at n points the cubics through any four neighbours."""
    m = field.shape[axis]
    position = np.arange(n) * (m / n)
    left = np.floor(position).astype(int)
    t = position - left
    weights = {
        -1: -t * (t - 1) * (t - 2) / 6,
        0: (t + 1) * (t - 1) * (t - 2) / 2,
        1: -(t + 1) * t * (t - 2) / 2,
        2: (t + 1) * t * (t - 1) / 6,
    }
    total = 0.0
    for offset, weight in weights.items():
        weight = weight[:, None] if axis == 0 else weight
        total = total + weight * np.take(field, (left + offset) % m, axis=axis)
    return total.astype(field.dtype)
