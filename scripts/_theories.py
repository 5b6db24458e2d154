"""Variants and corrections of Persson's theory that stages compute beside each other."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import xarray as xr

from _model import VARIANT
from stickiness.persson_kernels import CORRECTIONS

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
