"""What would make a material stick to a rough surface: the verdict's questions the other way round.

Shares need not fall steadily, so that a whole range is searched. The limits of a threshold are
where the low limit of the share first fails, and where the high limit of the share last suffices.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from stickiness.criteria.a_v_table import RANGES
from stickiness.criteria.pair import Pair
from stickiness.limited import Limited
from stickiness.persson.theory import Persson
from stickiness.remaining.thin_layers import find_flow
from stickiness.solids import Layer, Skin, Solid
from stickiness.solids.moduli import Modulus
from stickiness.spectrum.interface import Spectrum
from stickiness.verdicts.draws import find_share_quantiles
from stickiness.verdicts.limits import find_limits, find_value
from stickiness.verdicts.material import Material
from stickiness.verdicts.pair_roughness import PairRoughness

CONTACT_AREA = 0.05  #: share of the nominal area
LEAST_AREA = 0.005  #: least and largest share of the nominal area that may be asked for
MOST_AREA = 0.35
# Relative, of areas by theory: covers simulations at these areas (H = 0.3 to 0.9, magnifications of
# 16 to 256, cells of two waves and more). On thin bonded layers theory has as little as half of it.
AREA_ERROR = 0.15
AREA_ERROR_LAYER = 0.45
AREA_ERROR_SKIN = 0.35  # simulations have 0.75 to 1.2 times the area of theory
MOST_AREA_ERROR = 0.9
ROUGHEST = 1e3  #: highest rms height that is searched, over the actual one
DEEPEST = 25.0  #: thickest layer that is searched, over 1/q of the longest waves
LOWEST_FREQUENCY = 1e-12  #: [Hz], lowest and highest that are searched of a Prony series
HIGHEST_FREQUENCY = 1e12
_POINTS_PER_DECADE = 5  # of the search
_PRECISION = 1e-8  # relative, between two points of the search
_CONVERGED = 0  # status of SciPy's search
_NOT_BRACKETED = -1

Remain = Callable[[Pair], NDArray]  # shares (n, end, limit), see `remain_at_ends`


UNKNOWN = Limited(np.nan, np.nan, np.nan)
THRESHOLDS = {  #: unit, description, and why a value may be missing
    "rms_height_threshold": ("m", "rms height below which the wanted share remains", "not known"),
    "thickness_threshold": ("m", "thickness above which the wanted share remains", "no layer"),
    "rate_threshold": ("Hz", "frequency below which the wanted share remains", "elastic, or dwell"),
    "contact_pressure": (
        "Pa",
        f"mean pressure that makes {CONTACT_AREA:.0%} contact without adhesion",
        "not judged",
    ),
}


def find_thresholds(
    material: Material,
    rough: PairRoughness,
    cell: xr.Dataset,
    contact_area: float,
    wanted_share: float,
) -> dict[str, Limited]:
    """Find every one of `THRESHOLDS` for a pair; NaN where it does not apply.

    `cell` has the judged modulus threshold of the pair.
    """
    if rough.not_judged:
        return dict.fromkeys(THRESHOLDS, UNKNOWN)
    draws = rough.meet_draws(material, wanted_share)
    if draws is None:
        pair = rough.meet_ends(material, wanted_share)
        remain: Remain = remain_at_ends
        h_rms = float(rough.ends.h_rms[-1])
    else:
        pair = draws
        remain = remain_on_draws
        h_rms = float(np.sqrt(np.prod(rough.ends.h_rms)))
    spectra = list(rough.spectra)
    return {
        "rms_height_threshold": find_rms_height(pair, h_rms, remain),
        "thickness_threshold": find_thickness(pair, material.solid, spectra, remain) or UNKNOWN,
        "rate_threshold": _find_rate_of(material, cell),
        "contact_pressure": find_pressure(spectra, material.solid, pair, contact_area),
    }


def _find_rate_of(material: Material, cell: xr.Dataset) -> Limited:
    """Frequency below which a material sticks; NaN of an elastic solid, and after a dwell."""
    if not material.depends_on_rate or material.dwell is not None:
        return UNKNOWN
    name = "modulus_threshold"
    moduli = np.sort([float(find_value(cell, name)), *map(float, find_limits(cell, name))])
    return find_rate(material.plane_strain, moduli)


def remain_at_ends(pair: Pair) -> NDArray:
    """Low limit, value and high limit of the share that remains, along a last axis."""
    return np.stack([pair.remaining(sign) for sign in (-1, 0, 1)], axis=-1)


def remain_on_draws(draws: Pair) -> NDArray:
    """Quantiles of the share that remains over the draws, ``(n, 1, limit)``."""
    return find_share_quantiles(draws)[:, None]


def find_rms_height(pair: Pair, h_rms: float, remain: Remain = remain_at_ends) -> Limited:
    """Find the rms height [m] below which the wanted share remains; `h_rms` is what `pair` has.

    `pair` has arrays of the ends of what is known of a surface, or of draws.
    """
    return find_threshold(
        lambda height: remain(pair.scaled(height / h_rms)),
        start=pair.range / RANGES[-1],
        stop=ROUGHEST * h_rms,
        wanted=pair.wanted_share,
    )


def find_thickness(
    pair: Pair, solid: Solid, spectra: list[Spectrum], remain: Remain = remain_at_ends
) -> Limited | None:
    """Find the thickness [m] of a layer above which the wanted share remains; None of other solids.

    `spectra` are of the ends; draws change as both do on average. Others as of `find_rms_height`.
    """
    if not isinstance(solid, Layer):
        return None
    h_rms, q0 = np.atleast_1d(pair.h_rms, pair.q0)

    def put_on(thickness: NDArray) -> NDArray:
        # The layer as it is comes first: all else is in proportion to what the pair has with it.
        layers = [solid, *(replace(solid, thickness=d) for d in thickness[:, 0])]
        energy = np.array([[s.elastic_energy(layer) for s in spectra] for layer in layers])
        if h_rms.size > len(spectra):
            energy = np.exp(np.log(energy).mean(axis=1, keepdims=True))
        softness = np.array([layer.factor(q0) for layer in layers])
        changed = replace(
            pair,
            elastic_energy=pair.elastic_energy * energy[1:] / energy[0],
            relative_compliance=pair.relative_compliance * softness[1:] / softness[0],
            flow=np.array([find_flow(layer, q0) for layer in layers[1:]]),
            layer_strain=np.array([layer.strain(h_rms, q0) for layer in layers[1:]]),
        )
        if np.any(np.not_equal(pair.simulated, None)):
            # Simulated states are those of one thickness; others keep what it does at the same
            # ratio of the work of adhesion to the energy of full contact.
            work = pair.work_of_adhesion * energy[0] / energy[1:]
            changed = replace(changed, work_of_adhesion=work)
        return remain(changed)

    return find_threshold(
        put_on, start=DEEPEST / spectra[0].band[0], stop=h_rms.min(), wanted=pair.wanted_share
    )


def find_rate(storage: Modulus, moduli: ArrayLike) -> Limited:
    """Find the frequency [Hz] up to which a storage modulus stays below others: low, value, high.

    It is searched within a table, and over all frequencies of a Prony series.
    """
    frequencies = getattr(storage, "frequencies", (LOWEST_FREQUENCY, HIGHEST_FREQUENCY))
    return find_threshold(
        lambda f: moduli / storage.storage(f)[..., None],
        start=frequencies[0],
        stop=frequencies[-1],
        wanted=1.0,
    )


def find_threshold(
    remain: Callable[[NDArray], NDArray], start: float, stop: float, wanted: float
) -> Limited:
    """Find where shares fall below the wanted one from `start`, where they are large, to `stop`.

    0 or infinity if that is beyond the start or the stop. `remain` makes shares (n, end, limit) of
    values (n, 1). The value is at the last end, the rough one, as in verdicts; limits are farthest.
    """
    points = 2 + int(_POINTS_PER_DECADE * abs(np.log10(stop / start)))
    x = np.geomspace(start, stop, points)
    enough = remain(x[:, None]) >= wanted

    # How many points lie before the crossing of every end and limit: for the high limit up to the
    # last that suffices, for the others up to the first that fails.
    backwards = np.concatenate([enough[::-1], np.ones((1, *enough.shape[1:]), dtype=bool)])
    forwards = np.concatenate([enough, np.zeros((1, *enough.shape[1:]), dtype=bool)])
    is_high = np.arange(enough.shape[-1]) == 2
    before = np.where(is_high, points - backwards.argmax(axis=0), forwards.argmin(axis=0))

    # A crossing beyond the start or the stop is not searched.
    crossing = np.where((before == 0) == (start < stop), 0.0, np.inf)
    is_within = (before > 0) & (before < points)
    if is_within.any():
        bracket = (x[before[is_within] - 1], x[before[is_within]])
        crossing[is_within] = _find_crossings(remain, bracket, np.nonzero(is_within), wanted)
    return Limited(
        value=float(crossing[-1, 1]), low=float(crossing.min()), high=float(crossing.max())
    )


def _find_crossings(
    remain: Callable[[NDArray], NDArray],
    bracket: tuple[NDArray, NDArray],
    places: tuple[NDArray, ...],
    wanted: float,
) -> NDArray:
    """Find where shares cross the wanted one, each between two points; `places` are end and limit.

    All are searched together: an evaluation gives the shares of all ends and limits anyway.
    """
    from scipy.optimize import elementwise  # not loaded with `scipy.optimize`

    def find_excess(value: NDArray, end: NDArray, limit: NDArray) -> NDArray:
        return remain(value[:, None])[np.arange(value.size), end, limit] - wanted

    root = elementwise.find_root(
        find_excess, bracket, args=places, tolerances={"xrtol": _PRECISION}
    )
    if not np.isin(root.status, (_CONVERGED, _NOT_BRACKETED)).all():
        raise ValueError("a share that remains is not a number within the range searched")
    # By rounding, a share that equals the wanted one at a point may lie on either side of it.
    left, right = np.abs(root.f_bracket)
    nearest = np.where(left <= right, *bracket)
    return np.where(root.success, root.x, nearest)


def find_pressure(
    spectra: list[Spectrum], solid: Solid, pair: Pair, area: float = CONTACT_AREA
) -> Limited:
    """Find the mean pressure [Pa] at an area of contact, without adhesion.

    The value is at the last of the `spectra`, the rough one, or with draws between the ends.
    """
    q0 = float(np.mean(pair.q0))
    error = min(AREA_ERROR * float(np.mean(pair.anisotropy_error_factor)), MOST_AREA_ERROR)
    if isinstance(solid, Skin):
        error = max(error, AREA_ERROR_SKIN)
    stiffer_layer = max(1 - float(solid.factor(q0)), 0.0)
    least = (1 - error) * (1 - AREA_ERROR_LAYER * stiffer_layer)
    areas = area * np.array([least, 1.0, 1 + error])
    theories = [Persson(spectrum, correction="wang2017", solid=solid) for spectrum in spectra]
    pressures = np.array([theory.pressure_at_area(areas) for theory in theories]) * pair.modulus
    is_drawn = np.size(pair.h_rms) > len(spectra)
    value = np.exp(np.log(pressures[:, 1]).mean()) if is_drawn else pressures[-1, 1]
    return Limited(
        value=float(value), low=float(pressures[:, 0].min()), high=float(pressures[:, 2].max())
    )
