"""Attraction next to the edges of contact at equal area: from weak edges to tough ones as in JKR.

With a gap ``C x^(3/2)`` next to an edge, Maugis' traction over the width ``d = (range/C)^(2/3)``
depends on Tabor's parameter ``tau = l_a d/range^2`` of the edge alone: weak << 1, tough >> 1. A
rough contact is taken for its *equivalent sphere*, of equal tau and equal t, attractive over
contact area (doi:10.1016/0021-9797(92)90285-T). Its contact has the radius a, its zone c, and c_0
at vanishing traction; the attraction over its DMT sum is ``2 [c^2 arccos(a/c) + a sqrt(c^2 -
a^2)]/(pi (c_0^2 - a^2))``. Simulation over the model is 1.03 +- .06 for tau < 0.2 and 0.75 to 1.35
beyond, up to tau = 4.6 and down to t = 0.2. l_a = w/E*.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import plain, takes_positive
from stickiness.criteria.formulas import traction_ratio
from stickiness.remaining.sphere import opening

KAPPA_REP = 2.0  #: area over load without adhesion, A_rep/A_nom = kappa p/(E* h'_rms)

WEAK = 0.2  #: strength tau up to which adhesion is weak
STRONGEST_SIMULATED = 4.0  #: strength tau up to which the model was compared with simulation
LEAST_STRENGTH = 2e-7  # tau below which attraction changes no zone
TOUGH = 2.0  # strength, and relative distance from JKR, see `tough`
TOUGH_WITHIN = 0.1
SMALLEST_SIMULATED = 0.13  #: attractive over contact area from which on it was
# Factors, up or down, within which simulation agrees with the model; beyond what was simulated a
# guess that allows for edges with scattered B and for contacts that are no spheres.
ERROR_WEAK = 1.3
ERROR_STRONG = 1.4
ERROR_BEYOND = 2.0


@dataclass(frozen=True)
class EdgeAttraction:
    """Attraction on a rough contact at a given area of contact."""

    #: What adhesion takes off the external load, over the load without it; sticky above 1.
    ratio: float | NDArray
    error_factor: float | NDArray  #: up or down, by which `ratio` may be wrong for the model's sake
    effect: float | NDArray  #: `ratio` over its DMT sum
    attractive_over_contact: float | NDArray  #: area within the range, without adhesion
    strength: float | NDArray  #: Tabor's tau of the edges: weak below `WEAK`, see `tough`

    @property
    def simulated(self) -> bool | NDArray:
        """Whether the model was compared with simulation there."""
        return plain(np.asarray(self.error_factor) < ERROR_BEYOND)


@takes_positive
def attraction(h_rms, q0, rms_slope, adhesion_length, range, a_v, kappa_rep=KAPPA_REP):
    """`EdgeAttraction`: attraction over repulsion at equal area, by the equivalent sphere.

    `rms_slope` is the rms gradient of all waves, `kappa_rep` the slope of area against load without
    adhesion; the other arguments are those of `criteria.traction_ratio`.
    """
    dmt = traction_ratio(h_rms, q0, adhesion_length, range, a_v)
    # Mean pressure in the contact is E* h'/kappa, attraction over it sigma_0 t.
    strength_over_pressure = adhesion_length / range * kappa_rep / rms_slope
    area = dmt / strength_over_pressure
    tau = edge_strength(area, strength_over_pressure)
    change = effect(area, tau)
    return EdgeAttraction(
        ratio=plain(dmt * change),
        error_factor=error_factor(area, tau),
        effect=change,
        attractive_over_contact=plain(area),
        strength=tau,
    )


@takes_positive
def edge_strength(attractive_over_contact: ArrayLike, traction: ArrayLike) -> float | NDArray:
    """Tabor's tau = l_a d/range^2 of the edges; `traction` is over the mean pressure in contact."""
    # From delta/d = (16/3pi) tau at weak adhesion and the effect (4/pi) t^(-1/2) of small zones, in
    # a contact whose area is proportional to its load.
    return plain(0.75 * traction / np.sqrt(attractive_over_contact))


@takes_positive
def error_factor(attractive_over_contact: ArrayLike, strength: ArrayLike) -> float | NDArray:
    """Factor, up or down, within which `effect` holds for rough contacts."""
    is_wide = attractive_over_contact >= SMALLEST_SIMULATED
    is_simulated = is_wide & (strength <= STRONGEST_SIMULATED)
    error = np.where(strength <= WEAK, ERROR_WEAK, ERROR_STRONG)
    return plain(np.where(is_simulated, error, ERROR_BEYOND))


@takes_positive
def effect(attractive_over_contact: ArrayLike, strength: ArrayLike) -> float | NDArray:
    """Attraction over its DMT sum: `weak_effect` for small tau, `tough_effect` for large ones."""
    from scipy.optimize import elementwise  # not needed to read a configuration

    t, tau = np.broadcast_arrays(attractive_over_contact, strength)
    widest, traction, reach = _describe_edge(t, tau)

    def excess(log_angle, traction, reach):
        angle = np.exp(log_angle)
        return _hertz_gap(angle) + traction * _closing(angle) - reach

    narrowest = _find_narrowest_zone(widest, traction, reach)
    bracket = (np.log(narrowest), np.log(widest) + 1e-12)
    angle = np.exp(elementwise.find_root(excess, bracket, args=(traction, reach)).x)
    return plain(_effect_of_zone(angle, t))


