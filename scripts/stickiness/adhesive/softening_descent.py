"""Quick descent for laws with a wall, whose traction never grows with the gap.

Most of it is in single precision. The steps are those of `descent`, in rounds: increments of gap,
force and energy are in single precision within a round, and computed again in double precision
between rounds (iterative refinement). Once the force is small it changes linearly with the gap: the
law is then evaluated, and energies are compared, between rounds only. Fields of the compiled loops
at the end are flat.
"""

import numpy as np

from stickiness.adhesive.problem import largest, spans, sum_blocks
from stickiness.compiled import compiled
from stickiness.repulsive import convolution

_ROUND_REDUCTION = 1e-3  # reduction of the force by a round
_LINEAR_RESIDUAL = 1e-3  # residual below which the traction is linear in the change of the gap
_MAX_ROUND_STEPS = 50  # steps of a round at most
_MAX_LINEAR_CHANGE = 0.03  # change of a gap, over the range, up to which that holds
# A step is cut at the wall once the force behind it exceeds this multiple of the residual.
_CUT_FORCE = 1.0
_PUT_OFF_FORCE = 0.3  # residual over the force on points behind the wall at which a round ends
_MAX_SHORTENINGS = 30
_ROUNDING = 1e-7  # relative error of a sum of energies in single precision
_LAST_ROUND_SHARE = 0.8  # of the tolerance that a last round aims for
# Numbers of single precision, for the compiled loops.
_NONE = np.float32(0)
_HALF = np.float32(0.5)


def quick_descent(problem, gap, tol, max_iterations, observer=None, convex=False):
    """Go down in energy from a gap; returns the last `State` and whether the descent finished.

    At a prescribed mean gap the start must have it. It does not finish if a round raises the energy
    or comes to nothing, or, if `convex`, at the first direction of negative curvature. `observer`
    is called with the state at every round; descent stops when it returns true.
    """
    state = problem.state(gap)
    steps = _Steps(problem)
    finished = True
    while finished:
        done = state.residual <= tol or steps.count >= max_iterations
        done = done or not np.isfinite(state.residual)
        if done or (observer is not None and observer(state)):
            break
        # A round in single precision, and the state that it leads to in double precision.
        steps.begin(state)
        goal = max(_ROUND_REDUCTION * state.residual, _LAST_ROUND_SHARE * tol)
        steps.descend(goal, max_iterations, convex)
        moved = None
        if not (convex and steps.last_soft) and (steps.soft or steps.change.any()):
            moved = _moved(problem, state, steps)
        finished = moved is not None
        state = moved if finished else state
    state.iterations = steps.count
    state.last_run = steps.count - steps.last_soft
    return state, finished


def _moved(problem, state, steps):
    """State after a round; None if the energy rose."""
    gap = np.empty_like(state.gap)
    total = _move_gap(state.gap.ravel(), gap.ravel(), steps.change, problem.unit, steps.above)
    if problem.mean_gap is not None and total > 0:
        # In proportion: contact stays contact, edges keep their shape.
        gap *= problem.mean_gap * gap.size / total
    moved = problem.state(gap)
    # Work against elastic and mean pressure between the two gaps, and change of the potential.
    work = sum_blocks(
        lambda last_gap, gap, last_elastic, elastic: np.vdot(
            gap - last_gap, (last_elastic + elastic) / 2 + state.pressure
        ),
        state.gap,
        gap,
        state.elastic,
        moved.elastic,
    )
    change = work / gap.size + moved.potential - state.potential
    return moved if change <= 8 * np.finfo(float).eps * abs(state.potential) else None


