"""Means over the realisations of a case, with their errors."""

from operator import itemgetter

import numpy as np
import xarray as xr

from pipeline import grid_limits
from pipeline.conventions import DESCRIBED, middles
from pipeline.ensemble_means import PREFIX, coarse, described, mean, with_errors
from pipeline.error_budgets import Simulation
from pipeline.grid_limits import EXTRAPOLATION
from stickiness.accuracy import error_laws
from stickiness.core import datasets
from stickiness.core.budget import with_budget

KEPT = ("area_fraction", "mean_gap", "residual", "iterations", "rms_slope")


NEEDED = (*KEPT, "pixel_area_fraction", "edges", "edge_gap")


COARSE = ("area_fraction", "mean_gap", "rms_slope")


GAPS = ("attractive_area",)  # what is there besides if ranges were asked for


LONG_WAVES = ("long_waves", "other_long_waves")


SURFACES = {"gaussian": "Gaussian surfaces", "fixed": "surfaces of fixed amplitudes"}


def ensemble_of(inputs, loads, averaged):
    """Means and errors from the files of realisations and coarse solutions, and what made them."""
    gaps = [name for name in GAPS if name in averaged]
    files = [read(path, (*NEEDED, *gaps), loads) for path in inputs.realisations]
    others = [read(path, (*COARSE, *gaps), loads) for path in inputs.coarse]
    seeds = [datasets.parameters(file)["seed"] for file in files]
    realisations = xr.concat(files, xr.DataArray(seeds, dims="seed", name="seed"))
    more = renamed(joined(others), (*COARSE, *gaps)) if others else xr.Dataset()
    dataset = with_statistics(realisations, more, averaged)
    parameters = datasets.parameters(files[0])
    parameters["largest_residual"] = float(realisations.residual.max())
    del parameters["seed"]
    return dataset, {**parameters, "seeds": seeds, **sampled(parameters, dataset)}


def joined(files):
    """Coarse solutions of all files; the seeds that are not solved are in the first."""
    solved = xr.concat([file.drop_dims("other") for file in files], "seed", data_vars="minimal")
    return solved.merge(files[0][["other_long_waves"]])


def wanted(quantities):
    """What to average for the quantities wanted of a case; areas and mean gaps come for free."""
    names = ["area_fraction", "mean_gap"]
    if any(quantity in error_laws.OF_GAPS for quantity in quantities):
        names.append("attractive_area")
    if "gap_distribution" in quantities:
        names.append("gap_density")
    return {name: AVERAGED[name] for name in names}


def read(path, names, loads):
    """Solutions at the loads of this case; the file may be that of another one with more."""
    return datasets.read(path, names).sel(pressure=loads)


def renamed(others, kept=(*COARSE, *GAPS)):
    """Coarse solutions under names that leave those of the fine ones free."""
    names = {name: f"{PREFIX}{name}" for name in (*kept, "seed")}
    return others[[*kept, *LONG_WAVES]].rename(names)


def sampled(made, dataset):
    """What the means stand for and how they are taken, for the parameters of the file."""
    surfaces, window = SURFACES[made.get("amplitudes", "gaussian")], made.get("window", 1)
    found = {
        "estimates": f"mean over {surfaces} on a window of {window:g} longest wavelengths",
        "estimator": "plain",
    }
    if f"{PREFIX}seed" in dataset.dims and dataset.sizes["seed"] > 1:
        found["estimator"] = "multilevel"
        found["coarse_seeds"] = dataset.sizes[f"{PREFIX}seed"]
        found["descriptor_seeds"] = dataset.sizes["other"]
    return found


def gap_density(solutions):
    """P(u) between neighbouring ranges, as the slope of the attractive area."""
    edges = solutions["range"].values
    density = solutions.attractive_area.diff("range") / xr.DataArray(np.diff(edges), dims="range")
    return density.rename(range="gap").assign_coords(gap=middles(edges))


AVERAGED = {name: itemgetter(name) for name in ("area_fraction", "mean_gap", "attractive_area")}


AVERAGED["gap_density"] = gap_density


def with_statistics(realisations, others, averaged=AVERAGED):
    """Mean and errors of every quantity, beside the values seed by seed."""
    gaps = [name for name in GAPS if name in averaged]
    dataset = realisations[[*KEPT, *gaps]].merge(others)
    dataset["edge_gap_mean"] = mean(realisations.edge_gap)
    limits = grid_limits.of_ensemble(realisations, averaged)
    for name, quantity in averaged.items():
        more = coarse(dataset, quantity)
        dataset = with_errors(dataset, name, quantity(realisations), more, limit=limits[name])
    if "attractive_area" in averaged:  # the one quantity that has any
        dataset[f"attractive_area_{EXTRAPOLATION}"] = limits["attractive_area"].shift
    return dataset


def budgeted(dataset, made, laws, averaged=AVERAGED):
    """The means with their errors by source."""
    simulation = Simulation.of(error_laws.read_laws(laws), made)
    for name in averaged:
        parts = simulation.parts(
            name,
            *(dataset[f"{name}_{kind}"] for kind in ("mean", "standard_error")),
            dataset[f"{name}_discretisation_error"],
        )
        dataset = with_budget(dataset, f"{name}_mean", **parts)
    return dataset


def annotated(dataset, averaged=AVERAGED):
    texts = {
        "seed": ("1", "seed of the realisation"),
        "edge_gap_mean": ("1", "gap next to the contact over h_rms: smallest range resolved"),
    }
    for name in averaged:
        texts |= described(name, DESCRIBED[name][1], discretisation=grid_limits.DIRECT)
    if "gap_density" in averaged:
        texts["gap"] = DESCRIBED["gap"]
    if "attractive_area" in averaged:
        texts[f"attractive_area_{EXTRAPOLATION}"] = (
            "1",
            f"{DESCRIBED['attractive_area'][1]}: of the mean, extrapolated from below the edge gap",
        )
    return datasets.annotate(dataset, **texts)
