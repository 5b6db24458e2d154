"""Closed forms of adhesive contact, to check numerical solutions against.

Lengths are in one unit of the caller's choice, pressures in units of the plane-strain modulus E*,
forces in units of E* times length squared. The adhesion length is l_a = (work of adhesion)/E*.
Pressures, forces and indentations are positive in compression, so a pull-off force is negative.
Radii, wavelengths, adhesion lengths and ranges must be positive and finite: ValueError otherwise.

Which model holds for a sphere of radius R depends on `tabor_parameter`: `JKRSphere` from about 5
on, `DMTSphere` below about 0.1, `MaugisSphere` anywhere for the Maugis law; `derjaguin_force` is
the rigid limit for every law. Paraboloids stand for spheres: contact radii are small against R.
For a wave, `AdhesiveWave` is the limit of short range, `MaugisWave` holds for any range.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.adhesive.laws import TractionLaw
from stickiness.arguments import plain, positive
from stickiness.closed_forms.contact import Hertz, PositiveFields, full_contact_pressure
from stickiness.closed_forms.maugis_sphere import (
    MaugisSphere,
    SphereState,
    check_force,
    maugis_parameter,
    tabor_parameter,
)
from stickiness.closed_forms.wave import AdhesiveWave, MaugisWave, WaveState

__all__ = [
    "AdhesiveWave",
    "DMTSphere",
    "JKRSphere",
    "MaugisSphere",
    "MaugisWave",
    "SphereState",
    "WaveState",
    "critical_wavelength",
    "derjaguin_force",
    "flat_pull_off",
    "full_contact_pull_off",
    "maugis_parameter",
    "tabor_parameter",
]


@dataclass(frozen=True)
class _Sphere(PositiveFields):
    """Radius and adhesion length, checked."""

    radius: float
    adhesion_length: float


@dataclass(frozen=True)
class JKRSphere(_Sphere):
    """Adhesive contact of a half-space with a paraboloid, attraction of vanishing range.

    Valid for `tabor_parameter` above about 5. ValueError by methods, if a force lies beyond
    pull-off. Johnson, Kendall & Roberts, Proc. R. Soc. A 324, 301 (1971),
    doi:10.1098/rspa.1971.0141.

    Parameters
    ----------
    radius, adhesion_length : float
        Radius of curvature, work of adhesion over E* [length].
    """

    @property
    def pull_off_force(self) -> float:
        """Least force under load control, -3/2 pi R l_a."""
        return -1.5 * np.pi * self.radius * self.adhesion_length

    @property
    def pull_off_radius(self) -> float:
        """Contact radius [length] at `pull_off_force`."""
        return float(np.cbrt(9 * np.pi * self.adhesion_length * self.radius**2 / 8))

    @property
    def separation_radius(self) -> float:
        """Contact radius [length] at which contact is lost under displacement control."""
        return float(np.cbrt(np.pi * self.adhesion_length * self.radius**2 / 8))

    @property
    def separation_indentation(self) -> float:
        """Least (most negative) indentation [length], -3 a^2/R at `separation_radius`."""
        return -3 * self.separation_radius**2 / self.radius

    @property
    def separation_force(self) -> float:
        """Force at `separation_indentation`, -5/6 pi R l_a."""
        return -5 / 6 * np.pi * self.radius * self.adhesion_length

    def force(self, contact_radius: ArrayLike):
        """Force [E* length^2] of a contact of given radius [length], on either branch."""
        (a,) = positive(contact_radius=contact_radius)
        lost = np.sqrt(8 * np.pi * self.adhesion_length * a**3)
        return plain(4 * a**3 / (3 * self.radius) - lost)

    def indentation(self, contact_radius: ArrayLike):
        """Approach of distant points [length] at a given contact radius [length]."""
        (a,) = positive(contact_radius=contact_radius)
        return plain(a**2 / self.radius - self._stretch(a))

    def contact_radius(self, force: float) -> float:
        """Contact radius [length] at a force, on the branch that is stable under load control."""
        force = check_force(force, self.pull_off_force)
        unit = -self.pull_off_force
        # F + 3 pi R w + sqrt(...) is the perfect square (sqrt(unit) + sqrt(F + unit))^2.
        root = np.sqrt(unit) + np.sqrt(force + unit)
        return float(np.cbrt(0.75 * self.radius * root**2))

    def repulsive_radius(self, contact_radius: ArrayLike):
        """Radius [length] within which the pressure is positive; zero if it is so nowhere."""
        (a,) = positive(contact_radius=contact_radius)
        share = self._stretch(a) * self.radius / (2 * a**2)
        return plain(a * np.sqrt(np.maximum(1 - share, 0)))

    def contact_pressure(self, r: ArrayLike, contact_radius: float):
        """Pressure [E*] at distances `r` [length] from the axis; zero outside contact.

        At the edge it tends to minus infinity as an inverse square root.
        """
        (a,) = positive(contact_radius=contact_radius)
        r = np.asarray(r, dtype=float)
        root = np.sqrt(np.maximum(1 - (r / a) ** 2, 0))
        with np.errstate(divide="ignore"):
            tension = self._stretch(a) / (np.pi * a * root)
        return plain(np.where(r > a, 0.0, 2 * a * root / (np.pi * self.radius) - tension))

    def gap(self, r: ArrayLike, contact_radius: float):
        """Gap [length] at distances `r` [length] from the axis; zero in contact."""
        (a,) = positive(contact_radius=contact_radius)
        hertz = Hertz(self.radius, float(4 * a**3 / (3 * self.radius)))
        ratio = np.maximum(np.asarray(r, dtype=float) / a, 1.0)
        return plain(hertz.gap(r) + self._stretch(a) * 2 / np.pi * np.arccos(1 / ratio))

    def _stretch(self, a: NDArray) -> NDArray:
        """Displacement [length] of the flat punch superposed on the Hertzian solution."""
        return np.sqrt(2 * np.pi * self.adhesion_length * a)


@dataclass(frozen=True)
class DMTSphere(_Sphere):
    """Adhesive contact with a paraboloid when attraction does not deform it.

    Hertz' contact under the force plus 2 pi R l_a. Valid for `tabor_parameter` below about 0.1.
    Derjaguin, Muller & Toporov, J. Colloid Interface Sci. 53, 314 (1975),
    doi:10.1016/0021-9797(75)90018-1; in this form Maugis (1992). Parameters and errors are those
    of `JKRSphere`.
    """

    @property
    def pull_off_force(self) -> float:
        """Least force, -2 pi R l_a, at which the contact shrinks to a point."""
        return -2 * np.pi * self.radius * self.adhesion_length

    def contact_radius(self, force: float) -> float:
        """Contact radius [length] at a force [E* length^2]."""
        force = check_force(force, self.pull_off_force)
        return float(np.cbrt(0.75 * self.radius * (force - self.pull_off_force)))

    def indentation(self, force: float) -> float:
        """Approach of distant points [length] at a force [E* length^2]."""
        return self.contact_radius(force) ** 2 / self.radius


def derjaguin_force(radius: float, law: TractionLaw, separation: ArrayLike):
    """Force [E* length^2] between a rigid paraboloid and a rigid flat, negative in attraction.

    The rigid limit, `tabor_parameter` to zero, of any law: -2 pi R times the work still to be done
    at a least gap `separation` [length]. At contact, for laws that only attract, the pull-off force
    is -2 pi R l_a. Bradley, Philos. Mag. 13, 853 (1932), doi:10.1080/14786449209461990; Derjaguin,
    Kolloid-Z. 69, 155 (1934), doi:10.1007/BF01433225.
    """
    (radius,) = positive(radius=radius)
    return plain(2 * np.pi * radius * np.asarray(law.potential(separation)))


def flat_pull_off(law: TractionLaw) -> float:
    """Mean pressure [E*] at which parallel flats come apart: minus the strength of the law."""
    return -float(law.strength)


def full_contact_pull_off(heights: ArrayLike, length: float | tuple, law: TractionLaw) -> float:
    """Mean pressure [E*] below which full contact with a hard wall is no longer in equilibrium.

    Contact is held as long as the tension is nowhere above the traction at zero gap, and that
    tension is the full-contact one. Down to there it is also stable: every point has a positive
    repulsive pressure, so that any small opening costs energy to first order. For the wave
    ``d cos(2 pi x/l)`` it is ``pi d/l`` minus the strength, for the product of two such waves
    ``sqrt(2) pi d/l`` minus it. Heights and length [length] as for `full_contact_pressure`.
    """
    fluctuation = full_contact_pressure(heights, length, 0.0)
    return float(-fluctuation.min() - law.traction(0.0))


def critical_wavelength(slope: ArrayLike):
    """Wavelength [length] above which parallel flats at a uniform gap are unstable.

    A wave of the gap is resisted by the stiffness ``|q|/2`` of the half-space and driven by
    `slope`, the derivative of the traction with respect to the gap [E*/length], negative and finite
    (else ValueError): the gap is stable at a fixed mean while ``pi/wavelength`` exceeds minus
    that slope. In a periodic cell the longest wavelength is the side, whatever its amplitude.
    """
    (steepness,) = positive(**{"-slope": -np.asarray(slope, dtype=float)})
    return plain(np.pi / steepness)
