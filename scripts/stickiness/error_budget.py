"""Error budgets: beside every quoted number its errors, source by source.

A quoted variable ``q`` has three more beside it: ``q_error`` along `SOURCES`, each covering 90 % (0
where a source does not apply, NaN where it is not known; ``comment`` says why), ``q_total_error``
in quadrature, and ``q_dominant``, a flag of the largest, which is one that is not known if any is.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr

from stickiness import datasets

SOURCES = ("discretisation", "solver", "sampling", "bandwidth", "model")
NONE = -1  #: flag of what has no error, or no value
ENDINGS = ("_error", "_total_error", "_dominant")


@dataclass(frozen=True)
class ErrorComponent:
    """Error by one source, absolute and covering 90 %, and what it is or why there is none."""

    error: xr.DataArray | float
    text: str


def not_applicable(why: str) -> ErrorComponent:
    return ErrorComponent(0.0, f"none, {why}")


def unknown_error(why: str) -> ErrorComponent:
    return ErrorComponent(np.nan, f"not known, {why}")


def with_budget(dataset: xr.Dataset, name: str, **components: ErrorComponent) -> xr.Dataset:
    """Add the budget of a variable that has `units` and `long_name`: a component by each source.

    Components are of the shape of the variable, or of one that broadcasts to it.
    """
    value = dataset[name]
    parts = [components[source] for source in SOURCES]
    # Errors by source, of the shape of the value, and in quadrature.
    whole = xr.zeros_like(value, dtype=float).where(value.notnull())
    errors = [
        (whole + abs(part.error)).transpose(*value.dims).reset_coords(drop=True) for part in parts
    ]
    error = xr.concat(errors, "source", coords="minimal", compat="override")
    total = np.sqrt((error**2).sum("source", skipna=False))
    largest = error.fillna(np.inf).argmax("source")
    largest = largest.where(value.notnull() & ~(total == 0), NONE).astype("i1")
    # What each error is, and why one may be missing.
    units = value.attrs["units"]
    text = value.attrs["long_name"]
    comment = "; ".join(f"{s}: {part.text}" for s, part in zip(SOURCES, parts, strict=True))
    missing = [value.attrs.get("nan_means", "")]
    missing += [
        f"{source} {part.text}" if np.ndim(part.error) == 0 else f"{source} not known there"
        for source, part in zip(SOURCES, parts, strict=True)
        if np.isnan(part.error).any()
    ]
    reasons = ", or ".join(dict.fromkeys(filter(None, missing)))
    gaps = {"nan_means": reasons} if reasons else {}
    long_name = f"error by source, covers 90 %: {text}"
    error.attrs = {"units": units, "long_name": long_name, **gaps, "comment": comment}
    total.attrs = {"units": units, "long_name": f"error by all sources: {text}", **gaps}
    largest.attrs = {
        "units": "1",
        "long_name": f"source of the largest error: {text}",
        **datasets.flags(("none", *SOURCES), first=NONE),
    }
    names = [f"{name}{ending}" for ending in ENDINGS]
    quoted = value.assign_attrs(ancillary_variables=" ".join(names))
    added = dict(zip(names, (error, total, largest), strict=True))
    dataset = dataset.assign({name: quoted, **added}).assign_coords(source=list(SOURCES))
    return datasets.annotate(dataset, source=("1", "where an error comes from"))


def split(error: xr.DataArray, texts: Mapping[str, str]) -> dict[str, ErrorComponent]:
    """Parts of a budget from errors along `source` and their texts."""
    return {s: ErrorComponent(error.sel(source=s, drop=True), texts[s]) for s in SOURCES}


def part(dataset: xr.Dataset, name: str, source: str) -> xr.DataArray:
    """Error of a quoted variable by one source."""
    return dataset[f"{name}_error"].sel(source=source, drop=True)


def total_error(dataset: xr.Dataset, name: str) -> xr.DataArray:
    """Error of a quoted variable by all sources, in quadrature; NaN where one is not known."""
    return dataset[f"{name}_total_error"]


def dominant(dataset: xr.Dataset, name: str) -> str:
    """Word for the source of the largest error of a single number."""
    flag = dataset[f"{name}_dominant"]
    return flag.attrs["flag_meanings"].split()[int(flag) - NONE]
