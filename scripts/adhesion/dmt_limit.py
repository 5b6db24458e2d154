"""Adhesion in the DMT limit from the attractive areas of contact without it.

The quantities take the variables of one ensemble, of its coarse solutions or of its means alike,
see `ensemble_means.coarse`, so that the same function gives a mean and its control.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from common.adhesion_sets import axes, scaled_law
from common.conventions import LINEAR_UP_TO
from stickiness import dmt

PER_DECADE = 64  # ranges at which a traction law is integrated
SMALLEST = 1e-300  # area: none at ranges that a coarse grid does not see

QUANTITIES = {
    "attraction": "attractive pressure over E* q0 h_rms",
    "inverse_kappa": "1/kappa = p_ext A_nom/(A_rep E* h'_rms)",
    "inverse_kappa_ad": "1/kappa_ad = p_ad/(2 p_rep)",
    "inverse_kappa_fit": "1/kappa fitted through the origin over the loads up to 30 % area",
    "inverse_kappa_ad_fit": "1/kappa_ad, from the fall of the fitted 1/kappa",
}


@dataclass(frozen=True)
class DmtLimit:
    """Quantities of a set of adhesive parameters."""

    asked: Mapping[str, Any]  # the set, as in the configuration
    linear: xr.DataArray  # by pressure, whether the area is one that a slope is fitted to

    @classmethod
    def of(cls, asked: Mapping[str, Any], ensemble: xr.Dataset) -> DmtLimit:
        """Limit for an ensemble, whose mean area says where it is linear in the load."""
        area = ensemble.area_fraction_mean.sel(pressure=axes(asked)[0])
        return cls(asked, (area <= LINEAR_UP_TO).drop_vars(set(area.coords) - {"pressure"}))

    def at_loads(self, solved: xr.Dataset) -> xr.Dataset:
        """Solutions at the pressures of the set."""
        return solved.sel(pressure=axes(self.asked)[0])

    def attraction(self, solved: xr.Dataset) -> xr.DataArray:
        """Mean attraction, the integral of the law over the gaps."""
        _, lengths, ranges = axes(self.asked)
        logs = np.log(np.maximum(self.at_loads(solved).attractive_area, SMALLEST))
        known = logs["range"].values
        count = round(np.log10(known[-1] / known[0]) * PER_DECADE) + 1
        logs = logs.assign_coords(range=np.log(known))
        parts = []
        for range_ in ranges.values:
            # In proportion to the adhesion length: once for the smallest of them.
            law = scaled_law(self.asked, self.asked["law"], float(lengths[0]), range_)
            nodes = np.union1d(np.geomspace(known[0], known[-1], count), [range_])
            area = np.exp(logs.interp(range=np.log(nodes).clip(*np.log(known[[0, -1]]))))
            area = area.transpose(..., "range")
            pull = dmt.attraction_of_areas(area.values, nodes, law)
            parts.append(area.isel(range=0, drop=True).copy(data=pull))
        return xr.concat(parts, ranges) * (lengths / lengths[0])

    def inverse_kappa(self, solved: xr.Dataset) -> xr.DataArray:
        """1/kappa, the external pressure over area times slope."""
        held = self.at_loads(solved)
        external = held.pressure - self.attraction(solved)
        return external / (held.area_fraction * held.rms_slope)

    def inverse_kappa_ad(self, solved: xr.Dataset) -> xr.DataArray:
        """1/kappa_ad, half the attraction over the repulsion."""
        attraction = self.attraction(solved)
        return attraction / attraction.pressure / 2

    def inverse_kappa_fit(self, solved: xr.Dataset) -> xr.DataArray:
        """1/kappa over all loads whose area is linear."""
        held = self.at_loads(solved)
        external = held.pressure - self.attraction(solved)
        return fit_slope(external, held.area_fraction * held.rms_slope, self.linear)

    def inverse_kappa_ad_fit(self, solved: xr.Dataset) -> xr.DataArray:
        """1/kappa_ad by the fall of that slope."""
        held = self.at_loads(solved)
        area = held.area_fraction * held.rms_slope
        fall = fit_slope(self.attraction(solved), area, self.linear)
        return fall / fit_slope(held.pressure, area, self.linear) / 2


def fit_slope(external: xr.DataArray, area: xr.DataArray, linear: xr.DataArray) -> xr.DataArray:
    """Fitted slope of pressure against area through the origin; NaN for fewer than two loads.

    Where a load is missing there is no slope: the others alone would have another.
    """
    inside = linear & (linear.sum("pressure") > 1)
    product, square = (external * area).where(inside), (area**2).where(inside)
    slope = product.sum("pressure") / square.sum("pressure")
    return slope.where((product.notnull() | ~inside).all("pressure") & inside.any("pressure"))


def linearity_error(values: xr.DataArray, linear: xr.DataArray) -> xr.DataArray:
    """Half the range over the loads of a fit: what its straight line leaves out."""
    inside = values.where(linear)
    return (inside.max("pressure") - inside.min("pressure")) / 2
