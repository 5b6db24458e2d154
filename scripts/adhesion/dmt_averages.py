"""Area-load curves with attraction in the DMT limit: the gaps stay those without adhesion."""

import numpy as np
import xarray as xr

from adhesion.dmt_limit import QUANTITIES, DmtLimit, linearity_error
from common import conventions, grid_limits
from common.adhesion_sets import AXES, OUTSIDE, axes, roughness
from common.ensemble_means import add_errors, coarse, describe_errors
from common.error_budgets import SIMULATED, Simulation
from stickiness import datasets
from stickiness.accuracy.error_models import read_models
from stickiness.error_budget import ENDINGS, Part, with_budget

MODEL = "of the DMT limit against full simulation, as measured"
MODEL_OF_FIT = f"{MODEL}, and what the straight line leaves out"


def write_limit(asked, ensemble, laws, errors, output):
    """Write a set of adhesive parameters in the DMT limit, averaged over an ensemble.

    `errors` has, at every point, ``dmt_valid`` and ``dmt_error``, the measured error of the limit.
    """
    limit = DmtLimit.of(asked, ensemble)
    pressures, lengths, ranges = axes(asked)
    dataset = xr.Dataset(
        {
            "area_fraction": ensemble.area_fraction_mean.sel(pressure=pressures),
            "dmt_valid": (AXES, np.asarray(errors["dmt_valid"], dtype="i1")),
            "dmt_error": (AXES, np.asarray(errors["dmt_error"], dtype=float)),
            "q0_h_rms": roughness(asked),
        },
        coords={one.name: one for one in (pressures, lengths, ranges)},
    )
    for name in QUANTITIES:
        quantity = getattr(limit, name)
        left = grid_limits.inherit(ensemble, quantity, ["area_fraction", "attractive_area"])
        values, more = quantity(ensemble), coarse(ensemble, quantity)
        dataset = add_errors(dataset, name, values, more, plain=True, limit=left)
    simulation = Simulation.of(read_models(laws), datasets.parameters(ensemble))
    dataset = add_budgets(annotate(dataset), simulation, limit.linear)
    for ending in ENDINGS:
        known = ensemble[f"area_fraction_mean{ending}"]
        dataset[f"area_fraction{ending}"] = known.sel(pressure=pressures)
    datasets.write(
        dataset,
        output,
        title=f"adhesion in the DMT limit, {asked['law']} traction",
        parameters={**datasets.parameters(ensemble), **asked},
    )


def add_budgets(dataset, simulation, linear):
    """Every quantity with its errors, those of fits as at the least certain of their loads."""
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


def annotate(dataset):
    texts = {}
    for name, text in QUANTITIES.items():
        texts |= describe_errors(name, text, plain=True, discretisation=grid_limits.INHERITED)
    few = "fewer than two loads, or a single seed"
    return conventions.annotate(
        dataset,
        dmt_error=("1", "measured relative error of this 1/kappa_ad", OUTSIDE),
        **{name: (*text[:2], few) if "fit" in name else text for name, text in texts.items()},
    )
