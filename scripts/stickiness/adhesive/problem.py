"""A problem of adhesive contact in scaled units: operators, traction law, prescribed load or gap.

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
from stickiness.compiled import compiled
from stickiness.repulsive import half_space
from stickiness.solids import HALF_SPACE, Solid

_BLOCK_POINTS = 2**14  # in a block of rows, which stays in cache


@dataclass(frozen=True, eq=False)
class Problem:
    """Surface and elasticity on its grid, law, and control: a pressure or a mean gap."""

    heights: np.ndarray  #: about their mean, in h_rms
    sides: tuple  #: of the cell, in units of the first
    law: object  #: TractionLaw or FrozenTraction
    unit: float  #: pressure that residuals are measured in
    solid: Solid = HALF_SPACE  #: its thickness in the unit of the sides
    mirrored: bool = False  #: whether all fields go on as their mirror images
    pressure: float | None = None
    mean_gap: float | None = None

    @property
    def exact(self):
        """Elasticity in double precision."""
        return self._operator(np.float64)

    @property
    def quick(self):
        """Elasticity in single precision."""
        return self._operator(np.float32)

    def _operator(self, dtype):
        """Compliance on this grid, and its inverse."""
        return half_space.half_space(
            self.heights.shape, self.sides, dtype, self.solid, mirrored=self.mirrored
        )

    @property
    def smoother(self):
        """Approximate inverse of the stiffness."""
        return half_space.keep(Smoother, self.heights.shape, self.sides, self.solid, self.mirrored)

    @property
    def wall(self):
        """Whether gaps end at a hard wall; if not, every point is free."""
        return self.law.hard_wall

    def lowest(self, gap):
        """Lowest gaps of a step: the wall, or half the way to the singularity of the law."""
        return 0.0 if self.wall else 0.5 * (gap - self.law.range)

    def state(self, gap, elastic=None):
        """State of a gap (not negative at a wall); `elastic` is its elastic pressure, if known.

        The mean pressure, if not prescribed, is the one that balances the open points in the mean.
        """
        if elastic is None:
            elastic = self.exact.stiffness(gap + self.heights)
        traction, slope, potential = self._evaluate(gap)
        flat_gap = gap.ravel()
        flat_elastic = elastic.ravel()
        flat_traction = traction.ravel()
        pressure = self.pressure
        if pressure is None:
            total, count, least = _unloaded(flat_gap, flat_elastic, flat_traction, self.wall)
            # In full contact the least pressure that keeps it.
            pressure = -total / count if count else -least
        free = np.empty(gap.shape, bool)
        force = np.empty(gap.shape, np.float32)
        _react(
            flat_gap,
            flat_elastic,
            flat_traction,
            pressure,
            self.unit,
            self.wall,
            free.ravel(),
            force.ravel(),
        )
        return State(
            gap=gap,
            elastic=elastic,
            traction=traction,
            slope=slope,
            free=free,
            force=force,
            potential=potential / gap.size,
            pressure=pressure,
        )

    def _evaluate(self, gap):
        """Traction and slope of the law on a grid, and the sum of its potential."""
        if isinstance(self.law, FrozenTraction):
            work = sum_blocks(lambda stress, open_by: (stress * open_by).sum(), self.law.field, gap)
            return self.law.field, np.broadcast_to(0.0, gap.shape), work
        traction = np.empty(gap.shape)
        slope = np.empty(gap.shape)
        total = 0.0
        for span in spans(gap.shape):
            traction[span], slope[span], potential = self.law.evaluate(gap[span])
            total += float(potential.sum())
        return traction, slope, total


@dataclass(frozen=True, eq=False)
class FrozenTraction:
    """Traction that does not depend on the gap: with the hard wall the problem is convex."""

    field: np.ndarray
    range: float  #: of the law it is frozen from
    hard_wall = True


@dataclass(eq=False)
class State:
    """A gap with what follows from it."""

    gap: np.ndarray
    elastic: np.ndarray  #: pressure of zero mean that belongs to the gap
    traction: np.ndarray  #: of the law at this gap, with its slope
    slope: np.ndarray
    free: np.ndarray  #: points that are open or would be pulled by the wall
    #: Sum of elastic pressure, traction and mean pressure on free points, in the problem's unit and
    #: in single precision: zero in equilibrium.
    force: np.ndarray
    potential: float  #: mean of the law's
    pressure: float  #: mean, prescribed or in balance with the prescribed mean gap
    iterations: int = 0
    fft_pairs: float = 0.0  #: convolutions, by their share of the points
    last_run: int = 0  #: iterations since a direction of negative curvature was met
    separated: bool = False  #: whether no attraction left can balance the tension

    def __post_init__(self):
        self.residual = largest(self.force)


def spans(shape):
    """Slices of rows that cover a grid block by block."""
    rows = max(1, _BLOCK_POINTS // shape[1])
    return [slice(start, start + rows) for start in range(0, shape[0], rows)]


def sum_blocks(function, *fields):
    """Sum, in double precision, what a function of fields, say `np.vdot`, gives over blocks."""
    return sum(float(function(*(f[span] for f in fields))) for span in spans(fields[0].shape))


@compiled
def _react(gap, elastic, traction, pressure, unit, wall, free, force):
    """Find the points that are free, and the forces on them."""
    for i in range(gap.size):
        reaction = elastic[i] + traction[i] + pressure
        # A reaction that is not a number makes a point free, and so comes to light.
        free[i] = gap[i] > 0 or not reaction >= 0 or not wall
        force[i] = reaction / unit if free[i] else 0.0


@compiled
def _unloaded(gap, elastic, traction, wall):
    """Sum and count of reactions without load on open points, and the least on all points."""
    total = 0.0
    count = 0
    least = np.inf
    for i in range(gap.size):
        reaction = elastic[i] + traction[i]
        if gap[i] > 0 or not wall:
            total += reaction
            count += 1
        least = min(least, reaction)
    return total, count, least


def largest(field):
    """Largest magnitude in a field; not a number if any is none."""
    return float(np.maximum(field.max(), -field.min()))


def balanced(field, points):
    """Subtract, in place, a constant on some points so that the field has no mean."""
    count = np.count_nonzero(points)
    if count:
        field -= field.dtype.type(field.sum(dtype=float) / count) * points
    return field


def lowered(gap, mean, lowest=0.0):
    """Lower a gap rigidly to a given mean, no point below its bound."""
    gap = np.maximum(gap, lowest)
    for _ in range(100):
        excess = float(gap.mean()) - mean
        movable = gap > lowest
        count = np.count_nonzero(movable)
        if count == 0 or abs(excess) <= 1e-15 * abs(mean):
            break
        gap = np.maximum(gap - np.where(movable, excess * gap.size / count, 0), lowest)
    return gap
