"""Share that remains along the modulus, the rms height, the rate and the dwell of a pair."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stickiness.criteria.pair import SIGNS, Pair
from stickiness.verdicts.draws import QUANTILES, find_share_quantiles
from stickiness.verdicts.limits import find_limits
from stickiness.verdicts.material import Material

PAIR_DIMENSIONS = ("material", "surface", "end")
# Factors on E*, on heights at an unchanged shape of the spectrum, and on the dwell, 1 among them.
MODULUS_FACTORS = 10.0 ** (np.arange(-60, 41) / 10)
ROUGHNESS_FACTORS = 10.0 ** (np.arange(-16, 17) / 16)
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
    """Points along an axis, at which the share is evaluated."""

    moduli: NDArray  #: E* [Pa], (point, material); NaN where it is not known
    heights: NDArray  #: factors on the heights, (point,)
    instant_ratios: NDArray  #: `Material.instant_ratio` there, (point, material)


def follow_remaining(
    pair: Pair,
    materials: Sequence[Material],
    draws: Sequence[Sequence[Pair | None]],
    rate_moduli: NDArray,
) -> dict[str, xr.DataArray | NDArray]:
    """Share that remains along every axis of `AXES`, with its limits.

    `draws` has a row for every material with a `Pair` for every surface. `rate_moduli` are the
    storage moduli at the frequencies, ``(material, frequency)``.
    """
    has_dwell = np.array([material.dwell is not None for material in materials])
    moduli = np.array([material.plane_strain_modulus for material in materials])
    dwell_factors = DWELL_FACTORS if has_dwell.any() else np.ones(1)
    dwell_moduli = np.array(
        [[_find_modulus(material, factor) for material in materials] for factor in dwell_factors]
    )
    instant_ratios = np.array([material.instant_ratio for material in materials])
    paths = {
        "modulus": _Path(
            moduli=MODULUS_FACTORS[:, None] * moduli,
            heights=np.ones(MODULUS_FACTORS.size),
            instant_ratios=instant_ratios[None],
        ),
        "roughness": _Path(
            moduli=np.broadcast_to(moduli, (ROUGHNESS_FACTORS.size, moduli.size)),
            heights=ROUGHNESS_FACTORS,
            instant_ratios=instant_ratios[None],
        ),
        "rate": _Path(
            moduli=np.where(has_dwell, np.nan, rate_moduli.T),
            heights=np.ones(rate_moduli.shape[1]),
            instant_ratios=instant_ratios[None],
        ),
        "dwell": _Path(
            moduli=np.where(has_dwell, dwell_moduli, np.nan),
            heights=np.ones(dwell_factors.size),
            instant_ratios=instant_ratios * moduli / dwell_moduli,
        ),
    }
    curves: dict[str, xr.DataArray | NDArray] = {
        "modulus_factor": MODULUS_FACTORS,
        "roughness_factor": ROUGHNESS_FACTORS,
        "dwell_factor": dwell_factors,
    }
    for axis, path in paths.items():
        followed = _follow(pair, draws, AXES[axis].dimension, path)
        for ending, curve in zip(SIGNS, followed, strict=True):
            curves[f"remaining_by_{axis}{ending}"] = curve
    return curves


def _find_modulus(material: Material, dwell_factor: float) -> float:
    """E* after the dwell times a factor [Pa]; NaN beyond a table."""
    if material.dwell is None:
        return material.plane_strain_modulus
    return float(material.plane_strain.relaxation(dwell_factor * material.dwell))


def _follow(
    pair: Pair, draws: Sequence[Sequence[Pair | None]], dimension: str, path: _Path
) -> list[xr.DataArray]:
    """Share along a path, with the limits that decide."""
    is_known = xr.DataArray(~np.isnan(path.moduli), dims=(dimension, "material"))
    moduli = np.where(is_known, path.moduli, pair.modulus[:, 0, 0])
    ratios = np.where(is_known, path.instant_ratios, 1.0)

    # Both ends of every surface.
    scaled = pair.scaled(path.heights[:, None, None, None])
    changed = replace(
        scaled.at_modulus(moduli[..., None, None] / pair.modulus),
        modulus=moduli[..., None, None],
        instant_ratio=ratios[..., None, None],
    )
    shares = xr.Dataset(
        {
            f"remaining{ending}": ((dimension, *PAIR_DIMENSIONS), changed.remaining(sign))
            for ending, sign in SIGNS.items()
        }
    )
    # The draws of measured surfaces.
    quantiles = [
        [_follow_draws(drawn, moduli[:, i], ratios[:, i], path.heights) for drawn in row]
        for i, row in enumerate(draws)
    ]
    dims = (*PAIR_DIMENSIONS[:2], dimension, "quantile")
    shares["remaining_quantile"] = (dims, np.array(quantiles))
    low, high = find_limits(shares)
    return [
        curve.where(is_known).transpose(*PAIR_DIMENSIONS, dimension, missing_dims="ignore")
        for curve in (shares.remaining, low, high)
    ]


def _follow_draws(
    draws: Pair | None, moduli: NDArray, ratios: NDArray, heights: NDArray
) -> NDArray:
    """Quantiles of the share over the draws of a surface, ``(point, quantile)``; NaN without."""
    if draws is None:
        return np.full((len(moduli), len(QUANTILES)), np.nan)
    # Points at which nothing differs are evaluated once.
    points, place = np.unique([moduli, heights, ratios], axis=1, return_inverse=True)
    moduli, heights, ratios = points[..., None]
    changed = replace(
        draws.scaled(heights).at_modulus(moduli / draws.modulus),
        modulus=moduli,
        instant_ratio=ratios,
    )
    return find_share_quantiles(changed)[place]
