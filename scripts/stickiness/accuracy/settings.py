"""Error and cost that settings are predicted to have, and the cheapest for an accuracy.

The error of one column at one load is `predicted_error`. The shares in it are what a control leaves
of the standard deviation. All columns at all loads are within the accuracy in 90 % of cases by
`joint_error`.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy  # scipy.special is loaded when first used, which reading a configuration does not
from numpy.typing import ArrayLike, NDArray

from stickiness.accuracy import error_models
from stickiness.accuracy.error_models import COARSE, FULL, ErrorModels, Settings, Surface
from stickiness.statistics import COVERS, covering_multiple

# The settings to choose from; errors were measured for these pixels.
PIXELS = (4, 8, 16)
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-8)
# fmt: off
SEEDS = (
    2, 3, 4, 5, 6, 8, 10, 12, 14, 16, 20, 24, 28, 32, 40, 48, 56, 64, 80, 96, 112, 128,
)
COARSE_SEEDS = (
    0, 32, 64, 96, 128, 160, 192, 256, 320, 384, 512, 640, 768, 1024, 1536, 2048,
)
# fmt: on
LEAST = Settings(
    pixels_per_wavelength=PIXELS[0],
    tolerance=TOLERANCES[0],
    seeds=SEEDS[0],
    coarse_seeds=COARSE_SEEDS[0],
)
MOST_POINTS = 2048  #: along a side of a grid
SAME_COST = 1.05  #: ratio of costs that were not measured well enough to tell them apart
# By how much the error of the worst quantity is widened, see `joint_error`. With 1.1 and models
# fitted without the surface at hand, 96 % of runs on the surfaces of `finer` were within the
# accuracy; without it 88 % on the hardest. Half was taken before `validation` was looked at.
SAFETY = 1.05
# Power with which chances add up: 1 would hold for errors that exclude each other, infinity for
# errors that come together.
TOGETHER = 2.0
_BISECTIONS = 16


class UnreachableError(ValueError):
    """No settings are predicted to reach the requested accuracy."""


@dataclass(frozen=True)
class Problem:
    """What is to be known, and how errors are predicted."""

    models: ErrorModels  #: of `error_models.read_models`
    surface: Surface
    pressures: Sequence[float]  #: mean, over E* q0 h_rms
    columns: Sequence[str]  #: of the quantities wanted, see `quantities.columns_of`
    descriptor_seeds: int = 2048  #: of which only the long waves are looked at

    @property
    def points(self) -> list[tuple[float, str]]:
        """Every pressure with every column."""
        return list(itertools.product(self.pressures, self.columns))


def error_parts(problem, settings, pressure, column) -> dict[str, NDArray]:
    """Return the relative errors by discretisation, solver and sampling, each covering 90 %.

    Here and below the numbers of seeds in the settings may be arrays that broadcast.
    """
    discretisation = error_models.single_error(
        problem.models,
        "discretisation",
        column,
        problem.surface,
        pressure,
        pixels=settings.pixels_per_wavelength,
    )
    solver = error_models.single_error(
        problem.models, "solver", column, problem.surface, pressure, tolerance=settings.tolerance
    )
    sampling = COVERS * np.sqrt(mean_variance(problem, settings, pressure, column))
    return {"discretisation": discretisation, "solver": solver, "sampling": sampling}


def predicted_error(problem: Problem, settings: Settings, pressure: float, column: str) -> NDArray:
    """Return the relative error that covers 90 % of means: `error_parts` in quadrature."""
    parts = error_parts(problem, settings, pressure, column).values()
    return np.sqrt(sum(part**2 for part in parts))


def worst_error(problem: Problem, settings: Settings) -> tuple[float, str, float]:
    """Return the error of the worst of all columns and loads, and which has the largest."""
    errors = [
        float(predicted_error(problem, settings, pressure, column))
        for pressure, column in problem.points
    ]
    pressure, column = problem.points[int(np.argmax(errors))]
    return float(joint_error(errors)), column, pressure


def joint_error(errors: ArrayLike) -> NDArray:
    """Relative error that covers 90 % of the worst of several, which are along the first axis.

    Each is taken to be normal, and covers 90 % by itself. Their chances to be beyond the result add
    up with the power `TOGETHER`.
    """
    single = np.asarray(errors, float)
    low, high = np.ones((2, *single.shape[1:]))
    high *= -scipy.special.ndtri((1 - 0.9) / 2 / len(single)) / COVERS
    largest = single.max(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(largest > 0, COVERS / math.sqrt(2) * largest / single, np.inf)
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2
        beyond = np.sum(scipy.special.erfc(middle * share) ** TOGETHER, axis=0) > 0.1**TOGETHER
        low = np.where(beyond, middle, low)
        high = np.where(beyond, high, middle)
    return SAFETY * high * largest


def mean_variance(problem: Problem, settings: Settings, pressure: float, column: str) -> NDArray:
    """Return the relative variance of a mean of n fine and N coarse seeds, and M of long waves.

    scatter^2 (fine_share^2/n + coarse_share^2/N + (1 - coarse_share^2)/M), plain scatter^2/n.
    """
    multilevel = sum(part for part, _ in _levels(problem, settings, pressure, column))
    plain = 1 / np.asarray(settings.seeds)
    surface, pressure, factor = error_models.nearest_measured(problem.surface, pressure)
    scatter = problem.models["scatter", column](surface, pressure)
    return (factor * scatter) ** 2 * np.where(np.equal(settings.coarse_seeds, 0), plain, multilevel)


def covering_factor(problem: Problem, settings: Settings, pressure: float, column: str) -> float:
    """Return how many standard errors, themselves of the seeds at hand, cover 90 % of means.

    Student's t with n - 1 degrees of freedom, those of Welch and Satterthwaite for multilevel
    means, by the error models; NaN for a single seed, whose standard error is unknown.
    """
    if settings.seeds < 2:
        return math.nan
    if not settings.coarse_seeds:
        return float(covering_multiple(settings.seeds - 1))
    levels = _levels(problem, settings, pressure, column)
    total = sum(part for part, _ in levels) ** 2
    return float(covering_multiple(total / sum(part**2 / freedom for part, freedom in levels)))


def _levels(problem, settings, pressure, column):
    """Variance of the fine, coarse and long-wave means over scatter², and degrees of freedom."""
    surface, pressure, _ = error_models.nearest_measured(problem.surface, pressure)
    models = problem.models
    coarse = min(models["coarse_share", column](surface, pressure), 1.0)
    fine = models["fine_share", column](surface, pressure, settings.pixels_per_wavelength)
    long_waves = math.sqrt(1 - coarse**2)
    fine_seeds = np.asarray(settings.seeds)
    coarse_seeds = np.maximum(settings.coarse_seeds, 2)
    return [
        (fine**2 / fine_seeds, fine_seeds - 1),
        (coarse**2 / coarse_seeds, coarse_seeds - 1),
        (long_waves**2 / problem.descriptor_seeds, problem.descriptor_seeds - 1),
    ]


def predicted_cost(problem: Problem, settings: Settings) -> NDArray:
    """Return the cost of a case on all its grids, in pairs of transforms of 1024 x 1024 doubles."""
    models = problem.models
    surface = problem.surface
    # Costs were measured at the tolerance `FULL`; a larger one saves a part, at every load.
    tolerance = settings.tolerance / FULL
    saved = len(problem.pressures) * models["tolerance_cost", ""](surface, tolerance=tolerance)
    # A fine seed is solved on its grid and on two coarser ones.
    pixels = settings.pixels_per_wavelength
    grids = {pixels, pixels // 2, COARSE}
    fine_seed = saved * sum(models["fine_cost", ""](surface, pixels=grid) for grid in grids)
    coarse_seeds = saved * models["coarse_cost", ""](surface) * np.asarray(settings.coarse_seeds)
    described = problem.descriptor_seeds * models["described_cost", ""](surface)
    plain = np.equal(settings.coarse_seeds, 0)
    multilevel = np.where(plain, 0.0, coarse_seeds + described)
    return fine_seed * np.asarray(settings.seeds) + multilevel


@dataclass(frozen=True, order=True)
class _Candidate:
    """Settings with their predicted error and cost, in the order of preference."""

    error: float
    cost: float
    settings: Settings


def cheapest(
    problem: Problem, accuracy: float, *, plain: bool = False, least: Settings = LEAST
) -> Settings:
    """Return the cheapest settings predicted to reach an accuracy in all columns at all loads.

    Among settings whose cost is within 5 % of the lowest, the most accurate.

    Parameters
    ----------
    problem : Problem
        What is to be known, and how errors are predicted.
    accuracy : float
        Largest relative error, covering 90 %, of all columns at all loads together (`joint_error`).
    plain : bool
        Whether to leave out coarse seeds.
    least : Settings
        The fewest pixels and seeds, and the largest tolerance that are allowed.

    Returns
    -------
    Settings

    Raises
    ------
    UnreachableError
        If no settings reach the accuracy; the message says what could be reached.
    """
    waves = problem.surface.magnification * problem.surface.window
    coarsest = least.pixels_per_wavelength
    grids = [p for p in PIXELS if p >= coarsest and p * waves <= MOST_POINTS]
    if not grids:
        raise UnreachableError(
            f"the coarsest grid, {coarsest} points per shortest wavelength, would take "
            f"{coarsest * waves:.0f} points a side, above {MOST_POINTS}; simulate a smaller "
            "magnification or window"
        )
    tolerances = [tolerance for tolerance in TOLERANCES if tolerance <= least.tolerance]
    seeds = [n for n in SEEDS if n >= least.seeds]
    coarse = [0] if plain else [n for n in COARSE_SEEDS if n >= least.coarse_seeds]
    fine_numbers, coarse_numbers = np.transpose(list(itertools.product(seeds, coarse)))
    # All settings that are accurate enough, but for those that cost more than ones found before.
    candidates = []
    lowest = math.inf
    for pixels, tolerance in itertools.product(grids, tolerances):
        costs = predicted_cost(problem, Settings(pixels, tolerance, fine_numbers, coarse_numbers))
        is_cheap = costs <= SAME_COST * lowest
        if not is_cheap.any():
            continue
        cheap_fine, cheap_coarse = fine_numbers[is_cheap], coarse_numbers[is_cheap]
        grid = Settings(pixels, tolerance, cheap_fine, cheap_coarse)
        errors = joint_error(
            [
                predicted_error(problem, grid, pressure, column)
                for pressure, column in problem.points
            ]
        )
        for k in np.flatnonzero(errors <= accuracy):
            settings = Settings(pixels, tolerance, int(cheap_fine[k]), int(cheap_coarse[k]))
            cost = float(costs[is_cheap][k])
            candidates.append(_Candidate(float(errors[k]), cost, settings))
            lowest = min(lowest, cost)
    if candidates:
        # Among the cheapest the most accurate, then the cheapest again.
        return min(c for c in candidates if c.cost <= SAME_COST * lowest).settings
    best = Settings(grids[-1], TOLERANCES[-1], SEEDS[-1], coarse[-1])
    error, column, pressure = worst_error(problem, best)
    raise UnreachableError(
        f"the best that {best.seeds} seeds on {best.pixels_per_wavelength} points per shortest "
        f"wavelength reach is {error:.2g}, for {column} at pressure {pressure:g}; ask for less "
        "accuracy or fewer quantities, or give the case settings of its own"
    )


def allow_for_few_seeds(problem: Problem, chosen: Settings, accuracy: float) -> Settings:
    """Return the settings with as many more fine seeds as Student's t requires, if any number does.

    `cheapest` uses the true scatter. An answer knows only the standard error of its few seeds, so
    that the error it states is larger.
    """
    # Errors that more seeds do not change.
    fixed = []
    for pressure, column in problem.points:
        parts = error_parts(problem, chosen, pressure, column)
        fixed.append(math.hypot(parts["discretisation"], parts["solver"]))
    for n in (n for n in SEEDS if n >= max(chosen.seeds, 2)):
        settings = replace(chosen, seeds=n)
        if joint_error(np.hypot(fixed, _stated_sampling(problem, settings))) <= accuracy:
            break
    return settings


def seeds_enough(
    problem: Problem, settings: Settings, accuracy: float, fixed: ArrayLike, sampling: ArrayLike
) -> int | None:
    """Return the fewest fine seeds that are predicted to be enough; None if none of `SEEDS` are.

    `fixed` and `sampling` (column, pressure) are the relative errors measured with the settings,
    covering 90 %: those that more seeds do not change, and the sampling error.
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


def _stated_sampling(problem, settings):
    """Sampling error that an answer is expected to state at every point, with Student's t."""
    errors = []
    for pressure, column in problem.points:
        multiple = covering_factor(problem, settings, pressure, column)
        variance = mean_variance(problem, settings, pressure, column)
        errors.append(multiple * math.sqrt(variance))
    return np.array(errors)
