"""The file of an ensemble: means in the limit of fine grids, with their errors.

Coarse solutions of further seeds, if the case has them, are kept beside the values seed by seed:
whatever is derived from those is averaged in the same way, as the slope of area against load is.
"""

from operator import itemgetter

import xarray as xr

from common import continuum_values, conventions
from common.contact_curves import (
    CONTACT_VARIABLES,
    MEASURED_TEXTS,
    coarse_seeds,
    describe_others,
)
from common.continuum_values import EXTRAPOLATION
from common.derived_quantities import fit_kappa, gap_density
from common.ensemble_means import PREFIX, add_errors, coarse, describe_errors, mean
from common.error_budgets import Simulation
from common.model_surfaces import read_block, skewness_of
from stickiness import datasets
from stickiness.accuracy.error_models import read_models
from stickiness.accuracy.quantities import MEASURED, means_of
from stickiness.error_budget import with_budget

# Variables of realisations that an ensemble's file keeps seed by seed, all that are read of them,
# and those of coarse solutions. OPTIONAL are kept only if the case wants them.
KEPT = ("area_fraction", "mean_gap", "residual", "iterations", "rms_slope")
COARSE = ("area_fraction", "mean_gap", "rms_slope")
OPTIONAL = ("attractive_area", *MEASURED)
AVERAGED = {name: itemgetter(name) for name in ("area_fraction", "mean_gap", "attractive_area")}
AVERAGED["gap_density"] = gap_density
TEXTS = {name: conventions.SHARED_VARIABLES[name][1] for name in AVERAGED}
ENSEMBLE_VARIABLES = {
    **MEASURED_TEXTS,
    **describe_errors(TEXTS, discretisation=continuum_values.DIRECT),
    **describe_errors(
        {name: text for name, (_, text, _) in MEASURED_TEXTS.items()},
        discretisation=continuum_values.FIRST_ORDER,
    ),
    "rms_slope": conventions.RMS_SLOPE,
    "edge_gap_mean": "gap next to the contact over h_rms: smallest range resolved",
    f"attractive_area_{EXTRAPOLATION}": f"{TEXTS['attractive_area']}: of the mean, extrapolated "
    "from below the edge gap",
}


def average_case(case, plan, inputs, output):
    """Average the realisations of a case; write the means and the slope of area against load."""
    averaged = choose_means(plan["quantities"])
    optional = [name for name in OPTIONAL if name in averaged]
    loads = plan["pressures"]
    seeds = list(range(1, plan["settings"]["seeds"] + 1))
    needed = (*KEPT, "pixel_area_fraction", "edges", "edge_gap")
    realisations = read_block(inputs.realisations, (*needed, *optional), seeds, loads)
    others = xr.Dataset()
    if count := plan["settings"]["coarse_seeds"]:
        kept = (*COARSE, *optional)
        solved = read_block(inputs.coarse, kept, coarse_seeds(range(1, count + 1)).tolist(), loads)
        described = describe_others(plan["surface"], plan["descriptor_seeds"])
        others = name_coarse(solved, described, kept)
    parameters_of_means = datasets.parameters(realisations) | {"seeds": seeds, "case": case}
    write_means(
        realisations,
        others,
        parameters_of_means,
        inputs.laws,
        output.means,
        averaged,
    )
    means = datasets.read(output.means)
    title = "slope of the area-load relation"
    parameters = {**datasets.parameters(means), "linear_up_to": conventions.LINEAR_UP_TO}
    kappa = fit_kappa(means, read_models(inputs.laws))
    datasets.write(kappa, output.kappa, title=title, parameters=parameters)


def choose_means(quantities):
    """What to average for the quantities wanted of a case; areas and mean gaps come for free."""
    needed = means_of(quantities) | {"area_fraction", "mean_gap"}
    measured = {name: itemgetter(name) for name in MEASURED}
    return {name: value for name, value in (AVERAGED | measured).items() if name in needed}


def name_coarse(solved, other_long_waves, kept=(*COARSE, "attractive_area")):
    """Coarse solutions under the names of an ensemble's file, and seeds that are not solved."""
    solved = solved[[*kept, "long_waves"]].assign(other_long_waves=other_long_waves)
    solved = conventions.annotate(solved, **CONTACT_VARIABLES)
    return solved.rename({name: f"{PREFIX}{name}" for name in (*kept, "seed")})


def add_statistics(realisations, others, averaged=AVERAGED):
    """Mean and errors of every quantity, beside the values seed by seed."""
    optional = [name for name in OPTIONAL if name in averaged]
    dataset = realisations[[*KEPT, *optional]].merge(others)
    dataset["edge_gap_mean"] = mean(realisations.edge_gap)
    for name, quantity in averaged.items():
        values = quantity(realisations)
        more = coarse(dataset, quantity)
        if name in MEASURED:
            correction = continuum_values.estimate_first_order(values)
        else:
            correction = continuum_values.estimate(name, realisations, quantity)
        dataset = add_errors(dataset, name, values, more, correction=correction)
        if name == "attractive_area":  # the one quantity that is extrapolated
            dataset[f"{name}_{EXTRAPOLATION}"] = correction.shift
    return dataset


def write_means(realisations, others, parameters, laws, output, averaged=AVERAGED):
    """Write the means, their errors by source, and what they stand for and how they are taken."""
    dataset = conventions.annotate(
        add_statistics(realisations, others, averaged), **ENSEMBLE_VARIABLES
    )
    surface_texts = {"gaussian": "Gaussian surfaces", "fixed": "surfaces of fixed amplitudes"}
    surfaces = surface_texts[parameters["amplitudes"]]
    if "heights" in parameters:
        surfaces = f"surfaces of a skewness of {skewness_of(parameters):g}"
    window = parameters["window"]
    parameters = parameters | {
        "estimates": f"mean over {surfaces} on a window of {window:g} longest wavelengths",
        "largest_residual": float(realisations.residual.max()),
        "estimator": "plain",
    }
    if others and realisations.sizes["seed"] > 1:
        parameters |= {"coarse_seeds": others.sizes[f"{PREFIX}seed"], "estimator": "multilevel"}
        parameters["descriptor_seeds"] = others.sizes["other"]
    simulation = Simulation(read_models(laws), parameters)
    for name in averaged:
        left = continuum_values.FIRST_ORDER if name in MEASURED else continuum_values.LEFT
        parts = simulation.parts(
            name,
            dataset[f"{name}_mean"],
            dataset[f"{name}_standard_error"],
            dataset[f"{name}_discretisation_error"],
            text=left,
        )
        dataset = with_budget(dataset, f"{name}_mean", **parts)
    title = "repulsive contact averaged over realisations"
    datasets.write(dataset, output, title=title, parameters=parameters)
