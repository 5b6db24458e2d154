"""Make, press and average all realisations of a case that only theory is compared with."""

import logging

import numpy as np
import xarray as xr

from common.contact_curves import VARIABLES, coarse_solutions, load_curves, steps_of
from common.conventions import annotate, logarithmic_grid
from common.job import start
from common.model_surfaces import cell_size, grid_points, make_heights, waves_across
from contact.ensembles import join_coarse, write_means
from stickiness import surface as synthesis


def main(job):
    surface, params = job.params.surface, job.params
    curves = np.sort(params.pressures), logarithmic_grid(params.gaps), params.tolerance
    seeds = np.arange(1, params.seeds + 1)
    fine = xr.concat(
        [realisation(surface, int(seed), params.pixels_per_wavelength, curves) for seed in seeds],
        xr.DataArray(seeds, dims="seed", name="seed"),
    )
    others = []
    if params.coarse_seeds:
        count = range(params.coarse_seeds), params.descriptor_seeds
        others = [annotate(coarse_solutions(surface, *count, *curves), **VARIABLES)]
    made = {
        **surface,
        "case": job.wildcards.comparison,
        "seeds": seeds.tolist(),
        "tolerance": params.tolerance,
        "pixels_per_wavelength": params.pixels_per_wavelength,
        "grid_points": grid_points(surface, params.pixels_per_wavelength),
    }
    fine, others = annotate(fine, **VARIABLES), join_coarse(others)
    write_means(fine, others, made, job.input.laws, job.output[0])


def realisation(surface, seed, pixels_per_wavelength, curves):
    """Contact of one random surface on all its grids."""
    logging.info("seed %d", seed)
    length, n = cell_size(surface), grid_points(surface, pixels_per_wavelength)
    heights = make_heights(surface, n, seed)
    steps = steps_of(pixels_per_wavelength)
    dataset = load_curves(heights, length, steps, *curves)
    dataset["rms_slope"] = synthesis.moments(heights, length).rms_slope
    return dataset.assign_coords(resolution=n / waves_across(surface) / np.array(steps))


if __name__ == "__main__":
    main(start(globals(), "solve_ensemble", comparison="H0.5_zeta16_4x4"))
