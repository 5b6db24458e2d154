"""Settings that full adhesion needs for an accuracy, from what was measured.

Full adhesion is solved on the realisations of a case and with their grid, to a tolerance of its
own. Its errors follow from error models of the same kind as those of `error_models`, and add up in
the same way. Means have the DMT limit of the coarse seeds as their control, from `FEWEST` seeds on;
below they are plain. A pull-off is that of one realisation, no mean: it has the error of its grid
alone.
"""

from __future__ import annotations

import itertools
from bisect import bisect_left
from dataclasses import replace

from stickiness.accuracy import prediction
from stickiness.accuracy.choice import COARSE_SEEDS, PIXELS, SEEDS, TOLERANCES, UnreachableError
from stickiness.accuracy.error_models import Settings, single_error
from stickiness.accuracy.prediction import Problem

QUANTITIES = {
    "inverse_kappa_ad": ("inverse_kappa_ad_0.0075", "inverse_kappa_ad_0.1", "inverse_kappa_ad_1"),
    "threshold": ("threshold",),
    "pull_off": ("pull_off",),
}
COLUMNS = tuple(itertools.chain(*QUANTITIES.values()))
TOLERANCE = 1e-7  #: of the solver of full adhesion, whatever that of the settings
PULL_OFF_UP_TO = 32  #: magnification to which pull-offs were measured
FEWEST = 8  #: seeds from which on a mean has a control


def predicted_error(problem: Problem, settings: Settings, pressure: float, column: str) -> float:
    """Return the relative error of one of `COLUMNS` that covers 90 %."""
    if column == "pull_off":
        # It falls so steeply that the model would promise too much beyond what was measured.
        nearest = min(problem.surface.magnification, PULL_OFF_UP_TO)
        surface = replace(problem.surface, magnification=nearest)
        grid = {"pixels": settings.pixels_per_wavelength}
        return single_error(problem.models, "discretisation", column, surface, pressure, **grid)
    coarse = settings.coarse_seeds if settings.seeds >= FEWEST else 0
    settings = replace(settings, tolerance=TOLERANCE, coarse_seeds=coarse)
    return prediction.predicted_error(problem, settings, pressure, column)


def worst_error(problem: Problem, settings: Settings) -> tuple[float, str, float]:
    """Return the largest predicted error; its column and pressure."""
    return max(
        (predicted_error(problem, settings, pressure, column), column, pressure)
        for pressure, column in problem.points
    )


def predicted_cost(problem: Problem, settings: Settings) -> float:
    """Return the cost of one adhesive state of every seed, both its grids, and coarse seeds.

    In pairs of Fourier transforms of 1024 x 1024 doubles.
    """
    models, surface, pixels = problem.models, problem.surface, settings.pixels_per_wavelength
    state = sum(models["adhesive_cost", ""](surface, pixels=grid) for grid in (pixels, pixels // 2))
    return settings.seeds * state + settings.coarse_seeds * models["coarse_cost", ""](surface)


def cheapest(problem: Problem, accuracy: float) -> Settings:
    """Return the cheapest settings whose predicted error is within the accuracy in all columns.

    An UnreachableError says what could be reached, for which quantity and at which pressure.
    """

    def reached(settings: Settings) -> bool:
        return worst_error(problem, settings)[0] <= accuracy

    found = []
    for pixels, coarse in itertools.product(PIXELS, COARSE_SEEDS):
        chosen = [Settings(pixels, TOLERANCES[0], seeds, coarse) for seeds in SEEDS]
        if reached(chosen[-1]):
            enough = chosen[bisect_left(chosen, True, key=reached)]
            found.append((predicted_cost(problem, enough), enough))
    if found:
        return min(found)[1]
    best = Settings(PIXELS[-1], TOLERANCES[0], SEEDS[-1], COARSE_SEEDS[-1])
    left, column, pressure = worst_error(problem, best)
    raise UnreachableError(
        f"the best that full adhesion reaches is {left:.2g}, for {column} at pressure {pressure:g}"
    )
