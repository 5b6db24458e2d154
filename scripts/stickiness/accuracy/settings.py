"""The cheapest settings for an accuracy, with and without adhesion.

Full adhesion is solved on the realisations of a case and on their grid, to a tolerance of its own.
Its errors follow error models of the same kind, and add up in the same way. From `FEWEST` seeds on,
means of adhesive contact use the DMT limit of the coarse seeds as their control; with fewer they
are plain. A pull-off is a result of one realisation, not a mean: only the error of its grid counts.
"""

from __future__ import annotations

import itertools
import math
from bisect import bisect_left
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.accuracy.error_models import ErrorModels, Settings, Surface, single_error
from stickiness.accuracy.prediction import (
    Problem,
    costs_of_seeds,
    covering_factor,
    fixed_errors,
    joint_error,
    mean_variance,
    predicted_error,
    worst_error,
)
from stickiness.accuracy.quantities import MODELLED, columns_of
from stickiness.statistics import COVERS

SAME_COST = 1.05  #: ratio of costs that were not measured well enough to tell them apart

# The settings to choose from; errors were measured for these pixels.
PIXELS = (4, 8, 16)
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-8)
SEEDS = (*(2, 3, 4, 5, 6, 8, 10, 12, 14, 16, 20, 24, 28, 32), *(40, 48, 56, 64, 80, 96, 112, 128))
COARSE_SEEDS = (*(0, 32, 64, 96, 128, 160, 192, 256, 320, 384), *(512, 640, 768, 1024, 1536, 2048))

ADHESIVE_QUANTITIES = {
    "inverse_kappa_ad": ("inverse_kappa_ad_0.0075", "inverse_kappa_ad_0.1", "inverse_kappa_ad_1"),
    "threshold": ("threshold",),
    "pull_off": ("pull_off",),
}
ADHESIVE_COLUMNS = tuple(itertools.chain(*ADHESIVE_QUANTITIES.values()))
ADHESIVE_TOLERANCE = 1e-7  #: of the solver of full adhesion, whatever that of the settings
PULL_OFF_UP_TO = 32  #: magnification to which pull-offs were measured
FEWEST = 8  #: seeds from which on a mean of adhesive contact has a control


class UnreachableError(ValueError):
    """No settings are predicted to reach the requested accuracy."""

    remedy = "ask for less accuracy or fewer quantities, or give the case settings of its own"


class GridError(UnreachableError):
    """Even the coarsest grid is too large."""

    remedy = "simulate a smaller magnification or window"


