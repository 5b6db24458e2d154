"""The settings of each case of the configuration."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from stickiness.accuracy.error_models import ErrorModels, Settings, Surface
from stickiness.accuracy.quantities import MEASURED, MODELLED, columns_of
from stickiness.accuracy.settings import (
    Problem,
    UnreachableError,
    allow_for_few_seeds,
    cheapest,
)

FEWEST_COARSE = 64  #: coarse seeds if nothing says how many


@dataclass(frozen=True)
class Plan:
    """How one case is solved."""

    settings: Settings
    quantities: tuple[str, ...]
    pressures: tuple[float, ...]  #: ascending
    surface: str  #: name of the model surface
    simulated: bool  #: false if the case takes Persson's theory alone

    @property
    def complete(self) -> bool:
        """Whether the case is simulated and has what figures and report need."""
        return self.simulated and set(self.quantities) >= set(MODELLED)


def plans_of(config: Mapping[str, Any], models: ErrorModels) -> dict[str, Plan]:
    """Return the plan of every case of a checked configuration; a ValueError names a case in it."""
    plans: dict[str, Plan] = {}
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
        plans[name] = Plan(
            settings=settings_of(name, config, models),
            quantities=quantities,
            pressures=tuple(sorted(case["pressures"])),
            surface=case["surface"],
            simulated=simulated,
        )
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