class _Steps:
    """Conjugate directions and steps along them, in single precision and the problem's pressure.

    At first a step is cut short at the wall, which takes another convolution: a step that passes
    the wall might pass a barrier, too. Once the force is small, points that pass it by little stay
    behind it for the rest of the round and are put back at its end, and a round ends when the force
    on them is no longer small against the residual.
    """

    def __init__(self, problem):
        self.problem = problem
        self.law = problem.law
        self.unit = problem.unit
        self.shape = problem.heights.shape
        self.at_gap = problem.pressure is None
        self.pixel = problem.quick.mean_stiffness
        size = problem.heights.size

        def field():
            return convolution.aligned_zeros(size, np.float32)

        # All gaps and pressures here are over `problem.unit`. The change of the gap in a round, and
        # the one that brings a point to the wall.
        self.change = field()
        self.lowest = field()
        # Traction of the law and its slope, at the last step and at the next.
        self.traction = field()
        self.slope = field()
        self.new_traction = field()
        self.new_slope = field()
        # Reaction, the part of it on free points, and that one step before.
        self.reaction = field()
        self.force = field()
        self.last_force = field()
        # Direction and its image under the stiffness; a step cut short, and its image.
        self.direction = field()
        self.image = field()
        self.step = field()
        self.cut_image = field()
        # Points that take part, and those above the wall.
        self.free = np.empty(size, bool)
        self.above = np.empty(size, bool)
        # Steps so far, and up to the last direction of negative curvature; `soft` tells whether
        # the round ended at one, along which the tangent of the law is no guide.
        self.count = 0
        self.last_soft = 0
        self.soft = False
        self.product = 0.0

    def begin(self, state):
        """Begin a round at a state; directions stay conjugate to those of the last one."""
        self.linear = state.residual < _LINEAR_RESIDUAL and not self.soft
        self.soft = False
        self.residual = state.residual
        self.behind = 0.0  # force on points behind the wall
        self.change[...] = 0
        self.lowest[...] = state.gap.ravel() / -self.unit
        reaction = state.elastic + state.traction
        reaction += state.pressure
        reaction /= self.unit
        self.reaction[...] = reaction.ravel()
        self.slope[...] = state.slope.ravel()
        self.free[...] = state.free.ravel()
        self.above[...] = state.gap.ravel() > 0
        self._swap_forces()
        self.force[...] = state.force.ravel()
        self.free_points = np.count_nonzero(self.free)
        self.share = self.problem.smoother.share_of(self.free.reshape(self.shape))
        if self.at_gap:
            mean = np.float32(self._mean(self.force.sum(dtype=float)))
            np.subtract(self.force, mean, out=self.force, where=self.free)
        if not self.linear:
            self.potential = self._evaluate(self.change, 0.0, self.traction, self.slope)
            self.slack = _ROUNDING * abs(self.potential)

    def descend(self, goal, limit, convex):
        """Go on until the largest force is down to a goal, or curvature is no guide."""
        limit = min(limit, self.count + _MAX_ROUND_STEPS)
        while self.count < limit and self.residual > max(goal, _PUT_OFF_FORCE * self.behind):
            weight, slope, softening = self._turn()
            self._stiffen(self.direction, self.image)
            stiffness = _dot(self.direction, self.image)
            self.count += 1
            if not slope < 0:
                if weight == 0:
                    break  # nothing but rounding is left to gain
                self.product = 0.0
                continue
            curvature = stiffness + softening
            longest = max(self.law.range, 1.0)  # or h_rms, the unit of heights
            if not curvature > 0:
                curvature = stiffness
                longest = self.law.range
                self.last_soft = self.count
                self.soft = self.linear or convex
                self.share = None  # edges of contact move
            longest /= self.unit * largest(self.direction)
            # A uniform direction has no stiffness.
            length = min(-slope / curvature, longest) if curvature > 0 else longest
            if self.soft or not self._advance(slope, length):
                break

    def _turn(self):
        """Turn the direction; weight of the last one, slope of the energy, curvature by the law."""
        step = self.problem.smoother.apply(self.force.reshape(self.shape), self.share).ravel()
        total, product, cross, force, last_force = _sum_over_free(
            step, self.free, self.force, self.last_force
        )
        mean = self._mean(total)
        # Weight of the last direction by Polak and Ribiere, of forces and steps without a mean.
        last_product = self.product
        self.product = product - mean * force
        gain = self.product - (cross - mean * last_force)
        weight = max(0.0, gain / last_product) if last_product > 0 else 0.0
        total, count = _turn_direction(
            self.direction, np.float32(weight), step, np.float32(mean), self.free, self.above
        )
        mean = np.float32(total / count if self.at_gap and count else 0)
        slope, softening = _settle_direction(
            self.direction, mean, self.above, self.force, self.slope
        )
        return weight, slope, softening

    def _advance(self, slope, length):
        """Go along the direction; returns whether the round may go on."""
        for _ in range(_MAX_SHORTENINGS):
            step, image, factor = self._within(np.float32(length))
            if self.linear:
                return self._go(step, image, factor)
            elastic, work = _sum_work(step, factor, image, self.reaction, self.traction)
            self.new_potential = self._evaluate(step, factor, self.new_traction, self.new_slope)
            rise = self.unit * (self.unit * elastic - work) + self.new_potential - self.potential
            if rise <= self.slack:
                return self._go(step, image, factor)
            predicted = length * slope * self.unit**2
            length *= min(max(-0.5 * predicted / (rise - predicted), 0.1), 0.5)
        return False

    def _within(self, length):
        """Step, its image, and a factor for both; a step cut short at the wall has a new image."""
        # A small force on what lies behind the wall is put off.
        allowed = max(_CUT_FORCE * self.residual if self.linear else 0.0, self.behind)
        bound = np.float32(-allowed / self.pixel)
        deeper, total, count = _cut_at_wall(
            bound, self.step, self.direction, length, self.change, self.lowest, self.above
        )
        if not deeper:
            return self.direction, self.image, length
        if self.at_gap and count:
            mean = np.float32(total / count)
            np.subtract(self.step, mean, out=self.step, where=self.above)
        self._stiffen(self.step, self.cut_image)
        return self.step, self.cut_image, np.float32(1)

    def _evaluate(self, step, factor, traction, slope):
        """Traction and slope of the law after a step; returns the sum of its potential."""
        gap = traction  # a block of gaps makes room for tractions
        _find_gaps(step, np.float32(factor), self.change, self.lowest, np.float32(self.unit), gap)
        gap = gap.reshape(self.shape)
        traction = traction.reshape(self.shape)
        slope = slope.reshape(self.shape)
        total = 0.0
        for span in spans(self.shape):
            traction[span], slope[span], potential = self.law.evaluate(gap[span])
            total += float(potential.sum())
        return total

    def _go(self, step, image, factor):
        """Make a step; returns whether it is short enough for the present tangent."""
        if self.linear:
            total = _apply_step_linearly(
                step, factor, image, self.change, self.reaction, self.free, self.slope
            )
        else:
            tractions = (self.traction, self.new_traction)
            unit = np.float32(self.unit)
            total = _apply_step(
                step, factor, image, self.change, self.reaction, self.free, tractions, unit
            )
            self._accept_law()
        if step is self.step:  # no rounding where it ends at the wall
            np.copyto(self.change, self.lowest, where=self.free & ~self.above & (step < 0))
        # Free points that the wall would have to pull, put off those behind it; new forces.
        self._swap_forces()
        height = self.step  # scratch: not in use any more
        self.free_points, changed = _release_points(
            self.reaction,
            np.float32(self._mean(total)),
            self.change,
            self.lowest,
            self.above,
            self.free,
            self.force,
            height,
        )
        self.residual = largest(self.force)
        self.behind = max(-float(height.min()), 0.0) * self.pixel
        if changed:
            self.share = self.problem.smoother.share_of(self.free.reshape(self.shape))
        return (
            not self.linear
            or self.unit * largest(self.change) <= _MAX_LINEAR_CHANGE * self.law.range
        )

    def _swap_forces(self):
        """Keep the force as the last one, and make room for a new one."""
        self.force, self.last_force = self.last_force, self.force

    def _accept_law(self):
        """Take traction, slope and potential of the law as they are after the step."""
        self.traction, self.new_traction = self.new_traction, self.traction
        self.slope, self.new_slope = self.new_slope, self.slope
        self.potential = self.new_potential

    def _mean(self, total):
        """Mean over free points: at a prescribed mean gap it does no work."""
        return total / max(self.free_points, 1) if self.at_gap else 0.0

    def _stiffen(self, field, out):
        self.problem.quick.stiffness(field.reshape(self.shape), out=out.reshape(self.shape))


