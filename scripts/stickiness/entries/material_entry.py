"""Models of a material in the configuration."""

from typing import Annotated, Any, Literal, Self

from pydantic import ConfigDict, Discriminator, Field, Strict, Tag, ValidationInfo, model_validator

from stickiness.entries import fields as f
from stickiness.entries.common_materials import find_common_material
from stickiness.entries.errors import EntryError, suggest
from stickiness.entries.fields import Section, needed, optional
from stickiness.solids.moduli import (
    REFERENCE_FREQUENCY,
    find_fall,
    find_rise,
    relaxation_frequency,
)
from stickiness.traction_laws import EXPONENTIAL
from stickiness.units import Quantity

_MODULI = ("plane_strain_modulus", "youngs_modulus and poisson_ratio")


class ElasticPair(Section):
    """Elasticity and adhesion of a pair of solids."""

    one_of = (_MODULI,)

    plane_strain_modulus: f.Modulus = optional('E* of the pair, e.g. "2 MPa"')
    youngs_modulus: f.Modulus = optional('Young\'s modulus, e.g. "3 GPa"')
    poisson_ratio: Annotated[float, Field(gt=-1, le=0.5)] = optional("Poisson's ratio")
    work_of_adhesion: f.Energy = needed('work of adhesion of the pair, e.g. "50 mJ/m^2"')
    range: f.Range = needed('range of the attraction, e.g. "0.2 nm"')


class Prony(Section):
    """Prony series of Young's modulus, e.g. `[["0.3 MPa", "1 ms"]]` for its terms."""

    equilibrium: f.Modulus = needed('modulus at rest, e.g. "30 kPa"')
    terms: f.Several[Annotated[tuple[f.Modulus, f.Time], Strict(False)]] = needed(
        "pairs of modulus and relaxation time"
    )


class Film(Section):
    """Film that carries an adhesive, such as that of a tape; it bends as a plate."""

    youngs_modulus: f.Modulus = needed('Young\'s modulus of the film, e.g. "3 GPa"')
    poisson_ratio: f.Poisson = needed("Poisson's ratio of the film")
    thickness: f.Length = needed('thickness of the film, e.g. "25 um"')


class Skin(Section):
    """Thin skin of another modulus, bonded to the material: an oxide, a paint, an aged surface."""

    thickness: f.SkinThickness = needed('thickness of the skin, e.g. "90 nm"')
    modulus: f.Modulus = needed('Young\'s modulus of the skin, e.g. "3 GPa"')
    poisson: f.Poisson = needed("Poisson's ratio of the skin")


def _name_backing(backing: object) -> str:
    return "film" if isinstance(backing, dict | Film) else "base"


Backing = Annotated[
    Annotated[Film, Tag("film")] | Annotated[Literal["bonded", "slip"], Tag("base")],
    Discriminator(_name_backing),
]


def _let_common_complete(schema: dict[str, Any], section: type[Section]) -> None:
    """Complete the JSON schema of a material, which `common` frees of the required keys."""
    f.complete_schema(schema, section)
    alone = {key: schema.pop(key) for key in ("required", "allOf")}
    schema["anyOf"] = [{"required": ["common"]}, alone]


