"""Settings of a simulation for the accuracy that is asked for, from what was measured.

What a mean over random surfaces errs by, and what it costs, was measured on a few surfaces with
many settings (target `tradeoff`). Each part is kept as a `Law`: a power law in magnification,
window, pressure, pixels and tolerance, times an exponential of the Hurst exponent. The relative
error of one quantity at one load that covers 90 % is

    error^2 = discretisation^2 + solver^2
              + z^2 scatter^2 (fine_share^2/n + coarse_share^2/N + (1 - coarse_share^2)/M)

with n fine, N coarse and M described seeds of the multilevel mean of `sampling` and z = 1.645; with
plain means the inner bracket is 1/n. The shares are what a control leaves of the standard
deviation. All quantities at all loads are within the accuracy in 90 % of cases by `joint_error`.
Outside what was measured (`MEASURED`) errors are doubled, with the laws taken at the edge of it.
Beside these the table says what theory errs by in place of a simulation, and what a value to which
theory adds a broader spectrum's difference errs by (`carrying_error`).
"""

from __future__ import annotations

import csv
import itertools
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special  # not stats, whose import would cost every job a third of a second

PARTS = (
    "discretisation",
    "solver",
    "scatter",
    "fine_share",
    "coarse_share",
    "theory",
    "carrying",
)
COSTS = ("fine_cost", "coarse_cost", "described_cost", "tolerance_cost")
COVERS = 1.645  # standard deviations that cover 90 % of a normal distribution
_QUANTILE = 0.95  # one-sided, of the same
COARSE = 2  # pixels per shortest wavelength of the coarse seeds
SAME_COST = 1.05  # ratio of costs that were not measured well enough to tell them apart
FULL = 1e-8  # tolerance at which costs were measured
# By how much the error of the worst quantity is widened, see `joint_error`. With 1.1 and laws
# fitted without the surface at hand, 96 % of runs on the four surfaces of `finer` were within the
# accuracy, at a median of 1.23 times the least cost; without it 88 % on the hardest of these. Half
# of that was taken before the surfaces of `validation` were looked at.
SAFETY = 1.05
TOGETHER = 2.0  # power with which chances add up; 1 would be a plain sum, infinity their largest
_BISECTIONS = 16
# Where the laws were fitted or, at the largest Hurst exponent and the smallest pressure, compared
# with other simulations.
MEASURED = {
    "hurst": (0.5, 0.9),
    "magnification": (16.0, 64.0),
    "window": (1.0, 4.0),
    "pressure": (0.0065, 0.3),
}
# What is finer errs no more than at the edge, what is coarser as outside.
KNOBS = {"pixels": (4.0, 16.0), "tolerance": (1e-8, 1e-3)}
CARRIED_TIMES, CARRIED_TO = 8, 512  # magnification, up to which theory's difference was measured
OUTSIDE = 2.0  # factor by which errors outside are widened; P(u) at magnification 128 needs 1.1

# What a user may ask for, by the columns of the table that it depends on.
QUANTITIES = {
    "area": ("area",),
    "mean_gap": ("mean_gap",),
    "attractive_area": ("attractive_area_0.01", "attractive_area_0.1"),
    "gap_distribution": ("gap_distribution",),
    "a_v": ("a_v",),
    "kappa": ("kappa",),
}
# Quantities that rest on the gaps, which take longer to evaluate than areas and mean gaps.
OF_GAPS = ("attractive_area", "gap_distribution", "a_v")

# From what settings are put together; the pixels are those for which errors were measured.
PIXELS = (4, 8, 16)
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-8)
SEEDS = (
    *(2, 3, 4, 5, 6, 8, 10, 12, 14, 16, 20, 24, 28, 32),
    *(40, 48, 56, 64, 80, 96, 112, 128),
)
COARSE_SEEDS = (
    *(0, 32, 64, 96, 128, 160, 192, 256, 320, 384),
    *(512, 640, 768, 1024, 1536, 2048),
)


@dataclass(frozen=True)
class Surface:
    """What settings depend on: Hurst exponent, q1/q0, side over longest wavelength."""

    hurst: float
    magnification: float
    window: float = 1.0

    @classmethod
    def of(cls, made: Mapping[str, Any]) -> Surface:
        """From a model surface of the configuration, or the parameters of a file."""
        return cls(made["hurst"], made["magnification"], made.get("window", 1.0))


