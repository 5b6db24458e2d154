"""Grids and the Fourier operators of an elastic solid: periodic, mirrored or with free edges.

A pressure wave ``p_q`` (in units of E*) displaces a half-space by ``u_q = 2 p_q / |q|``, q != 0
(Johnson, *Contact Mechanics*, 1985, section 13.2; Stanley and Kato, J. Tribol. 119:481, 1997,
doi 10.1115/1.2833523), and a layer by S times that, see `solids`.
"""

import math
import threading
from dataclasses import dataclass
from functools import cache, cached_property, lru_cache

import numpy as np
from scipy import fft

from stickiness.repulsive import convolution, free_edges, sharing
from stickiness.repulsive.free_edges import displace_by_pixel
from stickiness.solids import HALF_SPACE

# Objects kept of one kind, of all threads: many operators of half-spaces, few others.
_FEW = 12
_MANY = 24
_PATCH = 64  # pixels along the sides of a grid whose mean stiffness is that of any


def keep(kind, *arguments, most=_FEW):
    """Object of a kind, kept for the next call: threads must not share plans and buffers."""
    return _last(kind, most)(threading.get_ident(), *arguments)


@cache
def _last(kind, most):
    """Function that keeps the last objects of a kind."""
    return lru_cache(maxsize=most)(lambda thread, *arguments: kind(*arguments))


def clear_caches():
    """Free the plans and buffers of all objects that are kept."""
    _last.cache_clear()


def wavenumbers(shape, lengths, mirrored=False):
    """Magnitudes ``|q|`` of one quadrant of wave vectors, ``(n0 // 2 + 1, n1 // 2 + 1)``.

    Or those of the cosines of a cell that is `mirrored`, ``(n0, n1)``: its period has twice the
    sides.
    """
    if mirrored:
        steps = [np.pi / side for side in lengths]
        return np.hypot.outer(*(step * np.arange(n) for step, n in zip(steps, shape, strict=True)))
    q0 = 2 * np.pi * np.fft.rfftfreq(shape[0], lengths[0] / shape[0])
    q1 = 2 * np.pi * np.fft.rfftfreq(shape[1], lengths[1] / shape[1])
    return np.hypot.outer(q0, q1)


def effective_wavenumbers(shape, lengths, solid=HALF_SPACE, mirrored=False):
    """Wave numbers ``|q|``/S, zero at q = 0, at which a half-space is as stiff as the solid."""
    q = wavenumbers(shape, lengths, mirrored)
    if solid != HALF_SPACE:
        q[0, 0] = 1.0
        q /= solid.factor(q)
        q[0, 0] = 0.0
    return q


@dataclass(frozen=True, eq=False)
class _Kernel:
    """A convolution, and the symbol of what a field is convolved with."""

    convolution: (
        convolution.WholeConvolution
        | convolution.MirroredConvolution
        | convolution.BlockedConvolution
    )
    symbol: object


