"""Adhesive parameters of the configuration in the units of the simulations.

Those are h_rms for gaps and ranges and E* q0 h_rms for pressures, so that the strength
sigma0/E* = l_a/range becomes (l_a/range)/(q0 h_rms).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from stickiness import adhesive
from stickiness.model_choice import roughness

LAWS = {
    "maugis": adhesive.Maugis,
    "exponential": adhesive.Exponential,
}

MISSING = "the grid does not resolve the edge, or a window closes"

AXES = ("pressure", "adhesion_length_over_range", "range_over_h_rms")
DESCRIBED = {
    "q0_h_rms": ("1", "lowest wave number times rms height"),
    "adhesion_length_over_range": ("1", "adhesion length over range, sigma0/E*"),
    "range_over_h_rms": ("1", "range of attraction over h_rms"),
}


def axis(name: str, asked: Mapping[str, Any], key: str | None = None) -> xr.DataArray:
    """One list of the configuration (under `key`, by default its name), in increasing order."""
    values = np.sort(np.array(asked[key or name], dtype=float))
    return xr.DataArray(values, dims=name, coords={name: values}, name=name)


def axes(asked: Mapping[str, Any]) -> tuple[xr.DataArray, xr.DataArray, xr.DataArray]:
    """Pressures, adhesion lengths and ranges of a set, in the order of `AXES`."""
    return tuple(axis(name, asked, "pressures" if name == "pressure" else None) for name in AXES)


def scaled_law(
    asked: Mapping[str, Any], kind: str, adhesion_length_over_range: float, range_over_h_rms: float
) -> adhesive.TractionLaw:
    """Traction law in the units of the simulations."""
    strength = adhesion_length_over_range / roughness(asked)
    return LAWS[kind](adhesion_length=strength * range_over_h_rms, range=range_over_h_rms)
