"""Value and limits of what is known of a pair: they decide the verdict."""

from __future__ import annotations

import xarray as xr


def find_limits(dataset: xr.Dataset, name: str = "remaining") -> tuple[xr.DataArray, xr.DataArray]:
    """Low and high limit of a quantity, over both ends of the surface and the limits of the model.

    On a measured surface they are quantiles over the draws, which contain the errors of the model.
    The limits of margin and threshold are the values at which the limits of the remaining share
    equal the wanted share.
    """
    low = dataset[f"{name}_low"].min("end")
    high = dataset[f"{name}_high"].max("end")
    if f"{name}_quantile" in dataset:
        drawn = dataset[f"{name}_quantile"]
        low = drawn.isel(quantile=0, drop=True).fillna(low)
        high = drawn.isel(quantile=-1, drop=True).fillna(high)
    return low, high


def find_value(dataset: xr.Dataset, name: str = "remaining") -> xr.DataArray:
    """One value of a quantity, between its limits: the median of draws, or that at the rough end.

    Means over both ends could contradict each other, for a share is no power of a modulus.
    """
    value = dataset[name].sel(end="rough", drop=True)
    if f"{name}_quantile" in dataset:
        drawn = dataset[f"{name}_quantile"]
        value = drawn.isel(quantile=drawn.sizes["quantile"] // 2, drop=True).fillna(value)
    return value