class HalfSpace:
    """Compliance ``2 S/|q|`` of a periodic solid and its inverse, the stiffness, but for q = 0.

    It counts its convolutions in `pairs`. `mean_stiffness` is the diagonal of the stiffness matrix:
    pressure under a pixel lifted alone, per unit of lift. No two threads may use it at once.
    """

    mirrored = False  #: whether the period has twice the sides, and fields are even there

    def __init__(self, shape, lengths, dtype, solid):
        self.dtype = np.dtype(dtype)
        self.shape = shape
        self.lengths = lengths
        self.solid = solid
        self.pairs = 0
        n0, n1 = shape
        # FFTW does not normalise; the symbols carry the 1 / (n0 n1) of the inverse transform.
        q = effective_wavenumbers(shape, lengths, solid, self.mirrored).T
        # Waves mirror one another but for the first and a last along each axis.
        half0, half1 = (n if self.mirrored else n / 2 for n in shape)
        across = np.where(np.arange(q.shape[0]) % half1, 2.0, 1.0)
        along = np.where(np.arange(q.shape[1]) % half0, 2.0, 1.0)
        self.mean_stiffness = float(across @ q @ along) / (8 * half0 * half1)
        q[0, 0] = np.inf
        np.divide(2 / (n0 * n1), q, out=q)
        self._compliance = _Kernel(self._convolution, self._convolution.symbol(q))

    # Made on demand: some methods do not need it, and in double precision hardly any the stiffness.
    @cached_property
    def _convolution(self):
        return convolution.convolution(self.shape, self.dtype, self.mirrored)

    @cached_property
    def _stiffness(self):
        q = effective_wavenumbers(self.shape, self.lengths, self.solid, self.mirrored).T
        q /= 2 * self.shape[0] * self.shape[1]
        return _Kernel(self._convolution, self._convolution.symbol(q))

    def compliance(self, pressure, out=None, rows_in=None, rows_out=None):
        """Displacement under a pressure [E*], in the unit of `lengths` and, if periodic, of mean 0.

        Both fields are zero but in `rows_in`; other rows of `out` than `rows_out` stay as they are,
        but of a mirrored solid.
        """
        return self._convolve(self._compliance, pressure, out, rows_in, rows_out)

    def stiffness(self, displacement, out=None, rows_in=None, rows_out=None):
        """Pressure [E*], of zero mean, that causes a displacement."""
        return self._convolve(self._stiffness, displacement, out, rows_in, rows_out)

    def _convolve(self, kernel, field, out, rows_in, rows_out):
        out = np.zeros(self.shape, self.dtype) if out is None else out
        kernel.convolution.apply(kernel.symbol, field, out, rows_in, rows_out)
        self.pairs += math.prod(kernel.convolution.shape) / math.prod(self.shape)
        return out


class MirroredHalfSpace(HalfSpace):
    """The same for heights that are periodic together with their mirror images.

    The rectangle is a quarter of the period. So fields on it take a quarter of the work.
    """

    mirrored = True


