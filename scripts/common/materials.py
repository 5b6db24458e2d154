"""Materials of the configuration in SI units."""

from dataclasses import dataclass, replace

import numpy as np

from common.formatting import number, unit_for
from stickiness.plausibility import LIMITS
from stickiness.solids import HALF_SPACE, Film, Layer, Solid
from stickiness.solids.moduli import REFERENCE_FREQUENCY, Constant, Modulus, Prony, Table
from stickiness.traction_laws import EXPONENTIAL
from stickiness.units import si

LEAST_READABLE, MOST_READABLE = 0.01, 1e3  # numbers in the unit that a modulus was given in
RATE_KEYS = ("youngs_modulus_table", "youngs_modulus_prony")


@dataclass(frozen=True)
class Material:
    """Pair of a solid and a rigid rough counterface."""

    plane_strain: Modulus  # E* [Pa] against the frequency
    work_of_adhesion: float  # J/m^2
    range: float  # of the attraction, m
    depends_on_rate: bool  # whether the modulus is more than a constant
    solid: Solid = HALF_SPACE  # or a layer, thickness in m
    surface: str | None = None  # name of the rough surface of the material
    law: str = EXPONENTIAL  # name of the traction law
    pressed: float = 0.0  # mean pressure before separation, Pa
    dwell: float = np.nan  # time for which contact is made, s
    broken_at: float = REFERENCE_FREQUENCY  # Hz, after a dwell

    @property
    def modulus(self):
        """E* after the dwell, or without one at the reference frequency of 1 Hz [Pa]."""
        if np.isnan(self.dwell):
            return float(self.plane_strain.storage(REFERENCE_FREQUENCY))
        return float(self.plane_strain.relaxation(self.dwell))

    @property
    def separation_factor(self):
        """Factor on the work of separation (value, low, high); 1 without a dwell."""
        if np.isnan(self.dwell):
            return 1.0, 1.0, 1.0
        return self.plane_strain.separation_factor(self.dwell, self.broken_at)


def read_material(entry):
    """`Material` from its entry in the configuration."""
    material = Material(
        plane_strain=read_modulus(entry),
        work_of_adhesion=si(entry["work_of_adhesion"], "J/m^2"),
        range=si(entry["range"], "m"),
        depends_on_rate=any(key in entry for key in RATE_KEYS),
        surface=entry.get("surface"),
        law=entry.get("law", EXPONENTIAL),
        pressed=si(entry.get("pressed", "0 Pa"), "Pa"),
        dwell=si(entry["dwell"], "s") if "dwell" in entry else np.nan,
        broken_at=si(entry.get("broken_at", "1 Hz"), "Hz"),
    )
    return replace(material, solid=read_solid(entry, material.modulus))


def find_doubts(entry):
    """Sentences about values that hardly any real pair has, as the configuration states them."""
    for key, limits in LIMITS.items():
        if key in entry and si(entry[key], limits.unit) > limits.usual:
            name = f"{entry['label']}: {key.replace('_', ' ')}"
            yield f"{name} = {entry[key]} is improbable: {limits.reason}"


def read_solid(entry, modulus):
    """Half-space, or layer of this E* [Pa] on a rigid base or a film."""
    if "thickness" not in entry:
        return HALF_SPACE
    backing = entry.get("backing", "bonded")
    if not isinstance(backing, str):
        layer = modulus * (1 - entry["poisson_ratio"] ** 2)
        ratio = si(backing["youngs_modulus"], "Pa") / layer
        backing = Film(ratio, backing["poisson_ratio"], si(backing["thickness"], "m"))
    return Layer(si(entry["thickness"], "m"), entry["poisson_ratio"], backing)


def read_modulus(entry):
    """Modulus E* = E/(1 - nu^2) as a function of the frequency."""
    if "plane_strain_modulus" in entry:
        return Constant(si(entry["plane_strain_modulus"], "Pa"))
    factor = 1 / (1 - entry["poisson_ratio"] ** 2)
    if "youngs_modulus_table" in entry:
        pairs = [
            (si(hertz, "Hz"), factor * si(e, "Pa")) for hertz, e in entry["youngs_modulus_table"]
        ]
        return Table(*zip(*pairs, strict=True))
    if "youngs_modulus_prony" in entry:
        series = entry["youngs_modulus_prony"]
        terms = tuple(
            (factor * si(modulus, "Pa"), si(time, "s")) for modulus, time in series["terms"]
        )
        return Prony(factor * si(series["equilibrium"], "Pa"), terms)
    return Constant(factor * si(entry["youngs_modulus"], "Pa"))


def show_modulus(modulus, entry, digits=2, beside=()):
    """E* [Pa] as the modulus that the configuration gives, e.g. "E = 0.2 MPa".

    In the unit given there, or in one that suits it and all E* that are shown `beside` it.
    """
    name, factor, given = "E*", 1.0, entry.get("plane_strain_modulus")
    if given is None:
        name, factor = "E", 1 - entry["poisson_ratio"] ** 2
        (_, given), *_ = entry.get("youngs_modulus_table", [("", entry.get("youngs_modulus"))])
        given = given or entry["youngs_modulus_prony"]["equilibrium"]
    unit = given.lstrip("0123456789.+-eE ")
    shown = factor * np.array([modulus, *beside])
    per_pascal = 1 / si(f"1 {unit}", "Pa")
    if not LEAST_READABLE <= min(shown * per_pascal) <= max(shown * per_pascal) <= MOST_READABLE:
        per_pascal, unit = unit_for(max(shown), "Pa", 2)
    return f"{name} = {number(shown[0] * per_pascal, digits)} {unit}"
