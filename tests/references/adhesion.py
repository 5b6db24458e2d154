"""Closed forms of adhesive contact: spheres in the limits and between them, one-dimensional waves.

Lengths are in one unit of the caller's choice, pressures in units of the plane-strain modulus E*,
forces in units of E* times length squared. The adhesion length is l_a = (work of adhesion)/E*.
Pressures, forces and indentations are positive in compression, so that a pull-off force is
negative.

A sphere of radius R is that of JKR for Tabor parameters (R l_a^2/range^3)^(1/3) above about 5, and
of DMT below about 0.1; `MaugisSphere` holds for any range. Paraboloids stand for spheres: contact
radii are small against R.

A rigid wave is ``amplitude * cos(2 pi x / wavelength)``, x the distance from a crest. Phases are
psi = pi x / wavelength: contact of half-width a stands for psi_a = pi a / wavelength and the area
fraction ``2 psi_a / pi``. Fields are real and imaginary parts of one function of the complex phase,
as without adhesion. `AdhesiveWave` is the limit of short range.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import optimize

from stickiness.remaining import sphere

# Gauss-Legendre on [0, 1] after a substitution that is flat of third order at either end: it
# removes a square root at one and a logarithm at the other to some 1e-11.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(96)
_NODES = (_NODES + 1) / 2
_STEP = _NODES**3 * (10 - 15 * _NODES + 6 * _NODES**2)
_STEP_WEIGHTS = _WEIGHTS / 2 * 30 * _NODES**2 * (1 - _NODES) ** 2
_SAMPLES = 400  # points on which the curve of equilibria is searched for turning points


@dataclass(frozen=True)
class JKRSphere:
    """Adhesive contact of a half-space with a paraboloid, attraction of vanishing range.

    Johnson, Kendall & Roberts, Proc. R. Soc. A 324, 301 (1971), doi:10.1098/rspa.1971.0141.
    """

    radius: float
    adhesion_length: float

    @property
    def pull_off_force(self) -> float:
        """Least force under load control, -3/2 pi R l_a."""
        return -1.5 * np.pi * self.radius * self.adhesion_length

    @property
    def pull_off_radius(self) -> float:
        """Contact radius [length] at `pull_off_force`."""
        return float(np.cbrt(9 * np.pi * self.adhesion_length * self.radius**2 / 8))

    def force(self, contact_radius: ArrayLike):
        """Force [E* length^2] of a contact of given radius [length], on either branch."""
        a = np.asarray(contact_radius, dtype=float)
        lost = np.sqrt(8 * np.pi * self.adhesion_length * a**3)
        return 4 * a**3 / (3 * self.radius) - lost

    def indentation(self, contact_radius: ArrayLike):
        """Approach of distant points [length] at a given contact radius [length]."""
        a = np.asarray(contact_radius, dtype=float)
        return a**2 / self.radius - self._stretch(a)

    def contact_radius(self, force: float) -> float:
        """Contact radius [length] at a force, on the branch that is stable under load control."""
        unit = -self.pull_off_force
        # F + 3 pi R w + sqrt(...) is the perfect square (sqrt(unit) + sqrt(F + unit))^2.
        root = np.sqrt(unit) + np.sqrt(force + unit)
        return float(np.cbrt(0.75 * self.radius * root**2))

    def repulsive_radius(self, contact_radius: ArrayLike):
        """Radius [length] within which the pressure is positive; zero if it is so nowhere."""
        a = np.asarray(contact_radius, dtype=float)
        share = self._stretch(a) * self.radius / (2 * a**2)
        return a * np.sqrt(np.maximum(1 - share, 0))

    def _stretch(self, a: NDArray) -> NDArray:
        """Displacement [length] of the flat punch superposed on the Hertzian solution."""
        return np.sqrt(2 * np.pi * self.adhesion_length * a)


@dataclass(frozen=True)
class DMTSphere:
    """Adhesive contact with a paraboloid when attraction does not deform it.

    Hertz' contact under the force plus 2 pi R l_a. Derjaguin, Muller & Toporov, J. Colloid
    Interface Sci. 53, 314 (1975), doi:10.1016/0021-9797(75)90018-1; in this form Maugis (1992).
    """

    radius: float
    adhesion_length: float

    @property
    def pull_off_force(self) -> float:
        """Least force, -2 pi R l_a, at which the contact shrinks to a point."""
        return -2 * np.pi * self.radius * self.adhesion_length

    def contact_radius(self, force: float) -> float:
        return float(np.cbrt(0.75 * self.radius * (force - self.pull_off_force)))

    def indentation(self, force: float) -> float:
        return self.contact_radius(force) ** 2 / self.radius


@dataclass(frozen=True)
class SphereState:
    """One equilibrium of a sphere."""

    contact_radius: float  #: of the circle of zero gap [length]
    cohesive_radius: float  #: within which the attraction acts [length]
    force: float  #: [E* length^2]
    indentation: float  #: approach of distant points [length]


@dataclass(frozen=True)
class MaugisSphere:
    """Adhesive contact of a half-space with a paraboloid, Maugis law, any range.

    States are those of `stickiness.remaining.sphere.maugis_curve`, in the caller's units.
    """

    radius: float
    adhesion_length: float
    range: float

    @property
    def strength(self) -> float:
        return self.adhesion_length / self.range

    @property
    def maugis_parameter(self) -> float:
        return float(sphere.maugis_parameter(self.radius, self.adhesion_length, self.range))

    @property
    def pull_off(self) -> SphereState:
        """State of least force, where contact is lost under load control."""
        return self._at(sphere.find_pull_off(self.maugis_parameter))

    def at_contact_radius(self, contact_radius: float) -> SphereState:
        """State of a given contact radius [length]: there is one for each."""
        return self._at(
            self._solve(lambda t: self._at(t).contact_radius - contact_radius, np.pi / 2)
        )

    def at_force(self, force: float) -> SphereState:
        """State at a force [E* length^2] on the branch that is stable under load control."""
        least = sphere.find_pull_off(self.maugis_parameter)
        return self._at(self._solve(lambda t: self._at(t).force - force, least))

    def _at(self, angle: float) -> SphereState:
        a, c, force, indentation = sphere.maugis_curve(angle, self.maugis_parameter)
        unit = np.cbrt(0.75 * np.pi * self.adhesion_length * self.radius**2)
        return SphereState(
            float(a * unit),
            float(c * unit),
            float(force * np.pi * self.adhesion_length * self.radius),
            float(indentation * unit**2 / self.radius),
        )

    def _solve(self, excess, highest: float) -> float:
        """Angle below `highest` where an excess that falls with the angle vanishes."""
        if excess(highest) >= 0:
            return highest
        lowest = highest / 2
        while excess(lowest) < 0:
            lowest /= 2
        return float(optimize.brentq(excess, lowest, highest, xtol=1e-300, rtol=1e-14))


@dataclass(frozen=True)
class _Wave:
    amplitude: float
    wavelength: float
    adhesion_length: float

    @property
    def full_contact_amplitude(self) -> float:
        """Amplitude of the pressure in full contact [E*], pi amplitude/wavelength."""
        return float(np.pi * self.amplitude / self.wavelength)

    @property
    def alpha(self) -> float:
        """Johnson's alpha: tension over `full_contact_amplitude`, dimensionless.

        alpha^2 = 2 E* w/(wavelength p*^2): two over pi times the work of adhesion over
        ``amplitude * p*``.
        """
        return float(
            np.sqrt(2 * self.adhesion_length / self.wavelength) / self.full_contact_amplitude
        )


@dataclass(frozen=True)
class AdhesiveWave(_Wave):
    """Wave in adhesive contact when the range of attraction is short (JKR's limit).

    Valid while the cohesive zone is short against the contact and its complement; `MaugisWave` has
    no such limit. With psi half the contact in phase the mean pressure is ``p* (sin^2 psi - alpha
    sqrt(tan psi))``. Johnson, Int. J. Solids Struct. 32, 423 (1995),
    doi:10.1016/0020-7683(94)00111-9.
    """

    # Largest alpha at which contact is partial without load, (27/256)^(1/4) = 0.570: the largest
    # sin^2/sqrt(tan), at psi = pi/3.
    CRITICAL_ALPHA = (27 / 256) ** 0.25
    # Largest alpha with a stable partial contact at any load, 1.065: the largest
    # 4 sin^(3/2) cos^(5/2), at tan^2 = 3/5.
    LARGEST_ALPHA = 4 * (3 / 8) ** 0.75 * (5 / 8) ** 1.25

    def pressure(self, area_fraction: ArrayLike):
        """Mean pressure [E*] of a contact of given area fraction, stable or not."""
        psi = np.pi / 2 * np.asarray(area_fraction, dtype=float)
        return self.full_contact_amplitude * (np.sin(psi) ** 2 - self.alpha * np.sqrt(np.tan(psi)))

    @property
    def turning_points(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Pull-off and jump into full contact, as pairs of area fraction and pressure [E*].

        Partial contact is stable under load control between them, if alpha is below
        `LARGEST_ALPHA`; above it the wave jumps from apart to full contact.
        """

        def slope(psi):
            return 4 * np.sin(psi) ** 1.5 * np.cos(psi) ** 2.5 - self.alpha

        middle = np.arctan(np.sqrt(0.6))
        ends = (0, middle), (middle, np.pi / 2)
        roots = (optimize.brentq(slope, *end, xtol=1e-15) for end in ends)
        first, last = (float(2 / np.pi * psi) for psi in roots)
        return (first, self.pressure(first)), (last, self.pressure(last))

    def area_fraction(self, pressure: float) -> float:
        """Area fraction of the stable partial contact at a mean pressure [E*]."""
        (first, _), (last, _) = self.turning_points
        return float(
            optimize.brentq(lambda x: self.pressure(x) - pressure, first, last, xtol=1e-15)
        )


@dataclass(frozen=True)
class WaveState:
    """One equilibrium of the wave under the Maugis law."""

    pressure: float  #: mean [E*]
    area_fraction: float  #: share of the wave in contact
    #: Share of the wave within the range of attraction, that in contact included; one if the
    #: cohesive zones of neighbouring crests have met.
    cohesive_fraction: float


@dataclass(frozen=True)
class MaugisWave(_Wave):
    """Wave in adhesive contact under the Maugis law, any range.

    Contact reaches to the phase a, the strength s acts between a and c. On top of Westergaard's
    solution of the same contact stands the real part of ``-(2 s/pi) arctan y``,
    ``y^2 = (tan^2 c - tan^2 a)/(tan^2 a - tan^2 psi)``: it is minus the strength between a and c,
    zero beyond, and leaves the gap flat in contact. Hence the mean pressure
    ``p* sin^2 a - (2 s/pi) arccos(cos c/cos a)``. The gap at c is the range, which for a given c
    has one root a; the curve of equilibria is therefore followed along c, and, once c has reached
    the trough, along a with ``p* sin^2 a - s``. The same problem by other means: Hui, Lin, Baney &
    Kramer, J. Polym. Sci. B 39, 1195 (2001).
    """

    range: float

    @property
    def strength(self) -> float:
        return self.adhesion_length / self.range

    def at_cohesive_fraction(self, place: float) -> WaveState | None:
        """Equilibrium whose attraction covers a given share of the wave, None if there is none.

        From a `place` of one on to two the attraction covers all, and the contact grows.
        """
        c = np.pi / 2 * min(place, 1.0)
        a = self._contact_phase(c)
        if place > 1:
            a = a or 0.0
            a += (place - 1) * (np.pi / 2 - a)
        if a is None:
            return None
        angle = np.arctan2(np.sqrt(max(np.sin(c - a) * np.sin(c + a), 0)), np.cos(c))
        pressure = self.full_contact_amplitude * np.sin(a) ** 2 - 2 * self.strength / np.pi * angle
        return WaveState(float(pressure), 2 / np.pi * a, 2 / np.pi * c)

    @cached_property
    def curve(self) -> list[tuple[float, WaveState]]:
        """Places along the curve of equilibria, from the smallest to full contact, and states."""
        even = np.linspace(0, 2, 2 * _SAMPLES + 1)[1:-1]
        places = np.append(np.geomspace(1e-4, even[0], 50)[:-1], even)  # small contacts first
        states = [(place, self.at_cohesive_fraction(place)) for place in places]
        return [(place, state) for place, state in states if state is not None]

    def equilibria(self, pressure: float) -> tuple[list[WaveState], list[bool]]:
        """All partial contacts at a mean pressure [E*] and whether each is stable.

        Stable means under load control: along the curve the pressure rises there with the
        contact. States follow each other by growing attractive area. The point contact where the
        curve starts, and full contact where it ends, are left out.
        """
        states, stable = [], []
        for (low, before), (high, after) in itertools.pairwise(self.curve):
            if (before.pressure < pressure) != (after.pressure < pressure):
                place = optimize.brentq(
                    lambda x: self.at_cohesive_fraction(x).pressure - pressure,
                    low,
                    high,
                    xtol=1e-14,
                )
                states.append(self.at_cohesive_fraction(place))
                stable.append(after.pressure > before.pressure)
        return states, stable

    def _contact_phase(self, c: float) -> float | None:
        """Phase a of the contact with a gap of the range at c; None if even a = 0 falls short."""
        smallest = 1e-9 * c
        if self._edge_gap(smallest, c) < self.range:
            return None
        return float(
            optimize.brentq(
                lambda a: self._edge_gap(a, c) - self.range, smallest, c, xtol=1e-15 * c
            )
        )

    def _edge_gap(self, a: float, c: float) -> float:
        """Gap [length] at the phase c where the strength acts between a and c."""
        if a >= c:
            return 0.0
        ratio = np.sin(c) / np.sin(a)
        hertzian = ratio * np.sqrt(ratio**2 - 1) - np.arccosh(ratio)
        opening = 4 * self.strength * self.wavelength / np.pi**2 * _slope_integral(a, c)
        return float(2 * self.amplitude * np.sin(a) ** 2 * hertzian + opening)


def _slope_integral(a: float, c: float) -> float:
    """Integral over the cohesive zone of artanh(1/y), y as in `MaugisWave`."""
    if c >= np.pi / 2:
        return 0.0
    width = c - a
    psi = a + width * _STEP
    spread = np.sin(width) * np.sin(c + a)  # sin^2 c - sin^2 a
    inverse = np.sqrt(np.sin(width * _STEP) * np.sin(psi + a) / spread) * np.cos(c) / np.cos(psi)
    # 1 - 1/y^2 as a product: close to c the difference would lose all its digits. The
    # substitution is symmetric, 1 - _STEP is itself in reverse.
    rest = np.cos(a) * np.sqrt(np.sin(width * _STEP[::-1]) * np.sin(c + psi) / spread)
    return float(width * np.sum(_STEP_WEIGHTS * np.log((1 + inverse) * np.cos(psi) / rest)))
