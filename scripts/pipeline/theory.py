"""Variants and corrections of Persson's theory that stages compute beside each other."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
import xarray as xr

from pipeline.conventions import VARIANT, middles
from stickiness.persson.kernels import CORRECTIONS

DESCRIBED = ("1", "variant of the theory, and its correction if not that of Yang & Persson")


def theories(variants: Iterable[str], gamma: float) -> dict[str, dict[str, Any]]:
    """Arguments of `Persson` by names.

    The variants asked for with the correction of Yang & Persson and `gamma`, then the quoted
    variant with the other corrections, each with its source's own gamma.
    """
    found = {name: {"variant": name, "gamma": gamma} for name in variants}
    for correction in CORRECTIONS[1:]:
        found[f"{VARIANT}, {correction}"] = {"variant": VARIANT, "correction": correction}
    return found


def between_corrections(values: xr.DataArray) -> tuple[xr.DataArray, xr.DataArray]:
    """Lowest and highest of the quoted variant by all its corrections, along `variant`."""
    names = [name for name in values["variant"].values if str(name).startswith(VARIANT)]
    chosen = values.sel(variant=names)
    return chosen.min("variant"), chosen.max("variant")


def evaluate(theory, pressures, ranges):
    """Contact by theory at every pressure, with P(u) between neighbouring ranges."""
    gaps = middles(ranges)
    density = [theory.gap_density(gaps, load) for load in pressures]
    contact = contact_of(theory, pressures, ranges).assign_coords(gap=gaps)
    return contact.assign(gap_density=(("pressure", "gap"), density))


def contact_of(theory, pressures, ranges):
    """Quantities of a contact by theory, under the names of `solve_repulsive`."""
    found = {name: [] for name in ("area_fraction", "mean_gap", "attractive_area")}
    for load in pressures:
        found["area_fraction"].append(float(theory.area_fraction(load)))
        found["mean_gap"].append(float(theory.mean_gap(load)))
        found["attractive_area"].append(theory.gap_cumulative(ranges, load))
    return xr.Dataset(
        {
            "area_fraction": ("pressure", found["area_fraction"]),
            "mean_gap": ("pressure", found["mean_gap"]),
            "attractive_area": (("pressure", "range"), found["attractive_area"]),
            "rms_slope": theory.spectrum.rms_slope,
        },
        coords={"pressure": np.asarray(pressures), "range": ranges},
    )
