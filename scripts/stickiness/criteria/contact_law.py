"""Attraction of a rough surface as that of a smooth one, for DEM and FE models."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from stickiness.remaining.prediction import PULL_OFF_UNKNOWN


def describe_contact_law(
    modulus: float,
    work_of_adhesion: float,
    range: float,
    remaining: ArrayLike,
    pull_off: ArrayLike,
    energy_ratio: float,
) -> dict[str, dict[str, Any]]:
    """Return what is given of a pair, in SI units, and its effective attraction, ready for JSON.

    `remaining` and `pull_off` are (value, low, high). What is not known is left out: all but the
    low limit of the pull-off where `energy_ratio`, the work of adhesion over the energy of full
    contact, is large.
    """
    work, stress = work_of_adhesion * np.array(remaining), np.array(pull_off, dtype=float)
    if energy_ratio > PULL_OFF_UNKNOWN:
        stress[[0, 2]] = np.nan
    found = {
        "modulus": ("Pa", [modulus]),
        "work_of_adhesion": ("J/m^2", [work_of_adhesion]),
        "range": ("m", [range]),
        "effective_work_of_adhesion": ("J/m^2", work),
        "pull_off_stress": ("Pa", stress),
    }
    ends = "value", "low", "high"
    return {
        name: {end: float(x) for end, x in zip(ends, values, strict=False) if np.isfinite(x)}
        | {"unit": unit}
        for name, (unit, values) in found.items()
    }
