"""Descent to a state of equilibrium: projected, preconditioned nonlinear conjugate gradients.

The unknown is the gap. Points are free where the gap is open or where the wall would have to pull;
the others rest at the wall. Directions are Polak-Ribiere's, preconditioned with
``1 / (|q| / 2 + |q|_min / 2)`` between masks of the free points, so that the number of iterations
hardly depends on the grid. Where a law hardens steeply, its stiffness preconditions.

The step is the exact one for the curvature along the direction, clipped at the wall, shortened
until the energy falls. Where that curvature is negative, the step is the one of the elastic energy
alone (the potential of the attraction is concave, so its tangent lies above it), bounded by the
range of attraction: longer ones could pass a barrier that a slow motion would not. Where it is
positive, on the way from wider gaps, the attraction only steepens ahead, so that the exact step
stops short of equilibrium. The states found from the solution without adhesion are those of
monotone rounds that cannot pass a barrier (see the tests).

Increments of gap and elastic pressure are in single precision; every four decades of the residual,
and before it is believed, the pressure is recomputed in double precision.
"""

import numpy as np

from stickiness.adhesive.preconditioner import Preconditioner
from stickiness.adhesive.problem import State, balanced, evaluate, lowered, spans

_REFRESH = 1e-4  # fall of the residual after which the elastic pressure is recomputed
_MAX_SHORTENINGS = 30
# Stiffness of a law, over a mean of the half-space's, from which on it preconditions.
_STIFF_POINT = 3.0
# Share of its way to the singularity of a law that a point may go in one step.
_LARGEST_APPROACH = 0.5


def descend(problem, gap, tol, max_iterations, observer=None, elastic=None, rough=False):
    """Go down in energy from a gap to a state of equilibrium; returns the last `State`.

    At a prescribed mean gap the start must have it. `observer` is called with every state; descent
    stops when it returns true. `elastic` is the elastic pressure of the start, if known. `rough`:
    increments in single precision are good enough for the result.
    """
    state, spare = State.empty(gap.shape), State.empty(gap.shape)
    state.gap[...] = gap
    state.elastic[...] = problem.surface.elastic(gap) if elastic is None else elastic
    evaluate(problem, state)
    fresh, reference = elastic is None or rough, state.residual
    conjugate = _Conjugate(problem)
    last_soft, iteration, soft = 0, 0, True
    while True:
        known = rough and state.residual <= tol
        if not fresh and not known and state.residual <= max(tol, _REFRESH * reference):
            _refresh(problem, state)
            fresh, reference = True, state.residual
            conjugate.forget()
        done = state.residual <= tol or iteration >= max_iterations
        done = done or not np.isfinite(state.residual)
        if done or (observer is not None and observer(state)):
            break
        direction, image = conjugate.direction(state, soft)
        lower, soft = _step(problem, state, direction, image, spare)
        iteration += 1
        last_soft = iteration if soft else last_soft
        if lower:
            state, spare, fresh = spare, state, False
        elif conjugate.restarted:
            break  # nothing but rounding is left to gain
        else:
            conjugate.forget()
    if not fresh and not rough:
        _refresh(problem, state)
    state.iterations, state.last_run = iteration, iteration - last_soft
    return state


def _refresh(problem, state):
    """Free a state from the rounding of single precision."""
    mean = float(state.gap.mean())
    if problem.mean_gap is not None and mean != problem.mean_gap:
        if problem.wall and mean > 0:
            state.gap *= problem.mean_gap / mean  # contact stays contact
        else:
            state.gap += problem.mean_gap - mean
    state.elastic[...] = problem.surface.elastic(state.gap)
    evaluate(problem, state)


class _Conjugate:
    """Directions of descent and their images under the stiffness, in single precision."""

    def __init__(self, problem):
        self.problem = problem
        self.spans = spans(problem.surface.heights.shape)
        # A single point is held by the stiffness of a pixel, long waves by the longest wave's.
        self.pixel = problem.surface.quick.mean_stiffness
        self.longest = problem.surface.smoother.shift
        self.stiff_limit = _STIFF_POINT * np.sqrt(self.longest * self.pixel)
        self.hardens = problem.law.hardens
        self._stiffness = self.longest
        self._direction = np.empty(problem.surface.heights.shape, np.float32)
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
        problem = self.problem
        force = state.force
        if self.hardens:  # of every point alone, or in the longest wave
            self._stiffness = np.where(
                state.slope > self.stiff_limit, state.slope + self.stiff_limit, self.longest
            )
        if problem.pressure is None:
            force = self._less_mean(force.copy(), state.free)
        step = self._precondition(force, state, soft)
        product, cross = 0.0, 0.0
        for span in self.spans:
            product += float(np.vdot(step[span], force[span]))
            if self._product is not None:
                cross += float(np.vdot(step[span], self._force[span]))
        self.restarted = self._product is None
        weight = 0.0 if self.restarted else max(0.0, (product - cross) / self._product)
        for span in self.spans:
            self._update(span, step[span], state, weight)
            self._force[span] = force[span]
        if problem.pressure is None:
            self._balance(self._direction, state.gap > 0 if problem.wall else state.free)
        # No product, no conjugacy: all forces are zero or too small to square.
        self._product = product if product > 0 else None
        return self._direction, problem.surface.quick.stiffness(self._direction, out=self._image)

    def _update(self, span, step, state, weight):
        direction = self._direction[span]
        if weight > 0:
            direction *= np.float32(weight)
            direction *= state.free[span]
            direction -= step
        else:
            np.negative(step, out=direction)
        if self.problem.wall:
            # A free point at the wall is pulled off it: it can only open.
            shut = state.gap[span] <= 0
            np.maximum(direction, 0, out=direction, where=shut)

    def _precondition(self, force, state, soft):
        smooth = self.problem.surface.smoother.apply
        if self.hardens:
            stiff = self._stiffness > self.stiff_limit
            step = smooth(np.where(stiff, np.float32(0), force))
            np.divide(force, self._stiffness, out=step, where=stiff, casting="unsafe")
        elif soft:
            step = smooth(force)
        else:
            if self._free is None or not np.array_equal(self._free, state.free):
                self._free = state.free.copy()
                self._of_free_points = Preconditioner(self.problem.surface, self._free)
            step = self._of_free_points(force)
        for span in self.spans:
            step[span] *= state.free[span]
        return self._balance(step, state.free) if self.problem.pressure is None else step

    def _less_mean(self, force, points):
        """Subtract, in place, the mean force on some points, by what each would give way."""
        if not self.hardens or not points.any():
            return balanced(force, points)
        weight = points / self._stiffness
        force -= np.vdot(weight, force) / weight.sum() * points
        return force

    def _balance(self, field, points):
        """Subtract, in place, the mean of a field on some points, most of it where they give way.

        Spread evenly, the rounding of single precision alone would press stiff points hard.
        """
        if not self.hardens or not points.any():
            return balanced(field, points)
        weight = points / self._stiffness
        field -= field.sum(dtype=float) / weight.sum() * weight
        return field


