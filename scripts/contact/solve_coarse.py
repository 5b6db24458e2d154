"""Solve many realisations on a coarse grid, to correct the mean of a few fine solutions.

Their seeds differ from those of the fine solutions. Each surface is solved on 2 pixels per shortest
wavelength, as every fine one is too, and its long waves are described.
"""

from common.contact_curves import COARSE, CONTACT_VARIABLES, coarse_solutions
from common.conventions import add_convergence, annotate, logarithmic_grid
from common.job import start
from common.model_surfaces import grid_points
from stickiness import datasets
from stickiness.accuracy.quantities import MEASURED


def main(job):
    params = job.params
    surface = params.surface
    ranges = logarithmic_grid(params.gaps)
    dataset = coarse_solutions(
        surface, params.seeds, params.pressures, ranges, params.tolerance, MEASURED
    )
    title = "coarse contact solutions and long waves of many realisations"
    parameters = {
        **surface,
        "tolerance": params.tolerance,
        "pixels_per_wavelength": COARSE,
        "grid_points": grid_points(surface, COARSE),
    }
    dataset = add_convergence(annotate(dataset, **CONTACT_VARIABLES), params.tolerance)
    datasets.write(dataset, job.output[0], title=title, parameters=parameters)


if __name__ == "__main__":
    main(start(globals()))
