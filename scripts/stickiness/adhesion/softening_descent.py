"""Quick descent for laws that only soften, mostly in single precision.

The steps are those of `descent`, in rounds: increments of gap, force and energy are in single
precision within a round, and computed again in double precision between rounds (iterative
refinement). Once the force is small it changes linearly with the gap: the law is then evaluated,
and energies are compared, between rounds only.

Until then a step is cut short at the wall, which takes an image of its own: one that passes the
wall might pass a barrier, too. Afterwards points that pass it by little stay behind it for the rest
of the round and are put back at its end, and a round ends when the force on them is no longer small
against the residual. If a round raises the energy or changes nothing, the general descent takes
over.
"""

import numpy as np

from stickiness.adhesion.preconditioner import Preconditioner
from stickiness.adhesion.state import State, evaluate, spans

_FALL = 1e-3  # reduction of the force by a round
_LINEAR = 1e-3  # residual below which the traction is linear in the change of the gap
_ROUND = 50  # steps of a round at most
_NEAR = 0.03  # change of a gap, over the range, up to which that holds
_CUT = 1.0  # force on points behind the wall over the residual from which a step is cut anyway
_PUT_OFF = 0.3  # residual over the force on points behind the wall at which a round ends
_FAR = np.float32(-1e30)  # no bound
_SHORTENINGS = 30
_ROUNDING = 1e-7  # relative error of a sum of energies in single precision
_MARGIN = 0.8  # of the tolerance that a last round aims for


def suits(problem):
    """Whether a problem is one for `quick_descent`."""
    return problem.wall and not problem.law.hardens


def quick_descent(problem, gap, tol, max_iterations, observer=None, convex=False):
    """Go down in energy from a gap; returns the last `State` and whether the descent finished.

    At a prescribed mean gap the start must have it. It does not finish if a round raises the energy
    or comes to nothing, or, if `convex`, at the first direction of negative curvature. `observer`
    is called with the state at every round; descent stops when it returns true.
    """
    state, other = State.empty(gap.shape), State.empty(gap.shape)
    state.gap[...] = gap
    state.elastic[...] = problem.surface.elastic(gap)
    evaluate(problem, state)
    steps, finished = _Steps(problem, gap.shape), True
    while finished:
        done = state.residual <= tol or steps.count >= max_iterations
        done = done or not np.isfinite(state.residual)
        if done or (observer is not None and observer(state)):
            break
        steps.begin(state)
        steps.descend(max(_FALL * state.residual, _MARGIN * tol), max_iterations, convex)
        finished = not (convex and steps.last_soft) and (steps.soft or steps.change.any())
        finished = finished and _moved(problem, state, steps, other)
        if finished:
            state, other = other, state
    state.iterations, state.last_run = steps.count, steps.count - steps.last_soft
    return state, finished


def _moved(problem, state, steps, other):
    """State after a round into the arrays of another; returns whether the energy fell."""
    total = 0.0
    for span in spans(state.gap.shape):
        gap = np.multiply(steps.change[span], problem.unit, out=other.gap[span], dtype=float)
        gap += state.gap[span]
        gap *= steps.above[span]
        total += float(np.maximum(gap, 0, out=gap).sum())
    if (
        problem.mean_gap is not None and total > 0
    ):  # in proportion: contact stays contact, edges keep their shape
        other.gap *= problem.mean_gap * other.gap.size / total
    other.elastic[...] = problem.surface.elastic(other.gap)
    change = 0.0
    for span in spans(state.gap.shape):
        force = state.elastic[span] + other.elastic[span]
        force *= 0.5
        force += state.pressure
        change += float(np.vdot(other.gap[span] - state.gap[span], force))
    evaluate(problem, other)
    change = change / state.gap.size + other.potential - state.potential
    return change <= 8 * np.finfo(float).eps * abs(state.potential)


