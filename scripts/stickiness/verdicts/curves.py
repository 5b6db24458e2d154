"""Share that remains along the modulus, the rms height, the rate and the dwell of a pair."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.criteria.pair import Pair
from stickiness.entries.material import Material
from stickiness.verdicts.pair_roughness import PairRoughness

# Factors on E*, on heights at an unchanged shape of the spectrum, and on the dwell, 1 among them.
MODULUS_FACTORS = 10.0 ** (np.arange(-60, 41) / 10)
ROUGHNESS_FACTORS = 10.0 ** (np.arange(-16, 17) / 16)
#: Frequencies of loading [Hz], for moduli that depend on it.
FREQUENCIES = 10.0 ** (np.arange(-8, 13) / 2)
DWELL_FACTORS = 10.0 ** (np.arange(-16, 17) / 4)


class Axis(NamedTuple):
    """An axis along which the share is followed."""

    dimension: str
    description: str
    nan_means: str


AXES = {
    "modulus": Axis("modulus_factor", "for E* times a factor", "not judged"),
    "roughness": Axis("roughness_factor", "for the pair's heights times a factor", "not judged"),
    "rate": Axis("frequency", "at a frequency", "beyond the material's table, or dwell"),
    "dwell": Axis("dwell_factor", "for the dwell times a factor", "no dwell, or beyond the table"),
}


class _Path(NamedTuple):
    """Points along an axis, at which the share is evaluated; numbers, or arrays ``(point,)``."""

    moduli: ArrayLike  #: E* [Pa]; NaN where it is not known
    instant_ratios: ArrayLike  #: `Material.instant_ratio` there
    heights: ArrayLike = 1.0  #: factors on the heights


def find_axes(materials: Iterable[Material], frequencies: NDArray) -> dict[str, NDArray]:
    """Points of all axes by their dimension, in common for the materials."""
    has_dwell = any(material.dwell is not None for material in materials)
    return {
        "modulus_factor": MODULUS_FACTORS,
        "roughness_factor": ROUGHNESS_FACTORS,
        "frequency": frequencies,
        "dwell_factor": DWELL_FACTORS if has_dwell else np.ones(1),
    }


def find_rate_moduli(material: Material, axes: Mapping[str, NDArray]) -> NDArray:
    """E* of a material at the frequencies of the axes [Pa]; NaN beyond a table."""
    return np.atleast_1d(material.plane_strain.storage(axes["frequency"]))


def follow_remaining(
    pair: Pair, rough: PairRoughness, material: Material, axes: Mapping[str, NDArray]
) -> dict[str, NDArray]:
    """Share that remains along every one of `AXES`, ``(point, limit)``; `axes` of `find_axes`."""
    modulus = material.plane_strain_modulus
    ratio = material.instant_ratio
    rate_moduli = find_rate_moduli(material, axes)
    dwell_moduli = np.full(axes["dwell_factor"].shape, np.nan)
    if material.dwell is not None:
        rate_moduli = np.full(rate_moduli.shape, np.nan)
        dwells = material.dwell * axes["dwell_factor"]
        dwell_moduli = np.array([float(material.plane_strain.relaxation(each)) for each in dwells])
    paths = {
        "modulus": _Path(axes["modulus_factor"] * modulus, ratio),
        "roughness": _Path(modulus, ratio, heights=axes["roughness_factor"]),
        "rate": _Path(rate_moduli, ratio),
        "dwell": _Path(dwell_moduli, instant_ratios=ratio * modulus / dwell_moduli),
    }
    return {f"remaining_by_{axis}": _follow(pair, rough, path) for axis, path in paths.items()}


def _follow(pair: Pair, rough: PairRoughness, path: _Path) -> NDArray:
    """Limits of the share along a path, ``(point, limit)``; NaN where the modulus is not known."""
    columns = np.array(np.broadcast_arrays(*path))
    is_known = np.isfinite(columns[0])
    curve = np.full((is_known.size, 3), np.nan)
    if not is_known.any():
        return curve
    # Points at which nothing differs are evaluated once.
    points, place = np.unique(columns[:, is_known], axis=1, return_inverse=True)
    moduli, ratios, heights = points[..., None]
    changed = pair.scaled(heights).at_modulus(moduli)
    changed = replace(changed, rough=replace(changed.rough, instant_ratio=ratios))
    curve[is_known] = rough.limit(changed.remaining, changed)[place]
    return curve
