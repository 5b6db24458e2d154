"""Fits of a_V, shared by stages."""

import numpy as np
import xarray as xr

from stickiness.criteria import a_v_fit


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
        return [found.value, found.standard_error]

    return xr.apply_ufunc(
        lambda *given: np.array(fit(*given)),
        area,
        pressure,
        input_core_dims=[["range"], []],
        output_core_dims=[["result"]],
        vectorize=True,
    )
