"""Materials: elasticity and adhesion of the solid that touches a rough surface.

A key stands here once, with its type, default and text. Files, the command and Python are checked
by it, and docs/configuration.md, config/schema.json, ``--help`` and the docstring tell of it.
"""

from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import (
    ConfigDict,
    Discriminator,
    Field,
    PlainValidator,
    SerializerFunctionWrapHandler,
    Tag,
    ValidationError,
    ValidationInfo,
    WithJsonSchema,
    model_serializer,
    model_validator,
)

from stickiness.entries import fields as f
from stickiness.entries.common_materials import find_common_material
from stickiness.entries.elasticity import ElasticPair, SeriesEntry, TableEntry
from stickiness.entries.errors import EntryError, argument_error, first_error, suggest
from stickiness.entries.fields import Section, needed, optional
from stickiness.entries.old_names import OLD_NAMES, take_old_names, warn_of_old_name
from stickiness.formatting import amount
from stickiness.plausibility import find_doubts
from stickiness.solids import HALF_SPACE, Film, HalfSpace, Layer, Skin, Solid
from stickiness.solids.moduli import (
    REFERENCE_FREQUENCY,
    Constant,
    Modulus,
    Prony,
    Table,
    find_fall,
    find_rise,
    relaxation_frequency,
)
from stickiness.traction_laws import EXPONENTIAL
from stickiness.units import Quantity


class FilmEntry(Section):
    """Film that carries an adhesive, such as that of a tape; it bends as a plate."""

    youngs_modulus: f.Modulus = needed('Young\'s modulus of the film, e.g. "3 GPa"')
    poisson_ratio: f.Poisson = needed("Poisson's ratio of the film")
    thickness: f.Length = needed('thickness of the film, e.g. "25 um"')


class SkinEntry(Section):
    """Thin skin of another modulus, bonded to the material: an oxide, a paint, an aged surface."""

    thickness: f.SkinThickness = needed('thickness of the skin, e.g. "90 nm"')
    modulus: f.Modulus = needed('Young\'s modulus of the skin, e.g. "3 GPa"')
    poisson: f.Poisson = needed("Poisson's ratio of the skin")


def _name_backing(backing: object) -> str:
    return "film" if isinstance(backing, dict | FilmEntry) else "base"


Backing = Annotated[
    Annotated[FilmEntry, Tag("film")] | Annotated[Literal["bonded", "slip"], Tag("base")],
    Discriminator(_name_backing),
]


def _read_solid(value: Any) -> Any:
    """Return a solid of the library."""
    if not isinstance(value, Solid):
        raise ValueError("must be solids.HalfSpace() or a solids.Layer(...) or solids.Skin(...)")
    return value


def _read_surface(value: Any, info: ValidationInfo) -> Any:
    """Return the name of a surface in files, a `Surface` in Python."""
    if info.context is not None:
        if not isinstance(value, str):
            raise ValueError("must be the name of a surface")
    elif isinstance(value, str):
        raise ValueError(
            "must be a Surface: names of surfaces are known to the workflow alone, by its "
            "configuration"
        )
    elif not hasattr(value, "family"):
        raise ValueError("must be a Surface")
    return value


def _let_common_complete(schema: dict[str, Any], section: type[Section]) -> None:
    """Complete the JSON schema of a material, which `common` frees of the required keys."""
    f.complete_schema(schema, section)
    alone = {key: schema.pop(key) for key in ("required", "allOf")}
    schema["anyOf"] = [{"required": ["common"]}, alone]