class _Steps:
    """Conjugate directions and steps along them, in single precision and the problem's pressure."""

    def __init__(self, problem, shape):
        self.problem, self.surface, self.spans = problem, problem.surface, spans(shape)
        self.law, self.unit = problem.law, problem.unit
        self.at_gap = problem.pressure is None
        self.pixel = problem.surface.quick.mean_stiffness
        fields = [np.zeros(shape, np.float32) for _ in range(13)]
        # `change` of the gap in a round, over the unit of pressure; `lowest` closes the gap.
        self.change, self.lowest, self.traction, self.slope, *fields = fields
        self.new_traction, self.new_slope, *fields = fields
        # `force` is the reaction on free points, `last_force` that one step before.
        self.reaction, self.force, self.last_force, *fields = fields
        self.direction, self.image, self.step, self.cut = fields
        # Points that take part, and those above the wall: 1, the others 0; quicker than booleans.
        self.free, self.above = np.empty((2, *shape), np.float32)
        # Steps so far, and up to the last direction of negative curvature; `soft` tells whether
        # the round ended at one, along which the tangent of the law is no guide.
        self.count = self.last_soft = 0
        self.product, self.soft = 0.0, False

    def begin(self, state):
        """Begin a round at a state; directions stay conjugate to those of the last one."""
        self.linear = state.residual < _LINEAR and not self.soft
        self.residual, self.behind, self.soft = state.residual, 0.0, False
        self.change[...] = 0
        for span in self.spans:
            reaction = state.elastic[span] + state.traction[span]
            reaction += state.pressure
            reaction /= self.unit
            self.reaction[span] = reaction
            self.lowest[span] = state.gap[span] / -self.unit
            self.slope[span] = state.slope[span]
            self.above[span] = state.gap[span] > 0
        self.free[...] = state.free
        self.free_points = np.count_nonzero(state.free)
        self.precondition = Preconditioner(self.surface, self.free)
        mean = float(state.force.sum(dtype=float)) / max(self.free_points, 1)
        mean = np.float32(mean if self.at_gap else 0)
        for span in self.spans:
            np.subtract(state.force[span], mean * self.free[span], out=self.last_force[span])
        self.force, self.last_force = self.last_force, self.force
        if not self.linear:
            self.potential = 0.0
            for span in self.spans:
                gap = np.float32(-self.unit) * self.lowest[span]
                traction, slope, potential = self.law.at(span).evaluate(gap)
                self.traction[span], self.slope[span] = traction, slope
                self.potential += float(potential.sum())
            self.slack = _ROUNDING * abs(self.potential)

    def descend(self, goal, limit, convex):
        """Go on until the largest force is down to a goal, or curvature is no guide."""
        limit = min(limit, self.count + _ROUND)
        while self.count < limit and self.residual > max(goal, _PUT_OFF * self.behind):
            weight = self._turn(self.precondition(self.force))
            self.surface.quick.stiffness(self.direction, out=self.image)
            slope, stiffness, softening, largest = self._measure()
            self.count += 1
            if not slope < 0:
                if weight == 0:
                    break  # nothing but rounding is left to gain
                self.product = 0.0
                continue
            curvature, longest = stiffness + softening, max(self.law.range, 1.0)
            if not curvature > 0:
                curvature, longest = stiffness, self.law.range
                self.last_soft, self.soft = self.count, self.linear or convex
                self.precondition = self.surface.smoother.apply  # edges of contact move
            longest /= self.unit * largest
            # A uniform direction has no stiffness.
            length = min(-slope / curvature, longest) if curvature > 0 else longest
            if self.soft or not self._advance(slope, length):
                break

    def _turn(self, step):
        """Next direction, from a preconditioned force; returns the weight of the last one."""
        last, self.product, weight, total = self.product, 0.0, 0.0, 0.0
        for span in self.spans:
            part = step[span]
            part *= self.free[span]
            total += float(part.sum())
        mean = np.float32(total / max(self.free_points, 1) if self.at_gap else 0)
        for span in self.spans:
            part = step[span]
            if self.at_gap:
                part -= mean * self.free[span]
            self.product += float(np.vdot(part, self.force[span]))
            weight += float(np.vdot(part, self.last_force[span]))
        weight = max(0.0, (self.product - weight) / last) if last > 0 else 0.0
        total = count = 0.0
        for span in self.spans:
            direction, above = self.direction[span], self.above[span]
            direction *= np.float32(weight)
            direction *= self.free[span]
            direction -= step[span]
            # A free point at the wall, or behind it, can only open.
            np.maximum(direction, above * _FAR, out=direction)
            total += float(direction.sum())
            count += float(above.sum())
        if self.at_gap and count:
            mean = np.float32(total / count)
            for span in self.spans:
                self.direction[span] -= mean * self.above[span]
        return weight

    def _measure(self):
        """Slope and curvatures of the energy along the direction, its largest component."""
        slope = stiffness = softening = largest = 0.0
        for span in self.spans:
            direction = self.direction[span]
            slope += float(np.vdot(direction, self.force[span]))
            stiffness += float(np.vdot(direction, self.image[span]))
            softening += float(np.vdot(direction, self.slope[span] * direction))
            largest = max(largest, float(direction.max()), -float(direction.min()))
        return slope, stiffness, softening, largest

    def _advance(self, slope, length):
        """Go along the direction; returns whether the round may go on."""
        for _ in range(1 if self.linear else _SHORTENINGS):
            step = self._within(np.float32(length))
            rise = 0.0 if self.linear else self._rise(*step)
            if self.linear or rise <= self.slack:
                return self._go(*step)
            predicted = length * slope * self.unit**2
            length *= min(max(-0.5 * predicted / (rise - predicted), 0.1), 0.5)
        return False

    def _within(self, length):
        """Step, its image, and a factor for both; cut short at the wall, of its own image.

        Not if the force on what lies behind the wall is small: that is put off.
        """
        deepest = 0.0
        for span in self.spans:
            height = self.direction[span] * length
            height += self.change[span]
            height -= self.lowest[span]
            deepest = min(deepest, float(height.min()))
        allowed = _CUT * self.residual if self.linear else 0.0
        if -deepest * self.pixel <= max(allowed, self.behind):
            return self.direction, self.image, length
        total, count = 0.0, 0.0
        for span in self.spans:
            step, above = self.step[span], self.above[span]
            np.multiply(self.direction[span], length, out=step)
            least = self.lowest[span] - self.change[span]
            np.minimum(least, 0, out=least)  # what is behind stays there
            np.maximum(step, least, out=step)
            above[...] = step > least
            count += float(above.sum())
            total += float(step.sum())
        if self.at_gap and count:
            mean = np.float32(total / count)
            for span in self.spans:
                self.step[span] -= mean * self.above[span]
        return self.step, self.surface.quick.stiffness(self.step, out=self.cut), np.float32(1)

    def _rise(self, step, image, factor):
        """Change of energy by a step, summed over the grid; keeps what the law says there."""
        total = work = self.new_potential = 0.0
        for span in self.spans:
            part = step[span] * factor
            gap = part - self.lowest[span]
            gap += self.change[span]
            np.maximum(gap, 0, out=gap)
            gap *= np.float32(self.unit)
            traction, slope, potential = self.law.at(span).evaluate(gap)
            self.new_traction[span], self.new_slope[span] = traction, slope
            self.new_potential += float(potential.sum())
            elastic = np.multiply(image[span], factor / 2, out=gap)
            elastic += self.reaction[span]
            total += float(np.vdot(part, elastic))
            work += float(np.vdot(part, self.traction[span]))
        total = self.unit * (self.unit * total - work)
        return total + self.new_potential - self.potential

    def _go(self, step, image, factor):
        """Make a step; returns whether it is short enough for the present tangent."""
        longest, total = 0.0, 0.0
        for span in self.spans:
            part = step[span] * factor
            change, reaction, free = self.change[span], self.reaction[span], self.free[span]
            change += part
            if step is self.step:  # no rounding where it ends at the wall
                at_wall = (self.above[span] == 0) & (free != 0) & (part < 0)
                change[at_wall] = self.lowest[span][at_wall]
            if self.linear:
                longest = max(longest, float(change.max()), -float(change.min()))
                part *= self.slope[span]
            else:
                np.subtract(self.new_traction[span], self.traction[span], out=part)
                part /= np.float32(self.unit)
            reaction += part
            reaction += np.multiply(image[span], factor, out=part)
            if self.at_gap:
                total += float(np.vdot(reaction, free))
        self._release(np.float32(total / max(self.free_points, 1)))
        if not self.linear:
            self.traction, self.new_traction = self.new_traction, self.traction
            self.slope, self.new_slope = self.new_slope, self.slope
            self.potential = self.new_potential
        return self.unit * longest <= _NEAR * self.law.range

    def _release(self, mean):
        """Free points that the wall would have to pull, put off those behind it; new forces."""
        residual, deepest, count, changed = 0.0, 0.0, 0, False
        self.force, self.last_force = self.last_force, self.force
        for span in self.spans:
            reaction, force = self.reaction[span], self.force[span]
            if self.at_gap:
                reaction -= mean
            height = self.change[span] - self.lowest[span]
            deepest = min(deepest, float(height.min()))
            above = height > 0
            self.above[span] = above
            free = np.logical_or(above, reaction < 0)
            count += np.count_nonzero(free)
            changed = changed or not np.array_equal(free, self.free[span])
            self.free[span] = free
            np.multiply(reaction, self.free[span], out=force)
            residual = max(residual, float(force.max()), -float(force.min()))
        self.residual, self.behind, self.free_points = residual, -deepest * self.pixel, count
        if changed:
            self.precondition = Preconditioner(self.surface, self.free)
