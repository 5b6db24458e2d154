"""Stable equilibrium from a start: smooth laws, the law of Maugis, and what has no equilibrium.

A law whose traction jumps (Maugis) is relaxed with its traction frozen at the points within its
range, a convex problem, and frozen anew. As its potential is concave, every such round lowers the
energy until the set of points no longer changes: it cannot cycle. At a prescribed load the rounds
are monotone too, as added attraction lowers the gap everywhere: from the solution without adhesion
the set only grows to the least possible (approach), from full contact it only shrinks to the
largest (separation).

A smooth law is relaxed as it is. A state found within a few iterations may be an unstable one
(two flats at a distance): it is probed for directions of negative curvature, and left along one.

Loading from afar starts from the contact without adhesion. It has wider gaps than any adhesive
state: a descent from it ends on the branch of approach. The adhesive state on a grid half as fine
is a better start, unless it lies beyond a jump that the fine grid does not make. So coarser grids
are used only while no descent on any grid meets negative curvature, without which there is no jump.
"""

from dataclasses import replace

import numpy as np

from stickiness.adhesive.descent import descend
from stickiness.adhesive.problem import FrozenTraction, State, balanced, evaluate, lowered
from stickiness.adhesive.softening_descent import quick_descent, suits
from stickiness.repulsive import solver
from stickiness.repulsive.active_set import PREDICTION
from stickiness.repulsive.half_space import coarsen, interpolate, sample

_FEW_ITERATIONS = 8  # iterations below which convergence says little about stability
_MAX_PROBES = 30
_FROZEN_REDUCTION = 0.1  # fall of the residual between two updates of a frozen traction
_MAX_ESCAPES = 5
_START_TOLERANCE = 1e-3  # tolerance of a solution without adhesion that is only a start
_COARSE_GRID_TOLERANCE = 1e-2  # of one on a coarser grid
_MIN_POINTS_TO_COARSEN = 128  # along the shorter side of a grid


def relax(problem, gap, tol, max_iterations, closing=True, logger=None):
    """Relax a gap to a stable equilibrium; returns the last `State`, converged or not, and a flag.

    The flag tells whether the surfaces part under tension: no attraction left can balance the pull.
    A `gap` of None stands for loading from afar; a given one has the mean gap if that is
    prescribed. `max_iterations` bounds all descents together. An unstable state is left towards
    contact if `closing`, else away from it.
    """
    watch = _Watch(problem, logger)
    run = _relax_smooth if problem.law.smooth else _relax_frozen
    spent, state, work = 0, None, []
    if gap is None:
        fine = min(problem.surface.heights.shape) >= _MIN_POINTS_TO_COARSEN
        if fine and suits(problem) and problem.law.smooth and problem.pressure is not None:
            state = _from_coarser_grids(problem, tol, max_iterations, watch, work)
        if state is None:
            gap, pairs = _without_adhesion(problem, max_iterations)
            work.append(pairs * gap.size)
    for _ in range(_MAX_ESCAPES):
        if state is None or gap is not None:
            state = run(problem, gap, tol, max_iterations - spent, watch)
        spent += state.iterations
        state.iterations = spent
        if watch.separated or not state.residual <= tol or spent >= max_iterations:
            break
        unsure = state.last_run < _FEW_ITERATIONS and not _surely_stable(problem, state)
        mode = _unstable_mode(problem, state) if unsure else None
        if mode is None:
            break
        gap = _left(problem, state, mode, closing)
    state.start_pairs = sum(work) / state.gap.size
    return state, watch.separated


class _Watch:
    """Observer of a descent: logs, and stops it when tension has parted the surfaces."""

    def __init__(self, problem, logger):
        self.law, self.pull, self.logger = problem.law, None, logger
        if problem.pressure is not None and problem.pressure < 0:
            self.pull = -problem.pressure
        self.separated = False

    def __call__(self, state):
        if self.logger is not None:
            self.logger.debug("residual %.2e, mean gap %.6g", state.residual, state.gap.mean())
        if self.pull is not None:
            nearest = float(state.gap.min())
            if nearest > self.law.strength_gap:
                self.separated = float(self.law.traction(nearest)) < self.pull
        return self.separated


def _relax_smooth(problem, gap, tol, max_iterations, watch):
    spent = 0
    if suits(problem):
        state, finished = quick_descent(problem, gap, tol, max_iterations, watch)
        if finished:
            return state
        gap, spent = state.gap, state.iterations
    state = descend(problem, gap, tol, max_iterations - spent, watch)
    state.iterations += spent
    return state