class Material(ElasticPair, f.Labelled):
    """An elastic solid against a rigid rough counterface.

    A common material gives the values of all keys that are not there.
    """

    model_config = ConfigDict(json_schema_extra=_let_common_complete)
    one_of = (
        (
            *_MODULI,
            "youngs_modulus_table and poisson_ratio",
            "youngs_modulus_prony and poisson_ratio",
        ),
    )

    common: str = Field(
        None,
        exclude=True,  # a checked entry has the values
        description="name of a common material, see `python -m stickiness --materials`",
    )
    youngs_modulus_table: f.AtLeastTwo[Annotated[tuple[f.Frequency, f.Modulus], Strict(False)]] = (
        optional('pairs of ascending frequency and storage modulus: [["1 Hz", "50 kPa"], ...]')
    )
    youngs_modulus_prony: Prony = optional("Prony series of Young's modulus")
    dwell: f.Time = optional('time for which contact is made, e.g. "60 s"')
    thickness: f.Thickness = optional("thickness of a layer; without it infinitely deep")
    backing: Backing = optional(
        "a layer is bonded to a rigid base (default), slips on it, or is bonded to a film"
    )
    work_on_smooth: bool = optional(
        "true: the work of adhesion is that of smooth surfaces, without dissipation, and may "
        "exceed 0.2 J/m^2",
        False,
    )
    skin: Skin = optional("stiff skin of an infinitely deep material")
    surface: str = optional("name of the rough surface of the solid itself, added to the other")
    pressed: f.Pressure = optional('pressure before separation, e.g. "10 kPa"; a touch without it')
    law: f.PredictedLaw = optional(
        "traction law; default exponential. The range of van_der_waals is D0", EXPONENTIAL
    )

    @model_validator(mode="before")
    @classmethod
    def take_common(cls, entry: Any) -> Any:
        """Take the values of a common material for keys that are not given."""
        if not isinstance(entry, dict) or "common" not in entry:
            return entry
        common = find_common_material(entry["common"])
        depends_on_rate = entry.keys() & {"youngs_modulus_table", "youngs_modulus_prony"}
        left_out = "youngs_modulus" if depends_on_rate else None
        return {key: value for key, value in common.items() if key != left_out} | entry

    @model_validator(mode="after")
    def check_rates(self) -> Self:
        """Check that the modulus is known at the rates at which verdicts are made."""
        frequencies = [frequency for frequency, _ in self.youngs_modulus_table or []]
        if frequencies != sorted(set(frequencies)):
            listed = ", ".join(frequency.text for frequency in frequencies)
            raise EntryError("youngs_modulus_table", listed, "frequencies must ascend")
        moduli = [modulus for _, modulus in self.youngs_modulus_table or []]
        rise = find_rise(frequencies, moduli) if moduli else None
        if rise is not None:
            text = (
                f"at {frequencies[rise].text} is too high: a storage modulus rises with the square "
                "of the frequency at most; correct this row or the one before"
            )
            raise EntryError(f"youngs_modulus_table[{rise}]", moduli[rise], text)
        fall = find_fall(moduli)
        if fall is not None:
            frequency, modulus = self.youngs_modulus_table[fall]
            text = (
                f"at {frequency.text} is below the modulus at lower frequencies: a storage modulus "
                "does not fall with frequency; correct this row"
            )
            raise EntryError(f"youngs_modulus_table[{fall}]", modulus, text)
        quoted = Quantity(REFERENCE_FREQUENCY, f"{REFERENCE_FREQUENCY:g} Hz")
        roles = {quoted: "at which the verdict is quoted"}
        if self.dwell is not None:
            if not frequencies and self.youngs_modulus_prony is None:
                text = "give youngs_modulus_table or youngs_modulus_prony"
                raise EntryError("dwell", self.dwell, text)
            rate = relaxation_frequency(self.dwell)
            relaxed = Quantity(float(f"{rate:.3g}"), f"{rate:.3g} Hz")
            roles = {relaxed: f"1/(pi^2 dwell) for dwell = {self.dwell!r}"}
        for frequency, role in roles.items():
            if frequencies and not frequencies[0] <= frequency <= frequencies[-1]:
                covered = f"{frequencies[0].text} to {frequencies[-1].text}"
                text = f"runs from {covered} and must cover {frequency.text}, {role}"
                raise EntryError("youngs_modulus_table", None, text)
        return self

    @model_validator(mode="after")
    def check_layer(self) -> Self:
        """Check what only layers have, and fill in that they are bonded."""
        if self.thickness is None:
            if self.backing is not None:
                text = "belongs to a layer: give its thickness, too"
                raise EntryError("backing", self.backing, text)
            return self
        if self.plane_strain_modulus is not None:
            text = "a layer needs youngs_modulus and poisson_ratio instead of plane_strain_modulus"
            raise EntryError("thickness", self.thickness, text)
        if self.poisson_ratio < 0:
            text = "must be between 0 and 0.5 for a layer"
            raise EntryError("poisson_ratio", self.poisson_ratio, text)
        self.backing = self.backing or "bonded"
        return self

    @model_validator(mode="after")
    def check_skin(self) -> Self:
        """Check what only a half-space with a skin has."""
        if self.skin is None:
            return self
        if self.thickness is not None:
            text = "a layer cannot have a skin: leave out thickness, or skin"
            raise EntryError("thickness", self.thickness, text)
        if self.plane_strain_modulus is not None:
            text = "needs youngs_modulus and poisson_ratio instead of plane_strain_modulus"
            raise EntryError("skin", None, text)
        if self.poisson_ratio < 0:
            text = "must be between 0 and 0.5 below a skin"
            raise EntryError("poisson_ratio", self.poisson_ratio, text)
        return self

    @model_validator(mode="after")
    def check_surface(self, info: ValidationInfo) -> Self:
        """Check that the surface of the solid itself is among those of the configuration."""
        surfaces = (info.context or {}).get("surfaces")
        if None not in (self.surface, surfaces) and self.surface not in surfaces:
            raise EntryError(
                "surface", self.surface, f"unknown name; {suggest(self.surface, surfaces)}"
            )
        return self


class Materials(Section):
    """The file of materials."""

    materials: f.Names[Material] = needed("materials by name")
