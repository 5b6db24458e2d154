"""Displacement of an unbounded half-space by pressure on few of its pixels.

A convolution on a grid of twice the sides spends nearly all its work on points without pressure.
The kernel is therefore split as Ewald split the Coulomb potential (Ann. Phys. 369:253, 1921):
``erf(r/w)/r`` is smooth enough for a grid with a sixteenth of the points, between B-splines
(Essmann et al., J. Chem. Phys. 103:8577, 1995, doi 10.1063/1.470117), and the rest is added point
by point, within a reach of each pixel that carries pressure.
"""

from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np
import scipy
from scipy import fft, special

from stickiness.compiled import compiled
from stickiness.repulsive import convolution, sharing

SPACING = 4  # of the grid of the smooth part, in pixels
_MARGIN = 24  # points of that grid beyond twice its size: the inverse of a blur has decayed there


@dataclass(frozen=True)
class Accuracy:
    """How well a split approximates the kernel."""

    order: int  #: of the B-splines, even
    width: float  #: w of the split, in spacings
    reach: int  #: of the rest, in pixels


# Errors relative to the largest displacement.
COARSE = Accuracy(order=4, width=1.6, reach=10)  # 1e-2
SINGLE = Accuracy(order=6, width=2.0, reach=28)  # 1e-5
DOUBLE = Accuracy(order=12, width=3.0, reach=50)  # 1e-9, see `displace`