@compiled
def _move_gap(gap, new_gap, change, unit, above):
    """Gap after a round, zero for what is not above the wall; returns its sum."""
    total = 0.0
    for i in range(gap.size):
        moved = gap[i] + change[i] * unit
        moved = 0.0 if not above[i] or moved <= 0 else moved  # NaN stays NaN
        new_gap[i] = moved
        total += moved
    return total


@compiled
def _dot(a, b):
    total = 0.0
    for i in range(a.size):
        total += a[i] * b[i]
    return total


@compiled
def _sum_over_free(step, free, force, last_force):
    """Sums over free points: of a step, its products with two forces, and of these forces."""
    total = product = last_product = forces = last_forces = 0.0
    for i in range(step.size):
        part = step[i] if free[i] else _NONE
        total += part
        product += part * force[i]
        last_product += part * last_force[i]
        forces += force[i]
        last_forces += last_force[i] if free[i] else _NONE
    return total, product, last_product, forces, last_forces


@compiled
def _turn_direction(direction, weight, step, mean, free, above):
    """Turn a direction against a step about its mean; its sum, and the count of points above."""
    total = 0.0
    count = 0
    for i in range(direction.size):
        part = weight * direction[i] - (step[i] - mean) if free[i] else _NONE
        if above[i]:
            count += 1
        elif part < 0:  # a free point at the wall, or behind it, can only open
            part = _NONE
        direction[i] = part
        total += part
    return total, count