def _relax_frozen(problem, gap, tol, max_iterations, watch):
    law = problem.law
    state = State.empty(gap.shape)
    state.gap[...], state.elastic[...] = gap, problem.surface.elastic(gap)
    inside = gap <= law.range
    aim, spent = None, 0
    while True:
        traction = FrozenTraction(law.maugis_stress * inside, law.range)
        frozen = replace(problem, law=traction)
        if aim is None:
            aim = max(tol, _FROZEN_REDUCTION * evaluate(frozen, state).residual)
        final = aim <= tol
        left = max_iterations - spent
        state = descend(frozen, state.gap, aim, left, watch, elastic=state.elastic, rough=not final)
        spent += state.iterations
        if watch.separated or spent >= max_iterations or not state.residual <= aim:
            break
        changed = (state.gap <= law.range) != inside
        if not final and changed.any():
            # Only where the gap is farther from the range than it may be from equilibrium.
            away = float(np.abs(frozen.surface.smoother.apply(state.force)).max())
            changed &= np.abs(state.gap - law.range) > 2 * frozen.unit * away
        if changed.any():
            inside ^= changed
            aim = None
        elif final:
            break
        else:
            aim = max(tol, _FROZEN_REDUCTION * aim)
    evaluate(problem, state)
    state.iterations, state.last_run = spent, spent
    return state


def _surely_stable(problem, state):
    """Whether the law softens less than elasticity holds the longest wave, at a given mean gap."""
    surface = problem.surface
    softest = min(surface.smoother.shift, np.pi / max(surface.sides))
    return problem.mean_gap is not None and float(-state.slope.min()) < softest


def _unstable_mode(problem, state):
    """Direction of negative curvature, or None if conjugate gradients find none.

    Where the law softens, elasticity couples all points with one sign: the softest mode of the
    open points is positive, and a positive right-hand side has a share of it.
    """
    open_points = state.gap > 0 if problem.wall else np.ones(state.gap.shape, bool)
    softening = np.where(open_points, np.maximum(-state.slope, 0), 0)
    if not softening.any():
        return None
    x0 = np.cos(2 * np.pi * np.arange(softening.shape[0]) / softening.shape[0])
    x1 = np.cos(2 * np.pi * np.arange(softening.shape[1]) / softening.shape[1])
    # A prescribed mean gap leaves a uniform load no work to do.
    load = softening / softening.max() * (1 + 0.1 * (x0[:, None] + x1[None, :]))

    def constrained(field):
        """Part of a field on open points, without a mean if the mean gap is prescribed."""
        field = field * open_points
        return balanced(field, open_points) if problem.pressure is None else field

    residual = constrained(-load.astype(np.float32))
    direction, product = None, 0.0
    first = float(np.abs(residual).max())
    for _ in range(_MAX_PROBES):
        image = constrained(problem.surface.smoother.apply(residual))
        last, product = product, float(np.vdot(image, residual))
        if not product > 0:
            return None
        direction = -image if direction is None else direction * np.float32(product / last) - image
        stress = problem.surface.quick.stiffness(direction) + state.slope * direction
        curvature = float(np.vdot(direction, stress))
        if curvature < 0:
            return direction
        stress = constrained(stress.astype(np.float32))
        residual = residual + np.float32(product / curvature) * stress
        if float(np.abs(residual).max()) < 1e-3 * first:
            return None
    return None


def _left(problem, state, mode, closing):
    """Gap a tenth of the range away from an unstable state."""
    mode = mode / float(np.abs(mode).max())
    if (mode.sum() > 0) == closing:
        mode = -mode
    lowest = 0.0 if problem.wall else 0.5 * (state.gap - problem.law.range)
    gap = np.maximum(state.gap + 0.1 * problem.law.range * mode, lowest)
    return gap if problem.mean_gap is None else lowered(gap, problem.mean_gap, lowest)


def _from_coarser_grids(problem, tol, max_iterations, observer, work):
    """State at a prescribed pressure by way of coarser grids.

    The problem must suit `quick_descent`; None if any descent meets a direction of negative
    curvature. `work` gets the convolutions of the starts, times their points.
    """
    shape = problem.surface.heights.shape
    if min(shape) < _MIN_POINTS_TO_COARSEN:
        gap, pairs = _without_adhesion(problem, max_iterations)
        work.append(pairs * gap.size)
    else:
        coarser = tuple(coarsen(n) for n in shape)
        heights = sample(problem.surface.heights, coarser)
        surface = replace(problem.surface, heights=heights)
        coarse = replace(problem, surface=surface)
        before = coarse.surface.pairs
        state = _from_coarser_grids(coarse, _COARSE_GRID_TOLERANCE, max_iterations, None, work)
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


def _without_adhesion(problem, max_iterations):
    """Gap without adhesion at the control of a problem, and the convolutions it took."""
    surface = problem.surface
    if problem.pressure is not None:
        contact = solver.press(
            surface.heights, surface.sides, problem.pressure, _START_TOLERANCE, solid=surface.solid
        )
        return contact.gap, contact.fft_pairs
    gap = problem.mean_gap - surface.heights
    if gap.min() >= 0:
        return gap, 0.0
    if problem.mean_gap <= 0:
        return np.full(gap.shape, problem.mean_gap), 0.0
    before = surface.pairs
    alone = replace(problem, law=FrozenTraction(0.0, problem.law.range))
    gap = descend(alone, lowered(gap, problem.mean_gap), _START_TOLERANCE, max_iterations).gap
    return gap, surface.pairs - before
