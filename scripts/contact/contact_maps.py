"""Keep the gap and pressure fields of one realisation at a few loads, for pictures."""

import numpy as np

from common.job import start
from common.model_surfaces import gather_fields, read_first
from stickiness import datasets
from stickiness.repulsive import solver


def main(job):
    surface = read_first(job.input.surfaces)
    pressures = np.sort(job.params.pressures)
    tolerance = job.params.tolerance
    heights = surface.height.values
    length = float(surface.window_length)
    contacts = solver.load_path(heights, length, pressures, tol=tolerance)
    text = "contact pressure over E* q0 h_rms"
    dataset = gather_fields(list(contacts), pressures, surface, tolerance, contact_pressure=text)
    title = "gap and pressure fields of one realisation"
    parameters = datasets.parameters(surface)
    datasets.write(dataset, job.output[0], title=title, parameters=parameters)


if __name__ == "__main__":
    main(start(globals()))
