"""The cheapest settings for the accuracy that is asked for."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.accuracy.error_models import Settings
from stickiness.accuracy.prediction import (
    Problem,
    costs_of_seeds,
    covering_factor,
    fixed_errors,
    joint_error,
    mean_variance,
    worst_error,
)
from stickiness.statistics import COVERS

SAME_COST = 1.05  #: ratio of costs that were not measured well enough to tell them apart

# From what settings are put together; the pixels are those for which errors were measured.
PIXELS = (4, 8, 16)
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-8)
SEEDS = (*(2, 3, 4, 5, 6, 8, 10, 12, 14, 16, 20, 24, 28, 32), *(40, 48, 56, 64, 80, 96, 112, 128))
COARSE_SEEDS = (*(0, 32, 64, 96, 128, 160, 192, 256, 320, 384), *(512, 640, 768, 1024, 1536, 2048))


class UnreachableError(ValueError):
    """No settings are predicted to be as accurate as asked for."""

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

    Of those that cost within 5 % of the cheapest, the most accurate.

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
        Fewest pixels and seeds, coarse ones too, and largest tolerance that others need.

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


def allow_for_few_seeds(problem: Problem, chosen: Settings, accuracy: float) -> Settings:
    """Return settings with as many more fine seeds as Student's t asks for.

    `cheapest` counts with the true scatter. The error that a few seeds will state is larger, since
    their own standard error is what they know. If no number of `SEEDS` is enough, it is the last.
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

    `fixed` and `sampling` (column, pressure) are relative errors as measured with the settings,
    covering 90 %: those that more seeds leave as they are, and that of the mean. The latter changes
    with the number of seeds as the error models say.
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


def _worst_errors(problem: Problem, grid: Settings, seeds: NDArray, coarse: NDArray) -> NDArray:
    """Largest predicted error on one grid for all numbers of seeds."""
    pixels, errors = grid.pixels_per_wavelength, []
    for at in problem.points:
        fixed = math.hypot(*fixed_errors(problem, *at, pixels, grid.tolerance))
        variance = mean_variance(problem, *at, pixels, seeds, coarse)
        errors.append(np.sqrt(fixed**2 + COVERS**2 * variance))
    return joint_error(errors)