class FreeHalfSpace(HalfSpace):
    """Displacement of a rectangle of an unbounded half-space under pressure on it.

    The displacement is absolute: it vanishes far away. A periodic convolution on a grid of twice
    the sides yields it (Hockney, Methods Comput. Phys. 9:135, 1970), which counts about fourfold in
    `pairs`. The `stiffness` of the periodic half-space only approximates the inverse of
    `compliance`, enough for a preconditioner.
    """

    def __init__(self, shape, lengths, dtype, solid):
        self.dtype = np.dtype(dtype)
        self.shape = shape
        self.lengths = lengths
        self.solid = solid
        self.pairs = 0
        self._pixel = tuple(a / n for a, n in zip(lengths, shape, strict=True))
        patch = [_PATCH * a for a in self._pixel]
        q = wavenumbers((_PATCH, _PATCH), patch)[:, : _PATCH // 2]
        self.mean_stiffness = float(q.mean()) / 2

    @cached_property
    def _compliance(self):
        padded = tuple(2 * fft.next_fast_len(n, real=True) for n in self.shape)
        operator = convolution.convolution(padded, self.dtype)
        # The kernel is even along both axes: a cosine transform of a quadrant has its spectrum.
        quadrant = displace_by_pixel([m // 2 + 1 for m in padded], self._pixel)
        return _Kernel(operator, free_edges.even_symbol(operator, quadrant))

    @cached_property
    def _split(self):
        accuracy = free_edges.SINGLE if self.dtype == np.float32 else free_edges.DOUBLE
        return free_edges.Split(self.shape, self._pixel, self.dtype, accuracy)

    def displace(self, points, pressure, out):
        """Displacement by pressure on few points, flat and increasing, with a known error."""
        self._split.displace(points, pressure, out)
        self.pairs += self._split.share


def half_space(
    shape,
    lengths,
    dtype=np.float64,
    solid=HALF_SPACE,
    periodic=True,
    mirrored=False,
    kept=True,
):
    """Operators of a grid, of one of three kinds; if `kept`, for the next call of a thread."""
    kind = MirroredHalfSpace if mirrored else HalfSpace if periodic else FreeHalfSpace
    most = _MANY if periodic and solid == HALF_SPACE else _FEW
    if not kept:
        return kind(tuple(shape), tuple(lengths), np.dtype(dtype), solid)
    return keep(kind, tuple(shape), tuple(lengths), np.dtype(dtype), solid, most=most)


def measure_scale(heights):
    """Mean and root mean square about it, safe from overflow and underflow of the squares."""
    mean = float(heights.mean())
    largest = max(float(heights.max()) - mean, mean - float(heights.min()))
    # Heights that differ by rounding only are flat.
    if largest <= 8 * np.finfo(float).eps * abs(mean):
        return mean, 0.0
    flat = heights.ravel()
    squares = sharing.spread(lambda c: np.sum(((flat[c] - mean) / largest) ** 2), flat.size)
    return mean, largest * math.sqrt(math.fsum(squares) / flat.size)


def measure_slope(heights, lengths, mirrored=False):
    """Root mean square gradient of periodic or mirrored heights, from differences of neighbours."""
    square = 0.0
    for axis, side in enumerate(lengths):
        step = np.diff(heights, axis=axis, append=np.take(heights, [-1 if mirrored else 0], axis))
        square += float(np.mean(step**2)) * (heights.shape[axis] / side) ** 2
    return float(np.sqrt(square))


def coarsen(n):
    """Points along an axis of the next coarser grid."""
    return (n + 1) // 2


def average_pixels(heights):
    """Means of two by two pixels; the last row or column of an odd number counts twice."""
    heights = np.pad(heights, [(0, n % 2) for n in heights.shape], mode="edge")
    return (heights[::2, ::2] + heights[1::2, ::2] + heights[::2, 1::2] + heights[1::2, 1::2]) / 4


def sample(field, shape):
    """Sample a periodic field on a grid about half as fine."""
    if all(n == 2 * m for n, m in zip(field.shape, shape, strict=True)):
        return np.ascontiguousarray(field[::2, ::2])
    return interpolate(field, shape)


def interpolate(field, shape):
    """Interpolate a periodic field by cubics along both axes, onto a grid of any shape."""
    if all(n == 2 * m for n, m in zip(shape, field.shape, strict=True)):
        fine = np.empty(shape, field.dtype)
        sharing.spread(lambda rows: _double(rows.start, rows.stop, field, fine), *field.shape)
        return fine
    for axis, n in enumerate(shape):
        if n != field.shape[axis]:
            field = _resample(field, n, axis)
    return field


def _double(start, stop, field, fine):
    """Put points between those of some rows, on the cubics through their four neighbours."""
    # Every other line is a row of the field, the others are between two rows.
    around = np.take(field, range(start - 1, stop + 2), axis=0, mode="wrap")
    lines = np.empty((2 * (stop - start), field.shape[1] + 3), field.dtype)
    inner = lines[:, 1:-2]
    inner[::2] = around[1:-2]
    inner[1::2] = _between(around[:-3], around[1:-2], around[2:-1], around[3:])
    # Along the lines, which go on beyond both ends.
    lines[:, 0] = inner[:, -1]
    lines[:, -2:] = inner[:, :2]
    fine[2 * start : 2 * stop, ::2] = inner
    fine[2 * start : 2 * stop, 1::2] = _between(lines[:, :-3], inner, lines[:, 2:-1], lines[:, 3:])


def _between(before, left, right, after):
    """Middle of the cubic through four points at equal distances."""
    return (9 * (left + right) - before - after) / 16


def _resample(field, n, axis):
    """Sample at n points the cubics through any four neighbours."""
    m = field.shape[axis]
    # Lagrange's polynomials through the points -1, 0, 1 and 2, at t between 0 and 1.
    position = np.arange(n) * (m / n)
    left = np.floor(position).astype(int)
    t = position - left
    cubics = (
        -t * (t - 1) * (t - 2) / 6,
        (t + 1) * (t - 1) * (t - 2) / 2,
        -(t + 1) * t * (t - 2) / 2,
        (t + 1) * t * (t - 1) / 6,
    )
    total = 0.0
    for offset, weight in enumerate(cubics, -1):
        weight = weight[:, None] if axis == 0 else weight
        total = total + weight * np.take(field, (left + offset) % m, axis=axis)
    return total.astype(field.dtype)
