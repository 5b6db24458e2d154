"""Maugis' solution for a sphere, at any range of attraction; Tabor's and Maugis' parameters.

Units and signs are those of `closed_forms.adhesion`, which exports all of this.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import optimize

from stickiness.arguments import plain, positive
from stickiness.closed_forms.contact import PositiveFields
from stickiness.equivalent_sphere import opening

_EDGE = np.pi / 2  # the angle arccos(a/c) of a point contact within a cohesive zone


def tabor_parameter(radius: ArrayLike, adhesion_length: ArrayLike, range: ArrayLike):
    """Tabor's parameter mu = (R l_a^2/range^3)^(1/3), dimensionless; arguments [length].

    Tabor, J. Colloid Interface Sci. 58, 2 (1977), doi:10.1016/0021-9797(77)90366-6.
    """
    radius, adhesion_length, range = positive(
        radius=radius, adhesion_length=adhesion_length, range=range
    )
    return plain(np.cbrt(radius * adhesion_length**2) / range)


def maugis_parameter(radius: ArrayLike, adhesion_length: ArrayLike, range: ArrayLike):
    """Maugis' parameter lambda = 2 sigma_0 (R/(pi w K^2))^(1/3) with K = 4 E*/3, dimensionless.

    It is 2 (9/(16 pi))^(1/3) = 1.127 times `tabor_parameter` when the range is that of the
    Maugis law, sigma_0 = w/range. (The 1.157 often quoted compares with the separation of a
    Lennard-Jones law of the same strength.) Maugis, J. Colloid Interface Sci. 150, 243 (1992),
    doi:10.1016/0021-9797(92)90285-T.
    """
    tabor = tabor_parameter(radius, adhesion_length, range)
    return plain(2 * np.cbrt(9 / (16 * np.pi)) * tabor)


def check_force(force: float, pull_off: float) -> float:
    """Return a force; ValueError if it is not finite or lies beyond pull-off."""
    if not np.isfinite(force):
        raise ValueError(f"force must be finite, got {force!r}")
    if force < pull_off:
        raise ValueError(f"force must be at least the pull-off force {pull_off:.6g}, got {force!r}")
    return float(force)


@dataclass(frozen=True)
class SphereState:
    """One equilibrium of a sphere, or arrays of them along a curve."""

    contact_radius: float | NDArray  #: of the circle of zero gap [length]
    cohesive_radius: float | NDArray  #: within which the attraction acts [length]
    force: float | NDArray  #: [E* length^2]
    indentation: float | NDArray  #: approach of distant points [length]


@dataclass(frozen=True)
class MaugisSphere(PositiveFields):
    """Adhesive contact of a half-space with a paraboloid, Maugis law, any range.

    The equilibria form one curve, on which the angle t = arccos(a/c) between contact radius a
    and cohesive radius c runs from 0 (large contact) to pi/2 (point contact). The condition that
    the gap be the range at c is quadratic in c at fixed t, so that nothing needs to be iterated
    along the curve. `separated` continues it beyond the point contact. Maugis, J. Colloid Interface
    Sci. 150, 243 (1992), doi:10.1016/0021-9797(92)90285-T; separated branch: Johnson & Greenwood,
    J. Colloid Interface Sci. 192, 326 (1997), doi:10.1006/jcis.1997.4984.

    Parameters
    ----------
    radius, adhesion_length, range : float
        Radius of curvature, work of adhesion over E*, range of the traction [length].
    """

    radius: float
    adhesion_length: float
    range: float

    @property
    def strength(self) -> float:
        """Traction within the range [E*]."""
        return self.adhesion_length / self.range

    @property
    def maugis_parameter(self) -> float:
        """Maugis' lambda, see the function of that name."""
        return maugis_parameter(self.radius, self.adhesion_length, self.range)

    @property
    def pull_off(self) -> SphereState:
        """State of least force, where contact is lost under load control."""
        return self._on_curve(self._lowest(lambda state: state.force))

    @property
    def separation(self) -> SphereState:
        """State of least indentation, where contact is lost under displacement control.

        For long ranges it is one without contact, held together at a distance.
        """
        best = self._on_curve(self._lowest(lambda state: state.indentation))
        apart = 4 * self.strength * self.radius / np.pi
        if apart < self._on_curve(_EDGE).cohesive_radius:
            other = self.separated(apart)
            return other if other.indentation < best.indentation else best
        return best

    def curve(self, largest_radius: float, points: int = 200) -> SphereState:
        """States from a contact radius [length] down to the point contact, arrays ``(points,)``.

        They are denser towards large contacts. ValueError if `largest_radius` is not positive and
        finite, or there are fewer than two points.
        """
        if int(points) != points or points < 2:
            raise ValueError(f"points must be an integer of at least 2, got {points!r}")
        return self._on_curve(np.geomspace(self._angle(largest_radius), _EDGE, int(points)))

    def at_contact_radius(self, contact_radius: float) -> SphereState:
        """State of a given contact radius [length]: there is one for each."""
        return self._on_curve(self._angle(contact_radius))

    def at_force(self, force: float) -> SphereState:
        """State at a force [E* length^2] on the branch that is stable under load control.

        ValueError if the force is not finite or lies beyond pull-off.
        """
        least = self._lowest(lambda state: state.force)
        check_force(force, self._on_curve(least).force)
        return self._on_curve(self._solve(lambda t: self._on_curve(t).force - force, least))

    def separated(self, cohesive_radius: float) -> SphereState:
        """State without contact, attraction acting within `cohesive_radius` [length].

        ValueError if the radius is not positive, or so large that the surfaces would touch.
        """
        (c,) = positive(cohesive_radius=cohesive_radius)
        indentation = c**2 / (2 * self.radius) - 4 * self.strength * c / np.pi - self.range
        if -indentation - 2 * self.strength * c < -1e-12 * self.range:
            largest = self._on_curve(_EDGE).cohesive_radius
            raise ValueError(f"cohesive_radius must be at most {largest:.6g}, got {c!r}")
        return SphereState(0.0, float(c), float(-np.pi * self.strength * c**2), float(indentation))

    def contact_pressure(self, r: ArrayLike, state: SphereState):
        """Net pressure [E*] at distances `r` [length]: minus the strength in the cohesive zone."""
        r = np.asarray(r, dtype=float)
        a, c = state.contact_radius, state.cohesive_radius
        inside = np.maximum(a**2 - r**2, 0)
        hertz = 2 * np.sqrt(inside) / (np.pi * self.radius)
        angle = np.arctan2(np.sqrt(c**2 - a**2), np.sqrt(inside))
        return plain(np.where(r > c, 0.0, hertz - 2 * self.strength / np.pi * angle))

    def _angle(self, contact_radius: float) -> float:
        """Angle arccos(a/c) of the state with a given contact radius."""
        positive(contact_radius=contact_radius)
        return self._solve(lambda t: self._on_curve(t).contact_radius - contact_radius, _EDGE)

    def _on_curve(self, t: float | NDArray) -> SphereState:
        """Return the state(s) at the angle t = arccos(a/c), in the caller's units."""
        t = np.asarray(t, dtype=float)
        unit = np.cbrt(0.75 * np.pi * self.adhesion_length * self.radius**2)
        lam = self.maugis_parameter
        first = lam / 2 * opening(t)
        second = 4 / 3 * lam**2 * (t * np.sin(t) - 2 * np.sin(t / 2) ** 2)
        c = 2 / (second + np.sqrt(second**2 + 4 * first))  # first c^2 + second c = 1
        a = np.where(t == _EDGE, 0.0, c * np.cos(t))
        force = a**3 - lam * c**2 * (np.sin(t) * np.cos(t) + t)
        indentation = a**2 - 4 / 3 * lam * c * np.sin(t)
        return SphereState(
            plain(a * unit),
            plain(c * unit),
            plain(force * np.pi * self.adhesion_length * self.radius),
            plain(indentation * unit**2 / self.radius),
        )

    def _lowest(self, quantity: Callable[[SphereState], float]) -> float:
        """Return the angle at which a quantity is least along the curve."""
        # Where the curve turns the angle is of order one, and of order 1/lambda for large lambda.
        t = np.geomspace(1e-3 / (1 + self.maugis_parameter), 1, 401) * _EDGE
        i = int(np.argmin(quantity(self._on_curve(t))))
        if i == t.size - 1:
            return _EDGE
        found = optimize.minimize_scalar(
            lambda x: quantity(self._on_curve(x)),
            bounds=(t[max(i - 1, 0)], t[i + 1]),
            method="bounded",
            options={"xatol": 1e-10 * t[i]},
        )
        return float(found.x)

    def _solve(self, excess: Callable[[float], float], highest: float) -> float:
        """Angle below `highest` where an excess that falls with the angle vanishes."""
        if excess(highest) >= 0:
            return highest
        lowest = highest / 2
        while excess(lowest) < 0:
            lowest /= 2
        return float(optimize.brentq(excess, lowest, highest, xtol=1e-300, rtol=1e-14))
