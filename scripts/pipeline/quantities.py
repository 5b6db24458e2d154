"""The quantities that a case may ask for, by the columns of the laws, from files of an ensemble."""

from __future__ import annotations

import xarray as xr

GAP = 0.1  # over h_rms, at which P(u) is quoted; the ensemble's file has all of it
TEXTS = {
    "area": "repulsive contact area over nominal area",
    "mean_gap": "mean gap over h_rms",
    "attractive_area_0.01": "attractive area at range 0.01 h_rms over nominal area",
    "attractive_area_0.1": "attractive area at range 0.1 h_rms over nominal area",
    "gap_distribution": "P(u) times h_rms at gap 0.1 h_rms",
    "a_v": "a_V",
    "kappa": "kappa_rep",
}
_OF_ENSEMBLE = {
    "area": ("area_fraction", {}),
    "mean_gap": ("mean_gap", {}),
    "attractive_area_0.01": ("attractive_area", {"range": 0.01}),
    "attractive_area_0.1": ("attractive_area", {"range": 0.1}),
    "gap_distribution": ("gap_density", {"gap": GAP}),
}


def statistics(
    column: str,
    ensemble: xr.Dataset,
    a_v: xr.Dataset | None = None,
    kappa: xr.Dataset | None = None,
) -> tuple[xr.DataArray, xr.DataArray, xr.DataArray]:
    """Return mean, standard error and discretisation error of a column, along the pressure.

    Parameters
    ----------
    column
        One of `TEXTS`.
    ensemble, a_v, kappa
        As `average_ensemble`, `fit_a_v` and `fit_kappa` make them; the fits for their own columns.
    """
    if column == "kappa":
        return kappa.kappa, kappa.kappa_standard_error, kappa.kappa_discretisation_error
    if column == "a_v":
        where, name = a_v.isel(window=0), "a_v"
    else:
        name, at = _OF_ENSEMBLE[column]
        where = ensemble.sel(at, method="nearest") if at else ensemble
    ends = ("mean", "standard_error", "discretisation_error")
    return tuple(where[f"{name}_{end}"] for end in ends)