@compiled
def _settle_direction(direction, mean, above, force, slope):
    """Lower a direction on points above; slope of the energy along it, curvature by the law."""
    fall = softening = 0.0
    for i in range(direction.size):
        part = direction[i] - mean if above[i] else direction[i]
        direction[i] = part
        fall += part * force[i]
        softening += part * part * slope[i]
    return fall, softening


@compiled
def _cut_at_wall(bound, step, direction, length, change, lowest, above):
    """Step that ends at the wall, or where a point behind it lies, if it went below a bound.

    Returns the number of points below the bound, the sum of the step, and the points above.
    """
    deeper = 0
    for i in range(step.size):
        deeper += direction[i] * length + change[i] - lowest[i] < bound
    total = 0.0
    count = 0
    if deeper > 0:
        for i in range(step.size):
            least = lowest[i] - change[i]
            least = least if least < 0 else _NONE
            part = direction[i] * length
            open_point = part > least
            above[i] = open_point
            count += open_point
            step[i] = part if open_point else least
            total += step[i]
    return deeper, total, count


@compiled
def _find_gaps(step, factor, change, lowest, unit, gap):
    """Gap after a step, not below the wall, in the unit of the law."""
    for i in range(step.size):
        height = step[i] * factor - lowest[i] + change[i]
        gap[i] = _NONE if height <= 0 else unit * height


@compiled
def _sum_work(step, factor, image, reaction, traction):
    """Work of a step against the mean of its reactions, and against the traction."""
    elastic = attraction = 0.0
    for i in range(step.size):
        part = step[i] * factor
        elastic += part * (image[i] * factor * _HALF + reaction[i])
        attraction += part * traction[i]
    return elastic, attraction


@compiled
def _apply_step(step, factor, image, change, reaction, free, tractions, unit):
    """Make a step that changes the traction; sum of the reactions on free points."""
    traction, new_traction = tractions
    total = 0.0
    for i in range(step.size):
        change[i] += step[i] * factor
        reaction[i] += (new_traction[i] - traction[i]) / unit + image[i] * factor
        total += reaction[i] if free[i] else _NONE
    return total


@compiled
def _apply_step_linearly(step, factor, image, change, reaction, free, slope):
    """Make a step along which the traction changes by its slope; else as `_apply_step`."""
    total = 0.0
    for i in range(step.size):
        part = step[i] * factor
        change[i] += part
        reaction[i] += part * slope[i] + image[i] * factor
        total += reaction[i] if free[i] else _NONE
    return total


@compiled
def _release_points(reaction, mean, change, lowest, above, free, force, height):
    """Free points above the wall, or that it would have to pull; their number, and of changes."""
    count = changed = 0
    for i in range(reaction.size):
        left = reaction[i] - mean
        reaction[i] = left
        height[i] = change[i] - lowest[i]
        above[i] = height[i] > 0
        now = above[i] or not left >= 0
        changed += now != free[i]
        free[i] = now
        count += now
        force[i] = left if now else _NONE
    return count, changed
