"""kappa_rep = A_rep E* h'_rms/(A_nom p) of a case, load by load and fitted, and of theory."""

import xarray as xr

from common import conventions, grid_limits
from common.conventions import LINEAR_UP_TO
from common.ensemble_means import SUFFIXES, add_errors, coarse, describe_errors
from common.error_budgets import Simulation, theory_parts
from common.quantities import slope_of_area
from stickiness import datasets
from stickiness.accuracy.error_models import ErrorModels
from stickiness.error_budget import ENDINGS, with_budget

TEXT = "kappa = A_rep E* h'_rms/(A_nom p)"


def fit_kappa(ensemble: xr.Dataset, models: ErrorModels) -> xr.Dataset:
    """Kappa of an ensemble at every load and fitted, and the mean area, with their errors."""
    dataset = xr.Dataset({"area_fraction": ensemble.area_fraction_mean})
    for name, quantity in {"kappa": slope_of_area, "kappa_fit": fit_slope}.items():
        dataset = average(dataset, name, quantity, ensemble)
    dataset = add_budgets(annotate(dataset), Simulation.of(models, datasets.parameters(ensemble)))
    for ending in ENDINGS:
        dataset[f"area_fraction{ending}"] = ensemble[f"area_fraction_mean{ending}"]
    return dataset


def add_theory(theory: xr.Dataset, models: ErrorModels, surface: dict) -> xr.Dataset:
    """Theory on the lattice spectrum of a surface with its kappa, which has a budget."""
    text = f"{TEXT} by Persson's theory on the lattice spectrum"
    theory = datasets.annotate(theory.assign(kappa=slope_of_area(theory)), kappa=("1", text))
    parts = theory_parts(models, "kappa", theory.kappa, surface, "area_fraction")
    return with_budget(theory, "kappa", **parts)


def average(dataset, name, quantity, ensemble):
    """Add mean and errors of a slope, with what the areas know of the limit of fine grids."""
    limit = grid_limits.inherit(ensemble, quantity, ["area_fraction"])
    values, more = quantity(ensemble), coarse(ensemble, quantity)
    return add_errors(dataset, name, values, more, plain=True, limit=limit)


def add_budgets(dataset, simulation):
    """Every kappa with its errors by source, those of the fit as at the largest of its loads."""
    inside = dataset.area_fraction <= LINEAR_UP_TO
    loads = {"kappa": dataset.pressure, "kappa_fit": dataset.pressure.where(inside).max()}
    for name, pressure in loads.items():
        errors = (dataset[f"{name}_{kind}"] for kind in list(SUFFIXES)[1:])
        value = dataset[name].assign_coords(pressure=pressure)
        parts = simulation.parts("kappa", value, *errors, grid_limits.INHERITED)
        dataset = with_budget(dataset, name, **parts)
    return dataset


def fit_slope(ensemble):
    """Least-squares slope of area h'_rms against pressure through the origin, A <= 30 %."""
    area = ensemble.area_fraction.where(ensemble.area_fraction <= LINEAR_UP_TO)
    pressure = ensemble.pressure.where(area.notnull())
    fitted = (area * pressure).sum("pressure") / (pressure**2).sum("pressure")
    return fitted * ensemble.rms_slope


def annotate(dataset):
    fit = f"{TEXT}, fitted through the origin up to {LINEAR_UP_TO:.0%} area"
    return conventions.annotate(
        dataset,
        **describe_errors("kappa", TEXT, plain=True, discretisation=grid_limits.INHERITED),
        **describe_errors("kappa_fit", fit, plain=True, discretisation=grid_limits.INHERITED),
    )
