"""A half-space that is not periodic: tractions act on a rectangle, and nowhere else.

The pressure is uniform on every pixel. The displacement of the surface under a uniform pressure p
on a rectangle is ``p / (pi E*)`` times the integral of ``1/r`` over it, which is known in closed
form (Love, Phil. Trans. R. Soc. A 228:377, 1929; Johnson, *Contact Mechanics*, 1985, section 3.3).
The displacement of all pixels is a convolution with it. On a grid of twice the sides, zero beyond
the rectangle, that is what a periodic convolution yields (Hockney, Methods Comput. Phys. 9:135,
1970). The displacement is absolute: it vanishes far away.
"""

import numpy as np
from scipy import fft

from stickiness.repulsive import convolution, half_space


class FreeHalfSpace(half_space.HalfSpace):
    """Displacement of a rectangle of an unbounded half-space under pressure on it.

    Its `stiffness` is that of the periodic half-space, which only approximates the inverse of
    `compliance`, enough for a preconditioner. `pairs` counts convolutions by their share of the
    points of the given grid, those on the grid of twice the sides about fourfold.

    Parameters
    ----------
    shape : tuple of int
        Pixels ``(n0, n1)`` of the rectangle.
    lengths : tuple of float
        Its sides; displacements come out in this unit.
    dtype : data-type, optional
        Of the fields.
    """

    def __init__(self, shape, lengths, dtype=np.float64):
        super().__init__(shape, lengths, dtype)
        padded = tuple(2 * fft.next_fast_len(n, real=True) for n in self.shape)
        pixel = tuple(a / n for a, n in zip(self.lengths, self.shape, strict=True))
        self._share = padded[0] * padded[1] / (self.shape[0] * self.shape[1])
        self._padded = convolution.choose(padded, self.dtype)
        self._symbol = self._padded.symbol(_transform_kernel(padded, pixel))

    def compliance(self, pressure, out=None, rows_in=None, rows_out=None):
        """Displacement, zero far away and in the unit of `lengths`, under a pressure [E*].

        `rows_in`, `rows_out`: as of `half_space.HalfSpace.compliance`.
        """
        out = self._convolve(self._padded, pressure, self._symbol, out, rows_in, rows_out)
        self.pairs += self._share - 1  # which has been counted as one
        return out


# Kept for the next call of the same thread.
free_half_space = half_space.keep_per_thread(12)(FreeHalfSpace)


def displace_by_pixel(shape, pixel):
    """Displacement under unit pressure [E*] on one pixel, at all pixels from there on.

    The integral of 1/r over a rectangle is the second difference, over its corners, of
    ``x asinh(y/x) + y asinh(x/y)``. At a distance of m pixels the difference loses some ``m**2``
    times the rounding.

    Parameters
    ----------
    shape : tuple of int
        Pixels ``(m0, m1)`` at which the displacement is wanted, the loaded one being the first.
    pixel : tuple of float
        Sides of a pixel.

    Returns
    -------
    numpy.ndarray
        Displacement ``(m0, m1)`` in the unit of `pixel`.
    """
    x, y = ((np.arange(m + 1) - 0.5) * side for m, side in zip(shape, pixel, strict=True))
    x, y = x[:, None], y[None, :]
    corners = x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))
    return np.diff(np.diff(corners, axis=0), axis=1) / np.pi


def _transform_kernel(padded, pixel):
    """Symbol of the kernel on a padded grid, normalised, ``(padded[1] // 2 + 1, padded[0])``."""
    # The kernel is even along both axes: a cosine transform of a quadrant has all of its spectrum.
    quadrant = displace_by_pixel([m // 2 + 1 for m in padded], pixel)
    spectrum = fft.dctn(quadrant, type=1, overwrite_x=True).T
    spectrum /= padded[0] * padded[1]
    return np.concatenate([spectrum, spectrum[:, -2:0:-1]], axis=1)


def coarsen_heights(heights):
    """Means of two by two pixels; the last row or column of an odd number counts twice."""
    for axis in (0, 1):
        if heights.shape[axis] % 2:
            heights = np.concatenate([heights, heights.take([-1], axis)], axis)
    return (heights[::2, ::2] + heights[1::2, ::2] + heights[::2, 1::2] + heights[1::2, 1::2]) / 4


def refine_pressure(pressure, shape):
    """Same pressure on pixels of half the side, ``shape`` of them."""
    fine = np.repeat(np.repeat(pressure, 2, axis=0), 2, axis=1)
    return np.ascontiguousarray(fine[: shape[0], : shape[1]])
