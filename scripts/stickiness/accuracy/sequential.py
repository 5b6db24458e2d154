"""When to stop drawing seeds: once the error measured is within the accuracy asked, or at a cap.

Seeds are drawn in rounds on one grid; each round keeps those of the rounds before. After a round
the relative error that covers 90 % is, for every quantity and load,

    error^2 = discretisation^2 + solver^2 + sampling^2,    sampling = t(f) sqrt(v),

with the standard error s of the mean measured on the seeds drawn, and the discretisation error by
`accuracy.grid_error`. All of them hold at once by `accuracy.joint_error`. Few seeds do not know
their own scatter: stopping at the first round that looks good would stop where s is too small by
luck. So their variance is pooled with that of the laws of `accuracy`, which counts
as an earlier sample of `PRIOR` degrees of freedom,

    v = (f_s s^2 + f_p s_law^2)/(f_s + f_p),    f = f_s + f_p,

f_s being those of the seeds (Welch and Satterthwaite) and t(f) Student's factor. Outside what the
laws were measured on they count a quarter as much.

What the next round holds is the cheapest that is expected to do: v changes with the numbers of
seeds as the laws say, from where it was measured. Fixed-width intervals by such rules are Stein's
and Chow and Robbins's (Ann. Math. Statist. 16, 243 (1945) and 36, 457 (1965)).

In simulations of surfaces that scatter 0.7, 1 and 1.4 times as much as the laws say, with 4 degrees
of freedom for the laws 98, 92 and 90 % of the plain means that it stops at are within the accuracy,
and 99, 94 and 91 % of multilevel ones (250 each, two standard deviations 4 %). With 16 the last are
88 and 84 %, at 10 and 16 % less cost where the laws are right. Laws fitted without a surface miss
its scatter by 8 to 16 %, so that 16 is taken; the validation of the target `tradeoff` is with it.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from stickiness.accuracy import error_laws as known
from stickiness.accuracy.error_laws import Laws, Settings, Surface

PRIOR = 16.0  # degrees of freedom of the laws' scatter: as good as that of so many more seeds
START = 1.5  # times the accuracy asked for, at which the first round aims
FEWEST = 3  # fine seeds of the first round, unless fewer were chosen in advance
COARSE_TIMES = 16  # coarse seeds at most, times the cap of fine ones
# Share of the accuracy that is always left to sampling: more seeds do not make up for a grid that
# takes all of it.
ROOM = 0.7

ENOUGH, MORE, CAP, GRID = STATES = ("enough", "more", "cap", "grid")


@dataclass(frozen=True)
class Asked:
    """What a case asks for, the same in all rounds.

    Attributes
    ----------
    accuracy : float
        Relative error that is to cover 90 % of every quantity at every load.
    surface : accuracy.Surface
        Surface of the case.
    pressures : tuple of float
        Loads, ascending.
    quantities : tuple of str
        What is wanted, of `accuracy.QUANTITIES`.
    at_most : int
        Cap of the fine seeds; that of coarse ones is `COARSE_TIMES` as many.
    plain : bool
        Whether there are to be no coarse seeds.
    descriptor_seeds : int
        See `accuracy.error_parts`.
    """

    accuracy: float
    surface: Surface
    pressures: tuple[float, ...]
    quantities: tuple[str, ...]
    at_most: int = known.SEEDS[-1]
    plain: bool = False
    descriptor_seeds: int = 2048

    def __post_init__(self) -> None:
        if not isinstance(self.surface, Surface):  # as it comes from a file
            object.__setattr__(self, "surface", Surface(**self.surface))

    @property
    def columns(self) -> tuple[str, ...]:
        """Columns of the table of laws behind the quantities."""
        return tuple(itertools.chain(*(known.QUANTITIES[name] for name in self.quantities)))


@dataclass(frozen=True)
class Measured:
    """What the seeds drawn so far say of every column and load of an `Asked`.

    Attributes
    ----------
    mean, standard_error, discretisation : (column, pressure) array
        Mean, its standard error, and its discretisation error that covers 90 %.
    """

    mean: NDArray
    standard_error: NDArray
    discretisation: NDArray


@dataclass(frozen=True)
class Decision:
    """Whether the seeds do, and if not what comes next.

    Attributes
    ----------
    state : str
        ``enough``; ``more`` seeds; at the ``cap`` without being accurate enough; or the ``grid``
        errs too much, which no seeds make up for.
    settings : Settings
        Those of the next round, or if there is none those assessed.
    error, sampling : (column, pressure) array
        Relative error that covers 90 %, and its part by sampling. NaN where there is no mean to
        refer to.
    """

    state: str
    settings: Settings
    error: NDArray
    sampling: NDArray


def first(laws: Laws, asked: Asked, chosen: Settings) -> Settings:
    """Return the settings of the first round, on the grid of those chosen in advance.

    The cheapest of the same kind, plain or multilevel, whose sampling error by the laws is within
    `START` times what the accuracy leaves room for.
    """
    least = replace(
        chosen,
        seeds=min(FEWEST, chosen.seeds, asked.at_most),
        coarse_seeds=min(chosen.coarse_seeds, known.COARSE_SEEDS[1]),
    )
    seeds, coarse = _candidates(replace(asked, plain=not chosen.coarse_seeds), least)
    freedom, variance = _sampling_by_law(laws, asked, least, seeds, coarse)
    sampling = known.covers(freedom + _prior(laws, asked)) * np.sqrt(variance) / START
    fixed = np.array(
        [
            [math.hypot(*known.fixed_errors(laws, asked.surface, load, column, *_grid(chosen)))]
            for column, load in itertools.product(asked.columns, asked.pressures)
        ]
    ).reshape(len(asked.columns), len(asked.pressures), 1)
    return _cheapest(laws, asked, least, seeds, coarse, _joint(asked, fixed, sampling))


def assess(laws: Laws, asked: Asked, settings: Settings, measured: Measured) -> Decision:
    """Return whether the seeds drawn with `settings` do, and if not what comes next."""
    freedom, by_law = _sampling_by_law(
        laws, asked, settings, np.array([settings.seeds]), np.array([settings.coarse_seeds])
    )
    prior = _prior(laws, asked)
    with np.errstate(divide="ignore", invalid="ignore"):
        scatter = (measured.standard_error / measured.mean)[..., None]
        found = np.abs(measured.discretisation / measured.mean)
    grid = _grid_error(laws, asked, settings, found)
    pooled = (freedom * scatter**2 + prior * by_law) / (freedom + prior)
    sampling = known.covers(freedom + prior) * np.sqrt(pooled)
    fixed = np.hypot(grid, _solver(laws, asked, settings))
    error = np.hypot(fixed, sampling)
    told = np.isfinite(error)

    def decided(state: str, settings: Settings) -> Decision:
        found = (np.where(told, part, np.nan)[..., 0] for part in (error, sampling))
        return Decision(state, settings, *found)

    fixed, sampling = (np.where(told, part, 0.0) for part in (fixed, sampling))
    if known.joint_error(np.hypot(fixed, sampling).ravel()) <= asked.accuracy:
        return decided(ENOUGH, settings)
    if _joint(asked, fixed, sampling)[0] <= asked.accuracy:
        return decided(GRID, settings)
    seeds, coarse = _candidates(asked, settings)
    if len(seeds) == 1:
        return decided(CAP, settings)
    freedom, variance = _sampling_by_law(laws, asked, settings, seeds, coarse)
    expected = known.covers(freedom + prior) * np.sqrt(pooled * variance / by_law)
    foreseen = _joint(asked, fixed, np.where(told, expected, 0.0))
    return decided(MORE, _cheapest(laws, asked, settings, seeds, coarse, foreseen))


def worst(error: NDArray, asked: Asked) -> tuple[float, str, float]:
    """Return what is held against the accuracy, and the column and load of the largest error."""
    row, at = np.unravel_index(np.nanargmax(error), error.shape)
    of_all = float(known.joint_error(error[np.isfinite(error)]))
    return of_all, asked.columns[row], asked.pressures[at]


def _candidates(asked: Asked, least: Settings) -> tuple[NDArray, NDArray]:
    """Numbers of fine and coarse seeds within the cap, none fewer than those of `least`."""
    seeds = sorted({least.seeds, *(n for n in known.SEEDS if n < asked.at_most), asked.at_most})
    coarse = [0] if asked.plain else known.COARSE_SEEDS
    most = max(COARSE_TIMES * asked.at_most, least.coarse_seeds)
    both = itertools.product(
        (n for n in seeds if n >= least.seeds),
        (n for n in coarse if least.coarse_seeds <= n <= most),
    )
    return tuple(np.array(list(both)).T)


def _cheapest(laws, asked, least, seeds, coarse, error) -> Settings:
    """Cheapest of the candidates whose error is within the accuracy, or the largest if none is."""
    does = error <= asked.accuracy
    loads, described = len(asked.pressures), asked.descriptor_seeds
    costs = known.costs_of_seeds(laws, least, asked.surface, loads, described, seeds, coarse)
    best = int(np.argmin(np.where(does, costs, np.inf))) if does.any() else -1
    return replace(least, seeds=int(seeds[best]), coarse_seeds=int(coarse[best]))


def _sampling_by_law(laws, asked, settings, seeds, coarse) -> tuple[NDArray, NDArray]:
    """Degrees of freedom and relative variance by the laws, `(column, pressure, candidate)`."""
    where = [
        (laws, asked.surface, load, column, settings.pixels_per_wavelength, asked.descriptor_seeds)
        for column, load in itertools.product(asked.columns, asked.pressures)
    ]
    shape = len(asked.columns), len(asked.pressures), len(seeds)
    found = (
        [law(*each, seeds, coarse) for each in where]
        for law in (known.degrees_of_freedom, known.mean_variance)
    )
    return tuple(np.reshape(values, shape) for values in found)


def _prior(laws: Laws, asked: Asked) -> NDArray:
    """Degrees of freedom that the laws count with, by load."""
    factors = np.array([known.measured(asked.surface, load)[-1] for load in asked.pressures])
    return (PRIOR / factors**2)[None, :, None]


def _grid_error(laws: Laws, asked: Asked, settings: Settings, found: NDArray) -> NDArray:
    """Relative error by the grid, where that of the case's own grids is `found`."""
    errors = [
        [
            known.grid_error(laws, column, asked.surface, load, settings.pixels_per_wavelength, own)
            for load, own in zip(asked.pressures, of_loads, strict=True)
        ]
        for column, of_loads in zip(asked.columns, found, strict=True)
    ]
    return np.array(errors)[..., None]


def _solver(laws: Laws, asked: Asked, settings: Settings) -> NDArray:
    """Relative error by the solver's tolerance."""
    return np.array(
        [
            [
                known.single_error(
                    laws, "solver", column, asked.surface, load, tolerance=settings.tolerance
                )
                for load in asked.pressures
            ]
            for column in asked.columns
        ]
    )[..., None]


def _joint(asked: Asked, fixed: NDArray, sampling: NDArray) -> NDArray:
    """Error of the worst column and load, with no more by the grid than leaves `ROOM` for seeds."""
    most = math.sqrt(1 - ROOM**2) * asked.accuracy
    error = np.hypot(np.minimum(fixed, most), sampling)
    return known.joint_error(error.reshape(-1, error.shape[-1]))


def _grid(settings: Settings) -> Sequence[float]:
    return settings.pixels_per_wavelength, settings.tolerance
