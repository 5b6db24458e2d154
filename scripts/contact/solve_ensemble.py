"""Make, press and average all realisations of a case that only theory is compared with."""

import numpy as np
import xarray as xr

from common.contact_curves import (
    CONTACT_VARIABLES,
    coarse_solutions,
    describe_others,
    solve_seeds,
    steps_of,
)
from common.conventions import annotate, logarithmic_grid
from common.job import start
from common.model_surfaces import grid_points
from contact.ensembles import name_coarse, write_means


def main(job):
    surface = job.params.surface
    params = job.params
    pressures = np.sort(params.pressures)
    ranges = logarithmic_grid(params.gaps)
    pixels = params.pixels_per_wavelength
    seeds = np.arange(1, params.seeds + 1)
    fine = solve_seeds(
        surface, seeds, pixels, steps_of(pixels), pressures, ranges, params.tolerance
    )
    fine = annotate(fine, **CONTACT_VARIABLES)
    others = xr.Dataset()
    if params.coarse_seeds:
        numbers = range(1, params.coarse_seeds + 1)
        coarse = coarse_solutions(surface, numbers, pressures, ranges, params.tolerance)
        others = name_coarse(coarse, describe_others(surface, params.descriptor_seeds))
    parameters = {
        **surface,
        "case": job.wildcards.comparison,
        "seeds": seeds.tolist(),
        "tolerance": params.tolerance,
        "pixels_per_wavelength": pixels,
        "grid_points": grid_points(surface, pixels),
    }
    write_means(fine, others, parameters, job.input.laws, job.output[0])


if __name__ == "__main__":
    main(start(globals()))
