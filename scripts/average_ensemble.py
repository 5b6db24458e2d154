"""Average the realisations of a case: means, standard errors and discretisation errors."""

import numpy as np
import xarray as xr

from _errors import described, mean, with_errors
from _job import start
from _model import DESCRIBED, middles
from stickiness import datasets

KEPT = ("area_fraction", "mean_gap", "attractive_area", "residual", "iterations", "rms_slope")
AVERAGED = ("area_fraction", "mean_gap", "attractive_area", "gap_density")


def main(job):
    needed = ("area_fraction", "mean_gap", "attractive_area", "edge_gap", "residual", "rms_slope")
    files = [datasets.read(path, needed) for path in job.input.realisations]
    seeds = [datasets.parameters(file)["seed"] for file in files]
    realisations = xr.concat(files, xr.DataArray(seeds, dims="seed", name="seed"))
    realisations = realisations.assign(gap_density=gap_density(realisations.attractive_area))
    dataset = with_statistics(realisations)
    parameters = datasets.parameters(files[0])
    parameters.pop("seed")
    parameters["largest_residual"] = float(realisations.residual.max())
    datasets.write(
        annotated(dataset),
        job.output[0],
        title="repulsive contact averaged over realisations",
        parameters={**parameters, "seeds": seeds},
    )


def gap_density(attractive_area):
    """P(u) between neighbouring ranges, as the slope of the attractive area."""
    edges = attractive_area["range"].values
    density = attractive_area.diff("range") / xr.DataArray(np.diff(edges), dims="range")
    return density.rename(range="gap").assign_coords(gap=middles(edges))


def with_statistics(realisations):
    """Mean and errors of every quantity, beside the values seed by seed."""
    dataset = realisations[list(KEPT)]
    dataset["edge_gap_mean"] = mean(realisations.edge_gap)
    for name in AVERAGED:
        dataset = with_errors(dataset, name, realisations[name])
    return dataset


def annotated(dataset):
    texts = {
        "seed": ("1", "seed of the realisation"),
        "gap": DESCRIBED["gap"],
        "edge_gap_mean": ("1", "gap next to the contact over h_rms: smallest range resolved"),
    }
    for name in AVERAGED:
        texts |= described(name, DESCRIBED[name][1])
    return datasets.annotate(dataset, **texts)


if __name__ == "__main__":
    main(start(globals(), "average_ensemble", case="H0.8_zeta64"))
