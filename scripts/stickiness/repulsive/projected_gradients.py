"""Projected conjugate gradients for the repulsive contact problem: slower, but sure.

The active-set iteration supposes that pressure on a point moves the others less and less with
distance. A film bends, and a thin incompressible layer yields only where material can flow off:
there it may cycle, or hardly gain. The method of Polonsky and Keer (Wear 231:206, 1999, doi
10.1016/S0043-1648(99)00113-1) changes the set of contact with every step. Here the stiffness
preconditions it, with directions of Polak and Ribiere: hundreds of iterations instead of thousands.

A stiff skin smooths every change of pressure, which this method then cannot see. `relax_gap` does
the same in the gap, where the pressure is what must vanish and the compliance preconditions it.
"""

from dataclasses import dataclass

import numpy as np

from stickiness.repulsive.active_set import State

_CHECK_EVERY = 10  # iterations in the gap
_JOINING = 1e-6  # of the mean pressure, for points that join: what they carry is the next step's


def relax(problem, pressure, tol, max_iterations):
    """Find pressure and gap, as `active_set.relax` does, from a pressure of any positive mean."""
    operator = problem.operator(np.float64)
    pairs_before = operator.pairs
    pressure = np.maximum(pressure, 0.0)
    pressure *= problem.load / pressure.mean()
    best = None
    iterations = 0
    last_gap = np.zeros_like(pressure)
    last_product = np.inf
    direction = np.zeros_like(pressure)
    while True:
        gap, touching, shift, residual = _gap(problem, operator, pressure)
        if best is None or residual < best.residual:
            best = _Iterate(pressure.copy(), gap.copy(), shift, residual)
        if residual <= tol or iterations >= max_iterations:
            break
        # The stiffness preconditions the gap in contact, which is the gradient of the energy.
        gap_in_contact = gap * touching
        fall = operator.stiffness(gap_in_contact)
        fall *= touching
        fall[touching] -= fall[touching].mean()
        product = _turn(direction, fall, touching, gap_in_contact, last_gap, last_product)
        conjugate = _step(problem, operator, pressure, gap, direction)
        last_gap = gap_in_contact
        last_product = product if conjugate else np.inf
        iterations += 1
    return _state(best, iterations, operator.pairs - pairs_before)


def relax_gap(problem, gap, tol, max_iterations):
    """Find pressure and gap, as `relax` does, from a gap that is zero somewhere."""
    operator = problem.operator(np.float64)
    pairs_before = operator.pairs
    gap = np.maximum(gap, 0.0)
    # No elasticity holds the mean gap: it is taken to be as soft as the longest wave.
    of_mean = 1 / problem.solid.stiffness(2 * np.pi / max(problem.sides))
    best = None
    iterations = 0
    last_pull = np.zeros_like(gap)
    last_product = np.inf
    direction = np.zeros_like(gap)
    while True:
        # The pressure that this gap takes must vanish at open points, and press at the others.
        pressure = operator.stiffness(gap + problem.heights)
        pressure += problem.load
        free = (gap > 0) | (pressure < 0)
        pull = pressure * free
        is_last = iterations >= max_iterations
        if (is_last or iterations % _CHECK_EVERY == 0) and not free.all():
            pressure[free] = 0
            pressure *= problem.load / pressure.mean()
            closed_gap, _, shift, residual = _gap(problem, operator, pressure)
            if best is None or residual < best.residual:
                best = _Iterate(pressure, closed_gap, shift, residual)
        if is_last or (best is not None and best.residual <= tol):
            break
        # The compliance preconditions the pressure, which is the gradient of the energy.
        fall = operator.compliance(pull)
        fall += of_mean * pull.mean()
        fall *= free
        product = _turn(direction, fall, free, pull, last_pull, last_product)
        curvature = float(np.vdot(direction, operator.stiffness(direction)))
        if not curvature > 0:  # nothing but rounding is left
            break
        gap -= float(np.vdot(pull, direction)) / curvature * direction
        np.maximum(gap, 0, out=gap)
        last_pull = pull
        last_product = product
        iterations += 1
    return _state(best, iterations, operator.pairs - pairs_before)


def _turn(direction, fall, free, gradient, last_gradient, last_product):
    """Turn the direction on the free points, in place, as Polak and Ribiere do.

    Returns the product of the gradient and its preconditioned `fall`, for the next turn.
    """
    product = float(np.vdot(gradient, fall))
    weight = max(0.0, (product - float(np.vdot(last_gradient, fall))) / last_product)
    direction *= weight
    direction *= free
    direction += fall
    return product


def _state(best, iterations, pairs):
    """State of the best iterate."""
    touching = best.pressure > 0
    gap = np.maximum(best.gap, 0.0)
    gap[touching] = 0
    return State(
        pressure=best.pressure,
        gap=gap,
        shift=best.shift,
        area_fraction=float(np.mean(touching)),
        residual=best.residual,
        iterations=iterations,
        fft_pairs=pairs,
    )


@dataclass(frozen=True, eq=False)
class _Iterate:
    """Pressure, its gap, and how well they meet the contact conditions."""

    pressure: np.ndarray
    gap: np.ndarray
    shift: float
    residual: float


def _gap(problem, operator, pressure):
    """Gap of zero mean in contact, points in contact, shift and residual of an iterate."""
    gap = operator.compliance(pressure)
    gap -= problem.heights
    touching = pressure > 0
    shift = -float(gap[touching].mean())
    gap += shift
    residual = max(float(np.abs(gap[touching]).max()), -float(gap.min()))
    return gap, touching, shift, residual


def _step(problem, operator, pressure, gap, direction):
    """Change the pressure, in place, along a direction; whether the next one may be conjugate."""
    touching = pressure > 0
    image = operator.compliance(direction)
    image -= image[touching].mean()
    curvature = float(np.vdot(image, direction))
    if not curvature > 0:  # nothing but rounding is left
        direction[...] = 0
        return False
    pressure -= float(np.vdot(gap, direction)) / curvature * direction
    np.maximum(pressure, 0, out=pressure)
    joined = (pressure == 0) & (gap < 0)
    pressure[joined] = _JOINING * problem.load
    pressure *= problem.load / pressure.mean()
    return not joined.any()
