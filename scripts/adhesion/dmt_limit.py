"""Adhesion in the DMT limit, from the attractive areas of contact without adhesion.

The quantities accept the variables of an ensemble, of its coarse solutions or of its means, see
`ensemble_means.coarse`, so that one function gives a mean and its control.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from common import conventions, grid_limits
from common.adhesion_sets import AXES, OUTSIDE, axes, roughness, scaled_law
from common.conventions import LINEAR_UP_TO
from common.ensemble_means import add_errors, coarse, describe_errors
from common.error_budgets import SIMULATED, Simulation
from stickiness import datasets, dmt
from stickiness.accuracy.error_models import read_models
from stickiness.error_budget import ENDINGS, Part, with_budget

PER_DECADE = 64  # ranges at which a traction law is integrated
SMALLEST = 1e-300  # area: none at ranges that a coarse grid does not see

QUANTITIES = {
    "attraction": "attractive pressure over E* q0 h_rms",
    "inverse_kappa": "1/kappa = p_ext A_nom/(A_rep E* h'_rms)",
    "inverse_kappa_ad": "1/kappa_ad = p_ad/(2 p_rep)",
    "inverse_kappa_fit": "1/kappa fitted through the origin over the loads up to 30 % area",
    "inverse_kappa_ad_fit": "1/kappa_ad, from the fall of the fitted 1/kappa",
}
FEW = "fewer than two loads, or a single seed"
VARIABLES = describe_errors(QUANTITIES, plain=True, discretisation=grid_limits.INHERITED)
VARIABLES |= {n: (*text[:2], FEW) for n, text in VARIABLES.items() if "fit" in n}
VARIABLES["dmt_error"] = ("1", "measured relative error of this 1/kappa_ad", OUTSIDE)
MODEL = "of the DMT limit against full simulation, as measured"
MODEL_OF_FIT = f"{MODEL}, and what the straight line leaves out"


@dataclass(frozen=True)
class DmtLimit:
    """Quantities of a set of adhesive parameters."""

    adhesion: Mapping[str, Any]  # the set, as in the configuration
    linear: xr.DataArray  # by pressure, whether the area is one that a slope is fitted to

    @classmethod
    def of(cls, adhesion: Mapping[str, Any], ensemble: xr.Dataset) -> DmtLimit:
        """Limit for an ensemble, whose mean area says where it is linear in the load."""
        area = ensemble.area_fraction_mean.sel(pressure=axes(adhesion)[0])
        return cls(adhesion, (area <= LINEAR_UP_TO).drop_vars(set(area.coords) - {"pressure"}))

    def at_loads(self, solved: xr.Dataset) -> xr.Dataset:
        """Solutions at the pressures of the set."""
        return solved.sel(pressure=axes(self.adhesion)[0])

    def attraction(self, solved: xr.Dataset) -> xr.DataArray:
        """Mean attraction, the integral of the law over the gaps."""
        _, lengths, ranges = axes(self.adhesion)
        logs = np.log(np.maximum(self.at_loads(solved).attractive_area, SMALLEST))
        known = logs["range"].values
        count = round(np.log10(known[-1] / known[0]) * PER_DECADE) + 1
        logs = logs.assign_coords(range=np.log(known))
        parts = []
        for range_ in ranges.values:
            # In proportion to the adhesion length: once for the smallest of them.
            law = scaled_law(self.adhesion, self.adhesion["law"], float(lengths[0]), range_)
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


def write_limit(adhesion, ensemble, laws, errors, output):
    """Write a set of adhesive parameters in the DMT limit, averaged over an ensemble.

    `errors` has, at every point, ``dmt_valid`` and ``dmt_error``, the measured error of the limit.
    """
    limit = DmtLimit.of(adhesion, ensemble)
    pressures, lengths, ranges = axes(adhesion)
    dataset = xr.Dataset(
        {
            "area_fraction": ensemble.area_fraction_mean.sel(pressure=pressures),
            "dmt_valid": (AXES, np.asarray(errors["dmt_valid"], dtype="i1")),
            "dmt_error": (AXES, np.asarray(errors["dmt_error"], dtype=float)),
            "q0_h_rms": roughness(adhesion),
        },
        coords={one.name: one for one in (pressures, lengths, ranges)},
    )
    for name in QUANTITIES:
        quantity = getattr(limit, name)
        left = grid_limits.inherit(ensemble, quantity, ["area_fraction", "attractive_area"])
        values, more = quantity(ensemble), coarse(ensemble, quantity)
        dataset = add_errors(dataset, name, values, more, plain=True, limit=left)
    simulation = Simulation.of(read_models(laws), datasets.parameters(ensemble))
    dataset = conventions.annotate(dataset, **VARIABLES)
    dataset = add_budgets(dataset, simulation, limit.linear)
    for ending in ENDINGS:
        known = ensemble[f"area_fraction_mean{ending}"]
        dataset[f"area_fraction{ending}"] = known.sel(pressure=pressures)
    datasets.write(
        dataset,
        output,
        title=f"adhesion in the DMT limit, {adhesion['law']} traction",
        parameters={**datasets.parameters(ensemble), **adhesion},
    )


def add_budgets(dataset, simulation, linear):
    """Add the errors of every quantity, for fits those at the least certain of their loads."""
    for name in QUANTITIES:
        fitted = "fit" in name
        solver, factor, model = (
            one.where(linear).max("pressure") if fitted else one
            for one in relative(dataset, simulation)
        )
        pull = dataset[name]
        if name.startswith("inverse_kappa") and "ad" not in name.split("_"):
            # The fall by attraction from what is left without.
            fall = dataset[name.replace("kappa", "kappa_ad")]
            pull = 2 * fall * pull / (1 - 2 * fall)
        error = model * abs(pull)
        if fitted:
            loadwise = dataset[name.removesuffix("_fit")]
            error = np.hypot(error, linearity_error(loadwise, linear))
        dataset = with_budget(
            dataset,
            name,
            discretisation=Part(dataset[f"{name}_discretisation_error"], grid_limits.INHERITED),
            solver=Part(solver * (abs(dataset[name]) + abs(pull)), "by the tolerance, as measured"),
            sampling=Part(factor * dataset[f"{name}_standard_error"], "Student's t"),
            bandwidth=SIMULATED["bandwidth"],
            model=Part(error, MODEL_OF_FIT if fitted else MODEL),
        )
    return dataset.drop_vars(f"{name}_discretisation_error" for name in QUANTITIES)


def relative(dataset, simulation):
    """Relative error by the solver, factor of standard errors, relative error of the DMT limit."""
    like = dataset.attraction.rename(range_over_h_rms="range")
    area = simulation.solver("area_fraction", dataset.area_fraction)
    gaps = simulation.solver("attractive_area", like).rename(range="range_over_h_rms")
    factor = simulation.factors("attractive_area", like).rename(range="range_over_h_rms")
    return np.hypot(area, gaps), factor, dataset.dmt_error
