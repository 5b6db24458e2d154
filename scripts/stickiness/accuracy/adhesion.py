"""Settings that full adhesion needs for an accuracy, from what was measured.

Full adhesion is solved on the realisations of a case and with their grid, to a tolerance of its
own. What its quantities err by follows from laws of the same kind as those of `accuracy` and by the
same sum. Means have the DMT limit of the coarse seeds as their control, from `FEWEST` seeds on;
below they are plain. A pull-off is that of one realisation, no mean: its grid alone counts.
"""

from __future__ import annotations

import itertools
from bisect import bisect_left
from collections.abc import Iterable, Sequence
from dataclasses import replace

from stickiness.accuracy import error_laws
from stickiness.accuracy.error_laws import (
    COARSE_SEEDS,
    PIXELS,
    SEEDS,
    TOLERANCES,
    Laws,
    Settings,
    Surface,
)

QUANTITIES = {
    "inverse_kappa_ad": ("inverse_kappa_ad_0.0075", "inverse_kappa_ad_0.1", "inverse_kappa_ad_1"),
    "threshold": ("threshold",),
    "pull_off": ("pull_off",),
}
COLUMNS = tuple(itertools.chain(*QUANTITIES.values()))
TOLERANCE = 1e-7  # of the solver of full adhesion, whatever that of the settings
PULL_OFF_UP_TO = 32  # magnification to which pull-offs were measured
FEWEST = 8  # seeds from which on a mean has a control


def predicted_error(
    laws: Laws,
    settings: Settings,
    surface: Surface,
    pressure: float,
    column: str,
    descriptor_seeds: int = 2048,
) -> float:
    """Return the relative error of one of `COLUMNS` that covers 90 %.

    Arguments are those of `error_laws.predicted_error`.
    """
    if column == "pull_off":
        # It falls so steeply that the law would promise too much beyond what was measured.
        nearest = min(surface.magnification, PULL_OFF_UP_TO)
        surface = replace(surface, magnification=nearest)
        grid = {"pixels": settings.pixels_per_wavelength}
        return error_laws.single_error(laws, "discretisation", column, surface, pressure, **grid)
    coarse = settings.coarse_seeds if settings.seeds >= FEWEST else 0
    settings = replace(settings, tolerance=TOLERANCE, coarse_seeds=coarse)
    return error_laws.predicted_error(laws, settings, surface, pressure, column, descriptor_seeds)


def worst_error(
    laws: Laws,
    settings: Settings,
    surface: Surface,
    pressures: Sequence[float],
    quantities: Iterable[str],
    descriptor_seeds: int = 2048,
) -> tuple[float, str, float]:
    """Return the largest predicted error of some of `QUANTITIES`; its column and pressure."""
    columns = itertools.chain(*(QUANTITIES[quantity] for quantity in quantities))
    return max(
        (
            predicted_error(laws, settings, surface, pressure, column, descriptor_seeds),
            column,
            pressure,
        )
        for pressure, column in itertools.product(pressures, columns)
    )


def predicted_cost(laws: Laws, settings: Settings, surface: Surface) -> float:
    """Return the cost of one adhesive state of every seed, both its grids, and coarse seeds.

    In pairs of Fourier transforms of 1024 x 1024 doubles.
    """
    pixels = settings.pixels_per_wavelength
    state = sum(laws["adhesive_cost", ""](surface, pixels=grid) for grid in (pixels, pixels // 2))
    return settings.seeds * state + settings.coarse_seeds * laws["coarse_cost", ""](surface)


def least(
    laws: Laws,
    error: float,
    surface: Surface,
    pressures: Sequence[float],
    quantities: Iterable[str],
    descriptor_seeds: int = 2048,
) -> Settings:
    """Return the cheapest settings whose predicted error in all quantities wanted is below one.

    Raises
    ------
    accuracy.UnreachableError
        Saying what could be reached, for which quantity and at which pressure.
    """
    where = surface, pressures, list(quantities), descriptor_seeds

    def reached(settings: Settings) -> bool:
        return worst_error(laws, settings, *where)[0] <= error

    found = []
    for pixels, coarse in itertools.product(PIXELS, COARSE_SEEDS):
        chosen = [Settings(pixels, TOLERANCES[0], seeds, coarse) for seeds in SEEDS]
        if reached(chosen[-1]):
            enough = chosen[bisect_left(chosen, True, key=reached)]
            found.append((predicted_cost(laws, enough, surface), enough))
    if found:
        return min(found)[1]
    best = Settings(PIXELS[-1], TOLERANCES[0], SEEDS[-1], COARSE_SEEDS[-1])
    left, column, pressure = worst_error(laws, best, *where)
    raise error_laws.UnreachableError(
        f"the best that full adhesion reaches is {left:.2g}, for {column} at pressure {pressure:g}"
    )
