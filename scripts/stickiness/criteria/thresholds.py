"""What would make a material stick to a rough surface: the verdict's questions the other way round.

Shares need not fall steadily, so that a whole range is searched. The limits of a threshold are
where the low limit of the share first fails, and where the high limit of the share last suffices.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from stickiness.criteria.a_v_table import RANGES
from stickiness.criteria.pair import BROAD_A_V, Pair
from stickiness.criteria.verdict import verdict
from stickiness.persson.theory import Persson
from stickiness.remaining.prediction import LEAST_LENGTH
from stickiness.solids import HALF_SPACE, Solid
from stickiness.solids.moduli import Modulus, Prony, Table
from stickiness.spectrum.interface import Spectrum

CONTACT_AREA = 0.05  #: share of the nominal area
# Relative, of areas by theory: covers simulations at these areas (H = 0.3 to 0.9, magnifications of
# 16 to 256, cells of two waves and more). On thin bonded layers theory has as little as half of it.
AREA_ERROR, AREA_ERROR_LAYER, AREAS = 0.15, 0.45, (0.005, 0.35)
ROUGHEST, DEEPEST = 1e3, 25.0  # searched, over the heights, and over 1/q of the longest waves
_PER_DECADE, _PRECISION = 5, 1e-8  # points of the search, and relative, between two of them
_FREQUENCIES = 1e-12, 1e12  # [Hz], of a Prony series

Remain = Callable[[Pair], NDArray]  # shares (n, end, limit), see `remain_at_ends`


class Threshold(NamedTuple):
    """A number with its limits; 0 or infinity where no value sticks, or all that were searched."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Thresholds:
    """What would make a material stick to a surface, all else being as it is."""

    modulus: Threshold  #: sticks below [Pa]; Young's modulus if Poisson's ratio was given, else E*
    rms_height: Threshold  #: sticks below [m]
    thickness: Threshold | None  #: sticks above [m]; None of a half-space
    pressure: Threshold  #: mean pressure [Pa] that makes the area of contact, without adhesion
    rate: Threshold | None  #: sticks below [Hz]; None without `storage`


def thresholds(
    surface: Spectrum | ArrayLike,
    *,
    contact_area: float = CONTACT_AREA,
    storage: Prony | Table | None = None,
    **material: Any,
) -> Thresholds:
    """Find the modulus, rms height, thickness and rate at which a material begins to stick.

    And the pressure at which a share of the nominal area is in contact.

    Parameters
    ----------
    surface : Spectrum or (nx, ny) array
        As of `verdict`. Other rms heights have a spectrum of the same shape.
    contact_area : float
        Share of the nominal area, 0.005 to 0.35, down to the shortest wave of the surface. By
        `Persson` with Wang and Müser's correction (Tribol. Lett. 65:103, 2017).
    storage : solids.moduli.Prony or Table, optional
        Modulus against the frequency, Young's or E* as `modulus`.
    **material
        Other arguments of `verdict`, with its errors and warnings.

    Returns
    -------
    Thresholds
        At a threshold the verdict has the wanted share to 1e-4; at its limits one of the limits of
        the share.

    Examples
    --------
    >>> from stickiness.spectrum import SelfAffine
    >>> wall = SelfAffine(hurst=0.8, q0=6e4, q1=6e8, h_rms=1e-6)
    >>> found = thresholds(wall, modulus=2e6, poisson=0.5, work_of_adhesion=0.06, range=3e-10)
    >>> print(f"sticks below E = {found.modulus.value / 1e6:.2f} MPa")
    sticks below E = 1.57 MPa
    """
    if not AREAS[0] <= contact_area <= AREAS[1]:
        raise ValueError(f"contact_area must be in {AREAS}, got {contact_area!r}")
    judged = verdict(surface, **{"a_v": (BROAD_A_V,) * 3} | material)
    pair, spectra, solid = judged.pair, [judged.spectrum], material.get("solid", HALF_SPACE)
    found = judged.modulus_threshold, *judged.modulus_threshold_limits
    any_modulus = 0.99 * pair.work_of_adhesion / (LEAST_LENGTH * pair.elastic_energy)
    as_given = material["modulus"] / pair.modulus  # Young's modulus or E*
    modulus = Threshold(*(as_given * x if x < any_modulus else np.inf for x in found))
    return Thresholds(
        modulus=modulus,
        rms_height=find_rms_height(pair, pair.h_rms),
        thickness=find_thickness(pair, solid, spectra),
        pressure=find_pressure(spectra, solid, pair, contact_area),
        rate=storage and find_rate(storage, sorted(modulus), _FREQUENCIES),
    )


def remain_at_ends(pair: Pair) -> NDArray:
    """Low limit, value and high limit of the share that remains, along a last axis."""
    return np.stack([pair.remaining(sign) for sign in (-1, 0, 1)], axis=-1)