def cheapest(
    problem: Problem,
    accuracy: float,
    *,
    most_points: int = 2048,
    plain: bool | None = None,
    least: Settings | None = None,
) -> Settings:
    """Return the cheapest settings predicted to reach an accuracy in all columns at all loads.

    Among settings whose cost is within 5 % of the lowest, the most accurate.

    Parameters
    ----------
    problem : Problem
    accuracy : float
        Relative error that is to cover 90 %.
    most_points : int
        Largest number of grid points along a side.
    plain : bool, optional
        True for plain means only, False for multilevel ones only; by default whichever is cheaper.
    least : Settings, optional
        Fewest pixels and seeds, coarse ones too, and largest tolerance that are allowed.

    Raises
    ------
    UnreachableError
        Saying what could be reached, for which quantity and at which pressure.
    """
    least = least or Settings(PIXELS[0], TOLERANCES[0], SEEDS[0], COARSE_SEEDS[0])
    waves = problem.surface.magnification * problem.surface.window
    grids = [
        pixels
        for pixels in PIXELS
        if pixels * waves <= most_points and pixels >= least.pixels_per_wavelength
    ]
    tolerances = [tolerance for tolerance in TOLERANCES if tolerance <= least.tolerance]
    if not grids:
        raise GridError(
            f"the coarsest grid, {least.pixels_per_wavelength} points per shortest wavelength, "
            f"would take {least.pixels_per_wavelength * waves:.0f} points a side, above "
            f"{most_points}"
        )
    seeds = np.array([n for n in SEEDS if n >= least.seeds])[:, None]
    kinds = {None: COARSE_SEEDS, True: COARSE_SEEDS[:1], False: COARSE_SEEDS[1:]}[plain]
    coarse = np.array([n for n in kinds if n >= least.coarse_seeds])
    found = []
    for pixels, tolerance in itertools.product(grids, tolerances):
        grid = Settings(pixels, tolerance, 0, 0)
        errors = _worst_errors(problem, grid, seeds, coarse)
        costs = costs_of_seeds(problem, grid, seeds, coarse)
        found += [
            (float(cost), float(error), Settings(pixels, tolerance, int(n), int(more)))
            for cost, error, n, more in zip(
                *(part.ravel() for part in np.broadcast_arrays(costs, errors, seeds, coarse)),
                strict=True,
            )
            if error <= accuracy
        ]
    if found:
        lowest = min(cost for cost, *_ in found)
        return min((e, c, one) for c, e, one in found if c <= SAME_COST * lowest)[-1]
    best = Settings(grids[-1], TOLERANCES[-1], SEEDS[-1], int(coarse[-1]))
    error, column, pressure = worst_error(problem, best)
    raise UnreachableError(
        f"the best that {best.seeds} seeds on {best.pixels_per_wavelength} points per shortest "
        f"wavelength reach is {error:.2g}, for {column} at pressure {pressure:g}"
    )


def _worst_errors(problem: Problem, grid: Settings, seeds: NDArray, coarse: NDArray) -> NDArray:
    """Largest predicted error on one grid for all numbers of seeds."""
    pixels, errors = grid.pixels_per_wavelength, []
    for at in problem.points:
        fixed = math.hypot(*fixed_errors(problem, *at, pixels, grid.tolerance))
        variance = mean_variance(problem, *at, pixels, seeds, coarse)
        errors.append(np.sqrt(fixed**2 + COVERS**2 * variance))
    return joint_error(errors)


def allow_for_few_seeds(problem: Problem, chosen: Settings, accuracy: float) -> Settings:
    """Return the settings with as many more fine seeds as Student's t requires.

    `cheapest` uses the true scatter. An answer knows only the standard error of its few seeds, so
    that the error it states is larger. If no number in `SEEDS` is enough, the last one is taken.
    """
    grid = chosen.pixels_per_wavelength, chosen.tolerance
    fixed = [math.hypot(*fixed_errors(problem, *at, *grid)) for at in problem.points]
    for n in (n for n in SEEDS if n >= max(chosen.seeds, 2)):
        settings = replace(chosen, seeds=n)
        if joint_error(np.hypot(fixed, _stated_sampling(problem, settings))) <= accuracy:
            break
    return settings


def seeds_enough(
    problem: Problem, settings: Settings, accuracy: float, fixed: ArrayLike, sampling: ArrayLike
) -> int | None:
    """Return the fewest fine seeds that are predicted to be enough; None if none of `SEEDS` are.

    Parameters
    ----------
    problem, settings
        What was solved.
    accuracy : float
        Relative error that is to cover 90 %.
    fixed, sampling : (column, pressure) array
        Relative errors measured with the settings, covering 90 %: those that more seeds do not
        change, and the sampling error, which changes with the seeds as the error models say.
    """
    if settings.seeds < 2:
        return None
    shape = len(problem.pressures), len(problem.columns)
    now = _stated_sampling(problem, settings)
    for n in (n for n in SEEDS if n > settings.seeds):
        falls = (_stated_sampling(problem, replace(settings, seeds=n)) / now).reshape(shape).T
        if joint_error(np.hypot(fixed, sampling * falls).ravel()) <= accuracy:
            return n
    return None


