"""kappa_rep = A_rep E* h'_rms/(A_nom p) of a case, load by load and fitted, beside theory's."""

import xarray as xr

from pipeline import conventions, grid_limits
from pipeline.conventions import LINEAR_UP_TO
from pipeline.ensemble_means import SUFFIXES, add_errors, coarse, describe_errors
from pipeline.error_budgets import Simulation, theory_parts
from pipeline.job import start
from pipeline.quantities import slope_of_area
from stickiness.accuracy.error_models import read_models
from stickiness.core import datasets
from stickiness.core.budget import ENDINGS, with_budget


def main(job):
    ensemble = datasets.read(job.input.ensemble, ["area_fraction", "rms_slope"])
    theory = datasets.read(job.input.theory, ["area_fraction", "rms_slope"])
    known = {"area_fraction": ensemble.area_fraction_mean, "kappa_theory": slope_of_area(theory)}
    dataset = xr.Dataset(known)
    for name, quantity in {"kappa": slope_of_area, "kappa_fit": fit_slope}.items():
        dataset = average(dataset, name, quantity, ensemble)
    models = read_models(job.input.laws)
    dataset = add_budgets(annotate(dataset), models, datasets.parameters(ensemble))
    for ending in ENDINGS:
        dataset[f"area_fraction{ending}"] = ensemble[f"area_fraction_mean{ending}"]
    datasets.write(
        dataset,
        job.output[0],
        title="slope of the area-load relation",
        parameters={**datasets.parameters(ensemble), "linear_up_to": LINEAR_UP_TO},
    )


def average(dataset, name, quantity, ensemble):
    """Add mean and errors of a slope, with what the areas know of the limit of fine grids."""
    limit = grid_limits.inherit(ensemble, quantity, ["area_fraction"])
    values, more = quantity(ensemble), coarse(ensemble, quantity)
    return add_errors(dataset, name, values, more, plain=True, limit=limit)


def add_budgets(dataset, models, made):
    """Every kappa with its errors by source, those of the fit as at the largest of its loads."""
    simulation, inside = Simulation.of(models, made), dataset.area_fraction <= LINEAR_UP_TO
    loads = {"kappa": dataset.pressure, "kappa_fit": dataset.pressure.where(inside).max()}
    for name, pressure in loads.items():
        errors = (dataset[f"{name}_{kind}"] for kind in list(SUFFIXES)[1:])
        value = dataset[name].assign_coords(pressure=pressure)
        parts = simulation.parts("kappa", value, *errors, grid_limits.INHERITED)
        dataset = with_budget(dataset, name, **parts)
    parts = theory_parts(models, "kappa", dataset.kappa_theory, made, "area_fraction")
    return with_budget(dataset, "kappa_theory", **parts)


def fit_slope(ensemble):
    """Least-squares slope of area h'_rms against pressure through the origin, A <= 30 %."""
    area = ensemble.area_fraction.where(ensemble.area_fraction <= LINEAR_UP_TO)
    pressure = ensemble.pressure.where(area.notnull())
    fitted = (area * pressure).sum("pressure") / (pressure**2).sum("pressure")
    return fitted * ensemble.rms_slope


def annotate(dataset):
    text = "kappa = A_rep E* h'_rms/(A_nom p)"
    fit = f"{text}, fitted through the origin up to {LINEAR_UP_TO:.0%} area"
    return conventions.annotate(
        dataset,
        kappa_theory=("1", f"{text} by Persson's theory on the lattice spectrum"),
        **describe_errors("kappa", text, plain=True, discretisation=grid_limits.INHERITED),
        **describe_errors("kappa_fit", fit, plain=True, discretisation=grid_limits.INHERITED),
    )


if __name__ == "__main__":
    main(start(globals(), "fit_kappa", case="H0.8_zeta64"))
