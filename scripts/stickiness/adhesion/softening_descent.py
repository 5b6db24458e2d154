"""Quick descent for laws that only soften, at a prescribed pressure, mostly in single precision.

The steps are those of `descent`, in rounds: increments of gap, force and energy are in single
precision within a round, and computed again in double precision between rounds (iterative
refinement). Once the force is small it changes linearly with the gap: the law is then evaluated,
and energies are compared, between rounds only. If a round raises the energy or changes nothing,
the general descent takes over.
"""

import numpy as np

from stickiness.adhesion.preconditioner import Preconditioner
from stickiness.adhesion.state import State, evaluate, spans

_FALL = 1e-3  # reduction of the force by a round
_LINEAR = 1e-3  # residual below which the traction is linear in the change of the gap
_ROUND = 50  # steps of a round at most
_NEAR = 0.03  # change of a gap, over the range, up to which that holds
_SHORTENINGS = 30
_ROUNDING = 1e-7  # relative error of a sum of energies in single precision
_MARGIN = 0.5  # of the tolerance that a last round aims for


def suits(problem):
    """Whether a problem is one for `quick_descent`."""
    return problem.wall and not problem.law.hardens and problem.pressure is not None


def quick_descent(problem, gap, tol, max_iterations, observer=None, convex=False):
    """Go down in energy from a gap; returns the last `State` and whether the descent finished.

    It does not if a round raises the energy or comes to nothing, or, if `convex`, at the first
    direction of negative curvature. `observer` is called with the state at every round; descent
    stops when it returns true.
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
    for span in spans(state.gap.shape):
        gap = np.multiply(steps.change[span], problem.unit, out=other.gap[span], dtype=float)
        gap += state.gap[span]
        gap[steps.change[span] <= steps.lowest[span]] = 0
        np.maximum(gap, 0, out=gap)
    other.elastic[...] = problem.surface.elastic(other.gap)
    change = 0.0
    for span in spans(state.gap.shape):
        force = state.elastic[span] + other.elastic[span]
        force *= 0.5
        force += problem.pressure
        change += float(np.vdot(other.gap[span] - state.gap[span], force))
    evaluate(problem, other)
    change = change / state.gap.size + other.potential - state.potential
    return change <= 8 * np.finfo(float).eps * abs(state.potential)


class _Steps:
    """Conjugate directions and steps along them, in single precision and the problem's pressure."""

    def __init__(self, problem, shape):
        self.problem, self.surface, self.spans = problem, problem.surface, spans(shape)
        self.law, self.unit = problem.law, problem.unit
        fields = [np.zeros(shape, np.float32) for _ in range(14)]
        # `change` of the gap in a round, over the unit of pressure; `lowest` closes the gap.
        self.change, self.lowest, self.traction, self.slope, self.potential, *fields = fields
        self.new_traction, self.new_slope, self.new_potential, *fields = fields
        # `force` is the reaction on free points, `fall` its last change.
        self.reaction, self.force, self.fall, self.direction, self.image, self.cut = fields
        self.free = np.empty(shape, bool)
        # Steps so far, and up to the last direction of negative curvature; `soft` tells whether
        # the round ended at one, along which the tangent of the law is no guide.
        self.count = self.last_soft = 0
        self.product, self.soft = 0.0, False

    def begin(self, state):
        """Begin a round at a state; directions stay conjugate to those of the last one."""
        self.linear = state.residual < _LINEAR and not self.soft
        self.residual, self.soft = state.residual, False
        self.change[...] = 0
        for span in self.spans:
            reaction = state.elastic[span] + state.traction[span]
            reaction += self.problem.pressure
            reaction /= self.unit
            self.reaction[span] = reaction
            self.lowest[span] = state.gap[span] / -self.unit
            self.slope[span] = state.slope[span]
            np.subtract(state.force[span], self.force[span], out=self.fall[span])
            self.force[span] = state.force[span]
        self.free[...] = state.free
        if not self.linear:
            total = 0.0
            for span in self.spans:
                gap = -self.unit * self.lowest[span]
                values = self.law.at(span).evaluate(gap)
                self.traction[span], self.slope[span], self.potential[span] = values
                total += float(self.potential[span].sum(dtype=float))
            self.slack = _ROUNDING * abs(total)
        self.precondition = Preconditioner(self.surface, state.free)

    def descend(self, goal, limit, convex):
        """Go on until the largest force is down to a goal, or curvature is no guide."""
        limit = min(limit, self.count + _ROUND)
        while self.count < limit and self.residual > goal:
            step = self.precondition(self.force)
            last, self.product, weight = self.product, 0.0, 0.0
            for span in self.spans:
                step[span] *= self.free[span]
                self.product += float(np.vdot(step[span], self.force[span]))
                weight += float(np.vdot(step[span], self.fall[span]))
            weight = max(0.0, weight / last) if last > 0 else 0.0
            slope, stiffness, softening, largest = self._turn(step, weight)
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
            longest /= self.unit * largest
            # A uniform direction has no stiffness.
            length = min(-slope / curvature, longest) if curvature > 0 else longest
            if self.soft or not self._advance(slope, length):
                break

    def _turn(self, step, weight):
        """Next direction; slope and curvatures of the energy along it, its largest component."""
        for span in self.spans:
            direction = self.direction[span]
            direction *= np.float32(weight)
            direction *= self.free[span]
            direction -= step[span]
            # A free point at the wall is pulled off it: it can only open.
            shut = self.change[span] <= self.lowest[span]
            np.maximum(direction, 0, out=direction, where=shut)
        self.surface.quick.stiffness(self.direction, out=self.image)
        slope = stiffness = softening = largest = 0.0
        for span in self.spans:
            direction = self.direction[span]
            slope += float(np.vdot(direction, self.force[span]))
            stiffness += float(np.vdot(direction, self.image[span]))
            softening += float(np.vdot(direction, self.slope[span] * direction))
            largest = max(largest, float(np.abs(direction).max()))
        return slope, stiffness, softening, largest

    def _advance(self, slope, length):
        """Go along the direction, not beyond the wall; returns whether the round may go on."""
        for _ in range(1 if self.linear else _SHORTENINGS):
            step, image, factor = self._within(np.float32(length))
            rise = 0.0 if self.linear else self._rise(step, image, factor)
            if self.linear or rise <= self.slack:
                return self._go(step, image, factor)
            predicted = length * slope * self.unit**2
            length *= min(max(-0.5 * predicted / (rise - predicted), 0.1), 0.5)
        return False

    def _within(self, length):
        """Step, its image, and a factor for both; if cut short at the wall, of its own image."""
        for span in self.spans:
            if np.any(self.change[span] + length * self.direction[span] < self.lowest[span]):
                break
        else:
            return self.direction, self.image, length
        step = np.empty_like(self.direction)
        for span in self.spans:
            np.multiply(self.direction[span], length, out=step[span])
            np.maximum(step[span], self.lowest[span] - self.change[span], out=step[span])
        return step, self.surface.quick.stiffness(step, out=self.cut), np.float32(1)

    def _rise(self, step, image, factor):
        """Change of energy by a step, summed over the grid; keeps what the law says there."""
        total = 0.0
        for span in self.spans:
            part = step[span] * factor
            gap = self.change[span] + part
            gap -= self.lowest[span]
            np.maximum(gap, 0, out=gap)
            gap *= np.float32(self.unit)
            traction, slope, potential = self.law.at(span).evaluate(gap)
            self.new_traction[span], self.new_slope[span] = traction, slope
            self.new_potential[span] = potential
            potential = potential - self.potential[span]
            elastic = image[span] * (factor / 2)
            elastic += self.reaction[span]
            total += self.unit**2 * float(np.vdot(part, elastic))
            total -= self.unit * float(np.vdot(part, self.traction[span]))
            total += float(potential.sum(dtype=float))
        return total

    def _go(self, step, image, factor):
        """Make a step; returns whether it is short enough for the present tangent."""
        residual = longest = 0.0
        for span in self.spans:
            change, reaction, force = self.change[span], self.reaction[span], self.force[span]
            part = step[span] * factor
            change += part
            np.maximum(change, self.lowest[span], out=change)
            reaction += factor * image[span]
            if self.linear:
                longest = max(longest, float(np.abs(change).max()))
                part *= self.slope[span]
            else:
                np.subtract(self.new_traction[span], self.traction[span], out=part)
                part /= np.float32(self.unit)
            reaction += part
            free = np.logical_or(change > self.lowest[span], reaction < 0, out=self.free[span])
            np.negative(force, out=self.fall[span])
            np.multiply(reaction, free, out=force)
            self.fall[span] += force
            residual = np.maximum(residual, np.abs(force).max())
        self.residual = float(residual)
        if not self.linear:
            self.traction, self.new_traction = self.new_traction, self.traction
            self.slope, self.new_slope = self.new_slope, self.slope
            self.potential, self.new_potential = self.new_potential, self.potential
        return self.unit * longest <= _NEAR * self.law.range
