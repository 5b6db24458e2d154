"""Values that theory extrapolates to a broader spectrum than is simulated (``carry_to``).

Of the accuracy asked for, the simulation is left

    left^2 = (accuracy^2 - extrapolation^2) / s^2,

s being the largest value simulated over the one extrapolated: more than 1 for the area, which finer
waves take away, and at small Hurst exponents for attractive areas too, so that errors of the
simulation weigh more. Both accuracies are of all columns at all loads together, and so is the error
of the extrapolation, by `joint_error`: the sum in quadrature then bounds that of the result.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

from stickiness.accuracy.error_models import MEASURED, ErrorModels, Surface, single_error
from stickiness.accuracy.prediction import Problem, joint_error
from stickiness.accuracy.quantities import COLUMNS, MODELLED, columns_of

# Magnifications, over the one simulated and in all, up to which theory's difference was measured.
CARRIED_TIMES, CARRIED_TO = 8, 512


def carrying_error(
    models: ErrorModels,
    surface: Surface,
    carry_to: float,
    size: float,
    column: str,
    pressure: float,
) -> float:
    """Error of theory's difference, covering 90 %, as a share of the value simulated.

    `surface` is the one simulated; `carry_to` the magnification that theory extrapolates to, within
    what was measured (else a ValueError); `size` by how much of itself theory changes the area:
    errors are in proportion to it.
    """
    if not carry_to <= min(CARRIED_TIMES * surface.magnification, CARRIED_TO):
        raise ValueError(
            f"carry_to = {carry_to:g} must be at most {CARRIED_TIMES} times the magnification "
            f"simulated, {surface.magnification:g}, and {CARRIED_TO}"
        )
    # One model for all magnifications and windows: only the kind of surface, the Hurst exponent
    # and the load may be outside.
    anywhere = replace(surface, magnification=MEASURED["magnification"][0], window=1.0)
    return size * single_error(models, "carrying", column, anywhere, pressure)


def left_to_simulation(problem: Problem, accuracy: float, carry_to: float) -> float:
    """Return the accuracy that a simulation needs whose values theory extrapolates.

    `accuracy` is the relative error of the extrapolated values that is to cover 90 %; both are of
    all columns at all loads together. 0 if theory alone has a larger error.
    """
    surface, weights, errors = problem.surface, [], []
    for pressure in problem.pressures:
        own, broad = (
            _values(surface.hurst, magnification, pressure)
            for magnification in (surface.magnification, carry_to)
        )
        size = 1 - broad["area"] / own["area"]
        for column in problem.columns:
            error = carrying_error(problem.models, surface, carry_to, size, column, pressure)
            weights.append(max(own[column] / broad[column], 1.0))
            errors.append(weights[-1] * error)
    rest = accuracy**2 - float(joint_error(errors)) ** 2
    return math.sqrt(max(rest, 0.0)) / max(weights)


@cache
def _values(hurst: float, magnification: float, pressure: float) -> dict[str, float]:
    """Columns by theory on continuous spectra, up to factors that no magnification changes."""
    # Every job of a run reads the configuration; theory is loaded only if a case extrapolates.
    from stickiness.persson.theory import Persson
    from stickiness.spectrum.kinds import SelfAffine

    theory = Persson(SelfAffine(hurst=hurst, q0=1.0, q1=magnification, h_rms=1.0))
    found = {name: COLUMNS[name].of_theory for name in columns_of(MODELLED)}
    return {name: float(value(theory, pressure)) for name, value in found.items()}