class Split:
    """Displacement by few pixels, on a grid of pixels with the given sides, zero far away."""

    def __init__(self, shape, pixel, dtype, accuracy):
        self.shape = shape
        self.pixel = pixel
        self.dtype = np.dtype(dtype)
        self.accuracy = accuracy
        order = accuracy.order
        self._width = accuracy.width * SPACING * max(pixel)
        self.coarse = tuple((n - 1) // SPACING + order for n in shape)
        padded = tuple(2 * fft.next_fast_len(m + _MARGIN, real=True) for m in self.coarse)
        self.share = padded[0] * padded[1] / (shape[0] * shape[1])
        spline = scipy.interpolate.BSpline.basis_element(np.arange(order + 1))
        # The smooth part without the blur by splines, once when spread and once when interpolated.
        smooth = self._smooth([np.arange(m // 2 + 1) * SPACING for m in padded])
        blur = [_blur(spline(np.arange(1, order)), m) ** 2 for m in padded]
        self._convolution = convolution.convolution(padded, self.dtype)
        self._symbol = even_symbol(self._convolution, smooth, np.outer(blur[0], blur[1]))
        phase = np.arange(SPACING)[:, None] / SPACING
        self._weights = spline(phase + order - 1 - np.arange(order)).astype(dtype)
        self._field = np.zeros(self.coarse, dtype)
        self._image = np.zeros(self.coarse, dtype)

    def _smooth(self, pixels):
        """Mean of ``erf(r/w)/(pi r)`` over a pixel, by Gauss's rule, times its area."""
        x, y = pixels
        side0, side1 = self.pixel
        limit = 6 * self._width  # beyond which erf is 1
        near = np.s_[: np.sum(x * side0 < limit), : np.sum(y * side1 < limit)]
        nodes, weights = np.polynomial.legendre.leggauss(3)
        rule = list(zip(nodes / 2, weights / 2, strict=True))
        total = 0.0
        for (node0, weight0), (node1, weight1) in product(rule, repeat=2):
            r = np.add.outer(((x + node0) * side0) ** 2, ((y + node1) * side1) ** 2)
            np.sqrt(r, out=r)
            np.maximum(r, 1e-9 * self._width, out=r)  # in the middle the quotient has a limit
            smooth = special.erf(r[near] / self._width)
            np.divide(weight0 * weight1, r, out=r)
            r[near] *= smooth
            total += r
        return total * (self.pixel[0] * self.pixel[1] / np.pi)

    def rest(self, reach):
        """Kernel less its smooth part, up to `reach` pixels away along each axis."""
        count = [m + 1 for m in reach]
        return displace_by_pixel(count, self.pixel) - self._smooth([np.arange(m) for m in count])

    @cached_property
    def _near(self):
        """The rest, by rows and from left to right, and in each row how far it reaches."""
        limit = self.accuracy.reach * max(self.pixel)
        reach = [int(limit / a) for a in self.pixel]
        rest = self.rest(reach)
        down = np.arange(reach[0] + 1) * self.pixel[0]
        half = (np.sqrt(limit**2 - down**2) / self.pixel[1]).astype(np.int64)
        whole_rows = np.hstack([rest[:, :0:-1], rest])
        return whole_rows.astype(self.dtype), half

    def convolve(self, field):
        """Smooth part on the coarse grid; the next call overwrites the result."""
        self._convolution.apply(self._symbol, field.reshape(self.coarse), self._image)
        return self._image.ravel()

    def displace(self, points, values, out):
        """Displacement of the whole grid under pressures on `points`, flat and increasing.

        In double precision its error is below 1e-9 of the largest displacement.
        """
        values = values.astype(self.dtype, copy=False)
        self._field[...] = 0
        _spread(points, values, self._weights, self.shape[1], self._field)
        self.convolve(self._field)
        starts = np.searchsorted(points, np.arange(self.shape[0] + 1) * self.shape[1])
        columns = points % self.shape[1]
        rest, half = self._near

        def fill(rows):
            _interpolate(self._image, self._weights, rows.start, rows.stop, out)
            _add_rest(starts, columns, values, rest, half, rows.start, rows.stop, out)

        sharing.spread(fill, *self.shape)


def displace_by_pixel(shape, pixel):
    """Displacement under unit pressure [E*] on one pixel, at `shape` pixels from there on.

    It is ``1/(pi E*)`` times the integral of 1/r over the pixel: the second difference, over its
    corners, of ``x asinh(y/x) + y asinh(x/y)`` (Love, Phil. Trans. R. Soc. A 228:377, 1929). At a
    distance of m pixels the difference loses some ``m**2`` times the rounding.
    """
    x = ((np.arange(shape[0] + 1) - 0.5) * pixel[0])[:, None]
    y = ((np.arange(shape[1] + 1) - 0.5) * pixel[1])[None, :]
    corners = x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))
    return np.diff(np.diff(corners, axis=0), axis=1) / np.pi


def even_symbol(operator, quadrant, divisor=1.0):
    """Symbol of a kernel even along both axes, given by a quadrant, over a spectrum."""
    spectrum = fft.dctn(quadrant, type=1, overwrite_x=True)
    spectrum /= np.multiply(divisor, operator.shape[0] * operator.shape[1])
    return operator.symbol(spectrum.T)


def _blur(values, size):
    """Half of the spectrum of a B-spline, given between its ends, on a periodic axis."""
    wave = np.arange(size // 2 + 1) * (2 * np.pi / size)
    middle = values.size // 2
    return np.cos(np.outer(wave, np.arange(values.size) - middle)) @ values


# Slices tell the compiler that no index is negative, so that it uses vector instructions.
@compiled
def _spread(points, values, weights, columns, coarse):
    """Spread values over the coarse points beside them: the transpose of `_interpolate`."""
    spacing, order = weights.shape
    for k in range(points.size):
        i, j = divmod(points[k], columns)
        along = weights[j % spacing]
        for u in range(order):
            value = values[k] * weights[i % spacing, u]
            part = coarse[i // spacing + u, j // spacing :]
            for v in range(order):
                part[v] += value * along[v]


@compiled
def _interpolate(coarse, weights, begin, end, out):
    """Interpolate some rows between the coarse points beside them."""
    spacing, order = weights.shape
    row = np.empty(coarse.shape[1], coarse.dtype)
    fine = np.empty(row.size - order + 1, coarse.dtype)
    for i in range(begin, end):
        row[:] = 0
        for u in range(order):
            weight = weights[i % spacing, u]
            part = coarse[i // spacing + u]
            for j in range(row.size):
                row[j] += weight * part[j]
        for f in range(spacing):
            fine[:] = 0
            for v in range(order):
                weight = weights[f, v]
                part = row[v:]
                for j in range(fine.size):
                    fine[j] += weight * part[j]
            part = out[i, f::spacing]
            part[:] = fine[: part.size]


@compiled
def _add_rest(starts, columns, values, near, half, begin, end, out):
    """Add to some rows the rest near each point; `starts`: the first point in each row."""
    reach = near.shape[0] - 1
    middle = near.shape[1] // 2
    for i in range(begin, end):
        for k in range(max(0, i - reach), min(out.shape[0], i + reach + 1)):
            kernel = near[abs(i - k)]
            width = half[abs(i - k)]
            for t in range(starts[k], starts[k + 1]):
                first = max(0, columns[t] - width)
                value = values[t]
                row = out[i, first : columns[t] + width + 1]
                part = kernel[middle - columns[t] + first :]
                for j in range(row.size):
                    row[j] += value * part[j]
