"""What each case of the configuration is solved with, and which cases share their solutions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from . import adhesive_accuracy
from .accuracy import QUANTITIES, Laws, Settings, Surface, UnreachableError, cheapest

# Quantities that rest on the gaps, which take longer to evaluate than areas and mean gaps.
OF_GAPS = ("attractive_area", "gap_distribution", "a_v")
FEWEST_COARSE = 64  # coarse seeds if nothing says how many


@dataclass(frozen=True)
class Plan:
    """How one case is solved.

    Attributes
    ----------
    settings : Settings
        Grid, tolerance and numbers of seeds.
    quantities : tuple of str
        What is wanted, of `accuracy.QUANTITIES`.
    pressures : tuple of float
        Loads, ascending.
    surface : str
        Name of the model surface.
    simulated : bool
        False if theory alone is asked for.
    owner : str
        Case whose solutions of single realisations are used: the case itself or an earlier one on
        the same surface and settings that has all its loads.
    """

    settings: Settings
    quantities: tuple[str, ...]
    pressures: tuple[float, ...]
    surface: str
    simulated: bool
    owner: str

    @property
    def gaps(self) -> bool:
        """Whether attractive areas at given ranges are needed."""
        return any(quantity in OF_GAPS for quantity in self.quantities)

    @property
    def complete(self) -> bool:
        """Whether the case is simulated and holds every quantity, as figures and report need."""
        return self.simulated and set(self.quantities) == set(QUANTITIES)


def plans_of(config: Mapping[str, Any], laws: Laws | None = None) -> dict[str, Plan]:
    """Return the plan of every case of a checked configuration.

    Parameters
    ----------
    config : mapping
        Content of config.yaml with everything that overrides it.
    laws : mapping, optional
        Table of `accuracy.read_laws`; needed if a case asks for an accuracy.

    Raises
    ------
    accuracy.UnreachableError
        If a case asks for more than any settings are predicted to reach; names the case.
    """
    plans: dict[str, Plan] = {}
    for name, case in config["cases"].items():
        own = Plan(
            settings=settings_of(name, config, laws),
            quantities=tuple(case.get("quantities", QUANTITIES)),
            pressures=tuple(sorted(case["pressures"])),
            surface=case["surface"],
            simulated=case.get("model", "simulation") == "simulation",
            owner=name,
        )
        owner = next((key for key, plan in plans.items() if shares(plan, own)), name)
        plans[name] = Plan(**{**vars(own), "owner": owner})
    return plans


def settings_of(name: str, config: Mapping[str, Any], laws: Laws | None) -> Settings:
    """Return the settings of a case: those of its own accuracy, or of the preset.

    `sampling` stands above both; `seeds`, of the case or of the whole configuration, above the
    preset.
    """
    case = config["cases"][name]
    method = case.get("sampling", config["sampling"]["method"])
    if "accuracy" in case and laws is not None:
        chosen = chosen_for(name, config, laws, method)
    else:
        chosen = preset(config["fidelities"][config["fidelity"]])
    seeds = chosen.seeds
    if "accuracy" not in case:
        seeds = case.get("seeds", config.get("seeds", seeds))
    coarse_seeds = chosen.coarse_seeds if method == "multilevel" else 0
    return Settings(chosen.pixels_per_wavelength, chosen.tolerance, seeds, coarse_seeds)


def preset(fidelity: Mapping[str, Any]) -> Settings:
    """Return the settings of a preset of the configuration."""
    return Settings(
        fidelity["pixels_per_wavelength"],
        fidelity["tolerance"],
        fidelity["seeds"],
        fidelity.get("coarse_seeds", FEWEST_COARSE),
    )


def preset_by_rule(
    laws: Laws,
    asked: Mapping[str, Any],
    name: str,
    surface: Mapping[str, Any],
    descriptor_seeds: int,
    free: bool = False,
) -> Settings:
    """Return the cheapest settings for the error of a preset in every quantity, adhesive ones too.

    Parameters
    ----------
    laws : mapping
        Table of `accuracy.read_laws`.
    asked : mapping
        What the configuration says under ``tradeoff.presets``.
    name : str
        Name of the preset.
    surface : mapping
        The model surface that ``asked`` names.
    descriptor_seeds : int
        See ``sampling`` of the configuration.
    free : bool
        Whether to leave aside the quantities of full adhesion, on the same realisations.
    """
    where, least = (surface_of(surface), asked["pressures"]), None
    if not free:
        wanted = asked["adhesive"]
        least = adhesive_accuracy.least(
            laws, wanted["accuracy"][name], *where, wanted["quantities"], descriptor_seeds
        )
    return cheapest(
        laws,
        asked["accuracy"][name],
        *where,
        QUANTITIES,
        descriptor_seeds=descriptor_seeds,
        plain=False,
        least=least,
    )


def chosen_for(name: str, config: Mapping[str, Any], laws: Laws, method: str) -> Settings:
    """Return the cheapest settings for the accuracy that a case asks for."""
    case = config["cases"][name]
    try:
        return cheapest(
            laws,
            case["accuracy"],
            surface_of(config["model_surfaces"][case["surface"]]),
            case["pressures"],
            case.get("quantities", QUANTITIES),
            descriptor_seeds=config["sampling"]["descriptor_seeds"],
            plain=True if method == "plain" else None,
        )
    except UnreachableError as error:
        raise UnreachableError(
            f"cases.{name}.accuracy = {case['accuracy']!r} is out of reach: {error}; ask for less "
            "accuracy or fewer quantities, or give the case settings of its own"
        ) from None


def surface_of(surface: Mapping[str, Any]) -> Surface:
    """Return what settings depend on, of a model surface of the configuration."""
    return Surface(surface["hurst"], surface["magnification"], surface.get("window", 1.0))


def shares(plan: Plan, own: Plan) -> bool:
    """Whether the realisations that one plan solves hold those of another."""
    same = (plan.surface, *grid(plan)) == (own.surface, *grid(own))
    loads: Sequence[float] = [p for p in own.pressures if p not in plan.pressures]
    return same and plan.simulated and own.simulated and not loads and plan.gaps >= own.gaps


def grid(plan: Plan) -> tuple[int, float]:
    """Return the settings that a single solution depends on."""
    return plan.settings.pixels_per_wavelength, plan.settings.tolerance
