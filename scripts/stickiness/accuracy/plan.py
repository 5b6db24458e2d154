"""What each case of the configuration is solved with, and which cases share their solutions."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from stickiness.accuracy import adhesion
from stickiness.accuracy.choice import (
    SEEDS,
    UnreachableError,
    allow_for_few_seeds,
    cheapest,
)
from stickiness.accuracy.error_models import ErrorModels, Settings, Surface
from stickiness.accuracy.extrapolation import left_to_simulation
from stickiness.accuracy.prediction import Problem
from stickiness.accuracy.quantities import (
    MEASURED,
    MODELLED,
    QUANTITIES,
    columns_of,
    refuse_unknown,
)

FEWEST_COARSE = 64  #: coarse seeds if nothing says how many
FIRST_FILE = 64  #: coarse seeds in the first file of a case
SEEDS_A_FILE = 4  #: fine seeds: few enough to spread over cores, enough to outweigh a start


@dataclass(frozen=True)
class Plan:
    """How one case is solved."""

    settings: Settings
    quantities: tuple[str, ...]  #: what is wanted, of `quantities.QUANTITIES`
    pressures: tuple[float, ...]  #: ascending
    surface: str  #: name of the model surface
    simulated: bool  #: false if theory alone is asked for
    #: Case whose solutions of single realisations are used: the case itself or an earlier one on
    #: the same surface and settings that has all its loads.
    owner: str

    @property
    def gaps(self) -> bool:
        """Whether attractive areas at given ranges are needed."""
        return any(QUANTITIES[name].needs_gaps for name in self.quantities)

    @property
    def measured(self) -> tuple[str, ...]:
        """Quantities that are measured on every solution because the case asks for them."""
        return tuple(name for name in self.quantities if name in MEASURED)

    @property
    def complete(self) -> bool:
        """Whether the case is simulated and holds what figures and report need."""
        return self.simulated and set(self.quantities) >= set(MODELLED)


def plans_of(config: Mapping[str, Any], models: ErrorModels) -> dict[str, Plan]:
    """Return the plan of every case of a checked configuration.

    Raises
    ------
    UnreachableError
        If a case asks for more than any settings are predicted to reach; names the case.
    ValueError
        If theory or error models do not know a quantity that a case asks them for.
    """
    plans: dict[str, Plan] = {}
    for name, case in config["cases"].items():
        quantities = tuple(case.get("quantities", MODELLED))
        simulated = case.get("model", "simulation") == "simulation"
        refuse_unknown(
            quantities,
            f"cases.{name}.quantities",
            by_theory=not simulated or "carry_to" in case,
            within_accuracy="accuracy" in case,
        )
        settings, pressures = settings_of(name, config, models), tuple(sorted(case["pressures"]))
        own = Plan(settings, quantities, pressures, case["surface"], simulated, name)
        owner = next((key for key, plan in plans.items() if shares(plan, own)), name)
        plans[name] = replace(own, owner=owner)
    return plans


def settings_of(name: str, config: Mapping[str, Any], models: ErrorModels) -> Settings:
    """Return the settings of a case: the cheapest for its accuracy, or those of the preset.

    `sampling` stands above both, and so do `seeds` of the case. `seeds` of the whole configuration
    stand above the preset.
    """
    case = config["cases"][name]
    if "accuracy" in case:
        chosen = cheapest_for(name, config, models)
        at_most = case.get("at_most", config["sampling"].get("at_most", SEEDS[-1]))
        return replace(chosen, seeds=case.get("seeds", min(chosen.seeds, at_most)))
    chosen = preset(config["fidelities"][config["fidelity"]])
    seeds = case.get("seeds", config.get("seeds", chosen.seeds))
    coarse = 0 if plain(case, config) else chosen.coarse_seeds
    return replace(chosen, seeds=seeds, coarse_seeds=coarse)


def plain(case: Mapping[str, Any], config: Mapping[str, Any]) -> bool:
    """Whether a case takes plain means."""
    return case.get("sampling", config["sampling"]["method"]) == "plain"


def preset(fidelity: Mapping[str, Any]) -> Settings:
    """Return the settings of a preset of the configuration."""
    chosen = (fidelity[key] for key in ("pixels_per_wavelength", "tolerance", "seeds"))
    return Settings(*chosen, fidelity.get("coarse_seeds", FEWEST_COARSE))


def cheapest_for(name: str, config: Mapping[str, Any], models: ErrorModels) -> Settings:
    """Return the settings predicted to be the cheapest for the accuracy that a case asks for."""
    case = config["cases"][name]
    problem = Problem(
        models,
        Surface.of(config["model_surfaces"][case["surface"]]),
        sorted(case["pressures"]),
        columns_of(case.get("quantities", MODELLED)),
        config["sampling"]["descriptor_seeds"],
    )
    refused, accuracy = f"cases.{name}.accuracy = {case['accuracy']!r} is out of reach: ", None
    if "carry_to" in case:
        accuracy = left_to_simulation(problem, case["accuracy"], case["carry_to"])
        if accuracy <= 0:
            raise UnreachableError(
                f"{refused}the error of theory's extrapolation to magnification "
                f"{case['carry_to']:g} is larger; ask for less accuracy, a smaller carry_to, or "
                "simulate a larger magnification"
            )
        refused += f"extrapolated by theory, the simulation has to reach {accuracy:.2g}, and "
    try:
        only_plain = True if plain(case, config) else None
        wanted = accuracy or case["accuracy"]
        return allow_for_few_seeds(problem, cheapest(problem, wanted, plain=only_plain), wanted)
    except UnreachableError as error:
        raise UnreachableError(f"{refused}{error}; {error.remedy}") from None


def preset_by_rule(
    models: ErrorModels,
    asked: Mapping[str, Any],
    name: str,
    surface: Mapping[str, Any],
    descriptor_seeds: int,
    free: bool = False,
) -> Settings:
    """Return the cheapest settings for the error of a preset in every quantity, adhesive ones too.

    `asked` is what the configuration says under ``tradeoff.presets``, `surface` the model surface
    that it names. `free` leaves aside the quantities of full adhesion, on the same realisations.
    """
    where, least = (models, Surface.of(surface), asked["pressures"]), None
    if not free:
        wanted = asked["adhesive"]
        columns = tuple(itertools.chain(*(adhesion.QUANTITIES[q] for q in wanted["quantities"])))
        least = adhesion.cheapest(
            Problem(*where, columns, descriptor_seeds), wanted["accuracy"][name]
        )
    problem = Problem(*where, columns_of(MODELLED), descriptor_seeds)
    return cheapest(problem, asked["accuracy"][name], plain=False, least=least)


def shares(plan: Plan, own: Plan) -> bool:
    """Whether the realisations that one plan solves hold those of another."""
    return (
        (plan.surface, *grid(plan)) == (own.surface, *grid(own))
        and plan.simulated
        and own.simulated
        and set(own.pressures) <= set(plan.pressures)
        and plan.gaps >= own.gaps
        and set(own.measured) <= set(plan.measured)
    )


def grid(plan: Plan) -> tuple[int, float]:
    """Return the settings that a single solution depends on."""
    return plan.settings.pixels_per_wavelength, plan.settings.tolerance


def coarse_parts(count: int) -> list[str]:
    """Return the names of the files of so many coarse seeds: the first and the last of each.

    Files end at the same seeds whatever the number, but for the last: a case that asks for more
    keeps what is solved. The first has `FIRST_FILE` seeds, and each doubles their number.

    Examples
    --------
    >>> coarse_parts(160)
    ['1-64', '65-128', '129-160']
    """
    last, parts = 0, []
    while last < count:
        first, last = last + 1, min(max(2 * last, FIRST_FILE), count)
        parts.append(f"{first}-{last}")
    return parts


def seed_parts(count: int) -> list[str]:
    """Return the names of the files of so many fine seeds, `SEEDS_A_FILE` in each but the last.

    Examples
    --------
    >>> seed_parts(9)
    ['1-4', '5-8', '9-9']
    """
    firsts = range(1, count + 1, SEEDS_A_FILE)
    return [f"{first}-{min(first + SEEDS_A_FILE - 1, count)}" for first in firsts]


def covering_parts(count: int, among: int) -> list[str]:
    """Return the files that hold so many fine seeds, those of `among` seeds where they do.

    Examples
    --------
    >>> covering_parts(6, among=8), covering_parts(6, among=3)
    (['1-4', '5-8'], ['1-4', '5-6'])
    """
    return [part for part in seed_parts(max(count, among)) if seeds_in(part)[0] <= count]


def seeds_in(part: str) -> list[int]:
    """Return the seeds of a file by its name, numbered from 1."""
    first, last = map(int, part.split("-"))
    return list(range(first, last + 1))


def coarse_range(part: str) -> range:
    """Return the coarse seeds of a file, numbered from 0."""
    return range(seeds_in(part)[0] - 1, seeds_in(part)[-1])
