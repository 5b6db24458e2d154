"""Adhesive parameters of the configuration in the units of the simulations.

Those are h_rms for gaps and ranges and E* q0 h_rms for pressures, so that the strength
sigma0/E* = l_a/range becomes (l_a/range)/(q0 h_rms).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from stickiness import adhesive, criteria
from stickiness.units import si

LAWS = {
    "maugis": adhesive.Maugis,
    "exponential": adhesive.Exponential,
}

MISSING = "the grid does not resolve the edge, or a window closes"

DESCRIBED = {
    "q0_h_rms": ("1", "lowest wave number times rms height"),
    "adhesion_length_over_range": ("1", "adhesion length over range, sigma0/E*"),
    "range_over_h_rms": ("1", "range of attraction over h_rms"),
}


def roughness(asked: Mapping[str, Any]) -> float:
    """Dimensionless roughness q0 h_rms, given as such or by a window and an rms height."""
    if "q0_h_rms" in asked:
        return float(asked["q0_h_rms"])
    return 2 * np.pi / si(asked["window"], "m") * si(asked["h_rms"], "m")


def axis(name: str, asked: Mapping[str, Any]) -> xr.DataArray:
    """One list of the configuration as a coordinate, in increasing order."""
    values = np.sort(np.array(asked[name], dtype=float))
    return xr.DataArray(values, dims=name, coords={name: values})


def scaled_law(
    asked: Mapping[str, Any], kind: str, adhesion_length_over_range: float, range_over_h_rms: float
) -> adhesive.TractionLaw:
    """Traction law in the units of the simulations."""
    strength = adhesion_length_over_range / roughness(asked)
    return LAWS[kind](adhesion_length=strength * range_over_h_rms, range=range_over_h_rms)


def dmt_valid(q0_h_rms, lengths, ranges):
    """Where the JTB condition lets the repulsive gaps stand, with lengths in units of 1/q0."""
    length, range_ = xr.broadcast(lengths, ranges)
    range_ = range_ * q0_h_rms
    valid = criteria.dmt_validity(q0_h_rms, 1.0, (length * range_).values, range_.values).valid
    return length.dims, np.asarray(valid, dtype="i1")
