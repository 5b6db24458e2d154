"""Models of config/campaigns/ but for paper.yaml: what this project measures once."""

from typing import Annotated, Literal, Self

from pydantic import Field, ValidationInfo, model_validator

from common.config.simulations import GaussianSurface, Loads, ModelSurface, Pixels, Values
from stickiness.entries import fields as f
from stickiness.entries.errors import EntryError, suggest
from stickiness.entries.fields import Section, optional

EvenNumbers = Annotated[f.Several[Annotated[int, Field(ge=2, multiple_of=2)]], Field(min_length=2)]


class PresetErrors(Section):
    """Errors that the presets may have in full adhesion."""

    quantities: f.Several[Literal["inverse_kappa_ad", "threshold", "pull_off"]]
    accuracy: f.Names[f.Share]


class Presets(Section):
    """Rule of the presets: the cheapest settings for an error in every quantity."""

    surface: str
    pressures: Loads
    accuracy: f.Names[f.Share]
    adhesive: PresetErrors


class Settings(Section):
    """Settings of the solver."""

    tolerances: Values
    at_tolerance: f.Positive
    at_pixels: Pixels


class PullOff(Section):
    """Pull-off during separation under a press."""

    tolerances: Values
    at_tolerance: f.Positive
    pixels: EvenNumbers
    points: f.Several[f.Pair[f.Positive]]
    seeds: f.Count
    pressure: f.Positive
    at_balance: f.Positive


class FullAdhesion(Settings):
    """Full adhesion with various settings."""

    surfaces: f.Names[GaussianSurface]
    q0_h_rms: f.Positive
    law: f.Law
    pressures: Loads
    points: f.Several[f.Pair[f.Positive]]
    pixels: EvenNumbers
    most_points: Annotated[int, Field(ge=16)]
    seeds: f.Count
    more_seeds: f.Count
    pull_off: PullOff


class Counts(Section):
    """Numbers of realisations."""

    fine: f.Count
    finest: f.Count
    coarse: f.Count
    described: f.Count


class MeasuredSurfaces(Section):
    """Surfaces that error models are fitted to."""

    first_seed: Annotated[int, Field(ge=1)]
    counts: Counts
    pixels: EvenNumbers
    pressures: Values = optional("loads, if not those of the campaign")
    surfaces: f.Names[GaussianSurface]


class Validation(MeasuredSurfaces):
    """Surfaces that the choice of settings is checked on."""

    accuracies: f.Several[f.Share]


class Tradeoff(Section):
    """What accuracy costs, as `snakemake tradeoff` measures it, and the rule of the presets."""

    presets: Presets
    settings: Settings
    pressures: Loads
    adhesion: FullAdhesion
    cases: MeasuredSurfaces
    finer: MeasuredSurfaces
    validation: Validation

    @model_validator(mode="after")
    def check_presets(self, info: ValidationInfo) -> Self:
        """Check that the presets and their surface are in the configuration."""
        config = info.context["config"]
        surface = self.presets.surface
        surfaces = config["model_surfaces"]
        if surface not in surfaces:
            text = f"unknown name; {suggest(surface, surfaces)}"
            raise EntryError("presets.surface", surface, text)
        for name in self.presets.accuracy:
            for table in (config["fidelities"], self.presets.adhesive.accuracy):
                if name not in table:
                    text = f"unknown name; {suggest(name, table)}"
                    raise EntryError("presets.accuracy", name, text)
        return self


class SimulatedSet(ModelSurface):
    """A surface on which adhesion is simulated."""

    points: Annotated[int, Field(ge=32, multiple_of=2)]
    seeds: f.Several[f.Index]

    @model_validator(mode="after")
    def check_points(self) -> Self:
        """Check that the grid resolves the shortest wavelength."""
        least = 2 * self.magnification * self.window
        if self.points < least:
            text = f"must be at least {least:g}, two per shortest wavelength"
            raise EntryError("points", self.points, text)
        return self


class RemainingSet(SimulatedSet):
    """A surface that approaches and separates, or rests at zero load."""

    one_of = (("zones", "ranges"),)

    energies: Values
    zones: Values = optional("q0 range^2/adhesion_length")
    ranges: Values = optional("ranges over h_rms")
    squeezes: Values = optional("pressures before separation, over E* q0 h_rms; by default 0.1")
    path: bool = optional(
        "false: only the energy at zero load, without approach and separation", True
    )


class Remaining(Section):
    """How much adhesion remains, as `snakemake remaining_measured` simulates it."""

    law: f.Law
    squeeze: f.Positive
    sets: f.Names[RemainingSet]


class HeightSet(SimulatedSet):
    """A surface on which the energy at zero load is simulated."""

    transform: Literal["squared", "-squared", "valleys cut", "tops cut", "exp", "-exp"] = optional(
        "what is done to the heights, point by point; waves beyond the band are left out"
    )


class HeightCampaign(Section):
    """Energies at zero load, as `snakemake heights_measured` simulates them."""

    law: f.Law
    energies: Values
    pixels_in_zone: Values
    sets: f.Names[HeightSet]
