"""Preconditioner of the descents: an approximate inverse of the stiffness of the free points.

Most of the inverse is in long waves, so that it is applied on a grid half as fine: its transforms
are four times smaller.
"""

import numpy as np

from stickiness.repulsive import convolution, half_space, halving
from stickiness.solids import HALF_SPACE

LONGEST = np.pi  #: ``|q|`` / 2 of the longest wave across a side of 1
# Yield of short waves over that of the shortest on its own; 1 to 2 do about equally well.
_SHORT = 1.6


class Smoother:
    """Convolution with about ``1 / (|q| / 2 + shift)`` in single precision.

    On an even grid ``constant + B apply B^T``, where B gathers from the coarse points around each.
    Mirrored fields are not halved: points of the coarse grid would not mirror one another.
    """

    def __init__(self, shape, sides, solid, mirrored=False):
        stiffness = half_space.effective_wavenumbers(shape, sides, solid, mirrored).T / 2
        # It stands for the grip of what touches on the mean gap, which no elasticity holds.
        self.shift = LONGEST
        if (mirrored or solid != HALF_SPACE) and stiffness.any():
            self.shift = float(stiffness[stiffness > 0].min())
        self.halved = not mirrored and min(shape) >= 4 and shape[0] % 2 == 0 and shape[1] % 2 == 0
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
        self._convolution = convolution.convolution(shape, np.float32, mirrored)
        self._every = np.arange(shape[0])
        self._symbol = self._convolution.symbol(symbol / (shape[0] * shape[1]))

    def share_of(self, free):
        """Shares of free points around the coarse ones; None on an odd or mirrored grid."""
        # Beside the wall long waves give way less: coarse points take part by this share.
        return halving.gather(free) / np.float32(16) if self.halved else None

    def apply(self, field, share=None):
        """Convolve a field in single precision; long waves between the `share` of coarse points."""
        values = halving.gather(field) if self.halved else field
        if share is not None:
            values *= share
        out = np.empty_like(values)
        self._convolution.apply(self._symbol, values, out, self._every, self._every)
        if share is not None:
            out *= share
        if self.halved:
            coarse = out
            out = field.copy()
            halving.spread(coarse, out, self._constant)
        return out
