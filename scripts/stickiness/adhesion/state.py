"""State of a descent: a gap and all that follows from it point by point.

These operations are bound by memory. They go over the grid in blocks of rows that stay in cache,
each block once for all that is to be computed there, and they write over the arrays of a state that
is no longer needed.
"""

from dataclasses import dataclass

import numpy as np

_POINTS = 2**14  # in a block: 128 kB in double precision


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
    potential: float = 0.0  #: mean of the law's
    pressure: float = 0.0  #: mean, prescribed or that of the prescribed mean gap
    residual: float = np.inf  #: largest magnitude of the force
    iterations: int = 0
    last_run: int = 0  #: iterations since a direction of negative curvature was met
    start_pairs: float = 0.0  #: convolutions of the start, on coarser grids by share of the points

    @classmethod
    def empty(cls, shape):
        """State with arrays of arbitrary content."""
        doubles = [np.empty(shape) for _ in range(4)]
        return cls(*doubles, np.empty(shape, bool), np.empty(shape, np.float32))


def spans(shape):
    """Slices of rows that cover a grid block by block."""
    rows = max(1, _POINTS // shape[1])
    return [slice(start, start + rows) for start in range(0, shape[0], rows)]


def evaluate(problem, state):
    """Fill in what follows from the gap (not negative at a wall) and elastic pressure of a state.

    The mean pressure, if not prescribed, is the one that balances the open points in the mean.
    """
    law, wall, unit = problem.law, problem.wall, problem.unit
    potential, total, count, least = 0.0, 0.0, 0, np.inf
    for span in spans(state.gap.shape):
        gap = state.gap[span]
        traction, slope, energy = law.at(span).evaluate(gap)
        state.traction[span], state.slope[span] = traction, slope
        potential += float(np.sum(energy))
        if problem.pressure is None:
            unloaded = state.elastic[span] + traction
            least = min(least, float(unloaded.min()))
            open_points = gap > 0 if wall else np.ones(gap.shape, bool)
            count += int(np.count_nonzero(open_points))
            total += float(np.sum(unloaded, where=open_points))
    state.potential = potential / state.gap.size
    state.pressure = problem.pressure
    if state.pressure is None:
        # In full contact the least pressure that keeps it.
        state.pressure = -total / count if count else -least
    largest = 0.0
    for span in spans(state.gap.shape):
        reaction = state.elastic[span] + state.traction[span]
        reaction += state.pressure
        if wall:
            free = np.logical_or(state.gap[span] > 0, reaction < 0, out=state.free[span])
            reaction *= free
        else:
            state.free[span] = True
        reaction /= unit
        largest = np.maximum(largest, np.abs(reaction).max())  # keeps NaN
        state.force[span] = reaction
    state.residual = float(largest)
    return state


def balanced(field, points=None):
    """Subtract, in place, a constant on some points so that the field has no mean."""
    if points is None or points.all():
        field -= field.dtype.type(field.mean(dtype=float))
    elif points.any():
        field -= field.dtype.type(field.sum(dtype=float) / np.count_nonzero(points)) * points
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
