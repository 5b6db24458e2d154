"""Attraction of a rough surface as that of a smooth one, for DEM and FE models."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from stickiness.remaining.prediction import PULL_OFF_UNKNOWN


def describe_contact_law(
    *,
    law: str,
    modulus: float,
    work_of_adhesion: float,
    range: float,
    remaining: ArrayLike,
    pull_off: ArrayLike,
    energy_ratio: float,
) -> dict[str, Any]:
    """Return what is given of a pair, in SI units, and its effective attraction, ready for JSON.

    The effective work of adhesion is the share that remains of the given one. Over the pull-off
    stress it is the effective range, over which a smooth surface would have to attract with that
    stress. What is not known is left out: the range where nothing pulls, and all but the low limit
    of the pull-off next to full contact, where `energy_ratio`, the work of adhesion over the energy
    of full contact, is large. `remaining` and `pull_off` are (value, low, high).
    """
    work, stress = work_of_adhesion * np.array(remaining), np.array(pull_off, dtype=float)
    if energy_ratio > PULL_OFF_UNKNOWN:
        stress[[0, 2]] = np.nan
    distance = np.divide(work, stress, out=np.full(3, np.nan), where=stress > 0)
    known = np.fmin.reduce(distance), np.fmax.reduce(distance)
    distance[1:] = known if np.isfinite(distance[0]) else np.nan
    given = {"modulus": (modulus, "Pa"), "range": (range, "m")}
    given["work_of_adhesion"] = work_of_adhesion, "J/m^2"
    effective = {"pull_off_stress": (stress, "Pa"), "range": (distance, "m")}
    effective["work_of_adhesion"] = work, "J/m^2"
    names = "value", "low", "high"
    return {
        "law": law,
        "given": {name: {"value": float(x), "unit": unit} for name, (x, unit) in given.items()},
        "effective": {
            name: {n: x for n, x in zip(names, three.tolist(), strict=True) if np.isfinite(x)}
            | {"unit": unit}
            for name, (three, unit) in effective.items()
        },
    }
