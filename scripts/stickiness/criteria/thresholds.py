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

from stickiness.criteria.a_v_table import RANGES
from stickiness.criteria.pair import BROAD_A_V, Pair
from stickiness.criteria.verdict import verdict
from stickiness.persson.theory import Persson
from stickiness.remaining.prediction import LEAST_LENGTH
from stickiness.solids import HALF_SPACE, Solid
from stickiness.solids.moduli import Modulus, Prony, Table, crossings
from stickiness.spectrum.interface import Spectrum

CONTACT_AREA = 0.05  #: share of the nominal area
# Relative, of areas by theory: covers simulations at these areas (H = 0.3 to 0.9, magnifications of
# 16 to 256). On thin bonded layers theory has as little as half of the area.
AREA_ERROR, AREA_ERROR_LAYER, AREAS = 0.15, 0.45, (0.005, 0.35)
ROUGHEST, DEEPEST = 1e3, 25.0  #: searched, over the heights, and over 1/q of the longest waves
_PER_DECADE, _FINER, _TIMES = 5, 9, 6  # points of the first search, of finer ones; searches

_FREQUENCIES = np.geomspace(1e-12, 1e12, 24_001)  # [Hz] of a Prony series

_TEXTS = {  # unit, and what stands for no value that sticks
    "modulus": ("sticks below a modulus of", "Pa", 0.0),
    "rms_height": ("sticks below an rms height of", "m", 0.0),
    "thickness": ("sticks above a thickness of", "m", np.inf),
    "rate": ("sticks below a rate of", "Hz", 0.0),
    "pressure": ("pressure for the area of contact", "Pa", 0.0),
}


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

    def __str__(self) -> str:
        lines = []
        for name, (text, unit, none) in _TEXTS.items():
            if getattr(self, name) is not None:
                words = {0.0: "any", np.inf: "any"} | {none: "none"}
                shown = (words.get(x, f"{x:.3g} {unit}") for x in getattr(self, name))
                lines.append("{}: {} ({} to {})".format(text, *shown))
        return "\n".join(lines)


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
        `Persson` with Wang and Müser's correction (doi:10.1007/s11249-017-0886-9).
    storage : solids.moduli.Prony or Table, optional
        Modulus against the frequency, Young's or E* as `modulus`.
    **material
        Other arguments of `verdict`, with its errors and warnings.

    Returns
    -------
    Thresholds
        At a threshold the verdict has the wanted share to 1e-4; at the limits of a threshold one of
        the limits of the share.

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
    pair, spectrum, solid = judged.pair, judged.spectrum, material.get("solid", HALF_SPACE)

    def put_on(thickness: NDArray) -> Pair:
        layers = [replace(solid, thickness=d) for d in thickness]
        of_layers = {
            "elastic_energy": [spectrum.elastic_energy(layer) for layer in layers],
            "relative_compliance": [layer.factor(pair.q0) for layer in layers],
            "layer_strain": [layer.strain(pair.h_rms, pair.q0) for layer in layers],
        }
        return replace(pair, **{name: np.array(x) for name, x in of_layers.items()})

    def search(change: Callable[[NDArray], Pair], start: float, stop: float) -> Threshold:
        at = start, stop, pair.wanted_share
        value, *limits = (
            find_crossing(lambda x, sign=sign: change(x).remaining(sign), *at, sign > 0)
            for sign in (0, -1, 1)
        )
        return Threshold(value, *sorted(limits))

    as_given = material["modulus"] / pair.modulus  # Young's modulus or E*
    hardest = pair.work_of_adhesion / pair.elastic_energy / LEAST_LENGTH
    found = judged.modulus_threshold, *judged.modulus_threshold_limits
    modulus = Threshold(*(as_given * x if x < 0.99 * hardest else np.inf for x in found))
    thickness = rate = None
    if solid != HALF_SPACE:
        thickness = search(put_on, DEEPEST / spectrum.band[0], pair.h_rms)
    if storage is not None:
        known = getattr(storage, "frequencies", _FREQUENCIES)
        rate = Threshold(*(find_rate(storage, x, known) for x in modulus))
    heights = pair.range / RANGES[-1], ROUGHEST * pair.h_rms
    error_factor = pair.anisotropy_error_factor
    pressures = find_pressures(spectrum, solid, pair.q0, error_factor, contact_area)
    return Thresholds(
        modulus=modulus,
        rms_height=search(lambda h_rms: pair.scaled(h_rms / pair.h_rms), *heights),
        thickness=thickness,
        pressure=Threshold(*(pair.modulus * pressures).tolist()),
        rate=rate,
    )


def find_crossing(
    share: Callable[[NDArray], NDArray], start: float, stop: float, wanted: float, last: bool
) -> float:
    """Find where a share first, or at `last`, falls below the wanted one from `start` to `stop`.

    0 or infinity if that is beyond the start or the stop. The share is large at the start.
    """
    x = np.geomspace(start, stop, 2 + int(_PER_DECADE * abs(np.log10(stop / start))))
    for finer in range(_TIMES):
        enough = share(x) >= wanted
        if finer:
            enough[0], enough[-1] = True, False
        before, after = np.append(True, enough), np.append(enough, False)
        count = np.flatnonzero(before)[-1] if last else np.argmin(after)
        if count in (0, x.size):
            return 0.0 if (count == 0) == (start < stop) else np.inf
        x = np.geomspace(x[count - 1], x[count], _FINER)
    return float(np.sqrt(x[0] * x[-1]))


def find_rate(storage: Modulus, modulus: float, frequencies: ArrayLike) -> float:
    """Find the frequency [Hz] up to which a storage modulus stays below another one.

    0 or infinity if that is at none of the increasing `frequencies`, or at all of them.
    """
    if not 0 < modulus < np.inf:
        return float(modulus)
    passed = [hertz for hertz, rises in crossings(storage, modulus, frequencies) if rises]
    below = np.nanmin(storage.storage(frequencies)) < modulus
    return passed[0] if passed else np.inf if below else 0.0


def find_pressures(
    spectrum: Spectrum, solid: Solid, q0: float, error_factor: float, area: float = CONTACT_AREA
) -> NDArray:
    """Mean pressure [E*] at an area of contact, with its low and high limit."""
    error, harder = min(AREA_ERROR * error_factor, 0.9), max(1 - float(solid.factor(q0)), 0.0)
    areas = area * np.array([1.0, (1 - error) * (1 - AREA_ERROR_LAYER * harder), 1 + error])
    return Persson(spectrum, correction="wang2017", solid=solid).pressure_at_area(areas)
