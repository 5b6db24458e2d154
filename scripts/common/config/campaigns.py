"""Models of config/campaigns/ but for paper.yaml: what this project measures once."""

from typing import Annotated, Literal, Self

from pydantic import Field, ValidationInfo, model_validator

from common.config.simulations import GaussianSurface, Loads, Pixels, Values
from stickiness.entries import fields as f
from stickiness.entries.errors import EntryError, suggest
from stickiness.entries.fields import Section, needed, optional

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


Grid = Annotated[int, Field(ge=32, multiple_of=4)]
Family = Literal[
    *("gaussian", "skewed_up", "skewed_down", "squared", "squared_down"),
    *("exponential", "exponential_down", "tops_cut", "valleys_cut"),
    *("plateau_honed", "terraced", "scratched", "dimpled"),
    *("cobbled", "beaded", "turned", "printed", "bifractal", "rolloff", "ground"),
]


class Topography(Section):
    """A synthetic topography."""

    family: Family = needed("name in common.topographies.FAMILIES, which takes long to load")
    hurst: f.Hurst = optional("of a family that has one, if not its own")
    points: Grid
    waves: Annotated[int, Field(ge=1)] = needed("longest waves along a side")
    shortest: Annotated[float, Field(ge=2)] = needed("shortest wave in pixels")


class VerdictSet(Topography):
    """Maps on which verdicts are made."""

    seeds: f.Several[f.Index]
    finest: f.Several[Grid] = optional("further grids on which contact is simulated")


class VerdictTrade(Section):
    """Verdicts on maps in several ways, beside full simulation on their whole grid."""

    law: f.Law
    grids: f.Several[Grid] = needed("on which contact is simulated, by their points along a side")
    energies: Values = needed("works of adhesion over the energy of full contact of the map")
    sets: f.Names[VerdictSet]


class Tradeoff(Section):
    """What accuracy costs, as `snakemake tradeoff` measures it, and the rule of the presets."""

    presets: Presets
    settings: Settings
    pressures: Loads
    adhesion: FullAdhesion
    cases: MeasuredSurfaces
    finer: MeasuredSurfaces
    validation: Validation
    verdicts: VerdictTrade

    @model_validator(mode="after")
    def check_presets(self, info: ValidationInfo) -> Self:
        """Check that the presets are in the configuration, and find the surface of their role."""
        config = info.context["config"]
        role = self.presets.surface
        roles = config["roles"]
        if role not in roles:
            raise EntryError("presets.surface", role, f"unknown role; {suggest(role, roles)}")
        self.presets.surface = config["cases"][roles[role]]["surface"]
        for name in self.presets.accuracy:
            for table in (config["fidelities"], self.presets.adhesive.accuracy):
                if name not in table:
                    text = f"unknown name; {suggest(name, table)}"
                    raise EntryError("presets.accuracy", name, text)
        return self


Role = Annotated[
    Literal["fitted", "unseen"],
    Field(description="whether constants of the theory may have been fitted to a set"),
]


class SimulatedSet(GaussianSurface):
    """A surface on which adhesion is simulated."""

    role: Role
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


class TopographySet(Topography):
    """Synthetic topographies of one family."""

    role: Role
    seeds: f.Several[f.Index]


class HeightSet(TopographySet):
    """Topographies on which the energy at zero load is simulated."""

    height_skewness: float = optional("of a family that has one, if not its own")


class HeightCampaign(Section):
    """Energies at zero load, as `snakemake heights_measured` simulates them."""

    law: f.Law
    energies: Values
    pixels_in_zone: Values
    sets: f.Names[HeightSet]


SolidKind = Literal["layer", "film", "thin", "skin"]


class SolidSet(SimulatedSet):
    """A solid, and a surface on which the energy at zero load is simulated; lengths in 1/q0."""

    one_of = (("backing", "skin_modulus_ratio and skin_poisson"),)

    kind: SolidKind = needed("class of solids")
    thickness: f.Positive = needed("of the layer or of the skin")
    poisson: f.Poisson = needed("Poisson's ratio of the layer, or below the skin")
    backing: Literal["bonded", "slip", "film"] = optional("what a layer lies on")
    film_modulus_ratio: f.Positive = optional("Young's modulus of the film over the layer's")
    film_poisson: f.Poisson = optional("Poisson's ratio of the film")
    film_thickness: f.Positive = optional("thickness of the film")
    skin_modulus_ratio: f.Positive = optional("Young's modulus of the skin over that below")
    skin_poisson: f.Poisson = optional("Poisson's ratio of the skin")

    @model_validator(mode="after")
    def check_film(self) -> Self:
        """Check that a film is described, and none where there is none."""
        for key in ("film_modulus_ratio", "film_poisson", "film_thickness"):
            if (getattr(self, key) is None) == (self.backing == "film"):
                raise EntryError(
                    key, getattr(self, key), "belongs to backing: film, and to no other"
                )
        return self