class Material(ElasticPair, f.Labelled):
    """An elastic solid against a rigid rough counterface.

    A common material gives the values of all keys that are not there.

    Raises
    ------
    ValueError
        If a key is unknown or missing, or has a value that cannot be used.

    Examples
    --------
    >>> tape = Material(youngs_modulus="0.2 MPa", work_of_adhesion=0.06, range=3e-10)
    >>> print(f"E* = {tape.plane_strain_modulus / 1e3:.0f} kPa")
    E* = 267 kPa
    >>> tape.replace(thickness=5e-5).solid
    Layer(thickness=5e-05, poisson=0.5, backing='bonded')
    """

    model_config = ConfigDict(frozen=True, json_schema_extra=_let_common_complete)
    one_of = (
        (
            "plane_strain_modulus",
            "youngs_modulus",
            "youngs_modulus_table",
            "youngs_modulus_prony",
            "shear_modulus",
            "shear_modulus_table",
        ),
    )
    only_in_python = ("solid",)
    unstated: ClassVar[dict[str, str]] = {"label": "the material", "source": "not stated"}

    common: f.Maybe[str] = Field(
        None,
        exclude=True,  # a checked entry has the values
        description="name of a common material, see `python -m stickiness --materials`",
    )
    youngs_modulus_table: f.Maybe[TableEntry] = optional(
        'pairs of ascending frequency and storage modulus E\': [["1 Hz", "50 kPa"], ...], or the '
        "file of a rheometer"
    )
    youngs_modulus_prony: f.Maybe[SeriesEntry] = optional("Prony series of Young's modulus")
    shear_modulus: f.Maybe[f.Modulus] = Field(
        None,
        exclude=True,  # a checked entry has Young's
        description='shear modulus, e.g. "60 kPa": E = 2 (1 + nu) G',
    )
    shear_modulus_table: f.Maybe[TableEntry] = Field(
        None, exclude=True, description="the same of the storage modulus G'"
    )
    dwell: f.Maybe[f.Time] = optional('time for which contact is made, e.g. "60 s"')
    thickness: f.Maybe[f.Thickness] = optional("thickness of a layer; without it infinitely deep")
    backing: f.Maybe[Backing] = optional(
        "bonded (default) or slip: how a layer meets its rigid base; or a film that it is bonded to"
    )
    work_on_smooth: bool = optional(
        "true: the work of adhesion is that of smooth surfaces, without dissipation, and may "
        "exceed 0.2 J/m^2",
        False,
    )
    skin: f.Maybe[SkinEntry] = optional("stiff skin of an infinitely deep material")
    surface: Annotated[Any, PlainValidator(_read_surface), WithJsonSchema({"type": "string"})] = (
        optional(
            "rough surface of the solid itself, added to the other: its name, in Python a `Surface`"
        )
    )
    pressed: f.Pressed = optional('pressure before separation, e.g. "10 kPa"; a touch without it')
    law: f.PredictedLaw = optional(
        "traction law; default exponential. The range of van_der_waals is D0", EXPONENTIAL
    )
    solid: Annotated[Any, PlainValidator(_read_solid), WithJsonSchema({})] = Field(
        None,
        exclude=True,
        description="shape of the solid in Python, see `stickiness.solids`, instead of thickness, "
        "backing and skin",
    )

    def __init__(self, **keys: Any) -> None:
        keys = self.complete({k: v for k, v in take_old_names(keys).items() if v is not None})
        try:
            super().__init__(**keys)
        except ValidationError as error:
            raise argument_error(first_error(error, keys)) from None

    # Pydantic takes this method for its own; else it would call it where a file is checked, too,
    # without the context.
    __init__.__pydantic_base_init__ = True  # type: ignore[attr-defined]

    @model_validator(mode="before")
    @classmethod
    def take_common(cls, entry: Any) -> Any:
        """Take the values of a common material for keys that are not given."""
        if not isinstance(entry, dict) or "common" not in entry:
            return entry
        common = find_common_material(entry["common"])
        has_modulus = not entry.keys().isdisjoint(cls.one_of[0])
        taken = {
            key: value
            for key, value in common.items()
            if not (has_modulus and key == "youngs_modulus")
        }
        return taken | {key: value for key, value in entry.items() if key != "common"}

    @model_validator(mode="after")
    def take_shear_modulus(self) -> Self:
        """Fill in Young's modulus, E = 2 (1 + nu) G of an isotropic solid."""
        if self.shear_modulus is None and self.shear_modulus_table is None:
            return self
        assert self.poisson_ratio is not None
        ratio = 2 * (1 + self.poisson_ratio)
        if self.shear_modulus is not None:
            self.fill_in("youngs_modulus", _stretch(self.shear_modulus, ratio))
        else:
            pairs = self.shear_modulus_table or []
            table = [(frequency, _stretch(modulus, ratio)) for frequency, modulus in pairs]
            self.fill_in("youngs_modulus_table", table)
        return self

    @model_validator(mode="after")
    def check_rates(self) -> Self:
        """Check that the modulus is known at the rates at which verdicts are made."""
        key = "youngs_modulus_table"
        table = self.youngs_modulus_table or []
        if self.shear_modulus_table is not None:  # which rises and falls alike
            key = "shear_modulus_table"
            table = self.shear_modulus_table
        frequencies = [frequency for frequency, _ in table]
        moduli = [modulus for _, modulus in table]
        if frequencies != sorted(set(frequencies)):
            listed = ", ".join(map(_name_frequency, frequencies))
            raise EntryError(key, listed, "frequencies must ascend")
        rise = find_rise(frequencies, moduli) if moduli else None
        if rise is not None:
            text = (
                f"at {_name_frequency(frequencies[rise])} is too high: a storage modulus rises "
                "with the square of the frequency at most; correct this row or the one before"
            )
            raise EntryError(f"{key}[{rise}]", moduli[rise], text)
        fall = find_fall(moduli)
        if fall is not None:
            text = (
                f"at {_name_frequency(frequencies[fall])} is below the modulus at lower "
                "frequencies: a storage modulus does not fall with frequency; correct this row"
            )
            raise EntryError(f"{key}[{fall}]", moduli[fall], text)
        if self.dwell is None:
            needed_frequency = REFERENCE_FREQUENCY
            role = "at which the verdict is quoted"
        elif self.depends_on_rate:
            needed_frequency = float(f"{relaxation_frequency(self.dwell):.3g}")
            role = f"1/(pi^2 dwell) for dwell = {self.dwell!r}"
        else:
            text = "needs a modulus of time: give youngs_modulus_table or youngs_modulus_prony"
            raise EntryError("dwell", self.dwell, text)
        if table and not frequencies[0] <= needed_frequency <= frequencies[-1]:
            first, last, wanted = map(
                _name_frequency, (frequencies[0], frequencies[-1], needed_frequency)
            )
            text = f"runs from {first} to {last} and must cover {wanted}, {role}"
            raise EntryError(key, None, text)
        return self

    @model_validator(mode="after")
    def check_shape(self) -> Self:
        """Check what only layers and skins have, and fill in that layers are bonded."""
        if self.thickness is None and self.backing is not None:
            text = "belongs to a layer: give its thickness, too"
            raise EntryError("backing", self.backing, text)
        if self.thickness is not None and self.skin is not None:
            text = "a layer cannot have a skin: leave out thickness, or skin"
            raise EntryError("thickness", self.thickness, text)
        for key, name in (("thickness", "a layer"), ("skin", "a skin")):
            if getattr(self, key) is None:
                continue
            if self.plane_strain_modulus is not None:
                text = f"{name} needs youngs_modulus and poisson_ratio, not plane_strain_modulus"
                raise EntryError(key, None, text)
            if self.poisson_ratio < 0:
                text = f"must be between 0 and 0.5 with {name}"
                raise EntryError("poisson_ratio", self.poisson_ratio, text)
        if self.thickness is not None and self.backing is None:
            self.fill_in("backing", "bonded")
        return self

    @model_validator(mode="after")
    def check_surface(self, info: ValidationInfo) -> Self:
        """Check that the surface of the solid itself is among those of the configuration."""
        surfaces = (info.context or {}).get("surfaces")
        if surfaces is not None and self.surface not in (None, *surfaces):
            text = f"unknown name; {suggest(self.surface, surfaces)}"
            raise EntryError("surface", self.surface, text)
        return self

    @model_validator(mode="after")
    def find_what_follows(self) -> Self:
        """Find E* at which the verdict is made, and the solid, from the keys that are given."""
        if self.pressed is None:
            self.fill_in("pressed", 0.0)
        if self.plane_strain_modulus is None:
            self.fill_in("plane_strain_modulus", self._find_plane_strain_modulus())
        if self.solid is None:
            self.fill_in("solid", self._find_solid())
        else:
            self._check_solid()
        if isinstance(self.solid, Skin) and self.solid.modulus_ratio < 1:
            text = (
                f"has {self.solid.modulus_ratio:.3g} times the modulus of what is below it. A "
                "verdict needs a skin that is at least as stiff; describe a soft coat as a layer"
            )
            raise EntryError("solid" if self.skin is None else "skin", None, text)
        return self

    def _find_plane_strain_modulus(self) -> float:
        if self.dwell is None:
            return float(self.plane_strain.storage(REFERENCE_FREQUENCY))
        return float(self.plane_strain.relaxation(self.dwell))

    def _find_solid(self) -> Solid:
        """Half-space, with a skin or without, or layer on a rigid base or a film."""
        if self.thickness is None and self.skin is None:
            return HALF_SPACE
        assert self.poisson_ratio is not None
        youngs_modulus = self.plane_strain_modulus * (1 - self.poisson_ratio**2)
        if self.thickness is None:
            assert self.skin is not None
            return Skin(
                thickness=float(self.skin.thickness),
                modulus_ratio=self.skin.modulus / youngs_modulus,
                skin_poisson=self.skin.poisson,
                poisson=self.poisson_ratio,
            )
        backing: Any = self.backing
        if isinstance(backing, FilmEntry):
            backing = Film(
                modulus_ratio=backing.youngs_modulus / youngs_modulus,
                poisson=backing.poisson_ratio,
                thickness=float(backing.thickness),
            )
        return Layer(thickness=float(self.thickness), poisson=self.poisson_ratio, backing=backing)

    def _check_solid(self) -> None:
        """Check a solid that was given as such."""
        for key in ("thickness", "skin"):
            if getattr(self, key) is not None:
                text = "is part of solid: give one of them"
                raise EntryError(key, getattr(self, key), text)
        if not isinstance(self.solid, HalfSpace) and self.poisson_ratio != self.solid.poisson:
            text = f"must equal the solid's, {self.solid.poisson!r}"
            raise EntryError("poisson_ratio", self.poisson_ratio, text)

    @model_serializer(mode="wrap")
    def leave_out_what_follows(self, write: SerializerFunctionWrapHandler) -> dict[str, Any]:
        """Write only what was given of what Python always has as numbers."""
        entry: dict[str, Any] = write(self)
        follows = {"plane_strain_modulus", "pressed"} - self.model_fields_set
        return entry | dict.fromkeys(follows)

    def __repr_args__(self) -> list[tuple[str, Any]]:
        given = [key for key in type(self).model_fields if key in self.model_fields_set]
        return [(key, getattr(self, key)) for key in given]

    __str__ = Section.__repr__

    @classmethod
    def from_entry(
        cls, entry: Mapping[str, Any], surfaces: Mapping[str, Any] | None = None
    ) -> Self:
        """Make a material of a checked entry of the configuration, with values in SI units.

        `surfaces` holds, by name, the surfaces of materials that are rough themselves.
        """
        name = entry.get("surface")
        surface = (surfaces or {}).get(name, name) if name else None
        return cls(**{**entry, "surface": surface})

    @classmethod
    def read(cls, path: str | Path, name: str | None = None) -> Self:
        """Read a material from a YAML file of the form ``materials: {my_tape: {…}}``.

        Parameters
        ----------
        path : path
            The file; its keys are those of the configuration, see docs/guides/tape.md.
        name : str, optional
            Which material to read; by default the only one in the file.

        Raises
        ------
        ValueError
            If the file is not valid, or if it holds several materials and no name is given.
        """
        from stickiness.entries import read_materials

        entries = read_materials(path)
        if name is None and len(entries) > 1:
            raise ValueError(f"{path} holds several materials; give one of {', '.join(entries)}")
        return cls.from_entry(entries[next(iter(entries)) if name is None else name])

    def replace(self, **changes: Any) -> Self:
        """Return the material with other values of some keys.

        A key takes the place of those that exclude it: of one modulus another, of a thickness a
        `solid`. None leaves a key out.
        """
        changes = take_old_names(changes)
        given = {key: getattr(self, key) for key in self.model_fields_set}
        for choices in (*self.one_of, ("solid", "thickness"), ("solid", "skin")):
            if any(changes.get(key) is not None for key in choices):
                given = {key: value for key, value in given.items() if key not in choices}
        if changes.get("thickness", given.get("thickness")) is None:
            given.pop("backing", None)
        return type(self)(**given | changes)

    @property
    def depends_on_rate(self) -> bool:
        """Whether the modulus depends on time or frequency."""
        return not (self.youngs_modulus_table is None and self.youngs_modulus_prony is None)

    @cached_property
    def plane_strain(self) -> Modulus:
        """Plane-strain modulus E* [Pa] as a function of time and frequency."""
        if self.is_plane_strain:
            return Constant(float(self.plane_strain_modulus))
        stated = self.stated_modulus
        modulus = stated if isinstance(stated, Prony | Table) else Constant(stated)
        return modulus.scaled(1 / (1 - self.poisson_ratio**2))

    @property
    def stated_modulus(self) -> float | Prony | Table:
        """Young's modulus [Pa], or E*, in the form that was given."""
        if self.youngs_modulus_table is not None:
            frequencies, moduli = zip(*self.youngs_modulus_table, strict=True)
            return Table(frequencies=frequencies, moduli=moduli)
        if self.youngs_modulus_prony is not None:
            series = self.youngs_modulus_prony
            return Prony(series.equilibrium, tuple(series.terms))
        given = self.plane_strain_modulus if self.youngs_modulus is None else self.youngs_modulus
        return float(given)

    @cached_property
    def instant_ratio(self) -> float:
        """Largest modulus known over that after the dwell; 1 without a dwell.

        Fast separation takes at most so many times the work and the stress of slow separation.
        """
        if self.dwell is None:
            return 1.0
        return self.plane_strain.largest / self.plane_strain_modulus

    @property
    def is_plane_strain(self) -> bool:
        """Whether the modulus was given as E*."""
        return "plane_strain_modulus" in self.model_fields_set

    @property
    def quoted_modulus(self) -> float:
        """Modulus [Pa] of the verdict as it was given: Young's, or E*."""
        stated = self.stated_modulus
        if not isinstance(stated, Prony | Table):
            return stated
        return self.plane_strain_modulus * (1 - self.poisson_ratio**2)

    @property
    def doubts(self) -> tuple[str, ...]:
        """Sentences about values that hardly any real pair has."""
        name = "plane_strain_modulus" if self.is_plane_strain else "youngs_modulus"
        values = {name: self.quoted_modulus, "range": self.range}
        if self.poisson_ratio is not None:
            values["poisson_ratio"] = self.poisson_ratio
        if not self.work_on_smooth:
            values["work_of_adhesion"] = self.work_of_adhesion
        if isinstance(self.solid, Skin):
            values["skin_thickness"] = self.solid.thickness
        elif not isinstance(self.solid, HalfSpace):
            values["thickness"] = self.solid.thickness
        return tuple(find_doubts(**values))

    @property
    def modulus(self) -> float | Prony | Table:
        """Old name of the modulus that was given."""
        warn_of_old_name("modulus", OLD_NAMES["modulus"])
        return self.stated_modulus

    @property
    def poisson(self) -> float | None:
        """Old name of Poisson's ratio."""
        warn_of_old_name("poisson", OLD_NAMES["poisson"])
        return self.poisson_ratio


def _stretch(modulus: float, ratio: float) -> Quantity:
    """Modulus times a ratio."""
    stretched = modulus * ratio
    return Quantity(stretched, amount(stretched, "Pa", 6))


def _name_frequency(frequency: float) -> str:
    return getattr(frequency, "text", f"{frequency:g} Hz")


f.document(Material)


class Materials(Section):
    """The file of materials."""

    materials: f.Names[Material] = needed("materials by name")