def _describe_edge(t: NDArray, tau: ArrayLike) -> tuple[NDArray, NDArray, NDArray]:
    """Widest angle of the zone, traction over it, and range of the attraction.

    Radius of contact and of curvature are 1; c = 1/cos(angle). The edge of a sphere has
    range/d = (8/3pi) sqrt(t) for small t, which defines its traction at any t.
    """
    widest = np.arctan(np.sqrt(t))
    traction = tau * 8 / (3 * np.pi) * np.sqrt(t)
    return widest, traction, _hertz_gap(widest)


def _find_narrowest_zone(widest: NDArray, traction: NDArray, reach: NDArray) -> NDArray:
    """An angle below that of the zone: that of a crack alone, pi range/(4 traction), is wider."""
    return 0.1 * np.minimum(widest, np.sqrt(reach / traction))


def _effect_of_zone(angle: NDArray, t: NDArray) -> NDArray:
    """Attraction over its DMT sum of a zone up to an angle."""
    return 2 * (angle / np.cos(angle) ** 2 + np.tan(angle)) / (np.pi * t)


@takes_positive
def weak_effect(attractive_over_contact: ArrayLike) -> float | NDArray:
    """`effect` at vanishing strength, ``2 [(1 + t) arctan(sqrt t) + sqrt t]/(pi t)``.

    It tends to 1 at large t and to ``(4/pi) t^(-1/2)`` at small t.
    """
    t = attractive_over_contact
    root = np.sqrt(t)
    return plain(2 * ((1 + t) * np.arctan(root) + root) / (np.pi * t))


@takes_positive
def weak_effect_at_approach(attractive_over_contact: ArrayLike) -> float | NDArray:
    """`weak_effect` at equal approach of the sphere; it tends to ``(4/3pi) sqrt(t)`` at small t.

    It is `dmt.weak_attraction` over the DMT sum; rough contacts have 0.4 to 2 times as much. A pull
    at the radius r of an open edge takes ``(2/pi) arccos(a/r)`` of itself off the load, by
    reciprocity with the flat punch.
    """
    t = attractive_over_contact
    root = np.sqrt(t)
    return plain(2 * ((1 + t) * np.arctan(root) - root) / (np.pi * t))


@takes_positive
def tough_effect(attractive_over_contact: ArrayLike, strength: ArrayLike) -> float | NDArray:
    """`effect` at large strength: JKR, ``(4/pi) sqrt(pi/(4 t tau))`` for small t."""
    t = attractive_over_contact
    tau = strength
    # sqrt(8 pi w a^3) over sigma_0 pi a^2 t, in the units and with the traction of `effect`.
    reach = _hertz_gap(np.arctan(np.sqrt(t)))
    return plain(np.sqrt(3 * reach / (tau * np.sqrt(t))) / t)


def tough(attractive_over_contact: ArrayLike, strength: ArrayLike) -> bool | NDArray:
    """Whether `effect` is within `TOUGH_WITHIN` of `tough_effect`, from the strength `TOUGH` on.

    Small zones reach that at tau = 1.93. Wide ones cross the limit at small strength, where they
    have nothing of it, and approach it later.
    """
    t = np.asarray(attractive_over_contact)
    tau = np.asarray(strength)
    over_tough = np.asarray(effect(t, tau)) / tough_effect(t, tau)
    return plain((tau >= TOUGH) & (np.abs(over_tough - 1) <= TOUGH_WITHIN))


@takes_positive
def adhesion_length_threshold(
    h_rms: ArrayLike, q0: ArrayLike, rms_slope: ArrayLike, range: ArrayLike, a_v: ArrayLike
) -> float | NDArray:
    """Adhesion length [length] at which the attraction balances the repulsion."""
    from scipy.optimize import elementwise  # not needed to read a configuration

    # The area depends on the surface and the range alone; the DMT sum and the traction of the edges
    # are in proportion to the adhesion length, here the range.
    unit = attraction(h_rms, q0, rms_slope, range, range, a_v)
    t = np.asarray(unit.attractive_over_contact)
    dmt = np.asarray(unit.ratio) / unit.effect
    widest, unit_traction, reach = _describe_edge(t, unit.strength)

    def find_length(angle, unit_traction, reach):
        """Adhesion length over the range that closes the zone up to an angle."""
        return (reach - _hertz_gap(angle)) / (unit_traction * _closing(angle))

    def excess(log_angle, t, dmt, unit_traction, reach):
        """Attraction over repulsion, less 1."""
        angle = np.exp(log_angle)
        return dmt * find_length(angle, unit_traction, reach) * _effect_of_zone(angle, t) - 1

    # What either limit has for the threshold, and the larger of both is near.
    weak = 1 / (dmt * weak_effect(t))
    tough = 1 / (dmt * tough_effect(t, unit.strength)) ** 2
    narrowest = _find_narrowest_zone(widest, 4 * (weak + tough) * unit_traction, reach)
    bracket = (np.log(narrowest), np.log(widest))
    root = elementwise.find_root(excess, bracket, args=(t, dmt, unit_traction, reach))
    length = find_length(np.exp(root.x), unit_traction, reach)
    # Where attraction is too weak to change the zone, rounding decides its length.
    is_weak = weak * unit.strength < LEAST_STRENGTH
    return plain(range * np.where(is_weak, weak, length))


def _hertz_gap(angle: NDArray) -> NDArray:
    """Gap at the radius 1/cos(angle) beside a Hertzian contact of radius 1, sphere of radius 1."""
    return opening(angle) / (np.pi * np.cos(angle) ** 2)


def _closing(angle: NDArray) -> NDArray:
    """What a unit traction over the zone closes the gap by at the radius 1/cos(angle)."""
    lever = angle * np.sin(angle) - 2 * np.sin(angle / 2) ** 2
    return 4 / np.pi * lever / np.cos(angle)
