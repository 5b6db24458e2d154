"""Materials: elasticity and adhesion of the solid that touches a rough surface, in SI units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from stickiness.arguments import number
from stickiness.plausibility import LIMITS, find_doubts
from stickiness.solids import HALF_SPACE, Film, HalfSpace, Layer, Skin, Solid, check_solid
from stickiness.solids.moduli import REFERENCE_FREQUENCY, Constant, Modulus, Prony, Table
from stickiness.traction_laws import EXPONENTIAL, PREDICTED

if TYPE_CHECKING:
    from stickiness.verdicts.rough_surface import Surface


@dataclass(frozen=True, kw_only=True)
class Material:
    """A solid that touches a rough surface, and its adhesion to that surface.

    Parameters
    ----------
    modulus : float or solids.moduli.Prony or solids.moduli.Table
        Young's modulus [Pa], or the plane-strain modulus E* if `poisson` is None. A Prony series
        or a table gives it as a function of time or frequency.
    poisson : float or None
        Poisson's ratio, 0.5 by default, so that E* = modulus/(1 - poisson^2). None: `modulus` is
        E* itself.
    work_of_adhesion : float
        Work of adhesion of the pair [J/m^2].
    work_on_smooth : bool
        Whether the work of adhesion is that of smooth surfaces, without dissipation. Else one above
        0.2 J/m^2 is doubted, because energies of peeling contain dissipation.
    range : float
        Range of the attraction [m].
    solid : HalfSpace, Layer or Skin
        Shape of the solid, thickness in m; see `stickiness.solids`. `modulus` is that of the layer,
        or of the half-space below a skin, and `work_of_adhesion` that of the surface.
    law : str
        Traction law: "exponential" or "van_der_waals".
    pressed : float
        Mean pressure [Pa] that pressed the pair together before separation.
    dwell : float, optional
        Time [s] for which contact is made. Then the relaxation modulus at this time decides, and
        the high limits allow for separation with the instantaneous modulus.
    surface : Surface, optional
        Roughness of the solid itself, which adds to that of the other.
    label : str
        Name for readers.

    Raises
    ------
    ValueError
        If a number is not positive and finite, if `poisson` is not above -1 and at most 0.5, if a
        layer or half-space has another Poisson's ratio, or if `modulus` is not known at the time or
        frequency at which the verdict is made.

    Examples
    --------
    >>> tape = Material(modulus=2e5, work_of_adhesion=0.06, range=3e-10)
    >>> print(f"E* = {tape.plane_strain_modulus / 1e3:.0f} kPa")
    E* = 267 kPa
    """

    modulus: float | Prony | Table
    work_of_adhesion: float
    range: float
    poisson: float | None = 0.5
    solid: Solid = HALF_SPACE
    law: str = EXPONENTIAL
    pressed: float = 0.0
    dwell: float | None = None
    surface: Surface | None = None
    work_on_smooth: bool = False
    label: str = "the material"

    def __post_init__(self):
        if not self.depends_on_rate:
            _check_size("modulus", self.modulus)
        _check_size("work_of_adhesion", self.work_of_adhesion)
        _check_size("range", self.range)
        number("pressed", self.pressed, zero=True)
        if self.poisson is not None and not -1 < self.poisson <= 0.5:
            raise ValueError(f"poisson must be above -1 and at most 0.5, got {self.poisson!r}")
        check_solid(self.solid)
        if isinstance(self.solid, Skin) and self.solid.modulus_ratio < 1:
            raise ValueError(
                f"solid: the skin has {self.solid.modulus_ratio:.3g} times the modulus of what is "
                "below it. A verdict needs a skin that is at least as stiff; describe a soft coat "
                "as a layer"
            )
        if not isinstance(self.solid, HalfSpace) and self.poisson != self.solid.poisson:
            part = "half-space below the skin" if isinstance(self.solid, Skin) else "layer"
            raise ValueError(
                f"poisson = {self.poisson!r} must equal the solid's, {self.solid.poisson!r}: "
                f"`modulus` is that of the {part}"
            )
        if self.surface is not None and not hasattr(self.surface, "scenarios"):
            raise ValueError(f"surface must be a Surface, got {self.surface!r}")
        if self.law not in PREDICTED:
            raise ValueError(f"law must be one of {', '.join(PREDICTED)}, got {self.law!r}")
        if self.dwell is not None:
            number("dwell", self.dwell)
            if not self.depends_on_rate:
                raise ValueError(
                    f"dwell = {self.dwell!r} needs a modulus that depends on time: give a Prony "
                    "series or a table"
                )
        if not np.isfinite(self.plane_strain_modulus):
            raise ValueError(
                "modulus: the table must cover the frequency at which the verdict is made: 1 Hz, "
                "or after a dwell 1/(pi^2 dwell)"
            )

    @classmethod
    def from_entry(
        cls, entry: Mapping[str, Any], surfaces: Mapping[str, Surface] | None = None
    ) -> Material:
        """Make a material of a checked entry of the configuration, with values in SI units.

        `surfaces` holds, by name, the surfaces of materials that are rough themselves.
        """
        material = cls(
            modulus=_read_modulus(entry),
            poisson=entry["poisson_ratio"] if entry["plane_strain_modulus"] is None else None,
            work_of_adhesion=float(entry["work_of_adhesion"]),
            range=float(entry["range"]),
            law=entry.get("law") or EXPONENTIAL,
            pressed=float(entry.get("pressed") or 0.0),
            dwell=entry.get("dwell"),
            surface=_find_surface(entry.get("surface"), surfaces),
            work_on_smooth=bool(entry.get("work_on_smooth")),
            label=entry.get("label") or cls.label,
        )
        return replace(material, solid=_read_solid(entry, material))

    @classmethod
    def read(cls, path: Any, name: str | None = None) -> Material:
        """Read a material from a YAML file of the form ``materials: {my_tape: {…}}``.

        Parameters
        ----------
        path : path
            The file; its keys are those of the configuration, see docs/inputs.md.
        name : str, optional
            Which material to read; by default the only one in the file.

        Raises
        ------
        ValueError
            If the file is not valid, or if it holds several materials and no name is given.
        """
        from stickiness.entries import read_materials  # needs pydantic, which little else does

        entries = read_materials(path)
        if name is None and len(entries) > 1:
            raise ValueError(f"{path} holds several materials; give one of {', '.join(entries)}")
        return cls.from_entry(entries[next(iter(entries)) if name is None else name])

    @property
    def depends_on_rate(self) -> bool:
        """Whether the modulus depends on time or frequency."""
        return isinstance(self.modulus, Prony | Table)

    @cached_property
    def plane_strain(self) -> Modulus:
        """Plane-strain modulus E* [Pa] as a function of time and frequency."""
        modulus = self.modulus if self.depends_on_rate else Constant(float(self.modulus))
        return modulus if self.poisson is None else modulus.scaled(1 / (1 - self.poisson**2))

    @cached_property
    def plane_strain_modulus(self) -> float:
        """Plane-strain modulus E* [Pa] of the verdict: after the dwell, or at 1 Hz without one."""
        if self.dwell is None:
            return float(self.plane_strain.storage(REFERENCE_FREQUENCY))
        return float(self.plane_strain.relaxation(self.dwell))

    @cached_property
    def instant_ratio(self) -> float:
        """Largest modulus known over that after the dwell; 1 without a dwell.

        Fast separation takes at most so many times the work and the stress of slow separation.
        """
        if self.dwell is None:
            return 1.0
        return self.plane_strain.largest / self.plane_strain_modulus

    def on_contact(self, contact: float) -> Material:
        """The material with its own roughness as a contact of a side [m] meets it."""
        if self.surface is None:
            return self
        return replace(self, surface=self.surface.on_contact(contact))

    @property
    def quoted_modulus(self) -> float:
        """Modulus [Pa] of the verdict as it was given: Young's, or E* if `poisson` is None."""
        if not self.depends_on_rate:
            return float(self.modulus)
        return self.plane_strain_modulus * (1 - (self.poisson or 0.0) ** 2)

    @property
    def doubts(self) -> tuple[str, ...]:
        """Sentences about values that hardly any real pair has."""
        values = {"modulus": self.quoted_modulus, "range": self.range}
        if self.poisson is not None:
            values["poisson"] = self.poisson
        if not self.work_on_smooth:
            values["work_of_adhesion"] = self.work_of_adhesion
        if isinstance(self.solid, Skin):
            values["skin_thickness"] = self.solid.thickness
        elif not isinstance(self.solid, HalfSpace):
            values["thickness"] = self.solid.thickness
        return tuple(find_doubts(**values))


