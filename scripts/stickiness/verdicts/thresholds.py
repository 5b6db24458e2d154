"""What would make a material stick to a rough surface: the verdict's questions the other way round.

Shares need not fall steadily, so that a whole range is searched. The limits of a threshold are
where the low limit of the share first fails, and where the high limit of the share last suffices.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.criteria.a_v_theory import RANGES
from stickiness.limited import Limited
from stickiness.persson.theory import Persson
from stickiness.remaining.solid_response import find_columns
from stickiness.solids import Layer, Skin
from stickiness.solids.moduli import Constant, Modulus
from stickiness.verdicts.limits import ROUGH_END, VALUE
from stickiness.verdicts.meeting import Meeting
from stickiness.verdicts.pair_variables import CONTACT_AREA, THRESHOLDS

LEAST_AREA = 0.005  #: least and largest share of the nominal area that may be asked for
MOST_AREA = 0.35
# Relative, of areas by theory: covers simulations at these areas (H = 0.3 to 0.9, magnifications of
# 16 to 256, cells of two waves and more). On thin bonded layers theory has as little as half of it.
AREA_ERROR = 0.15
AREA_ERROR_LAYER = 0.45
AREA_ERROR_SKIN = 0.35  # simulations have 0.75 to 1.2 times the area of theory
MOST_AREA_ERROR = 0.9
#: Columns of roughness that change with the thickness of a layer.
OF_LAYER = ("elastic_energy", "rigid_base_energy", "relative_compliance", "flow")
ROUGHEST = 1e3  #: highest rms height that is searched, over the actual one
DEEPEST = 25.0  #: thickest layer that is searched, over 1/q of the longest waves
LOWEST_FREQUENCY = 1e-12  #: [Hz], lowest and highest that are searched of a Prony series
HIGHEST_FREQUENCY = 1e12
_POINTS_PER_DECADE = 5  # of the search
_PRECISION = 1e-8  # relative, between two points of the search
_CONVERGED = 0  # status of SciPy's search
_NOT_BRACKETED = -1

UNKNOWN = Limited(np.nan, np.nan, np.nan)


def find_thresholds(
    meeting: Meeting,
    cell: Mapping[str, Any],
    contact_area: float,
    rms_height: float | None = None,
) -> dict[str, Limited[float]]:
    """Find every one of `THRESHOLDS` for a pair; NaN where it does not apply.

    `cell` has the threshold of E* [Pa]. `rms_height` [m] is the one that readers know, if it is not
    that of the spectrum: thresholds are in proportion.
    """
    if meeting.not_judged:
        return dict.fromkeys(THRESHOLDS, UNKNOWN)
    has_rates = not isinstance(meeting.moduli, Constant) and meeting.dwell is None
    moduli = cell["plane_strain_modulus_threshold"]
    return {
        "rms_height_threshold": find_rms_height(meeting, rms_height),
        "thickness_threshold": find_thickness(meeting),
        "rate_threshold": find_rate(meeting.moduli, moduli) if has_rates else UNKNOWN,
        "contact_pressure": find_pressure(meeting, contact_area),
    }


def find_rms_height(meeting: Meeting, rms_height: float | None = None) -> Limited[float]:
    """Find the rms height [m] below which the wanted share remains; see `find_thresholds`."""
    pair = meeting.pair
    h_rms = float(meeting.limit(pair.h_rms, pair)[VALUE])

    def remain(height: NDArray) -> NDArray:
        scaled = pair.scaled(height[:, None] / h_rms)
        return meeting.limit(scaled.remaining, scaled)

    highest = find_threshold(
        remain,
        start=pair.range / RANGES[-1],
        stop=ROUGHEST * h_rms,
        wanted=pair.wanted_share,
    )
    scale = 1.0 if rms_height is None else rms_height / h_rms
    return Limited(*(scale * height for height in highest))


def find_thickness(meeting: Meeting) -> Limited[float]:
    """Find the thickness [m] of a layer above which the wanted share remains; NaN of others."""
    solid = meeting.solid
    if not isinstance(solid, Layer):
        return UNKNOWN
    pair = meeting.pair
    rough = pair.rough
    family = meeting.family.take(np.asarray(rough.row))

    def remain(thickness: NDArray) -> NDArray:
        layers = [replace(solid, thickness=each) for each in thickness]
        by_layer = [find_columns(family, layer, rough.q0) for layer in layers]
        columns: dict[str, Any] = {
            name: np.array([column[name] for column in by_layer]) for name in OF_LAYER
        }
        changed = replace(
            pair,
            rough=replace(rough, **columns),
            layer_strain=np.array([layer.strain(rough.h_rms, rough.q0) for layer in layers]),
        )
        if rough.simulated is not None:
            # Simulated states are those of one thickness; others keep what it does at the same
            # ratio of the work of adhesion to the energy of full contact.
            ratio = rough.elastic_energy / columns["elastic_energy"]
            changed = replace(changed, work_of_adhesion=pair.work_of_adhesion * ratio)
        return meeting.limit(changed.remaining, changed)

    return find_threshold(
        remain,
        start=DEEPEST / meeting.spectra[0].band[0],
        stop=float(np.min(rough.h_rms)),
        wanted=pair.wanted_share,
    )


def find_rate(storage: Modulus, moduli: ArrayLike) -> Limited[float]:
    """Find the frequency [Hz] up to which a storage modulus stays below each of other moduli.

    It is searched within a table, and over all frequencies of a Prony series.
    """
    frequencies = getattr(storage, "frequencies", (LOWEST_FREQUENCY, HIGHEST_FREQUENCY))
    by_limit = np.sort(moduli)
    return find_threshold(
        lambda f: by_limit / np.asarray(storage.storage(f))[:, None],
        start=frequencies[0],
        stop=frequencies[-1],
        wanted=1.0,
    )


def find_threshold(
    remain: Callable[[NDArray], NDArray], start: float, stop: float, wanted: float
) -> Limited[float]:
    """Find where shares fall below the wanted one from `start`, where they are large, to `stop`.

    0 or infinity if that is beyond the start or the stop. `remain` makes shares ``(n, limit)``, low
    limit, value and high limit, of values ``(n,)``.
    """
    points = 2 + int(_POINTS_PER_DECADE * abs(np.log10(stop / start)))
    x = np.geomspace(start, stop, points)
    enough = remain(x) >= wanted

    # How many points lie before the crossing of every limit: for the high one up to the last that
    # suffices, for the others up to the first that fails.
    before = np.where(enough.all(axis=0), points, enough.argmin(axis=0))
    before[-1] = points - enough[::-1, -1].argmax() if enough[:, -1].any() else 0

    # A crossing beyond the start or the stop is not searched.
    crossing = np.where((before == 0) == (start < stop), 0.0, np.inf)
    (searched,) = np.nonzero((before > 0) & (before < points))
    if searched.size:
        bracket = (x[before[searched] - 1], x[before[searched]])
        crossing[searched] = _find_crossings(remain, bracket, searched, wanted)
    return Limited(
        value=float(crossing[VALUE]), low=float(crossing.min()), high=float(crossing.max())
    )


def _find_crossings(
    remain: Callable[[NDArray], NDArray],
    bracket: tuple[NDArray, NDArray],
    limits: NDArray,
    wanted: float,
) -> NDArray:
    """Find where shares cross the wanted one, for every one of the `limits` between two points.

    All are searched together: an evaluation gives the shares of all limits anyway.
    """
    from scipy.optimize import elementwise  # not loaded with `scipy.optimize`

    def find_excess(x: NDArray, limit: NDArray) -> NDArray:
        return remain(x)[np.arange(x.size), limit] - wanted

    root = elementwise.find_root(
        find_excess, bracket, args=(limits,), tolerances={"xrtol": _PRECISION}
    )
    if not np.isin(root.status, (_CONVERGED, _NOT_BRACKETED)).all():
        raise ValueError("a share that remains is not a number within the range searched")
    # By rounding, a share that equals the wanted one at a point may lie on either side of it.
    left, right = np.abs(root.f_bracket)
    nearest = np.where(left <= right, *bracket)
    return np.where(root.success, root.x, nearest)


def find_pressure(meeting: Meeting, area: float = CONTACT_AREA) -> Limited[float]:
    """Find the mean pressure [Pa] at an area of contact, without adhesion, by both ends."""
    ends = meeting.ends
    solid = meeting.solid
    error = min(AREA_ERROR * float(np.mean(ends.rough.anisotropy_error_factor)), MOST_AREA_ERROR)
    if isinstance(solid, Skin):
        error = max(error, AREA_ERROR_SKIN)
    stiffer_layer = max(1 - float(solid.factor(float(np.mean(ends.q0)))), 0.0)
    least = (1 - error) * (1 - AREA_ERROR_LAYER * stiffer_layer)
    areas = area * np.array([least, 1.0, 1 + error])
    theories = [
        Persson(spectrum, correction="wang2017", solid=solid) for spectrum in meeting.spectra
    ]
    pressures = ends.modulus * np.array([theory.pressure_at_area(areas) for theory in theories])
    low, middle, high = pressures.T
    # Measured surfaces lie between both ends, others at the rough one.
    value = np.sqrt(middle.prod()) if meeting.is_drawn else middle[ROUGH_END]
    return Limited(value=float(value), low=float(low.min()), high=float(high.max()))