@dataclass(frozen=True, order=True)
class Settings:
    """Settings of a case; no coarse seeds stand for plain means."""

    pixels_per_wavelength: int
    tolerance: float
    seeds: int
    coarse_seeds: int


@dataclass(frozen=True)
class Law:
    """One measured quantity over everything that it depends on.

    ``spread`` is the factor above the fit below which 90 % of the measured points lie, ``points``
    their number.
    """

    constant: float
    hurst: float = 0.0
    magnification: float = 0.0
    window: float = 0.0
    pressure: float = 0.0
    pixels: float = 0.0
    tolerance: float = 0.0
    spread: float = 1.0
    points: int = 0

    def __call__(
        self, surface: Surface, pressure: float = 1.0, pixels: float = 1.0, tolerance: float = 1.0
    ) -> float:
        """Return the value by the fit, without the spread."""
        return math.exp(
            self.constant
            + self.hurst * surface.hurst
            + self.magnification * math.log(surface.magnification)
            + self.window * math.log(surface.window)
            + self.pressure * math.log(pressure)
            + self.pixels * math.log(pixels)
            + self.tolerance * math.log(tolerance)
        )


Laws = Mapping[tuple[str, str], Law]


def measured(surface: Surface, pressure: float) -> tuple[Surface, float, float]:
    """Return the nearest surface and pressure measured, and what to widen errors there by.

    The factor is 1 for what lies within `MEASURED` itself, otherwise `OUTSIDE`.
    """
    asked = {**vars(surface), "pressure": pressure}
    near = {name: min(max(asked[name], low), high) for name, (low, high) in MEASURED.items()}
    factor = 1.0 if near == asked else OUTSIDE
    return Surface(**{name: near[name] for name in vars(surface)}), near["pressure"], factor


def single_error(
    laws: Laws, part: str, column: str, surface: Surface, pressure: float, **knob: float
) -> float:
    """Return what one law says of an error, covering 90 %; wider outside what was measured."""
    law, (surface, pressure, factor) = laws[part, column], measured(surface, pressure)
    if coarse(**knob):
        factor *= OUTSIDE
    return factor * law.spread * law(surface, pressure, **resolved(**knob))


def grid_error(
    laws: Laws, column: str, surface: Surface, pressure: float, pixels: float, found: float
) -> float:
    """Return the relative error by the grid, covering 90 %, of a case whose own grids say `found`.

    The smaller of that and the law's. What one case's grids say has to cover any surface, and is
    two to five times the error; outside what was measured it stands alone.
    """
    if extrapolated(surface, pressure, pixels):
        return found
    by_law = single_error(laws, "discretisation", column, surface, pressure, pixels=pixels)
    return float(np.fmin(found, by_law))


def coarse(pixels: float = 8.0, tolerance: float = 1e-8) -> bool:
    """Whether a grid or a tolerance is coarser than what was measured."""
    return pixels < KNOBS["pixels"][0] or tolerance > KNOBS["tolerance"][1]


def resolved(**knob: float) -> dict[str, float]:
    """Return pixels or tolerance as given, or if they are finer the finest measured."""
    finest = {"pixels": KNOBS["pixels"][1], "tolerance": KNOBS["tolerance"][0]}
    finer = {"pixels": min, "tolerance": max}
    return {name: finer[name](value, finest[name]) for name, value in knob.items()}


def extrapolated(
    surface: Surface, pressure: float, pixels: float = 8.0, tolerance: float = 1e-8
) -> bool:
    """Whether anything that errors are taken from is outside what was measured."""
    return measured(surface, pressure)[-1] > 1 or coarse(pixels, tolerance)


