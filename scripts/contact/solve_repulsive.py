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
from stickiness.accuracy.quantities import MEASURED


def main(job):
    params = job.params
    steps = steps_of(params.pixels_per_wavelength)
    ranges = logarithmic_grid(params.gaps)

    def solve(surface):
        heights = surface.height.values
        length = float(surface.window_length)
        curves = load_curves(
            heights, length, steps, params.pressures, ranges, params.tolerance, MEASURED
        )
        return curves.assign_coords(resolution=pixels(surface) / np.array(steps))

    dataset = each_seed(solve, job.input.surfaces, params.seeds)
    title = "repulsive contact of realisations along their load path"
    parameters = {
        **datasets.parameters(dataset),
        "seeds": list(params.seeds),
        "tolerance": params.tolerance,
    }
    dataset = add_convergence(annotate(dataset, **CONTACT_VARIABLES), params.tolerance)
    datasets.write(dataset, job.output[0], title=title, parameters=parameters)


if __name__ == "__main__":
    main(start(globals()))
