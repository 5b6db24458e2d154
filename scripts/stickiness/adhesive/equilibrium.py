"""Stable equilibrium from a start: smooth laws, the law of Maugis, and what has no equilibrium.

A smooth law is relaxed as it is. A law whose traction jumps (Maugis) is relaxed with its traction
frozen at the points within its range, a convex problem, and frozen anew. As its potential is
concave, every such round lowers the energy until the set of points no longer changes: it cannot
cycle. At a prescribed load the rounds are monotone: from the solution without adhesion the set only
grows to the least possible, from full contact it only shrinks to the largest.
"""

from dataclasses import replace

import numpy as np

from stickiness.adhesive.descent import REFRESH, descend, refreshed
from stickiness.adhesive.problem import FrozenTraction, balanced, lowered
from stickiness.adhesive.softening_descent import quick_descent
from stickiness.repulsive import solver
from stickiness.repulsive.active_set import PREDICTION, Problem
from stickiness.repulsive.convolution import count_points
from stickiness.repulsive.half_space import coarsen, interpolate, sample
from stickiness.solids import Film, Skin

_FEW_ITERATIONS = 8  # iterations below which convergence says little about stability
_MAX_PROBES = 30
_FROZEN_REDUCTION = 0.1  # fall of the residual between two updates of a frozen traction
_MAX_ESCAPES = 5
_START_TOLERANCE = 1e-3  # tolerance of a solution without adhesion that is only a start
_COARSE_GRID_TOLERANCE = 1e-2  # of one on a coarser grid
_MIN_POINTS_TO_COARSEN = 128  # along the shorter side of a grid


def relax(problem, gap, tol, max_iterations, closing=True):
    """Relax a gap, or load from afar if it is None; returns the last `State`, converged or not.

    `max_iterations` bounds all descents. An unstable state is left towards contact if `closing`.
    """
    run = _relax_smooth if problem.law.smooth else _relax_frozen
    observe = _observer(problem)
    state = None
    spent = 0
    points_before = count_points()
    if gap is None:
        fine = min(problem.heights.shape) >= _MIN_POINTS_TO_COARSEN
        if (
            fine
            and not problem.mirrored
            and problem.wall
            and problem.law.smooth
            and problem.pressure is not None
        ):
            state = _from_coarser_grids(problem, tol, max_iterations, observe)
        if state is None:
            gap = _without_adhesion(problem, max_iterations)
    for _ in range(_MAX_ESCAPES):
        if state is None or gap is not None:
            state = run(problem, gap, tol, max_iterations - spent, observe)
        spent += state.iterations
        state.iterations = spent
        if state.separated or not state.residual <= tol or spent >= max_iterations:
            break
        # Found within a few iterations, it may be an unstable one: two flats at a distance.
        unsure = state.last_run < _FEW_ITERATIONS and not _surely_stable(problem, state)
        mode = _unstable_mode(problem, state) if unsure else None
        if mode is None:
            break
        gap = _left(problem, state, mode, closing)
    state.fft_pairs = (count_points() - points_before) / state.gap.size
    return state


def _observer(problem):
    """Function that tells of a state, and notes, whether tension has parted the surfaces."""
    law = problem.law
    pull = -(problem.pressure or 0.0)

    def observe(state):
        nearest = float(state.gap.min()) if pull > 0 else 0.0
        if nearest > law.strength_gap:
            state.separated = float(law.traction(nearest)) < pull
        return state.separated

    return observe


def _relax_smooth(problem, gap, tol, max_iterations, observe):
    """State of a smooth law: by the quick descent if there is a wall and it finishes."""
    spent = 0
    if problem.wall:
        state, finished = quick_descent(problem, gap, tol, max_iterations, observe)
        if finished:
            return state
        gap = state.gap
        spent = state.iterations
    state = descend(problem, gap, tol, max_iterations - spent, observe)
    state.iterations += spent
    return state


def _relax_frozen(problem, gap, tol, max_iterations, observe):
    """State of a law with a jump: its traction is frozen, and anew until its points stay."""
    law = problem.law
    state = problem.state(gap)
    inside = state.gap <= law.range
    aim = None
    spent = 0
    refreshed_at = state.residual  # where the elastic pressure was last exact
    while True:
        # Relax with the traction at the points within the range, at first not to the tolerance.
        frozen = replace(problem, law=FrozenTraction(law.maugis_stress * inside, law.range))
        if aim is None:
            residual = frozen.state(state.gap, state.elastic).residual
            aim = max(tol, _FROZEN_REDUCTION * residual)
        # The increments of all rounds add up. Their rounding would exceed so small a residual, and
        # without contact or load nothing but rounding would then move the surfaces apart.
        if aim < REFRESH * refreshed_at:
            state = refreshed(frozen, state)
            refreshed_at = state.residual
        final = aim <= tol
        state = descend(
            frozen,
            state.gap,
            tol=aim,
            max_iterations=max_iterations - spent,
            observer=observe,
            elastic=state.elastic,
            approximate=not final,
        )
        spent += state.iterations
        if state.separated or spent >= max_iterations or not state.residual <= aim:
            break
        # Points that have crossed the range since.
        changed = (state.gap <= law.range) != inside
        if not final and changed.any():
            # Only where the gap is farther from the range than it may be from equilibrium.
            away = float(np.abs(frozen.smoother.apply(state.force)).max())
            changed &= np.abs(state.gap - law.range) > 2 * frozen.unit * away
        if changed.any():
            inside ^= changed
            aim = None
        elif final:
            break
        else:
            aim = max(tol, _FROZEN_REDUCTION * aim)
    last = problem.state(state.gap, state.elastic)
    return replace(last, iterations=spent, last_run=spent, separated=state.separated)


