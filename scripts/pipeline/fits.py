"""Fits of a_V, shared by stages."""

import numpy as np
import xarray as xr

from stickiness.criteria import a_v_fit


def fitted(areas, windows):
    """a_V and the standard error of its fit along every dimension but the range's."""
    area, pressure = areas.attractive_area, areas.pressure
    fits = [
        xr.apply_ufunc(
            lambda values, load, window=window: fit_one(area["range"].values, values, load, window),
            area,
            pressure,
            input_core_dims=[["range"], []],
            output_core_dims=[["result"]],
            vectorize=True,
        )
        for window in windows
    ]
    both = xr.concat(fits, "window")
    return xr.Dataset(
        {
            "a_v": both.isel(result=0),
            "a_v_fit_error": both.isel(result=1),
            "window_low": ("window", [float(low) for low, _ in windows]),
            "window_high": ("window", [float(high) for _, high in windows]),
        }
    )


def fit_one(ranges, area, pressure, window):
    fit = a_v_fit.fit_a_v(ranges, area, float(pressure), window=tuple(window))
    return np.array([fit.value, fit.standard_error])
