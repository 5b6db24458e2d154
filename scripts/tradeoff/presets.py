"""Presets: the cheapest settings for an error in every quantity, those of full adhesion too.

Full adhesion is solved on the realisations of a case and on their grid, to a tolerance of its own.
The rule takes all of them to be on the whole grid; sets solve half of the seeds there.
From `FEWEST` seeds on, the slope against the DMT sum of the coarse seeds corrects its means; what
the ratio gains with fewer is not counted. A pull-off is a result of one realisation, not a mean:
only its grid matters.
"""

import itertools
from dataclasses import replace

from common.adhesion_sets import LOOSEST
from common.ensemble_means import FEWEST
from stickiness.accuracy.error_models import Settings, Surface, single_error
from stickiness.accuracy.quantities import MODELLED, columns_of
from stickiness.accuracy.settings import (
    COARSE_SEEDS,
    PIXELS,
    SEEDS,
    TOLERANCES,
    Problem,
    UnreachableError,
    cheapest,
    predicted_cost,
    predicted_error,
)

ADHESIVE_QUANTITIES = {
    "inverse_kappa_ad": ("inverse_kappa_ad_0.0075", "inverse_kappa_ad_0.1", "inverse_kappa_ad_1"),
    "threshold": ("threshold",),
    "pull_off": ("pull_off",),
}


def adhesive_error(problem, settings, pressure, column):
    """Relative error of a column of full adhesion that covers 90 %."""
    pull_off_up_to = 32  # magnification to which pull-offs were measured
    if column == "pull_off":
        # It falls so steeply that the model would promise too much beyond what was measured.
        nearest = min(problem.surface.magnification, pull_off_up_to)
        surface = replace(problem.surface, magnification=nearest)
        pixels = settings.pixels_per_wavelength
        return single_error(
            problem.models, "discretisation", column, surface, pressure, pixels=pixels
        )
    coarse = settings.coarse_seeds if settings.seeds >= FEWEST else 0
    settings = replace(settings, tolerance=LOOSEST, coarse_seeds=coarse)
    return float(predicted_error(problem, settings, pressure, column))


def adhesive_cost(problem, settings):
    """Cost of one adhesive state of every seed on two grids, and of the coarse seeds."""
    models = problem.models
    surface = problem.surface
    pixels = settings.pixels_per_wavelength
    state = sum(models["adhesive_cost", ""](surface, pixels=grid) for grid in (pixels, pixels // 2))
    return settings.seeds * state + settings.coarse_seeds * models["coarse_cost", ""](surface)


def cheapest_adhesive(problem, accuracy):
    """Cheapest settings for an accuracy in all columns of full adhesion."""
    candidates = []
    knobs = itertools.product(PIXELS, TOLERANCES[:1], SEEDS, COARSE_SEEDS)
    for pixels, tolerance, seeds, coarse_seeds in knobs:
        settings = Settings(pixels, tolerance, seeds, coarse_seeds)
        worst, column, pressure = max(
            (adhesive_error(problem, settings, pressure, column), column, pressure)
            for pressure, column in problem.points
        )
        if worst <= accuracy:
            candidates.append((adhesive_cost(problem, settings), settings))
    if candidates:
        return min(candidates)[1]
    # What is left with the last settings, which are the most expensive.
    raise UnreachableError(
        f"the best that full adhesion reaches is {worst:.2g}, for {column} at pressure {pressure:g}"
    )


def preset_by_rule(problem, presets, name):
    """Cheapest multilevel settings for the errors of a preset, those of full adhesion included."""
    adhesive = presets["adhesive"]
    contact = replace(problem, columns=columns_of(MODELLED))
    columns = [
        column for quantity in adhesive["quantities"] for column in ADHESIVE_QUANTITIES[quantity]
    ]
    least = cheapest_adhesive(replace(problem, columns=columns), adhesive["accuracy"][name])
    least = replace(least, coarse_seeds=max(least.coarse_seeds, COARSE_SEEDS[1]))
    return cheapest(contact, presets["accuracy"][name], least=least)


def list_presets(models, presets, surface, descriptor_seeds):
    """Lines of a table of presets: settings, cost of contact and of full adhesion, by the rule."""
    problem = Problem(models, Surface.of(surface), presets["pressures"], (), descriptor_seeds)
    lines = []
    for name in presets["accuracy"]:
        try:
            chosen = preset_by_rule(problem, presets, name)
        except UnreachableError as refusal:
            reason = f"{name}: out of reach, {str(refusal).split(';')[0]}"
            lines.append([reason, *[""] * 6])
            continue
        costs = predicted_cost(problem, chosen), adhesive_cost(problem, chosen)
        lines.append([name, *vars(chosen).values(), *(f"{cost:.0f}" for cost in costs)])
    return lines
