"""Loading and unloading curves: quasi-static paths along branches, with their jumps.

Every state is the end of a descent in energy from the one before: it stays on its branch until that
ends, and then falls to the next. Whether a step was reversible shows in its energy balance, minus
the change of energy less the integral of the mean pressure over the mean gap, along a parabola
through both ends and the state before. On a branch this is of fourth order in the step; at a jump
it does not vanish with the step. So the balance sets the steps, and a jump is a step that stays out
of balance when it is as short as the tolerance for its place. What lies beyond the place is solved
once, from the near side of the first step across it. On a grid, attraction of short range
passes over points one by one, each with a small jump (a Maugis zone always does).
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from stickiness.adhesive import solver
from stickiness.adhesive.solver import APPROACH, SEPARATION, Adhesion, PullOffError
from stickiness.arguments import grid, number, numbers
from stickiness.repulsive.solver import Contact
from stickiness.solids import HALF_SPACE, Solid
from stickiness.traction_laws import TractionLaw

# Smooth law or not: by which a step may be refined for the sake of the balance alone.
_SUBSTEPS = {True: 16, False: 4}
_LEAST_SCALE = 1e-3  # of energies, over the work of adhesion
_NEAR_ZERO = 0.01  # share of the path's span below which a place is not located relative to itself


@dataclass(frozen=True, eq=False)
class PathPoint:
    """One state of a path and how it was reached; energies per nominal area [E* length]."""

    state: Adhesion  #: its `branch` is the direction of the path
    #: "jump-in" or "jump-out" if a jump led here, "pull-off" if the path ends here because any
    #: greater tension tears the surfaces apart.
    event: str | None = None
    bracket: tuple | None = None  #: values of the control before and after the event
    work: float = 0.0  #: of the control in this step
    #: Work less the gain in energy, which is lost at a jump and the error of integration elsewhere;
    #: infinite at a pull-off, where a dead load falls forever.
    dissipated: float = 0.0


def path(
    heights: ArrayLike,
    length: float | tuple[float, float],
    law: TractionLaw,
    values: ArrayLike,
    control: Literal["pressure", "mean_gap"] = "pressure",
    start: str | Adhesion | Contact | ArrayLike | None = None,
    tol: float = 1e-8,
    balance: float = 1e-5,
    smallest_jump: float = 1e-3,
    located: float = 1e-4,
    steps: int = 20,
    max_states: int = 5000,
    max_iterations: int = 3000,
    solid: Solid = HALF_SPACE,
    balanced_below: float = math.inf,
) -> Iterator[PathPoint]:
    """Follow the contact through rising and falling pressure or mean gap.

    The first state comes without work. After a pull-off the path ends.

    Parameters
    ----------
    heights, length, law, tol, max_iterations, solid
        As for `solve`.
    values : sequence of float
        At least two values of the control to go through in turn, each different from the one
        before, in units of E* (pressure) or of the heights (mean gap). Steps between them adapt.
    control : {"pressure", "mean_gap"}
        What is prescribed. A press controls the pressure and jumps where the curve turns back;
        control of the mean gap follows the curve through most of its turns.
    start : optional
        Of the first state, as for `solve`.
    balance : float
        Largest error of the energy balance in a step, relative to the largest change of elastic
        plus interaction energy along the path so far. Errors of steps add up: over a stretch
        without jumps 1e-6 leaves less than 1e-4 of the energy gained (see the tests).
    smallest_jump : float
        Least dissipated energy of a jump that is located, relative to the same; smaller ones
        are part of the step that they fall into.
    located : float
        Width of the brackets around jumps, relative to the control there (to a hundredth of
        the path's span if that is larger).
    steps : int
        Least number of steps between two of the values.
    max_states : int
        States to compute at most.
    balanced_below : float
        Mean pressure [E*] above which steps are as long as `steps` allows, and jumps part of them:
        for works of tension alone, which do not depend on where the surfaces jump under pressure.

    Raises
    ------
    PullOffError
        If there is no equilibrium at the first value.
    ConvergenceError
        If a state does not converge or `max_states` do not suffice.
    """
    controls = numbers("values", values)
    if controls.ndim != 1 or controls.size < 2 or not np.all(np.isfinite(controls)):
        raise ValueError(f"values must be at least two finite numbers, got {values!r}")
    targets = controls.tolist()
    if not np.all(np.diff(controls)):
        raise ValueError(f"values must differ from one to the next, got {targets!r}")
    if control not in ("pressure", "mean_gap"):
        raise ValueError(f"control must be 'pressure' or 'mean_gap', got {control!r}")
    sizes = {"balance": balance, "smallest_jump": smallest_jump, "located": located, "steps": steps}
    for name, value in sizes.items():
        number(name, value)
    last = solver.solve(
        heights,
        length,
        law,
        pressure=targets[0] if control == "pressure" else None,
        mean_gap=targets[0] if control == "mean_gap" else None,
        start=start,
        tol=tol,
        max_iterations=max_iterations,
        solid=solid,
    )
    yield PathPoint(last)
    follower = _Follower(
        first=last,
        scaled=solver.Scaled.of(grid("heights", heights), last.length, law, solid),
        control=control,
        effort=solver.Effort(tol, max_iterations),
        span=float(np.ptp(controls)),
        left=max_states - 1,
        scale=_LEAST_SCALE * law.adhesion_length,
        balance=balance,
        smallest_jump=smallest_jump,
        located=located,
        steps=steps,
        balanced_below=balanced_below,
    )
    for target in targets[1:]:
        for point in follower.leg(last, target):
            yield point
            if point.event == "pull-off":
                return
            last = point.state


@dataclass(eq=False)
class _Follower:
    """Follows a path leg by leg."""

    first: Adhesion
    scaled: solver.Scaled
    control: str
    effort: solver.Effort  #: of every state
    span: float  #: between the largest and the smallest value of the control
    left: int  #: states that may still be computed
    scale: float  #: largest change of elastic plus interaction energy so far [E* length]
    balance: float
    smallest_jump: float
    located: float
    steps: int
    balanced_below: float

    def leg(self, state, target):
        """Points from a state (left out) to a value of the control."""
        value = state.mean_pressure if self.control == "pressure" else state.mean_gap
        closing = (target > value) == (self.control == "pressure")
        longest = abs(target - value) / self.steps
        finest = longest / _SUBSTEPS[self.first.law.smooth]
        step = longest
        before = None  # the state before this one, on the same branch
        ahead = []  # values that were out of balance from states farther back, with their states
        halved = False
        while value != target:
            if ahead and not halved:
                trial, successor = ahead.pop()  # nothing is solved twice
            else:
                trial = self._next_value(value, target, step)
                successor = self._solve(state, trial, APPROACH if closing else SEPARATION)
            halved = False
            work, dissipated = self._dissipation(before, state, successor)
            width = abs(trial - value)
            allowed = max(self.smallest_jump, self.balance) if width <= finest else self.balance
            in_balance = abs(dissipated) <= allowed * self.scale
            free = self._press(state, successor)
            if in_balance or free:
                yield PathPoint(successor, work=work, dissipated=dissipated)
                # Go on, by a step whose error of fourth order is just allowed.
                growth = 0.8 * (self.balance * self.scale / max(abs(dissipated), 1e-300)) ** 0.25
                step = longest if free else min(longest, width * min(2.0, max(growth, 0.2)))
                before = state if in_balance else None
                state = successor
                value = trial
            elif width > self._width(trial):
                # Out of balance: approach the place by halves.
                ahead.append((trial, successor))
                step = width / 2
                halved = True
            elif successor is None:
                yield PathPoint(state, "pull-off", (value, trial), 0.0, math.inf)
                return
            else:
                event = "jump-in" if closing else "jump-out"
                yield PathPoint(successor, event, (value, trial), work, dissipated)
                before = None
                state = successor
                value = trial
                step = longest

    def _next_value(self, value, target, step):
        """Next value towards a target."""
        distance = abs(target - value)
        # No crumb of a step before the target.
        return target if 1.01 * step >= distance else value + math.copysign(step, target - value)

    def _press(self, state, successor):
        """Whether both states press, so that the step between them need not be in balance."""
        limit = self.balanced_below
        return successor is not None and min(state.mean_pressure, successor.mean_pressure) > limit

    def _width(self, value):
        return self.located * max(abs(value), _NEAR_ZERO * self.span)

    def _solve(self, state, value, branch):
        """State at a value, from a neighbour; None if the surfaces part."""
        if self.left <= 0:
            text = "max_states do not suffice for this path: raise it"
            raise solver.ConvergenceError(text, state)
        self.left -= 1
        if self.control == "pressure":
            control = solver.Control(pressure=value)
        else:
            control = solver.Control(mean_gap=value)
        gap = self.scaled.first_gap(state, control.mean_gap)
        try:
            return solver.relax_from(self.scaled, gap, branch, control, self.effort)
        except PullOffError:
            return None

    def _dissipation(self, before, state, successor):
        """Work of the control, and what of it is dissipated; infinite if the surfaces part."""
        if successor is None:
            return 0.0, math.inf
        points = [s for s in (before, state, successor) if s is not None]
        # Minus the integral of the mean pressure over the mean gap.
        if self.control == "mean_gap":
            work = -_integral([(s.mean_gap, s.mean_pressure) for s in points])
        else:  # by parts: the mean gap is a function of the pressure and not the other way round
            work = state.mean_pressure * state.mean_gap
            work -= successor.mean_pressure * successor.mean_gap
            work += _integral([(s.mean_pressure, s.mean_gap) for s in points])
        change = abs(successor.elastic_energy - self.first.elastic_energy)
        change += abs(successor.interaction_energy - self.first.interaction_energy)
        self.scale = max(self.scale, change)
        return work, work - (successor.energy - state.energy)


def _integral(points):
    """Integral between the last two points, on the parabola if there are three."""
    x1, y1 = points[-2]
    x2, y2 = points[-1]
    step = x2 - x1
    total = step * (y1 + y2) / 2
    if len(points) == 3:
        x0, y0 = points[0]
        curvature = ((y2 - y1) / step - (y1 - y0) / (x1 - x0)) / (x2 - x0)
        total -= step**3 / 6 * curvature
    return total
