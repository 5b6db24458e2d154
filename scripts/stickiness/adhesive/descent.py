"""Descent to a state of equilibrium: projected, preconditioned nonlinear conjugate gradients.

The unknown is the gap. Points are free where it is open or where the wall would have to pull.
Directions are Polak-Ribiere's. The step is the exact one for the curvature along the direction, cut
at the wall and shortened until the energy falls. Where that curvature is negative, the step is the
one of the elastic energy alone, bounded by the range of attraction: longer ones could pass a
barrier that a slow motion would not. Increments are in single precision; every four decades of the
residual, and before it is believed, the pressure is recomputed in double precision.
"""

from dataclasses import dataclass, replace

import numpy as np

from stickiness.adhesive.problem import balanced, largest, lowered, spans, sum_blocks

REFRESH = 1e-4  # fall of the residual after which the elastic pressure is recomputed
_MAX_SHORTENINGS = 30
# Stiffness of a law, over a mean of the half-space's, from which on it preconditions.
_STIFF_POINT = 3.0


def descend(problem, gap, tol, max_iterations, observer=None, elastic=None, approximate=False):
    """Go down in energy from a gap to a state of equilibrium; returns the last `State`.

    At a prescribed mean gap the start must have it. `observer` is called with every state; descent
    stops when it returns true. `elastic` is the elastic pressure of the start, if known. With
    `approximate`, increments in single precision are good enough for the result.
    """
    state = problem.state(gap, elastic)
    # Whether the elastic pressure is free of single precision, or need not be.
    fresh = elastic is None or approximate
    reference = state.residual
    conjugate = _Conjugate(problem)
    iteration = 0
    soft = True
    last_soft = 0
    while True:
        # Recompute the elastic pressure every four decades, and before the end is believed.
        good_enough = approximate and state.residual <= tol
        if not fresh and not good_enough and state.residual <= max(tol, REFRESH * reference):
            state = refreshed(problem, state)
            fresh = True
            reference = state.residual
            conjugate.forget()
        done = state.residual <= tol or iteration >= max_iterations
        done = done or not np.isfinite(state.residual)
        if done or (observer is not None and observer(state)):
            break
        direction, image = conjugate.direction(state, soft)
        lower, soft = _step(problem, state, direction, image)
        iteration += 1
        last_soft = iteration if soft else last_soft
        if lower is not None:
            state = lower
            fresh = False
        elif conjugate.restarted:
            break  # nothing but rounding is left to gain
        else:
            conjugate.forget()
    if not fresh and not approximate:
        state = refreshed(problem, state)
    state.iterations = iteration
    state.last_run = iteration - last_soft
    return state


def refreshed(problem, state):
    """State without the rounding of single precision."""
    gap = state.gap
    mean = float(gap.mean())
    if problem.mean_gap is not None and mean != problem.mean_gap:
        if problem.wall and mean > 0:
            gap = gap * (problem.mean_gap / mean)  # contact stays contact
        else:
            gap = gap + (problem.mean_gap - mean)
    return replace(problem.state(gap), separated=state.separated)


class _Conjugate:
    """Directions of descent and their images under the stiffness, in single precision."""

    def __init__(self, problem):
        self.problem = problem
        # A single point is held by the stiffness of a pixel, long waves by the longest wave's.
        self.longest = problem.smoother.shift
        self.stiff_limit = _STIFF_POINT * np.sqrt(self.longest * problem.quick.mean_stiffness)
        self._direction = np.empty(problem.heights.shape, np.float32)
        self._force = np.empty_like(self._direction)
        self._image = np.empty_like(self._direction)
        self._free = None
        self.forget()

    def forget(self):
        """Begin with steepest descent again."""
        self._product = None

    def direction(self, state, soft):
        """Next direction and its image, overwritten by the next call.

        After a `soft` step, of negative curvature, edges of contact are not attended to: they move.
        """
        wall = self.problem.wall
        at_gap = self.problem.pressure is None
        free = state.free
        force = state.force
        direction = self._direction
        if not wall:  # of every point alone, or in the longest wave
            stiff = state.slope > self.stiff_limit
            self._stiffness = np.where(stiff, state.slope + self.stiff_limit, self.longest)
            self._give = 1 / self._stiffness
        if at_gap:
            force = self._less_mean(force.copy(), free)
        step = self._precondition(force, free, soft)
        # Weight of the last direction by Polak and Ribiere.
        product = sum_blocks(np.vdot, step, force)
        self.restarted = self._product is None
        weight = 0.0
        if not self.restarted:
            cross = sum_blocks(np.vdot, step, self._force)
            weight = max(0.0, (product - cross) / self._product)
        if weight > 0:
            direction *= np.float32(weight)
            direction *= free
            direction -= step
        else:
            np.negative(step, out=direction)
        if wall:
            # A free point at the wall is pulled off it: it can only open.
            np.maximum(direction, 0, out=direction, where=state.gap <= 0)
        self._force[...] = force
        if at_gap:
            self._balance(direction, state.gap > 0)
        # No product, no conjugacy: all forces are zero or too small to square.
        self._product = product if product > 0 else None
        return direction, self.problem.quick.stiffness(direction, out=self._image)

    def _precondition(self, force, free, soft):
        """How far the free points would give way to a force, each and together."""
        smoother = self.problem.smoother
        if not self.problem.wall:
            stiff = self._stiffness > self.stiff_limit
            step = smoother.apply(np.where(stiff, np.float32(0), force))
            np.divide(force, self._stiffness, out=step, where=stiff, casting="unsafe")
        elif soft:
            step = smoother.apply(force)
        else:
            if self._free is None or not np.array_equal(self._free, free):
                self._free = free.copy()
                self._share = smoother.share_of(free)
            step = smoother.apply(force, self._share)
        step *= free
        return self._balance(step, free) if self.problem.pressure is None else step

    def _less_mean(self, force, free):
        """Subtract, in place, the mean force on free points, by what each would give way."""
        if self.problem.wall:
            return balanced(force, free)
        force -= np.vdot(self._give, force) / self._give.sum() * free
        return force

    def _balance(self, field, points):
        """Subtract, in place, the mean of a field; without a wall mostly where points give way."""
        if self.problem.wall:
            return balanced(field, points)
        # Spread evenly, the rounding of single precision alone would press stiff points hard.
        field -= field.sum(dtype=float) / self._give.sum() * self._give
        return field


