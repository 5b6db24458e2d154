"""Share that remains along the modulus, the rms height, the rate and the dwell of a pair."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

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
    """Points along an axis, at which the share is evaluated, arrays ``(point,)``."""

    moduli: NDArray  #: E* [Pa]; NaN where it is not known
    heights: NDArray  #: factors on the heights
    instant_ratios: NDArray  #: `Material.instant_ratio` there


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
    has_dwell = material.dwell is not None
    dwell_moduli = np.array([_find_modulus(material, factor) for factor in axes["dwell_factor"]])
    moduli = {
        "modulus": axes["modulus_factor"] * modulus,
        "roughness": np.full(axes["roughness_factor"].shape, modulus),
        "rate": np.where(has_dwell, np.nan, find_rate_moduli(material, axes)),
        "dwell": np.where(has_dwell, dwell_moduli, np.nan),
    }
    curves = {}
    for axis, its_moduli in moduli.items():
        ratios = np.full(its_moduli.shape, material.instant_ratio)
        path = _Path(
            moduli=its_moduli,
            heights=axes["roughness_factor"] if axis == "roughness" else np.ones(ratios.shape),
            instant_ratios=ratios * modulus / its_moduli if axis == "dwell" else ratios,
        )
        curves[f"remaining_by_{axis}"] = _follow(pair, rough, path)
    return curves


def _find_modulus(material: Material, dwell_factor: float) -> float:
    """E* after the dwell times a factor [Pa]; NaN beyond a table."""
    if material.dwell is None:
        return material.plane_strain_modulus
    return float(material.plane_strain.relaxation(dwell_factor * material.dwell))


def _follow(pair: Pair, rough: PairRoughness, path: _Path) -> NDArray:
    """Limits of the share along a path, ``(point, limit)``; NaN where the modulus is not known."""
    curve = np.full((path.moduli.size, 3), np.nan)
    is_known = np.isfinite(path.moduli)
    if not is_known.any():
        return curve
    # Points at which nothing differs are evaluated once.
    points, place = np.unique(np.array(path)[:, is_known], axis=1, return_inverse=True)
    moduli, heights, ratios = points[..., None]
    changed = pair.scaled(heights).at_modulus(moduli)
    changed = replace(changed, rough=replace(changed.rough, instant_ratio=ratios))
    curve[is_known] = rough.limit(changed.remaining, changed)[place]
    return curve
