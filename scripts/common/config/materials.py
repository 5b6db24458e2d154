"""Models of config/materials.yaml."""

from typing import Literal

from common.config import fields as f
from common.config.fields import Section, needed, optional
from stickiness.solids.moduli import relaxation_frequency

_MODULI = ("plane_strain_modulus", "youngs_modulus and poisson_ratio")


class ElasticPair(Section):
    """Elasticity and adhesion of a pair of solids."""

    one_of = (_MODULI,)

    plane_strain_modulus: f.Modulus = optional('E* of the pair, e.g. "2 MPa"')
    youngs_modulus: f.Modulus = optional('Young\'s modulus, e.g. "3 GPa"')
    poisson_ratio: f.number(gt=-1, le=0.5) = optional("Poisson's ratio")
    work_of_adhesion: f.Energy = needed('work of adhesion of the pair, e.g. "50 mJ/m^2"')
    range: f.Range = needed('range of the attraction, e.g. "0.2 nm"')


class Prony(Section):
    """Prony series of Young's modulus, e.g. `[["0.3 MPa", "1 ms"]]` for its terms."""

    equilibrium: f.Modulus = needed('modulus at rest, e.g. "30 kPa"')
    terms: f.Several[f.both(f.Modulus, f.Time)] = needed("pairs of modulus and relaxation time")


class Film(Section):
    """Film that carries an adhesive, such as that of a tape; it bends as a plate."""

    youngs_modulus: f.Modulus = needed('Young\'s modulus of the film, e.g. "3 GPa"')
    poisson_ratio: f.Poisson = needed("Poisson's ratio of the film")
    thickness: f.Length = needed('thickness of the film, e.g. "25 um"')


class Material(ElasticPair, f.Labelled):
    """An elastic solid against a rigid rough counterface."""

    one_of = (
        (*_MODULI, *(f"youngs_modulus_{kind} and poisson_ratio" for kind in ("table", "prony"))),
    )

    youngs_modulus_table: f.AtLeastTwo[f.both(f.Frequency, f.Modulus)] = optional(
        'pairs of ascending frequency and storage modulus: [["1 Hz", "50 kPa"], ...]'
    )
    youngs_modulus_prony: Prony = optional("Prony series of Young's modulus")
    dwell: f.Time = optional('time for which contact is made, e.g. "60 s"')
    broken_at: f.Frequency = optional("rate at which contact is broken after a dwell (1 Hz)")
    thickness: f.Thickness = optional("thickness of a layer; without it infinitely deep")
    backing: f.by_type(dict, Film, Literal["bonded", "slip"]) = optional(
        "a layer is bonded to a rigid base (default), slips on it, or is bonded to a film"
    )
    surface: str = optional("name of the rough surface of the solid itself, added to the other")
    pressed: f.Pressure = optional('pressure before separation, e.g. "10 kPa"; a touch without it')
    law: f.PredictedLaw = optional(
        "traction law; default exponential. The range of van_der_waals is D0"
    )

    def _problems(self, context):
        frequencies = [frequency for frequency, _ in self.youngs_modulus_table or []]
        if frequencies != sorted(set(frequencies)):
            listed = ", ".join(frequency.text for frequency in frequencies)
            yield f"youngs_modulus_table = {listed}: frequencies must ascend"
        covered = {self.broken_at or f.Quantity("1 Hz", "Hz"): "at which the verdict is quoted"}
        if self.dwell is not None:
            slow = f.Quantity(f"{relaxation_frequency(self.dwell):.3g} Hz", "Hz")
            covered[slow] = f"1/(pi^2 dwell) for dwell = {self.dwell!r}"
            if not frequencies and self.youngs_modulus_prony is None:
                yield f"dwell = {self.dwell!r}: give youngs_modulus_table or youngs_modulus_prony"
        elif self.broken_at is not None:
            yield f"broken_at = {self.broken_at!r} belongs to a dwell: give it, too"
        for frequency, role in covered.items():
            if frequencies and not frequencies[0] <= frequency <= frequencies[-1]:
                yield (
                    f"youngs_modulus_table runs from {frequencies[0].text} to "
                    f"{frequencies[-1].text} and must cover {frequency.text}, {role}"
                )
        if self.surface is not None and self.surface not in context["surfaces"]:
            yield f.unknown("surface", self.surface, context["surfaces"])
        if self.thickness is None:
            if self.backing is not None:
                yield f"backing = {self.backing!r} belongs to a layer: give its thickness, too"
            return
        if self.plane_strain_modulus is not None:
            yield (
                f"thickness = {self.thickness!r}: a layer needs youngs_modulus and poisson_ratio "
                "instead of plane_strain_modulus"
            )
        elif self.poisson_ratio < 0:
            yield f"poisson_ratio = {self.poisson_ratio:g} of a layer must be between 0 and 0.5"


class Materials(Section):
    """The file of materials."""

    materials: f.Names[Material] = needed("materials by name")
