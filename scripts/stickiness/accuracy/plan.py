"""The settings of each case of the configuration, and which cases share their solutions."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from stickiness.accuracy.error_models import ErrorModels, Settings, Surface
from stickiness.accuracy.quantities import MEASURED, MODELLED, columns_of, means_of
from stickiness.accuracy.settings import (
    Problem,
    UnreachableError,
    allow_for_few_seeds,
    cheapest,
)

FEWEST_COARSE = 64  #: coarse seeds if nothing says how many
FIRST_FILE = 64  #: coarse seeds in the first file of a case
SEEDS_A_FILE = 8  #: fine seeds: few enough to spread over cores, enough to outweigh a start


@dataclass(frozen=True)
class Plan:
    """How one case is solved."""

    settings: Settings
    quantities: tuple[str, ...]
    pressures: tuple[float, ...]  #: ascending
    surface: str  #: name of the model surface
    simulated: bool  #: false if the case takes Persson's theory alone
    #: Case whose solutions of single realisations are used: the case itself, or an earlier one on
    #: the same surface with the same settings and all its loads.
    solved_by: str

    @property
    def grid(self) -> tuple[str, int]:
        """Model surface, and grid points per shortest wavelength."""
        return self.surface, self.settings.pixels_per_wavelength

    @property
    def gaps(self) -> bool:
        """Whether attractive areas are needed, which take longer to evaluate than area and gap."""
        return "attractive_area" in means_of(self.quantities)

    @property
    def measured(self) -> tuple[str, ...]:
        """Quantities that are measured on every solution."""
        return tuple(name for name in self.quantities if name in MEASURED)

    @property
    def complete(self) -> bool:
        """Whether the case is simulated and has what figures and report need."""
        return self.simulated and set(self.quantities) >= set(MODELLED)


def plans_of(config: Mapping[str, Any], models: ErrorModels) -> dict[str, Plan]:
    """Return the plan of every case of a checked configuration; a ValueError names a case in it."""
    plans: dict[str, Plan] = {}
    on_grid: dict[tuple[str, int], list[Plan]] = defaultdict(list)  # plans that solve, by grid
    for name, case in config["cases"].items():
        quantities = tuple(case["quantities"])
        simulated = case["model"] == "simulation"
        for quantity in set(quantities) & set(MEASURED):
            key = f"cases.{name}.quantities"
            if not simulated:
                raise ValueError(
                    f"{key}: theory does not give {quantity}; simulate it, or leave it out"
                )
            if case["accuracy"] is not None:
                raise ValueError(
                    f"{key}: the errors of {quantity} were not measured, so that no accuracy can "
                    "be promised; give seeds in place of accuracy, or leave it out"
                )
        plan = Plan(
            settings=settings_of(name, config, models),
            quantities=quantities,
            pressures=tuple(sorted(case["pressures"])),
            surface=case["surface"],
            simulated=simulated,
            solved_by=name,
        )
        neighbours = on_grid[plan.grid]
        earlier = (other.solved_by for other in neighbours if can_reuse(plan, other))
        plans[name] = replace(plan, solved_by=next(earlier, name))
        # A plan that uses the solutions of another has none to offer that the other lacks.
        if plans[name].solved_by == name:
            neighbours.append(plans[name])
    return plans


def settings_of(name: str, config: Mapping[str, Any], models: ErrorModels) -> Settings:
    """Return the settings of a case: the cheapest for its accuracy, or those of the preset."""
    case = config["cases"][name]
    sampling = config["sampling"]
    plain = (case["sampling"] or sampling["method"]) == "plain"
    if case["accuracy"] is None:
        chosen = preset(config["fidelities"][config["fidelity"]])
        seeds = case["seeds"] or config["seeds"] or chosen.seeds
        return replace(chosen, seeds=seeds, coarse_seeds=0 if plain else chosen.coarse_seeds)
    problem = Problem(
        models=models,
        surface=Surface.of(config["model_surfaces"][case["surface"]]),
        pressures=sorted(case["pressures"]),
        columns=columns_of(case["quantities"]),
        descriptor_seeds=sampling["descriptor_seeds"],
    )
    accuracy = case["accuracy"]
    try:
        chosen = cheapest(problem, accuracy, plain=plain)
    except UnreachableError as error:
        raise UnreachableError(
            f"cases.{name}.accuracy = {accuracy!r} is out of reach: {error}"
        ) from None
    chosen = allow_for_few_seeds(problem, chosen, accuracy)
    at_most = case["at_most"] or sampling["at_most"]
    return replace(chosen, seeds=case["seeds"] or min(chosen.seeds, at_most))


def preset(fidelity: Mapping[str, Any]) -> Settings:
    """Return the settings of a preset of the configuration."""
    return Settings(
        pixels_per_wavelength=fidelity["pixels_per_wavelength"],
        tolerance=fidelity["tolerance"],
        seeds=fidelity["seeds"],
        coarse_seeds=fidelity["coarse_seeds"],
    )


def can_reuse(plan: Plan, other: Plan) -> bool:
    """Whether a plan can use the realisations that another one solves."""
    # The numbers of seeds may differ.
    return (
        plan.grid == other.grid
        and plan.settings.tolerance == other.settings.tolerance
        and plan.simulated
        and other.simulated
        and set(plan.pressures) <= set(other.pressures)
        and other.gaps >= plan.gaps
        and set(plan.measured) <= set(other.measured)
    )


def most_seeds(plans: Mapping[str, Plan]) -> dict[tuple[str, int], int]:
    """Return the largest number of fine seeds that simulated cases want on each `Plan.grid`."""
    most: dict[tuple[str, int], int] = {}
    for plan in plans.values():
        if plan.simulated:
            most[plan.grid] = max(most.get(plan.grid, 1), plan.settings.seeds)
    return most


def coarse_batches(count: int) -> list[str]:
    """Return the names of the files of so many coarse seeds: the first and the last of each.

    Files end at the same seeds whatever the number, but for the last: a case that asks for more
    keeps what is solved. 160 seeds are in '1-64', '65-128' and '129-160'.
    """
    last = 0
    parts = []
    while last < count:
        first = last + 1
        last = min(max(2 * last, FIRST_FILE), count)
        parts.append(f"{first}-{last}")
    return parts


def seed_batches(count: int) -> list[str]:
    """Return the names of the files of so many fine seeds: '1-8' and '9-9' of nine."""
    firsts = range(1, count + 1, SEEDS_A_FILE)
    return [f"{first}-{min(first + SEEDS_A_FILE - 1, count)}" for first in firsts]


def batches_covering(count: int, among: int) -> list[str]:
    """Return the files that hold so many fine seeds, those of `among` seeds where they do."""
    return [part for part in seed_batches(max(count, among)) if seeds_in(part)[0] <= count]


def seeds_in(part: str) -> list[int]:
    """Return the seeds of a file by its name, numbered from 1."""
    first, last = map(int, part.split("-"))
    return list(range(first, last + 1))