def _stated_sampling(problem: Problem, settings: Settings) -> NDArray:
    """Sampling error that an answer is expected to state at every point, with Student's t."""
    numbers = settings.pixels_per_wavelength, settings.seeds, settings.coarse_seeds
    return np.array(
        [
            covering_factor(problem, settings, *at)
            * math.sqrt(mean_variance(problem, *at, *numbers))
            for at in problem.points
        ]
    )


def adhesive_error(problem: Problem, settings: Settings, pressure: float, column: str) -> float:
    """Return the relative error of one of `ADHESIVE_COLUMNS` that covers 90 %."""
    if column == "pull_off":
        # It falls so steeply that the model would promise too much beyond what was measured.
        nearest = min(problem.surface.magnification, PULL_OFF_UP_TO)
        surface = replace(problem.surface, magnification=nearest)
        grid = {"pixels": settings.pixels_per_wavelength}
        return single_error(problem.models, "discretisation", column, surface, pressure, **grid)
    coarse = settings.coarse_seeds if settings.seeds >= FEWEST else 0
    settings = replace(settings, tolerance=ADHESIVE_TOLERANCE, coarse_seeds=coarse)
    return predicted_error(problem, settings, pressure, column)


def worst_adhesive_error(problem: Problem, settings: Settings) -> tuple[float, str, float]:
    """Return the largest error of full adhesion, its column and pressure."""
    return max(
        (adhesive_error(problem, settings, pressure, column), column, pressure)
        for pressure, column in problem.points
    )


def adhesive_cost(problem: Problem, settings: Settings) -> float:
    """Return the cost of one adhesive state of every seed on both grids, and of the coarse seeds.

    In pairs of Fourier transforms of 1024 x 1024 doubles.
    """
    models, surface, pixels = problem.models, problem.surface, settings.pixels_per_wavelength
    state = sum(models["adhesive_cost", ""](surface, pixels=grid) for grid in (pixels, pixels // 2))
    return settings.seeds * state + settings.coarse_seeds * models["coarse_cost", ""](surface)


def cheapest_adhesive(problem: Problem, accuracy: float) -> Settings:
    """Return the cheapest settings for an accuracy in all columns of full adhesion.

    Raises
    ------
    UnreachableError
        Saying what could be reached, for which quantity and at which pressure.
    """

    def reached(settings: Settings) -> bool:
        return worst_adhesive_error(problem, settings)[0] <= accuracy

    found = []
    for pixels, coarse in itertools.product(PIXELS, COARSE_SEEDS):
        chosen = [Settings(pixels, TOLERANCES[0], seeds, coarse) for seeds in SEEDS]
        if reached(chosen[-1]):
            enough = chosen[bisect_left(chosen, True, key=reached)]
            found.append((adhesive_cost(problem, enough), enough))
    if found:
        return min(found)[1]
    best = Settings(PIXELS[-1], TOLERANCES[0], SEEDS[-1], COARSE_SEEDS[-1])
    left, column, pressure = worst_adhesive_error(problem, best)
    raise UnreachableError(
        f"the best that full adhesion reaches is {left:.2g}, for {column} at pressure {pressure:g}"
    )


def preset_by_rule(
    models: ErrorModels,
    asked: Mapping[str, Any],
    name: str,
    surface: Mapping[str, Any],
    descriptor_seeds: int,
    free: bool = False,
) -> Settings:
    """Return the cheapest settings for the error of a preset in every quantity, adhesive ones too.

    `asked` is the entry ``tradeoff.presets`` of the configuration, `surface` the model surface that
    it names. With `free` the quantities of full adhesion are left out.
    """
    where, least = (models, Surface.of(surface), asked["pressures"]), None
    if not free:
        wanted = asked["adhesive"]
        columns = tuple(itertools.chain(*(ADHESIVE_QUANTITIES[q] for q in wanted["quantities"])))
        least = cheapest_adhesive(
            Problem(*where, columns, descriptor_seeds), wanted["accuracy"][name]
        )
    problem = Problem(*where, columns_of(MODELLED), descriptor_seeds)
    return cheapest(problem, asked["accuracy"][name], plain=False, least=least)
