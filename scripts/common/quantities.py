"""The quantities that a case may ask for: how they follow from areas, and from files of results.

The registry of quantities is `stickiness.accuracy.quantities`.
"""

from collections.abc import Sequence

import numpy as np
import xarray as xr

from common.conventions import middles
from stickiness.accuracy.quantities import COLUMNS
from stickiness.criteria import a_v_fit


def statistics(column: str, **files: xr.Dataset) -> tuple[xr.DataArray, xr.DataArray, xr.DataArray]:
    """Mean, standard error and discretisation error of a column, along the pressure.

    `files` are ``ensemble`` and, for their own columns, ``a_v`` and ``kappa``, as the rules
    `average_ensemble` and `fit_a_v` make them.
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
    """A column of a contact to which `derive` has added its quantities."""
    known = COLUMNS[column]
    return _at(contact, known)[known.variable]


def derive(contact: xr.Dataset, fit_interval: Sequence[float]) -> xr.Dataset:
    """Add P(u), a_V and kappa to a contact: area, rms slope and attractive areas by load and range.

    `fit_interval` is that of a_V, in ranges over h_rms.
    """
    a_v = fit_a_v(contact.attractive_area, contact.pressure, fit_interval).isel(result=0)
    return contact.assign(gap_density=gap_density(contact), a_v=a_v, kappa=slope_of_area(contact))


def gap_density(solutions: xr.Dataset) -> xr.DataArray:
    """P(u) between neighbouring ranges, as the slope of the attractive area."""
    edges = solutions["range"].values
    density = solutions.attractive_area.diff("range") / xr.DataArray(np.diff(edges), dims="range")
    return density.rename(range="gap").assign_coords(gap=middles(edges))


def slope_of_area(solutions: xr.Dataset) -> xr.DataArray:
    """kappa, area times rms slope over pressure, load by load."""
    return solutions.area_fraction * solutions.rms_slope / solutions.pressure


def fit_intervals(areas, windows):
    """a_V and the standard error of its fit along every dimension but the range's."""
    fits = [fit_a_v(areas.attractive_area, areas.pressure, window) for window in windows]
    both = xr.concat(fits, "window")
    return xr.Dataset(
        {
            "a_v": both.isel(result=0),
            "a_v_fit_error": both.isel(result=1),
            "window_low": ("window", [float(low) for low, _ in windows]),
            "window_high": ("window", [float(high) for _, high in windows]),
        }
    )


def fit_a_v(area, pressure, fit_interval):
    """a_V and the standard error of its fit, along the dimension `result`."""
    ranges = area["range"].values

    def fit(values, load):
        found = a_v_fit.fit_a_v(ranges, values, float(load), window=tuple(fit_interval))
        return np.array([found.value, found.standard_error])

    return xr.apply_ufunc(
        fit,
        area,
        pressure,
        input_core_dims=[["range"], []],
        output_core_dims=[["result"]],
        vectorize=True,
    )


def _at(dataset, column):
    return dataset.sel(column.at, method="nearest", drop=True) if column.at else dataset