def _surely_stable(problem, state):
    """Whether elasticity surely holds open points more than the law softens, at a mean gap.

    In any mode, the work of softening over that of elasticity is at most the largest displacement
    under a pressure that equals the softening (Schur's test), if no pressure lifts any point. The
    preconditioner gives that displacement, but for its shift, which stiffens long waves.
    """
    if problem.mean_gap is None:
        return False
    smoother = problem.smoother
    longest = max(problem.sides) * (2 if problem.mirrored else 1)
    softest = min(smoother.shift, np.pi / longest)
    softening = _softening(problem, state)
    if float(softening.max()) < softest:
        return True
    # Around what presses on a skin, or on a layer on a film, the surface may rise.
    if isinstance(problem.solid, Skin) or isinstance(getattr(problem.solid, "backing", None), Film):
        return False
    give = smoother.apply(softening.astype(np.float32))
    return float(give.max()) * (1 + smoother.shift / softest) < 1


def _softening(problem, state):
    """How fast the traction falls where open points part."""
    softening = np.maximum(-state.slope, 0)
    return np.where(state.gap > 0, softening, 0) if problem.wall else softening


def _unstable_mode(problem, state):
    """Direction of negative curvature, or None if conjugate gradients find none.

    Where the law softens, elasticity couples all points with one sign: the softest mode of the
    open points is positive, and a positive right-hand side has a share of it.
    """
    open_points = state.gap > 0 if problem.wall else np.ones(state.gap.shape, bool)
    softening = _softening(problem, state)
    if not softening.any():
        return None
    # A prescribed mean gap leaves a uniform load no work to do: it is varied by long waves.
    n0, n1 = softening.shape
    wave0 = np.cos(2 * np.pi * np.arange(n0) / n0)
    wave1 = np.cos(2 * np.pi * np.arange(n1) / n1)
    load = softening / softening.max() * (1 + 0.1 * np.add.outer(wave0, wave1))

    def constrained(field):
        """Part of a field on open points, without a mean if the mean gap is prescribed."""
        field = field * open_points
        return balanced(field, open_points) if problem.pressure is None else field

    # Conjugate gradients on the curvature of the energy, until one direction has a negative one.
    residual = constrained(-load.astype(np.float32))
    direction = None
    product = 0.0
    first = float(np.abs(residual).max())
    for _ in range(_MAX_PROBES):
        image = constrained(problem.smoother.apply(residual))
        last_product = product
        product = float(np.vdot(image, residual))
        if not product > 0:
            return None
        if direction is None:
            direction = -image
        else:
            direction = direction * np.float32(product / last_product) - image
        stress = problem.quick.stiffness(direction) + state.slope * direction
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
    lowest = problem.lowest(state.gap)
    gap = np.maximum(state.gap + 0.1 * problem.law.range * mode, lowest)
    return gap if problem.mean_gap is None else lowered(gap, problem.mean_gap, lowest)


def _from_coarser_grids(problem, tol, max_iterations, observe=None):
    """State at a prescribed pressure, from that on a grid half as fine.

    None if any descent meets negative curvature: the coarser grid may have jumped where this one
    does not. Without negative curvature there is no jump.
    """
    shape = problem.heights.shape
    if min(shape) < _MIN_POINTS_TO_COARSEN:
        gap = _without_adhesion(problem, max_iterations)
    else:
        heights = sample(problem.heights, tuple(coarsen(n) for n in shape))
        coarse = replace(problem, heights=heights)
        state = _from_coarser_grids(coarse, _COARSE_GRID_TOLERANCE, max_iterations)
        if state is None:
            return None
        gap = _predicted(problem, interpolate(state.gap, shape))
    state, finished = quick_descent(problem, gap, tol, max_iterations, observe, convex=True)
    return state if finished else None


def _predicted(problem, gap):
    """Gap interpolated from a coarser grid, closed where the heights of this one press."""
    pressure = problem.quick.stiffness((gap + problem.heights).astype(np.float32))
    pressure += problem.pressure + problem.law.traction(np.maximum(gap, 0))
    pressing = pressure > PREDICTION * problem.quick.mean_stiffness * gap
    return np.where(pressing, 0, np.maximum(gap, 0))


def _without_adhesion(problem, max_iterations):
    """Gap without adhesion, wider than any with it: a descent from it ends on the approach."""
    mean_gap = problem.mean_gap
    if problem.pressure is not None:
        alone = Problem(
            heights=problem.heights,
            sides=problem.sides,
            load=problem.pressure,
            solid=problem.solid,
            mirrored=problem.mirrored,
        )
        return solver.press(alone, _START_TOLERANCE).gap
    gap = mean_gap - problem.heights
    if gap.min() >= 0:
        return gap
    if mean_gap <= 0:
        return np.full(gap.shape, mean_gap)
    alone = replace(problem, law=FrozenTraction(np.zeros_like(gap), problem.law.range))
    return descend(alone, lowered(gap, mean_gap), _START_TOLERANCE, max_iterations).gap
