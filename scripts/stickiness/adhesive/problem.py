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

from stickiness.adhesive.preconditioner import Smoother
from stickiness.repulsive import half_space
from stickiness.solids import HALF_SPACE, Solid


@dataclass(frozen=True, eq=False)
class Surface:
    """Heights (about their mean, in h_rms) with the elasticity of the solid on their grid."""

    heights: np.ndarray
    sides: tuple  #: of the cell, in units of the first
    solid: Solid = HALF_SPACE  #: its thickness in the same unit

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
    law: object  #: TractionLaw or FrozenTraction
    unit: float  #: pressure that residuals are measured in
    pressure: float | None = None
    mean_gap: float | None = None

    @property
    def wall(self):
        """Whether gaps end at a hard wall."""
        return self.law.hard_wall


@dataclass(frozen=True, eq=False)
class FrozenTraction:
    """Traction that does not depend on the gap: with the hard wall the problem is convex."""

    field: np.ndarray  #: or one number
    range: float  #: of the law it is frozen from
    hard_wall = True
    hardens = False

    def at(self, span):
        """Law of some rows."""
        return FrozenTraction(self.field[span], self.range) if np.ndim(self.field) else self

    def evaluate(self, gap):
        """Traction, its derivative and its potential."""
        return self.field, 0.0, self.field * gap


_kept_smoother = half_space.keep_per_thread(24)(Smoother)
