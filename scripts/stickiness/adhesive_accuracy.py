"""Settings that full adhesion needs for an accuracy, from what was measured.

Full adhesion is solved on the realisations of a case, with their grid and tolerance. What its
quantities err by follows from laws of the same kind as those of `accuracy` and by the same sum.
Means have the DMT limit of the coarse seeds as their control, from `FEWEST` seeds on; below they
are plain. A pull-off is that of one realisation, no mean: only grid and tolerance count. Adhesion too weak to
change the area by a few pixels (``inverse_kappa_ad_weak``) no grid here resolves; what the solver
adds to that is to be small all the same.
"""

from __future__ import annotations

import itertools
import math
from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import replace

from . import accuracy
from .accuracy import COARSE_SEEDS, FULL, PIXELS, SEEDS, TOLERANCES, Laws, Settings, Surface

QUANTITIES = {
    "inverse_kappa_ad": (
        "inverse_kappa_ad_0.0075",
        "inverse_kappa_ad_0.1",
        "inverse_kappa_ad_1",
        "inverse_kappa_ad_weak",
    ),
    "threshold": ("threshold",),
    "pull_off": ("pull_off",),
}
# Parts of the error that count, where it is not all of them.
PARTS = {"inverse_kappa_ad_weak": ("solver",), "pull_off": ("discretisation", "solver")}
COLUMNS = tuple(itertools.chain(*QUANTITIES.values()))
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

    Arguments are those of `accuracy.predicted_error`.
    """
    if column in PARTS:
        knobs = {
            "discretisation": {"pixels": settings.pixels_per_wavelength},
            "solver": {"tolerance": settings.tolerance},
        }
        return math.hypot(
            *(
                accuracy.single_error(laws, part, column, surface, pressure, **knobs[part])
                for part in PARTS[column]
            )
        )
    if settings.seeds < FEWEST:
        settings = replace(settings, coarse_seeds=0)
    return accuracy.predicted_error(laws, settings, surface, pressure, column, descriptor_seeds)


def worst_error(
    laws: Laws,
    settings: Settings,
    surface: Surface,
    pressures: Sequence[float],
    descriptor_seeds: int = 2048,
) -> tuple[float, str, float]:
    """Return the largest predicted error of all `COLUMNS`; its column and pressure."""
    return max(
        (
            predicted_error(laws, settings, surface, pressure, column, descriptor_seeds),
            column,
            pressure,
        )
        for pressure, column in itertools.product(pressures, COLUMNS)
    )


def predicted_cost(laws: Laws, settings: Settings, surface: Surface) -> float:
    """Return the cost of one adhesive state of every seed, both its grids, and coarse seeds.

    In pairs of Fourier transforms of 1024 x 1024 doubles.
    """
    pixels = settings.pixels_per_wavelength
    saved = laws["tolerance_cost", ""](surface, tolerance=settings.tolerance / FULL)
    state = sum(laws["adhesive_cost", ""](surface, pixels=grid) for grid in (pixels, pixels // 2))
    coarse = laws["coarse_cost", ""](surface)
    return saved * (settings.seeds * state + settings.coarse_seeds * coarse)


def least(
    laws: Laws,
    error: float,
    surface: Surface,
    pressures: Sequence[float],
    descriptor_seeds: int = 2048,
) -> Settings:
    """Return the cheapest settings whose predicted error in every adhesive quantity is below one.

    Raises
    ------
    accuracy.UnreachableError
        Saying what could be reached, for which quantity and at which pressure.
    """

    def reached(settings):
        return worst_error(laws, settings, surface, pressures, descriptor_seeds)[0] <= error

    found = []
    for pixels, tolerance, coarse in itertools.product(PIXELS, TOLERANCES, COARSE_SEEDS):
        chosen = [Settings(pixels, tolerance, seeds, coarse) for seeds in SEEDS]
        if reached(chosen[-1]):
            enough = chosen[bisect_left(chosen, True, key=reached)]
            found.append((predicted_cost(laws, enough, surface), enough))
    if found:
        return min(found)[1]
    best = Settings(PIXELS[-1], TOLERANCES[-1], SEEDS[-1], COARSE_SEEDS[-1])
    left, column, pressure = worst_error(laws, best, surface, pressures, descriptor_seeds)
    raise accuracy.UnreachableError(
        f"the best that full adhesion reaches is {left:.2g}, for {column} at pressure {pressure:g}"
    )