def carrying_error(
    laws: Laws, surface: Surface, carry_to: float, size: float, column: str, pressure: float
) -> float:
    """Error of theory's difference, covering 90 %, as a share of the value simulated.

    Parameters
    ----------
    surface : Surface
        As it is simulated.
    carry_to : float
        Magnification that theory carries on to; at most `CARRIED_TIMES` that of the surface and
        `CARRIED_TO` in all, up to which this was measured.
    size : float
        By how much of itself theory changes the area: errors are in proportion to it.

    Raises
    ------
    ValueError
        If the magnification is beyond what was measured.
    """
    if not carry_to <= min(CARRIED_TIMES * surface.magnification, CARRIED_TO):
        raise ValueError(
            f"carry_to = {carry_to:g} must be at most {CARRIED_TIMES} times the magnification "
            f"simulated, {surface.magnification:g}, and {CARRIED_TO}"
        )
    # One law for all cuts and windows: only the Hurst exponent and the load may be outside.
    anywhere = Surface(surface.hurst, MEASURED["magnification"][0])
    return size * single_error(laws, "carrying", column, anywhere, pressure)


class UnreachableError(ValueError):
    """No settings within reach are predicted to be as accurate as asked for."""

    remedy = "ask for less accuracy or fewer quantities, or give the case settings of its own"


class GridError(UnreachableError):
    """Even the coarsest grid is too large."""

    remedy = "simulate a smaller magnification or window"


def read_laws(path: str | Path) -> dict[tuple[str, str], Law]:
    """Read the table of laws, by part and quantity (costs have none).

    Raises
    ------
    ValueError
        Naming the file, if it is missing or a part or quantity is.
    """
    try:
        with Path(path).open(encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        laws = {(row.pop("part"), row.pop("quantity")): _law(row) for row in rows}
    except FileNotFoundError:
        raise ValueError(f"{path}: no such file; the target tradeoff makes it") from None
    except (KeyError, TypeError, ValueError) as error:
        raise ValueError(f"{path}: not a table of laws ({error})") from None
    wanted = itertools.product(PARTS, itertools.chain(*QUANTITIES.values()))
    for part, quantity in (*wanted, *((cost, "") for cost in COSTS)):
        if (part, quantity) not in laws:
            raise ValueError(f"{path}: lacks {part} of {quantity or 'a solution'}")
    return laws


def write_laws(path: str | Path, laws: Laws, comment: str) -> None:
    """Write a table of laws, with lines of comment before it."""
    names = [field.name for field in fields(Law)]
    with Path(path).open("w", encoding="utf-8", newline="") as file:
        file.writelines(f"# {line}\n" for line in comment.splitlines())
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["part", "quantity", *names])
        for (part, quantity), law in laws.items():
            table.writerow([part, quantity, *(f"{getattr(law, name):.5g}" for name in names)])


def error_parts(
    laws: Laws,
    settings: Settings,
    surface: Surface,
    pressure: float,
    column: str,
    descriptor_seeds: int = 2048,
) -> dict[str, float]:
    """Relative errors by discretisation, solver and sampling, each covering 90 % of means.

    Parameters
    ----------
    laws : mapping
        From `read_laws`.
    pressure : float
        Mean pressure over E* q0 h_rms.
    column : str
        A column of the table, see `QUANTITIES`.
    descriptor_seeds : int
        Seeds of which only the long waves are looked at.
    """
    pixels, tolerance = settings.pixels_per_wavelength, settings.tolerance
    where = laws, surface, pressure, column
    seeds = settings.seeds, settings.coarse_seeds
    variance = mean_variance(*where, pixels, descriptor_seeds, *seeds)
    grid, solver = fixed_errors(*where, pixels, tolerance)
    return {
        "discretisation": grid,
        "solver": solver,
        "sampling": COVERS * float(np.sqrt(variance)),
    }


def predicted_error(
    laws: Laws,
    settings: Settings,
    surface: Surface,
    pressure: float,
    column: str,
    descriptor_seeds: int = 2048,
) -> float:
    """Relative error that covers 90 % of means: `error_parts` in quadrature."""
    parts = error_parts(laws, settings, surface, pressure, column, descriptor_seeds)
    return math.hypot(*parts.values())


