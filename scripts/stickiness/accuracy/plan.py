"""What each case of the configuration is solved with, and which cases share their solutions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from stickiness.accuracy import adhesion, sequential, spectral_cut
from stickiness.accuracy.error_laws import (
    COARSE_SEEDS,
    OF_GAPS,
    QUANTITIES,
    SEEDS,
    Laws,
    Settings,
    Surface,
    UnreachableError,
    cheapest,
)

FEWEST_COARSE = 64  # coarse seeds if nothing says how many


@dataclass(frozen=True)
class Plan:
    """How one case is solved.

    Attributes
    ----------
    settings : Settings
        Grid, tolerance and numbers of seeds; if an accuracy is asked for, those of the first round.
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
    asked : stopping.Asked or None
        The accuracy asked for, by which seeds are drawn in rounds; None if their number is given.
    """

    settings: Settings
    quantities: tuple[str, ...]
    pressures: tuple[float, ...]
    surface: str
    simulated: bool
    owner: str
    asked: sequential.Asked | None = None

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
            asked=asked_of(name, config, laws) if "accuracy" in case and laws is not None else None,
        )
        owner = next((key for key, plan in plans.items() if shares(plan, own)), name)
        plans[name] = Plan(**{**vars(own), "owner": owner})
    return plans


def settings_of(name: str, config: Mapping[str, Any], laws: Laws | None) -> Settings:
    """Return the settings of a case: of the first round for its own accuracy, or of the preset.

    `sampling` stands above both; `seeds`, of the case or of the whole configuration, above the
    preset.
    """
    case = config["cases"][name]
    if "accuracy" in case and laws is not None:
        return sequential.first(laws, asked_of(name, config, laws), chosen_for(name, config, laws))
    chosen = preset(config["fidelities"][config["fidelity"]])
    seeds = case.get("seeds", config.get("seeds", chosen.seeds))
    coarse_seeds = 0 if plain(case, config) else chosen.coarse_seeds
    return Settings(chosen.pixels_per_wavelength, chosen.tolerance, seeds, coarse_seeds)


def plain(case: Mapping[str, Any], config: Mapping[str, Any]) -> bool:
    """Whether a case takes plain means."""
    return case.get("sampling", config["sampling"]["method"]) == "plain"


def with_cuts(config: Mapping[str, Any], laws: Laws) -> dict[str, Any]:
    """Return a checked configuration whose cases are on cut spectra where `cut` has that cheaper.

    A cut surface is one more of ``model_surfaces``, and its case has theory ``carry_to`` the
    magnification of the whole.

    Raises
    ------
    ValueError
        If another surface of the configuration has the name of a cut one.
    """
    surfaces, cases = dict(config["model_surfaces"]), dict(config["cases"])
    for name, case in config["cases"].items():
        surface = surfaces[case["surface"]]
        if not spectral_cut.may_be_cut(case, surface):
            continue
        magnification = cheapest_for(name, config, laws)[0]
        if magnification < surface["magnification"]:
            own = spectral_cut.name_of(case["surface"], magnification)
            part = {**surface, "magnification": magnification}
            if surfaces.get(own, part) != part:
                raise ValueError(
                    f"model_surfaces.{own}: cases.{name} needs this name for {case['surface']} cut "
                    f"at magnification {magnification:g}; give yours another"
                )
            surfaces[own] = part
            cases[name] = {**case, "surface": own, "carry_to": surface["magnification"]}
    return {**config, "model_surfaces": surfaces, "cases": cases}


def asked_of(name: str, config: Mapping[str, Any], laws: Laws) -> sequential.Asked:
    """Return what a case that gives an accuracy asks of its simulation."""
    case, sampling = config["cases"][name], config["sampling"]
    surface = Surface.of(config["model_surfaces"][case["surface"]])
    wanted, pressures = tuple(case.get("quantities", QUANTITIES)), tuple(sorted(case["pressures"]))
    accuracy = case["accuracy"]
    if "carry_to" in case:
        accuracy = spectral_cut.left_to_simulation(
            laws, accuracy, surface, case["carry_to"], pressures, wanted
        )
    return sequential.Asked(
        accuracy=accuracy,
        surface=surface,
        pressures=pressures,
        quantities=wanted,
        at_most=case.get("at_most", sampling.get("at_most", SEEDS[-1])),
        plain=plain(case, config),
        descriptor_seeds=sampling["descriptor_seeds"],
    )


def rungs(coarse_seeds: int) -> list[int]:
    """Return where the files of coarse seeds drawn in rounds end, up to so many in all."""
    return [rung for rung in COARSE_SEEDS[1:] if rung <= coarse_seeds]


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
    where, least = (Surface.of(surface), asked["pressures"]), None
    if not free:
        wanted = asked["adhesive"]
        least = adhesion.least(
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


def chosen_for(name: str, config: Mapping[str, Any], laws: Laws) -> Settings:
    """Return the settings predicted to be the cheapest for the accuracy that a case asks for."""
    return cheapest_for(name, config, laws, whole=True)[1]


def cheapest_for(
    name: str, config: Mapping[str, Any], laws: Laws, whole: bool = False
) -> tuple[float, Settings]:
    """Return the magnification and the settings predicted to be the cheapest for a case.

    Parameters
    ----------
    whole : bool
        Whether to keep the spectrum as it is.
    """
    asked, case = asked_of(name, config, laws), config["cases"][name]
    wanted = laws, asked.accuracy, asked.surface, asked.pressures, asked.quantities
    options = {
        "descriptor_seeds": asked.descriptor_seeds,
        "plain": True if asked.plain else None,
    }
    try:
        if whole:
            return asked.surface.magnification, cheapest(*wanted, **options)
        return spectral_cut.cheapest(*wanted, **options)
    except UnreachableError as error:
        refused = f"cases.{name}.accuracy = {case['accuracy']!r} is out of reach: "
        if asked.accuracy <= 0:
            raise UnreachableError(
                f"{refused}theory that carries to magnification {case['carry_to']:g} errs by more "
                "than that; ask for less accuracy, carry less far or simulate more"
            ) from None
        if "carry_to" in case:
            refused += f"carried by theory, the simulation has to reach {asked.accuracy:.2g}, and "
        raise UnreachableError(f"{refused}{error}; {error.remedy}") from None


def shares(plan: Plan, own: Plan) -> bool:
    """Whether the realisations that one plan solves hold those of another."""
    same = (plan.surface, *grid(plan)) == (own.surface, *grid(own))
    loads: Sequence[float] = [p for p in own.pressures if p not in plan.pressures]
    return same and plan.simulated and own.simulated and not loads and plan.gaps >= own.gaps


def grid(plan: Plan) -> tuple[int, float]:
    """Return the settings that a single solution depends on."""
    return plan.settings.pixels_per_wavelength, plan.settings.tolerance
