"""Share that remains along the modulus, the rms height, the rate and the dwell of a pair."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.solids.moduli import Modulus
from stickiness.verdicts.meeting import Meeting

# Factors on E*, on heights at an unchanged shape of the spectrum, and on the dwell, 1 among them.
MODULUS_FACTORS = 10.0 ** (np.arange(-60, 41) / 10)
ROUGHNESS_FACTORS = 10.0 ** (np.arange(-16, 17) / 16)
#: Frequencies of loading [Hz], for moduli that depend on it.
FREQUENCIES = 10.0 ** (np.arange(-8, 13) / 2)
DWELL_FACTORS = 10.0 ** (np.arange(-16, 17) / 4)


class _Path(NamedTuple):
    """Points along an axis, at which the share is evaluated; numbers, or arrays ``(point,)``."""

    moduli: ArrayLike  #: E* [Pa]; NaN where it is not known
    instant_ratios: ArrayLike  #: `Material.instant_ratio` there
    heights: ArrayLike = 1.0  #: factors on the heights


def find_axes(frequencies: NDArray) -> dict[str, NDArray]:
    """Points of all axes by their dimension, the same for every material."""
    return {
        "modulus_factor": MODULUS_FACTORS,
        "roughness_factor": ROUGHNESS_FACTORS,
        "frequency": frequencies,
        "dwell_factor": DWELL_FACTORS,
    }


def find_rate_moduli(moduli: Modulus, axes: Mapping[str, NDArray]) -> NDArray:
    """E* at the frequencies of the axes [Pa]; NaN beyond a table."""
    return np.atleast_1d(moduli.storage(axes["frequency"]))


def follow_remaining(meeting: Meeting, axes: Mapping[str, NDArray]) -> dict[str, NDArray]:
    """Share that remains along every one of `AXES`, ``(point, limit)``; `axes` of `find_axes`."""
    modulus = meeting.pair.modulus
    ratio = meeting.pair.rough.instant_ratio
    rate_moduli = find_rate_moduli(meeting.moduli, axes)
    dwell_moduli = np.full(axes["dwell_factor"].shape, np.nan)
    if meeting.dwell is not None:
        rate_moduli = np.full(rate_moduli.shape, np.nan)
        dwells = meeting.dwell * axes["dwell_factor"]
        dwell_moduli = np.array([float(meeting.moduli.relaxation(each)) for each in dwells])
    paths = {
        "modulus": _Path(axes["modulus_factor"] * modulus, ratio),
        "roughness": _Path(modulus, ratio, heights=axes["roughness_factor"]),
        "rate": _Path(rate_moduli, ratio),
        "dwell": _Path(dwell_moduli, instant_ratios=ratio * modulus / dwell_moduli),
    }
    return {f"remaining_by_{axis}": _follow(meeting, path) for axis, path in paths.items()}


def _follow(meeting: Meeting, path: _Path) -> NDArray:
    """Limits of the share along a path, ``(point, limit)``; NaN where the modulus is not known."""
    columns = np.array(np.broadcast_arrays(*path))
    is_known = np.isfinite(columns[0])
    curve = np.full((is_known.size, 3), np.nan)
    if not is_known.any():
        return curve
    # Points at which nothing differs are evaluated once.
    points, place = np.unique(columns[:, is_known], axis=1, return_inverse=True)
    moduli, ratios, heights = points[..., None]
    changed = meeting.pair.scaled(heights).at_modulus(moduli)
    changed = replace(changed, rough=replace(changed.rough, instant_ratio=ratios))
    curve[is_known] = meeting.limit(changed.remaining, changed)[place]
    return curve