def joint_error(errors: ArrayLike) -> NDArray:
    """Relative error that covers 90 % of the worst of several, which are along the first axis.

    Each of these is taken to be normal, and covers 90 % by itself. Their chances to be beyond the
    result add up with the power `TOGETHER`: a plain sum would hold if they excluded each other,
    their largest if all came together.
    """
    single = np.asarray(errors, float)
    low, high = np.ones((2, *single.shape[1:]))
    high *= -special.ndtri((1 - 0.9) / 2 / len(single)) / COVERS
    largest = single.max(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(largest > 0, COVERS / math.sqrt(2) * largest / single, np.inf)
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2
        beyond = np.sum(special.erfc(middle * share) ** TOGETHER, axis=0) > 0.1**TOGETHER
        low, high = np.where(beyond, middle, low), np.where(beyond, high, middle)
    return SAFETY * high * largest


def fixed_errors(
    laws: Laws, surface: Surface, pressure: float, column: str, pixels: float, tolerance: float
) -> tuple[float, float]:
    """Return the errors by discretisation and solver, which more seeds do not reduce."""
    where = column, surface, pressure
    return (
        single_error(laws, "discretisation", *where, pixels=pixels),
        single_error(laws, "solver", *where, tolerance=tolerance),
    )


def covering_factor(
    laws: Laws,
    settings: Settings,
    surface: Surface,
    pressure: float,
    column: str,
    descriptor_seeds: int = 2048,
) -> float:
    """Return how many standard errors, themselves of the seeds at hand, cover 90 % of means.

    Student's t: with n - 1 degrees of freedom for plain means, with those of Welch and
    Satterthwaite for multilevel ones, the share of each level in the variance being that of the
    laws. NaN for a single seed, whose standard error is unknown.
    """
    if settings.seeds < 2:
        return math.nan
    numbers = descriptor_seeds, settings.seeds, settings.coarse_seeds
    where = laws, surface, pressure, column, settings.pixels_per_wavelength
    return float(covers(degrees_of_freedom(*where, *numbers)))


def covers(freedom: ArrayLike) -> NDArray:
    """Return how many standard errors with so many degrees of freedom cover 90 %."""
    return special.stdtrit(freedom, _QUANTILE)


def degrees_of_freedom(
    laws: Laws,
    surface: Surface,
    pressure: float,
    column: str,
    pixels: float,
    described: int,
    seeds: ArrayLike,
    coarse_seeds: ArrayLike,
) -> NDArray:
    """Return the degrees of freedom of a standard error; the seeds may be arrays that broadcast.

    One less than the seeds of plain means; those of Welch and Satterthwaite for multilevel ones.
    """
    seeds, several = np.asarray(seeds), np.maximum(coarse_seeds, 2)
    shares = _level_shares(laws, surface, pressure, column, pixels)
    levels = [
        (share**2 / n, n - 1) for share, n in zip(shares, (seeds, several, described), strict=True)
    ]
    total = sum(part for part, _ in levels) ** 2
    welch = total / sum(part**2 / freedom for part, freedom in levels)
    return np.where(np.equal(coarse_seeds, 0), seeds - 1, welch)


def students_t(seeds: int) -> float:
    """Return how many standard errors cover 90 % of plain means; NaN for a single seed."""
    return float(covers(seeds - 1)) if seeds > 1 else math.nan


def _level_shares(laws, surface, pressure, column, pixels):
    """Standard deviation left at the fine, coarse and described level, over that of one seed."""
    surface, pressure, _ = measured(surface, pressure)
    coarse = min(laws["coarse_share", column](surface, pressure), 1.0)
    fine = laws["fine_share", column](surface, pressure, pixels)
    return fine, coarse, math.sqrt(1 - coarse**2)


def mean_variance(
    laws: Laws,
    surface: Surface,
    pressure: float,
    column: str,
    pixels: float,
    described: int,
    seeds: ArrayLike,
    coarse_seeds: ArrayLike,
) -> NDArray:
    """Return the relative variance of a mean; the numbers of seeds may be arrays that broadcast."""
    fine, coarse, long = _level_shares(laws, surface, pressure, column, pixels)
    several = np.maximum(coarse_seeds, 1)
    multilevel = fine**2 / seeds + coarse**2 / several + long**2 / described
    surface, pressure, factor = measured(surface, pressure)
    scatter = laws["scatter", column](surface, pressure)
    return (factor * scatter) ** 2 * np.where(
        np.equal(coarse_seeds, 0), 1 / np.asarray(seeds), multilevel
    )


def predicted_cost(
    laws: Laws,
    settings: Settings,
    surface: Surface,
    pressures: Sequence[float],
    descriptor_seeds: int = 2048,
) -> float:
    """Cost of a case in pairs of Fourier transforms of 1024 x 1024 doubles.

    With the coarser grids on which every realisation is solved too.
    """
    seeds = settings.seeds, settings.coarse_seeds
    return float(costs_of_seeds(laws, settings, surface, len(pressures), descriptor_seeds, *seeds))


def costs_of_seeds(
    laws: Laws,
    settings: Settings,
    surface: Surface,
    loads: int,
    described: int,
    seeds: ArrayLike,
    coarse_seeds: ArrayLike,
) -> NDArray:
    """Return the costs of numbers of seeds, arrays that broadcast, on the grid of some settings."""
    pixels, tolerance = settings.pixels_per_wavelength, settings.tolerance
    saved = loads * laws["tolerance_cost", ""](surface, tolerance=tolerance / FULL)
    grids = {pixels, pixels // 2, COARSE}
    one = saved * sum(laws["fine_cost", ""](surface, pixels=grid) for grid in grids)
    many = saved * laws["coarse_cost", ""](surface) * np.asarray(coarse_seeds)
    fixed = described * laws["described_cost", ""](surface)
    return one * np.asarray(seeds) + np.where(np.equal(coarse_seeds, 0), 0.0, many + fixed)


def worst_error(
    laws: Laws,
    settings: Settings,
    surface: Surface,
    pressures: Iterable[float],
    quantities: Iterable[str],
    descriptor_seeds: int = 2048,
) -> tuple[float, str, float]:
    """Error of the worst of the quantities wanted; column and pressure of the largest."""
    errors = {
        (column, pressure): predicted_error(
            laws, settings, surface, pressure, column, descriptor_seeds
        )
        for pressure in pressures
        for quantity in quantities
        for column in QUANTITIES[quantity]
    }
    return float(joint_error(list(errors.values()))), *max(errors, key=errors.get)


def cheapest(
    laws: Laws,
    accuracy: float,
    surface: Surface,
    pressures: Sequence[float],
    quantities: Iterable[str],
    *,
    descriptor_seeds: int = 2048,
    most_points: int = 2048,
    plain: bool | None = None,
    least: Settings | None = None,
) -> Settings:
    """Return the cheapest settings predicted to reach an accuracy for all quantities wanted.

    Of those that cost within 5 % of the cheapest, the most accurate.

    Parameters
    ----------
    accuracy : float
        Relative error that is to cover 90 % at every pressure.
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
    quantities, waves = list(quantities), surface.magnification * surface.window
    least = least or Settings(PIXELS[0], TOLERANCES[0], SEEDS[0], COARSE_SEEDS[0])
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
        errors = _worst_errors(
            laws, surface, pressures, quantities, pixels, tolerance, descriptor_seeds, seeds, coarse
        )
        costs = costs_of_seeds(
            laws,
            Settings(pixels, tolerance, 0, 0),
            surface,
            len(pressures),
            descriptor_seeds,
            seeds,
            coarse,
        )
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
    error, column, pressure = worst_error(
        laws, best, surface, pressures, quantities, descriptor_seeds
    )
    raise UnreachableError(
        f"the best that {best.seeds} seeds on {best.pixels_per_wavelength} points per shortest "
        f"wavelength reach is {error:.2g}, for {column} at pressure {pressure:g}"
    )


def _worst_errors(
    laws, surface, pressures, quantities, pixels, tolerance, described, seeds, coarse
) -> NDArray:
    """Largest predicted error on one grid for all numbers of seeds."""
    errors = []
    for pressure in pressures:
        for column in itertools.chain(*(QUANTITIES[quantity] for quantity in quantities)):
            where = laws, surface, pressure, column
            fixed = math.hypot(*fixed_errors(*where, pixels, tolerance))
            variance = mean_variance(*where, pixels, described, seeds, coarse)
            errors.append(np.sqrt(fixed**2 + COVERS**2 * variance))
    return joint_error(errors)


def _law(row: Mapping[str, str]) -> Law:
    return Law(**{name: float(value) for name, value in row.items()})
