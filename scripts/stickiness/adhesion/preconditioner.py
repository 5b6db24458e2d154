"""Preconditioner of the descents: an approximate inverse of the stiffness of the free points.

Most of the inverse is in long waves, so that it is applied on a grid half as fine: its transforms
are four times smaller. Beside the wall, coarse points take part by their share of free ones.
"""

import numpy as np

from stickiness.contact import convolution, half_space
from stickiness.solids import HALF_SPACE

LONGEST = np.pi  #: ``|q|`` / 2 of the longest wave across a side of 1
# Yield of short waves over that of the shortest on its own; 1 to 2 do about equally well.
_SHORT = 1.6


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
        self.halved = min(shape) >= 4 and shape[0] % 2 == 0 and shape[1] % 2 == 0
        if self.halved:
            self._constant = np.float32(_SHORT / (stiffness.max() + self.shift))
            shape = tuple(n // 2 for n in shape)
            stiffness = half_space.effective_wavenumbers(shape, sides, solid).T / 2
        symbol = 1 / (stiffness + self.shift)
        if self.halved:
            # Squared transfer of full weighting, summed over the aliases along each axis; that is
            # B^T / 16, and interpolation is B / 4.
            weights = [(1 + np.cos(np.pi * np.fft.fftfreq(n)) ** 2) / 2 for n in shape]
            symbol -= self._constant
            symbol /= 64 * np.outer(weights[1][: symbol.shape[0]], weights[0])
        self._convolution = convolution.choose(shape, np.float32)
        self._every = np.arange(shape[0])
        self._symbol = self._convolution.symbol(symbol / (shape[0] * shape[1]))
        self.pairs = 0.0  # in units of the grid of the fields

    def apply(self, field, share=None):
        """Convolve a field in single precision; long waves between the `share` of coarse points."""
        values = _gather(field) if self.halved else field
        if share is not None:
            values *= share
        out = np.empty_like(values)
        self._convolution.apply(self._symbol, values, out, self._every, self._every)
        self.pairs += out.size / field.size
        if share is not None:
            out *= share
        if self.halved:
            out = _spread(out)
            out += self._constant * field
        return out


class Preconditioner:
    """Approximate inverse of the stiffness of the free points.

    Beside the wall long waves give way less: coarse points take part by their share of free ones.
    """

    def __init__(self, surface, free):
        self.smoother, self.share = surface.smoother, None
        if self.smoother.halved:
            self.share = _gather(free.astype(np.float32, copy=False))
            self.share /= 16

    def __call__(self, force):
        """Step for a force that is zero on all but free points."""
        return self.smoother.apply(force, self.share)


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