def _step(problem, state, direction, image):
    """State of less energy along a direction, if any, and whether curvature was negative."""
    law = problem.law
    along = _sum_along(direction, image, state)
    slope = along.slope * problem.unit / direction.size
    stiffness = along.stiffness / direction.size
    work = along.work / direction.size
    softening = along.softening / direction.size
    hardening = along.hardening / direction.size
    if not slope < 0:
        return None, False
    # Length of the exact step, where the curvature is positive.
    curvature = stiffness + softening + hardening
    soft = not curvature > 0
    if soft:
        # The potential of the attraction is concave, so that its tangent lies above it.
        curvature = stiffness + hardening
    # Never further than to the first touch and a little beyond, where curvature is no guide.
    reach = max(float(state.gap.min()), 0.0) + (law.range if soft else max(law.range, 1.0))
    longest = reach / largest(direction)
    length = min(-slope / curvature, longest) if curvature > -slope / longest else longest
    # Shorten it until the energy falls, by a parabola through what is known of the energy.
    slack = 8 * np.finfo(float).eps * abs(state.potential)
    for _ in range(_MAX_SHORTENINGS):
        gap = _moved(state.gap, direction, length)
        if _is_too_low(problem, state, gap):
            gap, elastic, change = _cut_short(problem, state, gap)
        else:
            elastic = _moved(state.elastic, image, length)
            change = length * slope + length**2 * stiffness / 2 - length * work
        lower = problem.state(gap, elastic)
        change = change + lower.potential - state.potential
        if change <= slack:
            return lower, soft
        predicted = length * slope
        length *= min(max(-0.5 * predicted / (change - predicted), 0.1), 0.5)
    return None, soft


def _is_too_low(problem, state, gap):
    """Whether a step ends below the lowest gaps anywhere."""
    return any(np.any(gap[s] < problem.lowest(state.gap[s])) for s in spans(gap.shape))


@dataclass(frozen=True)
class _AlongDirection:
    """Sums over the grid of what happens along a direction."""

    slope: float  #: of the energy, in the problem's unit
    stiffness: float  #: elastic curvature
    work: float  #: of the law's traction
    softening: float  #: curvature of the law's potential where it is negative
    hardening: float  #: and where it is positive


def _sum_along(direction, image, state):
    """Sum up slope and curvatures of the energy along a direction, block by block."""
    slope = stiffness = work = softening = hardening = 0.0
    for span in spans(direction.shape):
        part = direction[span]
        slope += float(np.vdot(part, state.force[span]))
        stiffness += float(np.vdot(part, image[span]))
        curvature = part.astype(float)
        work += float(np.vdot(curvature, state.traction[span]))
        curvature *= curvature
        curvature *= state.slope[span]
        total = curvature.sum()
        positive = np.maximum(curvature, 0, out=curvature).sum()
        softening += float(total - positive)
        hardening += float(positive)
    return _AlongDirection(slope, stiffness, work, softening, hardening)


def _moved(field, direction, length):
    """Field after a step, in blocks of rows that stay in cache."""
    out = np.empty_like(field)
    for span in spans(field.shape):
        np.multiply(direction[span], length, out=out[span], dtype=float)
        out[span] += field[span]
    return out


def _cut_short(problem, state, gap):
    """Gap cut short at its bounds, its elastic pressure, change of energy without the law's."""
    lowest = problem.lowest(state.gap)
    gap = np.maximum(gap, lowest)
    if problem.mean_gap is not None:
        gap = lowered(gap, problem.mean_gap, lowest)
    step = (gap - state.gap).astype(np.float32)
    image = problem.quick.stiffness(step)
    change = 0.0
    for span in spans(step.shape):
        change += problem.unit * float(np.vdot(step[span], state.force[span]))
        stress = 0.5 * image[span] - state.traction[span]
        change += float(np.vdot(step[span].astype(float), stress))
    return gap, state.elastic + image, change / step.size
