"""Errors and costs that settings are predicted to have, by the error models.

The relative error of one column at one load that covers 90 % is

    error^2 = discretisation^2 + solver^2
              + z^2 scatter^2 (fine_share^2/n + coarse_share^2/N + (1 - coarse_share^2)/M)

with n fine seeds, N coarse ones, M whose long waves alone are looked at (see
`accuracy.multilevel`), and z = 1.645; for plain means the inner bracket is 1/n. The shares are what
a control leaves of the standard deviation. All columns at all loads are within the accuracy in
90 % of cases by `joint_error`.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy  # scipy.special is loaded when first used, which reading a configuration does not
from numpy.typing import ArrayLike, NDArray

from stickiness.accuracy.error_models import (
    COARSE,
    FULL,
    ErrorModels,
    Settings,
    Surface,
    nearest_measured,
    single_error,
)
from stickiness.statistics import COVERS, covering_multiple

# By how much the error of the worst quantity is widened, see `joint_error`. With 1.1 and models
# fitted without the surface at hand, 96 % of runs on the four surfaces of `finer` were within the
# accuracy, at a median of 1.23 times the least cost; without it 88 % on the hardest of these. Half
# of that was taken before the surfaces of `validation` were looked at.
SAFETY = 1.05
TOGETHER = 2.0  #: power with which chances add up; 1 would be a plain sum, infinity their largest
_BISECTIONS = 16


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


def error_parts(
    problem: Problem, settings: Settings, pressure: float, column: str
) -> dict[str, float]:
    """Relative errors by discretisation, solver and sampling, each covering 90 % of means."""
    pixels, seeds = settings.pixels_per_wavelength, (settings.seeds, settings.coarse_seeds)
    variance = mean_variance(problem, pressure, column, pixels, *seeds)
    grid, solver = fixed_errors(problem, pressure, column, pixels, settings.tolerance)
    return {"discretisation": grid, "solver": solver, "sampling": COVERS * float(np.sqrt(variance))}


def predicted_error(problem: Problem, settings: Settings, pressure: float, column: str) -> float:
    """Relative error that covers 90 % of means: `error_parts` in quadrature."""
    return math.hypot(*error_parts(problem, settings, pressure, column).values())


def worst_error(problem: Problem, settings: Settings) -> tuple[float, str, float]:
    """Error of the worst of all columns and loads; column and pressure of the largest."""
    errors = {at: predicted_error(problem, settings, *at) for at in problem.points}
    pressure, column = max(errors, key=errors.get)
    return float(joint_error(list(errors.values()))), column, pressure


def joint_error(errors: ArrayLike) -> NDArray:
    """Relative error that covers 90 % of the worst of several, which are along the first axis.

    Each is taken to be normal, and covers 90 % by itself. Their chances to be beyond the result add
    up with the power `TOGETHER`: a plain sum would hold if they excluded each other, their largest
    if all came together.
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
        low, high = np.where(beyond, middle, low), np.where(beyond, high, middle)
    return SAFETY * high * largest


def fixed_errors(
    problem: Problem, pressure: float, column: str, pixels: float, tolerance: float
) -> tuple[float, float]:
    """Return the errors by discretisation and solver, which more seeds do not reduce."""
    where = column, problem.surface, pressure
    return (
        single_error(problem.models, "discretisation", *where, pixels=pixels),
        single_error(problem.models, "solver", *where, tolerance=tolerance),
    )


def covering_factor(problem: Problem, settings: Settings, pressure: float, column: str) -> float:
    """Return how many standard errors, themselves of the seeds at hand, cover 90 % of means.

    Student's t: with n - 1 degrees of freedom for plain means, with those of Welch and
    Satterthwaite for multilevel ones, the share of each level in the variance being that of the
    error models. NaN for a single seed, whose standard error is unknown.
    """
    if settings.seeds < 2:
        return math.nan
    grid_and_seeds = settings.pixels_per_wavelength, settings.seeds, settings.coarse_seeds
    return float(covering_multiple(degrees_of_freedom(problem, pressure, column, *grid_and_seeds)))


def degrees_of_freedom(
    problem: Problem,
    pressure: float,
    column: str,
    pixels: float,
    seeds: ArrayLike,
    coarse_seeds: ArrayLike,
) -> NDArray:
    """Return the degrees of freedom of a standard error; the seeds may be arrays that broadcast.

    One less than the seeds of plain means; those of Welch and Satterthwaite for multilevel ones.
    """
    seeds, several = np.asarray(seeds), np.maximum(coarse_seeds, 2)
    shares = _level_shares(problem, pressure, column, pixels)
    numbers = (seeds, several, problem.descriptor_seeds)
    levels = [(share**2 / n, n - 1) for share, n in zip(shares, numbers, strict=True)]
    total = sum(part for part, _ in levels) ** 2
    welch = total / sum(part**2 / freedom for part, freedom in levels)
    return np.where(np.equal(coarse_seeds, 0), seeds - 1, welch)


def mean_variance(
    problem: Problem,
    pressure: float,
    column: str,
    pixels: float,
    seeds: ArrayLike,
    coarse_seeds: ArrayLike,
) -> NDArray:
    """Return the relative variance of a mean; the numbers of seeds may be arrays that broadcast."""
    fine, coarse, long = _level_shares(problem, pressure, column, pixels)
    several = np.maximum(coarse_seeds, 1)
    multilevel = fine**2 / seeds + coarse**2 / several + long**2 / problem.descriptor_seeds
    surface, pressure, factor = nearest_measured(problem.surface, pressure)
    scatter = problem.models["scatter", column](surface, pressure)
    return (factor * scatter) ** 2 * np.where(
        np.equal(coarse_seeds, 0), 1 / np.asarray(seeds), multilevel
    )


def _level_shares(problem, pressure, column, pixels):
    """Standard deviation left at the fine, coarse and long-wave level, over that of one seed."""
    surface, pressure, _ = nearest_measured(problem.surface, pressure)
    coarse = min(problem.models["coarse_share", column](surface, pressure), 1.0)
    fine = problem.models["fine_share", column](surface, pressure, pixels)
    return fine, coarse, math.sqrt(1 - coarse**2)


def predicted_cost(problem: Problem, settings: Settings) -> float:
    """Cost of a case in pairs of Fourier transforms of 1024 x 1024 doubles.

    With the coarser grids on which every realisation is solved too.
    """
    return float(costs_of_seeds(problem, settings, settings.seeds, settings.coarse_seeds))


def costs_of_seeds(
    problem: Problem, settings: Settings, seeds: ArrayLike, coarse_seeds: ArrayLike
) -> NDArray:
    """Return the costs of numbers of seeds, arrays that broadcast, on the grid of some settings."""
    models, surface = problem.models, problem.surface
    pixels, tolerance = settings.pixels_per_wavelength, settings.tolerance / FULL
    saved = len(problem.pressures) * models["tolerance_cost", ""](surface, tolerance=tolerance)
    grids = {pixels, pixels // 2, COARSE}
    one = saved * sum(models["fine_cost", ""](surface, pixels=grid) for grid in grids)
    many = saved * models["coarse_cost", ""](surface) * np.asarray(coarse_seeds)
    fixed = problem.descriptor_seeds * models["described_cost", ""](surface)
    return one * np.asarray(seeds) + np.where(np.equal(coarse_seeds, 0), 0.0, many + fixed)