def _check_size(name: str, value: float) -> None:
    """Raise a ValueError unless a value in SI units leaves products of it within floats."""
    if not 1e-30 <= number(name, value) <= 1e30:
        unit = LIMITS[name].unit
        raise ValueError(
            f"{name} must be between 1e-30 and 1e30 {unit}, got {value!r}: {LIMITS[name].reason}"
        )


def _find_surface(name: str | None, surfaces: Mapping[str, Surface] | None) -> Surface | None:
    """Surface of this name, of a material that is rough itself."""
    if not name:
        return None
    if name not in (surfaces or {}):
        raise ValueError(
            f"surface = {name!r}: the roughness of a material itself is known only to the "
            "workflow, by the surfaces of its configuration; in Python give Material(surface=…)"
        )
    return surfaces[name]


def _read_modulus(entry: Mapping[str, Any]) -> float | Prony | Table:
    """Young's modulus, or E*, of an entry of the configuration."""
    if entry["plane_strain_modulus"] is not None:
        return float(entry["plane_strain_modulus"])
    if entry.get("youngs_modulus_table") is not None:
        frequencies, moduli = zip(*entry["youngs_modulus_table"], strict=True)
        return Table(frequencies=frequencies, moduli=moduli)
    if entry.get("youngs_modulus_prony") is not None:
        series = entry["youngs_modulus_prony"]
        return Prony(series["equilibrium"], tuple(map(tuple, series["terms"])))
    return float(entry["youngs_modulus"])


def _read_solid(entry: Mapping[str, Any], material: Material) -> Solid:
    """Half-space, with a skin or without, or layer on a rigid base or a film, of an entry."""
    poisson = entry["poisson_ratio"]
    skin = entry.get("skin")
    if skin is not None:
        youngs_modulus = material.plane_strain_modulus * (1 - poisson**2)
        return Skin(
            thickness=float(skin["thickness"]),
            modulus_ratio=skin["modulus"] / youngs_modulus,
            skin_poisson=skin["poisson"],
            poisson=poisson,
        )
    if entry.get("thickness") is None:
        return HALF_SPACE
    backing = entry["backing"]
    if isinstance(backing, Mapping):
        youngs_modulus = material.plane_strain_modulus * (1 - poisson**2)
        backing = Film(
            modulus_ratio=backing["youngs_modulus"] / youngs_modulus,
            poisson=backing["poisson_ratio"],
            thickness=float(backing["thickness"]),
        )
    return Layer(thickness=float(entry["thickness"]), poisson=poisson, backing=backing)
