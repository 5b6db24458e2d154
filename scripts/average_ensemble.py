"""Average the realisations of a case: means, standard errors and discretisation errors."""

import numpy as np
import xarray as xr
from _job import start
from _model import DESCRIBED, middles
from stickiness import datasets

AVERAGED = ("area_fraction", "mean_gap", "attractive_area", "gap_density")


def main(job):
    needed = ("area_fraction", "mean_gap", "attractive_area", "residual", "rms_slope")
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
    """Add mean, standard error and discretisation error of each quantity.

    The standard error is that of the mean over seeds (NaN for one seed). The discretisation
    error is the mean change from the coarse to the fine grid: with an error that falls at least
    in proportion to the pixel size, it bounds what is left.
    """
    fine = realisations.isel(resolution=-1)
    count = realisations.sizes["seed"]
    added = {}
    for name in AVERAGED:
        spread = fine[name].std("seed", ddof=1) if count > 1 else fine[name].mean("seed") * np.nan
        change = realisations[name].diff("resolution").isel(resolution=-1)
        added[f"{name}_mean"] = fine[name].mean("seed")
        added[f"{name}_standard_error"] = spread / np.sqrt(count)
        added[f"{name}_discretisation_error"] = abs(change.mean("seed"))
    kept = ["area_fraction", "mean_gap", "attractive_area", "residual", "iterations", "rms_slope"]
    added = {name: value.drop_vars("resolution", errors="ignore") for name, value in added.items()}
    return realisations[kept].assign(added)


def annotated(dataset):
    described = {"seed": ("1", "seed of the realisation"), "gap": DESCRIBED["gap"]}
    statistics = {
        "mean": "mean over seeds",
        "standard_error": "standard error of the mean over seeds",
        "discretisation_error": "change from half the resolution",
    }
    for name in AVERAGED:
        units, long_name = DESCRIBED[name]
        for suffix, meaning in statistics.items():
            described[f"{name}_{suffix}"] = (units, f"{long_name}: {meaning}")
        described[f"{name}_standard_error"] += ("a single seed",)
    return datasets.annotate(dataset, **described)


if __name__ == "__main__":
    main(start(globals(), "average_ensemble", case="H0.8_zeta64"))
