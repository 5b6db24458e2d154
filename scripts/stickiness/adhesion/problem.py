"""One problem of adhesive contact in its own units: operators, traction law and what is prescribed.

Lengths along the surface are in units of one side of the cell, heights and gaps in units of
h_rms (of the range of attraction if the surface is flat), pressures in E* times their quotient.
The energy per area is ``E(g) = <u K u> / 2 + <phi(g)>``, ``u = g + h``, ``phi' = traction``,
``K = |q| / 2`` or, for a layer, what `solids` says. A state of equilibrium at the mean pressure p
has ``r = K u + traction(g) + p = 0``, or, with a hard wall at ``g = 0``, ``r >= 0`` where ``g = 0``
and ``r = 0`` elsewhere.
"""

from dataclasses import dataclass

import numpy as np

from stickiness.contact import convolution, half_space
from stickiness.solids import HALF_SPACE, Solid

LONGEST = np.pi  # |q| / 2 of the longest wave across a side of 1


@dataclass(frozen=True, eq=False)
class Surface:
    """Heights (about their mean, in h_rms) with the elasticity of the solid on their grid."""

    heights: np.ndarray
    sides: tuple  # of the cell, in units of the first
    solid: Solid = HALF_SPACE  # its thickness in the same unit

    @property
    def exact(self):
        """Elasticity in double precision."""
        return half_space.half_space(self.heights.shape, self.sides, solid=self.solid)

    @property
    def quick(self):
        """Elasticity in single precision."""
        return half_space.half_space(self.heights.shape, self.sides, np.float32, self.solid)

    @property
    def smoother(self):
        """Approximate inverse of the stiffness."""
        return _kept_smoother(self.heights.shape, self.sides, self.solid)

    @property
    def pairs(self):
        """Convolutions so far by all operators of this grid."""
        return self.exact.pairs + self.quick.pairs + self.smoother.pairs

    def elastic(self, gap):
        """Pressure of zero mean that deforms the solid to a gap."""
        return self.exact.stiffness(gap + self.heights)

    def flattening_pressure(self):
        """Root mean square pressure that closes the gap everywhere."""
        return float(np.sqrt(np.mean(self.exact.stiffness(self.heights) ** 2)))


@dataclass(frozen=True, eq=False)
class Problem:
    """Surface, law (in the units of the surface) and control: a pressure or a mean gap."""

    surface: Surface
    law: object  # TractionLaw or FrozenTraction
    unit: float  # pressure that residuals are measured in
    pressure: float | None = None
    mean_gap: float | None = None

    @property
    def wall(self):
        """Whether gaps end at a hard wall."""
        return self.law.hard_wall


@dataclass(frozen=True, eq=False)
class FrozenTraction:
    """Traction that does not depend on the gap: with the hard wall the problem is convex."""

    field: np.ndarray  # or one number
    range: float  # of the law it is frozen from
    hard_wall = True
    hardens = False

    def at(self, span):
        """Law of some rows."""
        return FrozenTraction(self.field[span], self.range) if np.ndim(self.field) else self

    def evaluate(self, gap):
        """Traction, its derivative and its potential."""
        return self.field, 0.0, self.field * gap


class Smoother:
    """Convolution with ``1 / (|q| / 2 + shift)`` in single precision; counts its `pairs`.

    The shift is the stiffness of the longest wave, of a layer that of its softest (long waves of a
    thin incompressible one are the stiffest): it stands for the grip of what touches on the mean
    gap, which no elasticity holds.
    """

    def __init__(self, shape, sides, solid):
        self._convolution = convolution.choose(shape, np.float32)
        self._every = np.arange(shape[0])
        stiffness = half_space.effective_wavenumbers(shape, sides, solid).T / 2
        self.shift = LONGEST
        if solid != HALF_SPACE and stiffness.any():
            self.shift = float(stiffness[stiffness > 0].min())
        symbol = 1 / (stiffness + self.shift)
        self._symbol = self._convolution.symbol(symbol / (shape[0] * shape[1]))
        self.pairs = 0

    def apply(self, field):
        """Convolve a field in single precision."""
        out = np.empty_like(field)
        self._convolution.apply(self._symbol, field, out, self._every, self._every)
        self.pairs += 1
        return out


_kept_smoother = half_space.keep_per_thread(24)(Smoother)
