"""Columns of the quantities that a case may ask for, from files of results.

The quantities themselves are in `stickiness.accuracy.quantities`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr

from pipeline.conventions import middles
from pipeline.fits import fit_a_v
from stickiness.accuracy.quantities import COLUMNS, MEASURED


def statistics(column: str, **files: xr.Dataset) -> tuple[xr.DataArray, xr.DataArray, xr.DataArray]:
    """Return mean, standard error and discretisation error of a column, along the pressure.

    Parameters
    ----------
    column
        One of `COLUMNS`.
    **files
        ``ensemble``, ``a_v`` and ``kappa``, as `average_ensemble`, `fit_a_v` and `fit_kappa` make
        them; the fits for their own columns.
    """
    known = COLUMNS[column]
    found = files[known.file]
    if known.file == "kappa":
        mean = found[known.variable]
    else:
        found = found.isel(window=0) if known.file == "a_v" else _at(found, known)
        mean = found[f"{known.variable}_mean"]
    endings = ("standard_error", "discretisation_error")
    return mean, *(found[f"{known.variable}_{ending}"] for ending in endings)


def quote(column: str, contact: xr.Dataset) -> xr.DataArray:
    """Return a column of a contact to which `derive` has added its quantities."""
    known = COLUMNS[column]
    return _at(contact, known)[known.variable]


def derive(contact: xr.Dataset, fit_interval: Sequence[float]) -> xr.Dataset:
    """Add P(u), a_V and kappa to a contact.

    Parameters
    ----------
    contact
        With ``area_fraction``, ``rms_slope`` and ``attractive_area`` along ``pressure`` and
        ``range``, and any other dimensions.
    fit_interval
        Ranges over h_rms between which a_V is fitted.
    """
    fitted = fit_a_v(contact.attractive_area, contact.pressure, fit_interval)
    return contact.assign(
        gap_density=gap_density(contact),
        a_v=fitted.isel(result=0),
        kappa=slope_of_area(contact),
    )


def gap_density(solutions: xr.Dataset) -> xr.DataArray:
    """P(u) between neighbouring ranges, as the slope of the attractive area."""
    edges = solutions["range"].values
    density = solutions.attractive_area.diff("range") / xr.DataArray(np.diff(edges), dims="range")
    return density.rename(range="gap").assign_coords(gap=middles(edges))


def slope_of_area(solutions: xr.Dataset) -> xr.DataArray:
    """kappa, area times rms slope over pressure, load by load."""
    return solutions.area_fraction * solutions.rms_slope / solutions.pressure


def describe_measured(names: Sequence[str]) -> dict[str, tuple[str, ...]]:
    """Texts for `datasets.annotate` of the quantities measured on solutions."""
    return {name: ("1", COLUMNS[name].text, "no contact") for name in names if name in MEASURED}


def _at(dataset, column):
    return dataset.sel(column.at, method="nearest", drop=True) if column.at else dataset
