"""Walk realisations along their load path, on their grid, every second point of it, and 2 pixels.

The coarser grids sample the same band-limited surface. The change from every second point to all of
them measures the discretisation error; the solution on 2 pixels per shortest wavelength is the
control variate for the many coarse solutions of `solve_coarse`.
"""

import numpy as np

from common.contact_curves import CONTACT_VARIABLES, load_curves, steps_of
from common.conventions import add_convergence, annotate, logarithmic_grid
from common.job import start
from common.model_surfaces import each_seed, pixels
from stickiness import datasets


def main(job):
    surfaces = datasets.read(job.input.surfaces, ["height", "window_length", "rms_slope"])
    length = float(surfaces.window_length)
    steps = steps_of(job.params.pixels_per_wavelength)
    ranges = logarithmic_grid(job.params.gaps)

    def solve(heights):
        return load_curves(
            heights,
            length,
            steps,
            job.params.pressures,
            ranges,
            job.params.tolerance,
            job.params.measured,
        )

    dataset = each_seed(solve, surfaces, job.params.seeds)
    dataset = dataset.assign_coords(resolution=pixels(surfaces) / np.array(steps))
    title = "repulsive contact of realisations along their load path"
    parameters = {
        **datasets.parameters(surfaces),
        "seeds": list(job.params.seeds),
        "case": job.wildcards.case,
        "tolerance": job.params.tolerance,
    }
    dataset = add_convergence(annotate(dataset, **CONTACT_VARIABLES), job.params.tolerance)
    datasets.write(dataset, job.output[0], title=title, parameters=parameters)


if __name__ == "__main__":
    main(start(globals()))
