"""Preconditioner of the descents: an approximate inverse of the stiffness of the free points.

Most of the inverse is in long waves, so that it is applied on a grid half as fine: its transforms
are four times smaller.
"""

import numpy as np

from stickiness.compiled import compiled
from stickiness.repulsive import convolution, half_space
from stickiness.solids import HALF_SPACE

LONGEST = np.pi  #: ``|q|`` / 2 of the longest wave across a side of 1
# Yield of short waves over that of the shortest on its own; 1 to 2 do about equally well.
_SHORT = 1.6


class Smoother:
    """Convolution with about ``1 / (|q| / 2 + shift)`` in single precision.

    On an even grid ``constant + B apply B^T``, where B gathers from the coarse points around each.
    """

    def __init__(self, shape, sides, solid):
        stiffness = half_space.effective_wavenumbers(shape, sides, solid).T / 2
        # It stands for the grip of what touches on the mean gap, which no elasticity holds.
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
            weights = [(1 + np.cos(np.pi * np.fft.rfftfreq(n)) ** 2) / 2 for n in shape]
            symbol -= self._constant
            symbol /= 64 * np.outer(weights[1], weights[0])
        self._convolution = convolution.convolution(shape, np.float32)
        self._every = np.arange(shape[0])
        self._symbol = self._convolution.symbol(symbol / (shape[0] * shape[1]))

    def share_of(self, free):
        """Shares of free points around the coarse ones; None on an odd grid."""
        # Beside the wall long waves give way less: coarse points take part by this share.
        return _gather(free) / np.float32(16) if self.halved else None

    def apply(self, field, share=None):
        """Convolve a field in single precision; long waves between the `share` of coarse points."""
        values = _gather(field) if self.halved else field
        if share is not None:
            values *= share
        out = np.empty_like(values)
        self._convolution.apply(self._symbol, values, out, self._every, self._every)
        if share is not None:
            out *= share
        if self.halved:
            row = np.empty(out.shape[1] + 1, np.float32)
            coarse = out
            out = np.empty_like(field)
            _spread(coarse, self._constant, field, out, row)
        return out


def _gather(field):
    """Sums over the points around each coarse one, ``B^T field``."""
    coarse = np.empty(tuple(n // 2 for n in field.shape), np.float32)
    _add_around(field.astype(np.float32, copy=False), coarse, np.empty(field.shape[1], np.float32))
    return coarse


@compiled
def _add_around(field, coarse, row):
    """Fill the coarse points with sums of what is around them; `row` is scratch."""
    n0, n1 = coarse.shape
    for i in range(n0):
        before = 2 * i - 1 if i else 2 * n0 - 1
        for j in range(2 * n1):
            row[j] = field[before, j] + field[2 * i, j] + field[2 * i, j] + field[2 * i + 1, j]
        coarse[i, 0] = row[2 * n1 - 1] + row[0] + row[0] + row[1]
        for j in range(1, n1):
            coarse[i, j] = row[2 * j - 1] + row[2 * j] + row[2 * j] + row[2 * j + 1]


@compiled
def _spread(coarse, constant, field, out, row):
    """Sums over coarse points around each point, ``B coarse``, plus the constant times a field."""
    n0, n1 = coarse.shape
    for i in range(2 * n0):
        after = (i + 1) // 2 % n0
        for j in range(n1):
            row[j] = coarse[i // 2, j] + coarse[after, j]
        row[n1] = row[0]
        for j in range(n1):
            out[i, 2 * j] = row[j] + row[j] + constant * field[i, 2 * j]
            out[i, 2 * j + 1] = row[j] + row[j + 1] + constant * field[i, 2 * j + 1]
