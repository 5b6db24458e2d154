"""Starts of a descent when loading begins from afar: contact without adhesion, coarser grids.

The solution without adhesion has wider gaps than any adhesive state: a descent from it ends on the
branch of approach. The adhesive state on a grid half as fine is a better start, unless it lies
beyond a jump that the fine grid does not make. So coarser grids are used only while no descent on
any grid meets negative curvature, without which there is no jump.
"""

from dataclasses import replace

import numpy as np

from stickiness.adhesive.descent import descend
from stickiness.adhesive.problem import FrozenTraction
from stickiness.adhesive.softening_descent import quick_descent, suits
from stickiness.adhesive.state import lowered
from stickiness.repulsive import solver
from stickiness.repulsive.active_set import PREDICTION
from stickiness.repulsive.grids import coarsen, interpolate, sample

_ROUGH = 1e-3  # tolerance of a solution without adhesion that is only a start
_COARSE = 1e-2  # of one on a coarser grid
_COARSEST = 128  # points along the shorter side of a grid from which coarser ones are used


def has_coarser_grids(problem):
    """Whether `from_coarser_grids` is for this problem and its grid."""
    fine = min(problem.surface.heights.shape) >= _COARSEST
    suited = suits(problem) and problem.law.smooth
    return fine and suited and problem.pressure is not None


def from_coarser_grids(problem, tol, max_iterations, observer, work):
    """State at a prescribed pressure by way of coarser grids.

    The problem must suit `quick_descent`; None if any descent meets a direction of negative
    curvature. `work` gets the convolutions of the starts, times their points.
    """
    shape = problem.surface.heights.shape
    if min(shape) < _COARSEST:
        gap, pairs = without_adhesion(problem, max_iterations)
        work.append(pairs * gap.size)
    else:
        coarser = tuple(coarsen(n) for n in shape)
        heights = sample(problem.surface.heights, coarser)
        surface = replace(problem.surface, heights=heights)
        coarse = replace(problem, surface=surface)
        before = coarse.surface.pairs
        state = from_coarser_grids(coarse, _COARSE, max_iterations, None, work)
        work.append((coarse.surface.pairs - before) * heights.size)
        if state is None:
            return None
        gap = _predicted(problem, interpolate(state.gap, shape))
    state, finished = quick_descent(problem, gap, tol, max_iterations, observer, convex=True)
    return state if finished else None


def _predicted(problem, gap):
    """Gap interpolated from a coarser grid, closed where the heights of this one press."""
    surface = problem.surface
    pressure = surface.quick.stiffness((gap + surface.heights).astype(np.float32))
    pressure += problem.pressure + problem.law.traction(np.maximum(gap, 0))
    pressing = pressure > PREDICTION * surface.quick.mean_stiffness * gap
    return np.where(pressing, 0, np.maximum(gap, 0))


def without_adhesion(problem, max_iterations):
    """Gap without adhesion at the control of a problem, and the convolutions it took."""
    surface = problem.surface
    if problem.pressure is not None:
        effort = solver.Effort(_ROUGH)
        contact = solver.press(
            surface.heights, surface.sides, problem.pressure, effort, solid=surface.solid
        )
        return contact.gap, contact.fft_pairs
    gap = problem.mean_gap - surface.heights
    if gap.min() >= 0:
        return gap, 0.0
    if problem.mean_gap <= 0:
        return np.full(gap.shape, problem.mean_gap), 0.0
    before = surface.pairs
    alone = replace(problem, law=FrozenTraction(0.0, problem.law.range))
    gap = descend(alone, lowered(gap, problem.mean_gap), _ROUGH, max_iterations).gap
    return gap, surface.pairs - before
