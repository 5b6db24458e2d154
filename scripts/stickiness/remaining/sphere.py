"""Pull-off of a sphere from a rough surface: Maugis' sphere with the adhesion that remains.

Waves that are shorter than the zone of contact change the work of adhesion and the distance over
which it acts, both by `Roughness`. Maugis' solution goes from JKR to DMT. Longer waves tilt, shift
and curve what the sphere touches: whoever calls gives the roughness without them, `narrow`s it to
the waves across the zone, and gives their curvature.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
import scipy  # its parts are loaded when first used, which reading a configuration does not
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import plain, positive
from stickiness.remaining.errors import BALL
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.share import find_first_touch
from stickiness.traction_laws import find_strength

LEAST_SHARE = 1e-200  #: whose logarithm may be taken
FEWEST_WAVES = 5.0  #: longest waves across the contact, below which forces scatter much
_LEAST_PARAMETER = 1e-3  # of Maugis; below DMT to 0.2 %
_POINT_CONTACT = np.pi / 2  # the angle arccos(a/c) of a point contact within a cohesive zone


@dataclass(frozen=True)
class SpherePullOff:
    """Pull-off of a sphere from a rough surface; numbers or arrays."""

    force: float | NDArray  #: [E* length^2], positive
    smooth_force: float | NDArray  #: from a smooth surface [E* length^2]
    relative: float | NDArray  #: force over the pull-off force from a smooth surface
    work: float | NDArray  #: of separation per area over the work of adhesion of smooth surfaces
    #: Radius [length] of what is in contact or attracts at pull-off: the larger of JKR's contact
    #: and Derjaguin's zone. The model needs many of the longest waves across it.
    zone_radius: float | NDArray


def pull_off(
    rough: Roughness,
    radius: ArrayLike,
    adhesion_length: ArrayLike,
    range: ArrayLike,
    curvature: float = 0.0,
    error: float = 0.0,
) -> SpherePullOff:
    """Pull-off after a contact formed by load.

    Parameters
    ----------
    rough : Roughness
        What the sphere touches, with the error of the model in units of its limits.
    radius : float or array
        Of the sphere [length].
    adhesion_length : float or array
        Work of adhesion over E* [length].
    range : float or array
        Of the attraction [length].
    curvature : float
        Rms mean curvature of the waves that are longer than the zone of contact [1/length].
    error : float
        Of ln of the force from place to place, in the unit of `errors.BALL`: of real contacts its
        half-width.
    """
    radius, length, range = positive(radius=radius, adhesion_length=adhesion_length, range=range)
    eta = np.asarray(rough.eta)
    exact = rough.deviating(0.0)
    reach = np.asarray(rough.distance(length, range))
    share = np.maximum(exact.share(length, range), LEAST_SHARE)

    def find_force(share: NDArray, radius: NDArray) -> NDArray:
        """Force over pi E*."""
        return radius * share * length * _coefficient(radius, share * length, reach)

    force = find_force(share, radius)
    smooth = radius * length * _coefficient(radius, length, range / find_strength(rough.law))
    work = np.asarray(rough.separation(length, range))
    if np.any(eta):
        # Errors of the share, the radius and the place are independent: they add in quadrature.
        of_place = eta * error * BALL.unit(np.log(smooth / force))
        of_radius = np.log(find_force(share, curve(radius, curvature, eta)) / force)
        with np.errstate(divide="ignore"):  # nothing remains at a low limit
            of_limit = np.asarray(rough.share(length, range))
            of_share = np.log(find_force(of_limit, radius) / force)
            of_work = np.log(work / share)
        work = share * np.exp(np.sign(eta) * np.hypot(of_work, of_place))
        of_force = np.sqrt(of_share**2 + of_radius**2 + of_place**2)
        force = force * np.exp(np.sign(eta) * of_force)

    jkr_contact = np.cbrt(9 * np.pi / 8 * share * length * radius**2)
    derjaguin_zone = np.sqrt(2 * radius * reach)
    return SpherePullOff(
        force=plain(np.pi * force),
        smooth_force=plain(np.pi * smooth),
        relative=plain(force / smooth),
        work=plain(work),
        zone_radius=plain(np.maximum(jkr_contact, derjaguin_zone)),
    )


def narrow(rough: Roughness, waves: ArrayLike, summits: float) -> Roughness:
    """Roughness in a zone of contact that is a number of its longest waves wide.

    Few waves have few summits, so that hard solids touch at a lower one. `summits` are independent
    heights in a zone one wave wide: `errors.SUMMITS`.
    """
    return replace(
        rough,
        first_touch=find_first_touch(waves, summits),
        waves=np.minimum(rough.waves, np.maximum(waves, 1.0)),
    )


def curve(radius: ArrayLike, curvature: float, eta: ArrayLike) -> NDArray:
    """Radius of a sphere [length] on waves that are longer than the zone of contact.

    Their rms mean `curvature` [1/length] scatters it by at most 1/(1/radius - curvature), and not
    further than a factor of e, for a sphere that is large beside their summits bridges valleys.
    """
    radius = np.asarray(radius)
    curved = curvature * radius
    return radius * np.exp(np.asarray(eta) * curved / (1 + curved))


def _coefficient(radius: NDArray, length: NDArray, range: NDArray) -> NDArray:
    """Pull-off force over pi R l_a: from 3/2 (JKR) to 2 (DMT)."""
    log_parameters, coefficients = _tabulate_coefficient()
    parameter = np.maximum(maugis_parameter(radius, length, range), _LEAST_PARAMETER)
    return np.interp(np.log(parameter), log_parameters, coefficients)


@cache
def _tabulate_coefficient() -> tuple[NDArray, NDArray]:
    """Logarithm of Maugis' parameter, and the pull-off force over pi R l_a."""
    parameters = np.geomspace(_LEAST_PARAMETER, 1e3, 121)  # beyond, JKR to 0.2 %
    forces = []
    # The parameter is that of a sphere with a range, to rounding.
    unit = float(maugis_parameter(1.0, 1.0, 1.0))
    for nominal in parameters:
        parameter = float(maugis_parameter(1.0, 1.0, unit / nominal))
        _, _, force, _ = maugis_curve(find_pull_off(parameter), parameter)
        forces.append(-float(force * np.pi))
    return np.log(parameters), np.clip(np.array(forces) / np.pi, 1.5, 2.0)


