"""Models of config/campaigns: what this project measures once, apart from the user's runs."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from common.config import fields as f
from common.config.fields import Section, needed, optional
from common.config.models import BandWithPlateau, ModelSurface

Grids = Annotated[
    f.Several[Annotated[int, Field(ge=2, multiple_of=2)]],
    Field(min_length=2, description="grid points per shortest wavelength"),
]
MostPoints = Annotated[int, Field(ge=16, description="largest number of grid points along a side")]
Points = Annotated[
    f.Several[f.Pair[f.Positive]],
    Field(description="pairs of range/h_rms and adhesion length/range"),
]


class AdhesivePresets(Section):
    """Error that the rule of the presets allows in full adhesion."""

    quantities: f.Several[Literal["inverse_kappa_ad", "threshold", "pull_off"]] = needed(
        "quantities that must be within the error"
    )
    accuracy: f.Names[f.Share] = needed("error of each preset in them")


class Presets(Section):
    """Rule of the presets: the cheapest settings for an error in every quantity."""

    surface: str = needed("name in model_surfaces")
    pressures: f.Loads
    accuracy: f.Names[f.Share] = needed("error that each preset stands for")
    adhesive: AdhesivePresets = needed("error in full adhesion")


class Settings(Section):
    """Settings of the solver without adhesion."""

    tolerances: f.Values = needed("tolerances of the solver over h_rms")
    at_pixels: Annotated[int, Field(ge=4)] = optional("grid points while others are varied")
    at_tolerance: f.Positive = needed("tolerance while others are varied")


class VariedAdhesion(Settings):
    """Settings of full adhesion that are varied one at a time."""

    pixels: Grids
    points: Points
    seeds: f.Count = needed("realisations solved with every setting")


class PullOff(VariedAdhesion):
    """Pull-off during separation under a press."""

    pressure: f.Positive = needed("load over E* q0 h_rms from which the separation starts")
    at_balance: f.Positive = needed("error of the energy balance that sets the steps")


class FullAdhesion(VariedAdhesion):
    """Full adhesion with various settings."""

    surfaces: f.Names[ModelSurface] = needed("surfaces by name")
    q0_h_rms: f.Positive = needed("lowest wave number times rms height")
    law: f.Law
    pressures: f.Loads
    most_points: MostPoints
    more_seeds: f.Count = needed("realisations solved on `at_pixels` and coarser grids")
    pull_off: PullOff = needed("pull-off during separation")


class Counts(Section):
    """Numbers of realisations."""

    fine: f.Count = needed("solved on every grid but the finest")
    finest: f.Count = needed("solved on the finest grid")
    coarse: f.Count = needed("solved on 2 points per shortest wavelength only")
    described: f.Count = needed("of which only the long waves are used")


class MeasuredSurfaces(Section):
    """Surfaces that error models are fitted to or checked on."""

    first_seed: Annotated[int, Field(ge=1)] = needed("first seed; further ones follow")
    counts: Counts = needed("numbers of realisations")
    pixels: Grids
    pressures: f.Values = optional("loads, if not those of the campaign")
    accuracies: f.Several[f.Share] = optional("accuracies to choose settings for")
    surfaces: f.Names[ModelSurface] = needed("surfaces by name")


class Tradeoff(Section):
    """What accuracy costs, as `snakemake tradeoff` measures it, and the rule of the presets."""

    presets: Presets = needed("rule of the presets")
    settings: Settings = needed("tolerances of the solver that are measured")
    pressures: f.Loads
    adhesion: FullAdhesion = needed("full adhesion with various settings")
    cases: MeasuredSurfaces = needed("surfaces that the error models are fitted to")
    finer: MeasuredSurfaces = needed("more of them, on finer grids and at other loads")
    validation: MeasuredSurfaces = needed("surfaces that the choice of settings is checked on")

    def _problems(self, context):
        rule, user = self.presets, context["config"]
        if rule.surface not in user["model_surfaces"]:
            yield f.unknown("presets.surface", rule.surface, user["model_surfaces"])
        for name in rule.accuracy:
            for table in (user["fidelities"], rule.adhesive.accuracy):
                if name not in table:
                    yield f.unknown("presets.accuracy", name, table)


class RemainingSet(BandWithPlateau):
    """A surface on which adhesion is simulated."""

    one_of = (("zones", "ranges"),)

    points: Annotated[int, Field(ge=32, multiple_of=2)] = needed("grid points per side")
    seeds: f.Several[f.Index] = needed("realisations")
    energies: f.Values = needed("works of adhesion over the elastic energy of full contact")
    zones: f.Values = optional("q0 range^2/adhesion_length")
    ranges: f.Values = optional("ranges over h_rms")

    def _problems(self, context):
        yield from super()._problems(context)
        least = 2 * self.magnification * (self.window or 1)
        if self.points < least:
            yield f"points = {self.points} must be at least {least:g}, two per shortest wavelength"


class Remaining(Section):
    """How much adhesion remains, as `snakemake remaining_measured` simulates it."""

    law: f.Law
    squeeze: f.Positive = needed("mean pressure over E* q0 h_rms before separation")
    sets: f.Names[RemainingSet] = needed("surfaces by name")
