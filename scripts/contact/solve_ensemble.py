"""Make, press and average all realisations of a case that only theory is compared with."""

import numpy as np

from common.contact_curves import VARIABLES, coarse_solutions, solve_seeds, steps_of
from common.conventions import annotate, logarithmic_grid
from common.job import start
from common.model_surfaces import grid_points
from contact.ensembles import join_coarse, write_means


def main(job):
    surface, params = job.params.surface, job.params
    curves = np.sort(params.pressures), logarithmic_grid(params.gaps), params.tolerance
    seeds, pixels = np.arange(1, params.seeds + 1), params.pixels_per_wavelength
    fine = annotate(solve_seeds(surface, seeds, pixels, steps_of(pixels), *curves), **VARIABLES)
    others = []
    if params.coarse_seeds:
        count = range(params.coarse_seeds), params.descriptor_seeds
        others = [annotate(coarse_solutions(surface, *count, *curves), **VARIABLES)]
    made = {
        **surface,
        "case": job.wildcards.comparison,
        "seeds": seeds.tolist(),
        "tolerance": params.tolerance,
        "pixels_per_wavelength": pixels,
        "grid_points": grid_points(surface, pixels),
    }
    write_means(fine, join_coarse(others), made, job.input.laws, job.output[0])


if __name__ == "__main__":
    main(start(globals(), "solve_ensemble", comparison="H0.5_zeta16_4x4"))