class SolidCampaign(Section):
    """Energies at zero load on other solids than half-spaces."""

    energies: Values
    pixels_in_zone: dict[SolidKind, Values] = needed(
        "widths of the cohesive zone on a half-space, in pixels, by class"
    )
    sets: f.Names[SolidSet]


class Patches(Section):
    """Patches of one size that are cut from a surface."""

    waves: Annotated[int, Field(ge=1)] = needed("longest waves along a side of the patch")
    count: f.Count = needed("patches of a surface")


class PatchCampaign(Section):
    """What patches tell of the surface that they were cut from."""

    range: f.Positive = needed("range over h_rms of the surface")
    patches: f.Several[Patches]
    sets: f.Names[TopographySet]


class Refinement(Section):
    """A range shorter than that of the states, and the grid on which it is simulated."""

    ratio: f.Share = needed("range over that of the states")
    finer: f.Count = needed("points along a side over those of the states")


class RangeSet(TopographySet):
    """Topographies on which shorter ranges are simulated."""

    refinements: f.Several[Refinement]


class RangeCampaign(Section):
    """What remains at ranges shorter than those of the states."""

    works: f.Count = needed("works of adhesion on a surface, at most")
    shares: f.Interval[f.Share] = needed("between which the shares on the states are")
    sets: f.Names[RangeSet]


class PullOffCampaign(RangeCampaign):
    """Pull-off at the ranges of the states and at shorter ones."""

    squeeze: f.Positive = needed("pressure before separation, over E* q0 h_rms")
    steps: f.Count = needed("of the path, at least")


class UnresolvedCampaign(Section):
    """What states on every second or fourth point tell of a surface."""

    ranges: Values = needed("ranges over h_rms")
    strides: f.Several[Annotated[int, Field(ge=2)]] = needed("of which every n-th point")
    sets: f.Names[TopographySet]


class LargerSet(HeightSet):
    """Topographies whose patches are judged for contact with all of it."""

    parts: f.Several[f.Count] = needed("patches along a side, of every size")


class LargerCampaign(Section):
    """What scans tell of a larger contact."""

    range: f.Positive = needed("range over h_rms of the surface")
    count: f.Count = needed("patches of every size")
    sets: f.Names[LargerSet]


class CoatedSolid(Section):
    """A skin or a layer, the works of adhesion and the ranges on it; lengths in 1/q0."""

    one_of = (("backing", "skin_modulus_ratio and skin_poisson"),)

    thickness: f.Positive = needed("of the layer or of the skin")
    poisson: f.Poisson = needed("Poisson's ratio of the layer, or below the skin")
    backing: Literal["bonded", "slip"] = optional("what a layer lies on")
    skin_modulus_ratio: f.Positive = optional("Young's modulus of the skin over that below")
    skin_poisson: f.Poisson = optional("Poisson's ratio of the skin")
    energies: Values = needed("works of adhesion over the energy of full contact")
    pixels_in_zone: f.Positive = needed("width of the cohesive zone on a half-space, in pixels")


class CoatedSet(TopographySet):
    """Topographies whose map lacks the finest waves."""

    stride: Annotated[int, Field(ge=2)] = needed("the map has every n-th point")


class CoatedCampaign(Section):
    """Energies at zero load on solids, on surfaces whose finest waves a map lacks."""

    solids: f.Names[CoatedSolid]
    sets: f.Names[CoatedSet]


class BallSet(Section):
    """Balls on rough heights, in units of the zone of a smooth ball at pull-off."""

    role: Role
    tabor: Annotated[float, Field(ge=0)] = needed("Tabor's parameter; 0: rigid solids")
    law: f.Law
    hurst: f.Hurst
    skewness: float = optional("of the heights; by default they are Gaussian", 0.0)
    waves: Values = needed("longest waves across the zone")
    heights: Values = needed("rms heights over the distance of the attraction")
    shortest: f.Positive = needed("shortest wave, over the radius of the zone")
    side: f.Positive = needed("of the cell, over the radius of the zone")
    points: Annotated[int, Field(ge=32, multiple_of=2)]
    places: f.Count = needed("that a ball touches")
    seeds: f.Several[f.Index]


class BallCampaign(Section):
    """Pull-off of balls from rough heights."""

    sets: f.Names[BallSet]


class LongRangeCampaign(Section):
    """What remains where attraction reaches across much of the roughness."""

    energies: Values = needed("works of adhesion over the energy of full contact")
    ranges: Values = needed("ranges over h_rms")
    sets: f.Names[TopographySet]


class LimitCampaign(Section):
    """Simulations behind the limits of verdicts, as `snakemake limits_measured` makes them."""

    law: f.Law
    solids: SolidCampaign
    patches: PatchCampaign
    ranges: RangeCampaign
    pull_offs: PullOffCampaign
    unresolved: UnresolvedCampaign
    larger: LargerCampaign
    coated: CoatedCampaign
    balls: BallCampaign
    long_ranges: LongRangeCampaign
