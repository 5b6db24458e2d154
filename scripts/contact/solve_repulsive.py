"""Walk one realisation along its load path, on its grid, every second point of it, and 2 pixels.

The coarser grids sample the same band-limited surface. What changes from every second point to
all of them is a measure of the discretisation error; the solution on 2 pixels per shortest
wavelength is the control of `solve_coarse`'s many others.
"""

import numpy as np

from pipeline.contact_curves import annotate, load_curves, steps_of
from pipeline.conventions import logarithmic_grid, pixels
from pipeline.job import start
from stickiness.core import datasets


def main(job):
    surface = datasets.read(job.input.surface, ["height", "window_length", "rms_slope"])
    heights, length = surface.height.values, float(surface.window_length)
    steps = steps_of(job.params.pixels_per_wavelength)
    path = job.params.pressures, logarithmic_grid(job.params.gaps), job.params.tolerance
    dataset = load_curves(heights, length, steps, *path, job.params.measured)
    dataset = dataset.assign_coords(resolution=pixels(surface) / np.array(steps))
    dataset["rms_slope"] = surface.rms_slope.sel(source="heights", drop=True)
    datasets.write(
        annotate(dataset),
        job.output[0],
        title="repulsive contact of one realisation along its load path",
        parameters={
            **datasets.parameters(surface),
            "case": job.wildcards.case,
            "tolerance": job.params.tolerance,
            "largest_residual": float(dataset.residual.max()),
        },
    )


if __name__ == "__main__":
    main(start(globals(), "solve_repulsive", case="H0.8_zeta64", seed=1))
