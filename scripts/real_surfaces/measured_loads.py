"""Loads and solid of a contact of measured heights, as configured."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from common.config.entries import MOST_POINTS, has_units
from criteria.materials import Material, read_material
from stickiness.adhesive.laws import Exponential
from stickiness.units import si


@dataclass(frozen=True)
class Solid:
    """Modulus, work of adhesion and range of attraction, in SI units."""

    modulus: float  # E*
    work_of_adhesion: float
    range: float

    @classmethod
    def of(cls, material: Material):
        """Take what the contact needs of a material."""
        return cls(material.modulus, material.work_of_adhesion, material.range)

    def scaled_law(self, q0: float, h_rms: float) -> Exponential:
        """Return the law where heights are over h_rms, lengths times q0, p over E* q0 h_rms."""
        length = self.work_of_adhesion / self.modulus
        return Exponential(adhesion_length=length / (q0 * h_rms**2), range=self.range / h_rms)


@dataclass(frozen=True)
class Setting:
    """Loads and settings: pressures over E* q0 h_rms, ranges over h_rms."""

    pressures: NDArray  # over E* alone if `absolute`
    ranges: NDArray
    pixels: int  # per shortest wavelength, at least
    tolerance: float
    gamma: float  # of the theory
    absolute: bool = False
    solid: Solid | None = None  # for contact with adhesion
    ways: tuple[str, ...] = ("taper", "mirror")
    own_grid: bool = False  # periodic heights are not resampled
    most_points: int = MOST_POINTS

    def scaled_pressures(self, roughness: float) -> NDArray:
        """Pressures over E* q0 h_rms, of heights with this q0 h_rms."""
        return self.pressures / roughness if self.absolute else self.pressures


def read_loads(bem):
    """Read pressures, whether they are over E* alone, and the solid, as keywords of `Setting`."""
    solid = Solid.of(read_material(bem["adhesion"])) if "adhesion" in bem else None
    pressures, absolute = bem["pressures"], has_units(bem["pressures"])
    if absolute:
        pressures = [si(pressure, "Pa") / solid.modulus for pressure in pressures]
    return {"pressures": np.sort(pressures), "absolute": absolute, "solid": solid}
