"""Presets: the cheapest settings for an error in every quantity, those of full adhesion too.

Full adhesion is solved on the realisations of a case and on their grid, to a tolerance of its own.
From `FEWEST` seeds on, its means use the DMT limit of the coarse seeds as their control; with fewer
they are plain. A pull-off is a result of one realisation, not a mean: only its grid matters.
"""

import itertools
from dataclasses import replace

from common.tradeoff_table import percent
from stickiness.accuracy.error_models import Settings, Surface, single_error
from stickiness.accuracy.plan import preset
from stickiness.accuracy.quantities import MODELLED, columns_of
from stickiness.accuracy.settings import (
    COARSE_SEEDS,
    LEAST,
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
ADHESIVE_COLUMNS = tuple(itertools.chain(*ADHESIVE_QUANTITIES.values()))
ADHESIVE_TOLERANCE = 1e-7  # of the solver of full adhesion, whatever the settings say
PULL_OFF_UP_TO = 32  # magnification to which pull-offs were measured
FEWEST = 8  # seeds from which on a mean of adhesive contact has a control


def adhesive_error(problem, settings, pressure, column):
    """Relative error of one of `ADHESIVE_COLUMNS` that covers 90 %."""
    if column == "pull_off":
        # It falls so steeply that the model would promise too much beyond what was measured.
        nearest = min(problem.surface.magnification, PULL_OFF_UP_TO)
        surface = replace(problem.surface, magnification=nearest)
        at = problem.models, "discretisation", column, surface, pressure
        return single_error(*at, pixels=settings.pixels_per_wavelength)
    coarse = settings.coarse_seeds if settings.seeds >= FEWEST else 0
    settings = replace(settings, tolerance=ADHESIVE_TOLERANCE, coarse_seeds=coarse)
    return float(predicted_error(problem, settings, pressure, column))


def worst_adhesive_error(problem, settings):
    """Largest error of full adhesion, its column and pressure."""
    return max((adhesive_error(problem, settings, *at), *at[::-1]) for at in problem.points)


def adhesive_cost(problem, settings):
    """Cost of one adhesive state of every seed on two grids, and of the coarse seeds."""
    models, surface, pixels = problem.models, problem.surface, settings.pixels_per_wavelength
    state = sum(models["adhesive_cost", ""](surface, pixels=grid) for grid in (pixels, pixels // 2))
    return settings.seeds * state + settings.coarse_seeds * models["coarse_cost", ""](surface)


def cheapest_adhesive(problem, accuracy):
    """Cheapest settings for an accuracy in all columns of full adhesion."""
    every = itertools.product(PIXELS, TOLERANCES[:1], SEEDS, COARSE_SEEDS)
    found = [
        (adhesive_cost(problem, settings), settings)
        for settings in itertools.starmap(Settings, every)
        if worst_adhesive_error(problem, settings)[0] <= accuracy
    ]
    if found:
        return min(found)[1]
    best = Settings(PIXELS[-1], TOLERANCES[0], SEEDS[-1], COARSE_SEEDS[-1])
    left, column, pressure = worst_adhesive_error(problem, best)
    raise UnreachableError(
        f"the best that full adhesion reaches is {left:.2g}, for {column} at pressure {pressure:g}"
    )


def preset_by_rule(models, asked, name, surface, descriptor_seeds, free=False):
    """Cheapest settings for the error of a preset; `free` of the quantities of full adhesion."""
    where, least = (models, Surface.of(surface), asked["pressures"]), LEAST
    if not free:
        wanted = asked["adhesive"]
        columns = list(itertools.chain(*(ADHESIVE_QUANTITIES[q] for q in wanted["quantities"])))
        adhesion = Problem(*where, columns, descriptor_seeds)
        least = cheapest_adhesive(adhesion, wanted["accuracy"][name])
    problem = Problem(*where, columns_of(MODELLED), descriptor_seeds)
    return cheapest(problem, asked["accuracy"][name], plain=False, least=least)


def list_presets(models, presets, surface, fidelities, descriptor_seeds):
    """Table of the presets by the rule and of those of the configuration, with their errors."""
    where = models, Surface.of(surface), presets["pressures"]
    contact = Problem(*where, columns_of(MODELLED), descriptor_seeds)
    adhesion = Problem(*where, ADHESIVE_COLUMNS, descriptor_seeds)

    def describe(text, chosen):
        errors = [
            max(error(problem, chosen, p, column) for p in problem.pressures)
            for error, problem in ((predicted_error, contact), (adhesive_error, adhesion))
            for column in problem.columns
        ]
        costs = predicted_cost(contact, chosen), adhesive_cost(adhesion, chosen)
        pixels, tolerance, seeds, coarse = vars(chosen).values()
        settings = [pixels, f"{tolerance:.0e}", seeds, coarse, *(f"{cost:.0f}" for cost in costs)]
        return [text, *settings, *map(percent, errors)]

    settings = "preset", "pixels", "tolerance", "seeds", "coarse seeds", "cost", "adhesive cost"
    head, lines = [*settings, *contact.columns, *adhesion.columns], []
    for name, error in presets["accuracy"].items():
        for text, free in ((f"{name}: below {error:.0%}", False), ("without full adhesion", True)):
            by_rule = models, presets, name, surface, descriptor_seeds, free
            try:
                lines.append(describe(text, preset_by_rule(*by_rule)))
            except UnreachableError as refusal:
                reached = str(refusal).split(";")[0]
                lines.append([f"{text}: out of reach, {reached}", *[""] * (len(head) - 1)])
        lines.append(describe("in the configuration", preset(fidelities[name])))
    return {"asked": presets, "head": head, "lines": lines}