def _step(problem, state, direction, image, lower):
    """Step along a direction into `lower`; whether energy fell and curvature was negative."""
    line = _Line(problem, state, direction, image)
    if not line.slope < 0:
        return False, False
    curvature = line.stiffness + line.softening + line.hardening
    soft = not curvature > 0
    if soft:
        curvature = line.stiffness + line.hardening
    # Never further than to the first touch and a little beyond, where curvature is no guide.
    law = problem.law
    reach = max(float(state.gap.min()), 0.0) + (law.range if soft else max(law.range, 1.0))
    longest = reach / line.largest
    length = min(-line.slope / curvature, longest) if curvature > -line.slope / longest else longest
    slack = 8 * np.finfo(float).eps * abs(state.potential)
    for _ in range(_MAX_SHORTENINGS):
        change = _move(problem, state, line, length, lower)
        if change <= slack:
            return True, soft
        predicted = length * line.slope
        length *= min(max(-0.5 * predicted / (change - predicted), 0.1), 0.5)
    return False, soft


class _Line:
    """A direction with the means over the grid that tell the energy along it.

    `slope` of the energy, elastic `stiffness`, negative and positive part (`softening`,
    `hardening`) of the law's curvature, `work`, the mean of traction times direction, `largest`
    component.
    """

    def __init__(self, problem, state, direction, image):
        self.direction, self.image = direction, image
        slope = stiffness = softening = hardening = work = largest = 0.0
        for span in spans(direction.shape):
            part = direction[span]
            slope += float(np.vdot(part, state.force[span]))
            stiffness += float(np.vdot(part, image[span]))
            double = part.astype(float)
            work += float(np.vdot(double, state.traction[span]))
            largest = max(largest, float(np.abs(part).max()))
            double *= double
            double *= state.slope[span]
            total = float(double.sum())
            hardens = problem.law.hardens
            positive = float(np.maximum(double, 0, out=double).sum()) if hardens else 0.0
            hardening += positive
            softening += total - positive
        n = direction.size
        self.slope, self.stiffness = slope * problem.unit / n, stiffness / n
        self.softening, self.hardening = softening / n, hardening / n
        self.work, self.largest = work / n, largest


def _move(problem, state, line, length, lower):
    """Evaluate the state at a length along a line, within bounds; returns the change of energy."""
    # Without a wall, points stay clear of the singularity of the law.
    nearest = _LARGEST_APPROACH * problem.law.range
    within = True
    for span in spans(state.gap.shape):
        gap = np.multiply(line.direction[span], length, out=lower.gap[span], dtype=float)
        gap += state.gap[span]
        lowest = 0.0 if problem.wall else _LARGEST_APPROACH * state.gap[span] - nearest
        if np.any(gap < lowest):
            within = False
            np.maximum(gap, lowest, out=gap)
        np.multiply(line.image[span], length, out=lower.elastic[span], dtype=float)
        lower.elastic[span] += state.elastic[span]
    if within:
        change = length * line.slope + length**2 * line.stiffness / 2 - length * line.work
    else:
        change = _shortcut(problem, state, lower)
    evaluate(problem, lower)
    return change + lower.potential - state.potential


def _shortcut(problem, state, lower):
    """Elastic pressure after a step cut short at bounds; change of energy without the law's."""
    if problem.mean_gap is not None:
        lowest = 0.0 if problem.wall else _LARGEST_APPROACH * (state.gap - problem.law.range)
        lower.gap[...] = lowered(lower.gap, problem.mean_gap, lowest)
    step = (lower.gap - state.gap).astype(np.float32)
    image = problem.surface.quick.stiffness(step)
    change = 0.0
    for span in spans(step.shape):
        double = step[span].astype(float)
        change += problem.unit * float(np.vdot(step[span], state.force[span]))
        change += float(np.vdot(double, 0.5 * image[span] - state.traction[span]))
        np.add(state.elastic[span], image[span], out=lower.elastic[span])
    return change / step.size