def maugis_parameter(radius: ArrayLike, adhesion_length: ArrayLike, range: ArrayLike) -> NDArray:
    """Maugis' parameter lambda = 2 sigma_0 (R/(pi w K^2))^(1/3), K = 4 E*/3: 1.127 Tabor's.

    (The 1.157 often quoted compares with the separation of a Lennard-Jones law of equal strength.)
    """
    tabor = np.cbrt(radius * adhesion_length**2) / range
    return 2 * np.cbrt(9 / (16 * np.pi)) * tabor


def maugis_curve(angle: ArrayLike, parameter: float) -> tuple[NDArray, NDArray, NDArray, NDArray]:
    """Contact radius a, cohesive radius c, force and indentation of Maugis' sphere.

    At an angle arccos(a/c), the condition that the gap be the range at c is quadratic in c. Radii
    are in units of r = (3 pi l_a R^2/4)^(1/3), the force of pi l_a R, the indentation of r^2/R.
    Maugis, J. Colloid Interface Sci. 150, 243 (1992), doi:10.1016/0021-9797(92)90285-T.
    """
    t = np.asarray(angle, dtype=float)
    first = parameter / 2 * opening(t)
    second = 4 / 3 * parameter**2 * (t * np.sin(t) - 2 * np.sin(t / 2) ** 2)
    c = 2 / (second + np.sqrt(second**2 + 4 * first))  # first c^2 + second c = 1
    a = np.where(t == _POINT_CONTACT, 0.0, c * np.cos(t))
    force = a**3 - parameter * c**2 * (np.sin(t) * np.cos(t) + t)
    indentation = a**2 - 4 / 3 * parameter * c * np.sin(t)
    return a, c, force, indentation


def find_pull_off(parameter: float) -> float:
    """Angle of the least force along `maugis_curve`, at which a sphere pulls off."""

    def force(angle):
        return plain(maugis_curve(angle, parameter)[2])

    # Where the curve turns the angle is of order one, and of order 1/lambda for large lambda.
    t = np.geomspace(1e-3 / (1 + parameter), 1, 401) * _POINT_CONTACT
    i = int(np.argmin(force(t)))
    if i == t.size - 1:
        return _POINT_CONTACT
    bounds = (t[max(i - 1, 0)], t[i + 1])
    minimum = scipy.optimize.minimize_scalar(
        force, bounds=bounds, method="bounded", options={"xatol": 1e-10 * t[i]}
    )
    return float(minimum.x)


def opening(t: NDArray) -> NDArray:
    """Evaluate sin t cos t - t cos 2t, by its series where the terms cancel."""
    x = np.minimum(2 * t, 0.5)
    series = x**3 / 6 * (1 - x**2 / 10 * (1 - x**2 / 28 * (1 - x**2 / 54 * (1 - x**2 / 88))))
    return np.where(2 * t < 0.5, series, np.sin(2 * t) / 2 - t * np.cos(2 * t))
