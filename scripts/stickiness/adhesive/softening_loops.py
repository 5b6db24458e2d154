"""Loops over the grid of the quick descent, each for all that it needs of a point at a time.

Fields are flat; those of steps are in single precision, those of states and all sums in double
precision. Sets of points are booleans. Names are those of `softening_descent`.
"""

import numpy as np

from stickiness.compiled import compiled

_NONE, _HALF = np.float32(0), np.float32(0.5)


@compiled
def move(gap, new_gap, change, unit, above):
    """Gap after a round, zero for what is not above the wall; returns its sum."""
    total = 0.0
    for i in range(gap.size):
        moved = gap[i] + change[i] * unit
        moved = 0.0 if not above[i] or moved <= 0 else moved  # keeps what is not a number
        new_gap[i] = moved
        total += moved
    return total


@compiled
def sum_work_between(gap, new_gap, elastic, new_elastic, pressure):
    """Work against elastic and mean pressure between two gaps, summed over the grid."""
    total = 0.0
    for i in range(gap.size):
        total += (new_gap[i] - gap[i]) * ((elastic[i] + new_elastic[i]) * 0.5 + pressure)
    return total


@compiled
def dot(a, b):
    """Sum of the products of two fields."""
    total = 0.0
    for i in range(a.size):
        total += a[i] * b[i]
    return total


@compiled
def sum_over_free(step, free, force, last_force):
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
def turn(direction, weight, step, mean, free, above):
    """Turn a direction against a step about its mean; its sum, and the count of points above.

    A free point at the wall, or behind it, can only open.
    """
    total, count = 0.0, 0
    for i in range(direction.size):
        part = weight * direction[i] - (step[i] - mean) if free[i] else _NONE
        if above[i]:
            count += 1
        elif part < 0:
            part = _NONE
        direction[i] = part
        total += part
    return total, count


@compiled
def lower(field, mean, points):
    """Lower a field on some points."""
    for i in range(field.size):
        if points[i]:
            field[i] -= mean


@compiled
def settle(direction, mean, above, force, slope):
    """Lower a direction on points above; slope of the energy along it, curvature by the law."""
    fall = softening = 0.0
    for i in range(direction.size):
        part = direction[i] - mean if above[i] else direction[i]
        direction[i] = part
        fall += part * force[i]
        softening += part * part * slope[i]
    return fall, softening


@compiled
def count_deeper(bound, direction, length, change, lowest):
    """Count points that a step along a direction leaves below a bound."""
    count = 0
    for i in range(direction.size):
        count += direction[i] * length + change[i] - lowest[i] < bound
    return count


@compiled
def cut(step, direction, length, change, lowest, above):
    """Step along a direction that ends at the wall, or where a point behind it lies.

    Fills in the step and the points that end above; returns their count and the sum of the step.
    """
    total, count = 0.0, 0
    for i in range(step.size):
        least = lowest[i] - change[i]
        least = least if least < 0 else _NONE
        part = direction[i] * length
        open_point = part > least
        above[i] = open_point
        count += open_point
        step[i] = part if open_point else least
        total += step[i]
    return total, count


@compiled
def find_gaps(step, factor, change, lowest, unit, gap):
    """Gap after a step, not below the wall, in the unit of the law."""
    for i in range(step.size):
        height = step[i] * factor - lowest[i] + change[i]
        gap[i] = _NONE if height <= 0 else unit * height


@compiled
def sum_work(step, factor, image, reaction, traction):
    """Work of a step against the mean of its reactions, and against the traction."""
    elastic = attraction = 0.0
    for i in range(step.size):
        part = step[i] * factor
        elastic += part * (image[i] * factor * _HALF + reaction[i])
        attraction += part * traction[i]
    return elastic, attraction


@compiled
def go(step, factor, image, change, reaction, free, tractions, unit):
    """Make a step that changes the traction; sum of the reactions on free points."""
    traction, new_traction = tractions
    total = 0.0
    for i in range(step.size):
        change[i] += step[i] * factor
        reaction[i] += (new_traction[i] - traction[i]) / unit + image[i] * factor
        total += reaction[i] if free[i] else _NONE
    return total


@compiled
def go_linearly(step, factor, image, change, reaction, free, slope):
    """Make a step along which the traction changes by its slope; else as `go`."""
    total = 0.0
    for i in range(step.size):
        part = step[i] * factor
        change[i] += part
        reaction[i] += part * slope[i] + image[i] * factor
        total += reaction[i] if free[i] else _NONE
    return total


@compiled
def end_at_wall(step, change, lowest, free, above):
    """Put free points whose step ends at the wall exactly there."""
    for i in range(step.size):
        if free[i] and not above[i] and step[i] < 0:
            change[i] = lowest[i]


@compiled
def release(reaction, mean, change, lowest, above, free, force, height):
    """Free points above the wall, or that it would have to pull: forces on them, heights of all.

    Returns the counts of free points and of those that changed.
    """
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