def find_rms_height(pair: Pair, h_rms: float, remain: Remain = remain_at_ends) -> Threshold:
    """Find the rms height [m] below which the wanted share remains; `h_rms` is what `pair` has.

    `pair` has arrays of the ends of what is known of a surface, or of draws.
    """
    ends = pair.range / RANGES[-1], ROUGHEST * h_rms
    return find_threshold(lambda x: remain(pair.scaled(x / h_rms)), *ends, pair.wanted_share)


def find_thickness(
    pair: Pair, solid: Solid, spectra: list[Spectrum], remain: Remain = remain_at_ends
) -> Threshold | None:
    """Find the thickness [m] of a layer above which the wanted share remains; None of a half-space.

    `spectra` are of the ends; draws change as both do on average. Others as of `find_rms_height`.
    """
    h_rms, q0 = np.atleast_1d(pair.h_rms, pair.q0)

    def put_on(thickness: NDArray) -> NDArray:
        layers = [solid, *(replace(solid, thickness=d) for d in thickness[:, 0])]
        energy = np.array([[one.elastic_energy(layer) for one in spectra] for layer in layers])
        if h_rms.size > len(spectra):
            energy = np.exp(np.log(energy).mean(axis=1, keepdims=True))
        soft = np.array([layer.factor(q0) for layer in layers])
        changed = replace(
            pair,
            elastic_energy=pair.elastic_energy * energy[1:] / energy[0],
            relative_compliance=pair.relative_compliance * soft[1:] / soft[0],
            layer_strain=np.array([layer.strain(h_rms, q0) for layer in layers[1:]]),
        )
        return remain(changed)

    ends = DEEPEST / spectra[0].band[0], h_rms.min()
    return None if solid == HALF_SPACE else find_threshold(put_on, *ends, pair.wanted_share)


def find_rate(storage: Modulus, moduli: ArrayLike, frequencies: ArrayLike) -> Threshold:
    """Find the frequency [Hz] up to which a storage modulus stays below others: low, value, high.

    It is searched between the first and the last of `frequencies`, within a table.
    """
    known = getattr(storage, "frequencies", frequencies)
    start, stop = np.clip((known[0], known[-1]), frequencies[0], frequencies[-1])
    return find_threshold(lambda f: moduli / storage.storage(f)[..., None], start, stop, 1.0)


def find_threshold(
    remain: Callable[[NDArray], NDArray], start: float, stop: float, wanted: float
) -> Threshold:
    """Find where shares fall below the wanted one from `start`, where they are large, to `stop`.

    0 or infinity if that is beyond the start or the stop. `remain` makes shares (n, end, limit) of
    values (n, 1). The value is at the last end, the rough one, as in verdicts; limits are farthest.
    """

    def excess(x: float, *place: int) -> float:
        return remain(np.array([[x]]))[0, *place] - wanted

    x = np.geomspace(start, stop, 2 + int(_PER_DECADE * abs(np.log10(stop / start))))
    enough = remain(x[:, None]) >= wanted
    found = np.empty(enough.shape[1:])
    for end, limit in np.ndindex(found.shape):
        kept = enough[:, end, limit]
        count = np.flatnonzero([True, *kept])[-1] if limit == 2 else np.argmin([*kept, False])
        if count in (0, x.size):
            found[end, limit] = 0.0 if (count == 0) == (start < stop) else np.inf
        else:
            around, xtol = x[count - 1 : count + 1], _PRECISION * x[count]
            found[end, limit] = brentq(excess, *around, (end, limit), xtol)
    return Threshold(float(found[-1, 1]), float(found.min()), float(found.max()))


def find_pressure(
    spectra: list[Spectrum], solid: Solid, pair: Pair, area: float = CONTACT_AREA
) -> Threshold:
    """Find the mean pressure [Pa] at an area of contact, without adhesion.

    The value is at the last of the `spectra`, the rough one, or with draws between the ends.
    """
    q0, unlike = float(np.mean(pair.q0)), float(np.mean(pair.anisotropy_error_factor))
    error, harder = min(AREA_ERROR * unlike, 0.9), max(1 - float(solid.factor(q0)), 0.0)
    areas = area * np.array([(1 - error) * (1 - AREA_ERROR_LAYER * harder), 1.0, 1 + error])
    theories = [Persson(one, correction="wang2017", solid=solid) for one in spectra]
    found = np.array([theory.pressure_at_area(areas) for theory in theories]) * pair.modulus
    drawn = np.size(pair.h_rms) > len(spectra)
    value = float(np.exp(np.log(found[:, 1]).mean()) if drawn else found[-1, 1])
    return Threshold(value, float(found[:, 0].min()), float(found[:, 2].max()))
