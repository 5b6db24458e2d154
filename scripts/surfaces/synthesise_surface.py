"""Make a few random surfaces and record the moments that their cells really hold."""

import logging

import numpy as np
import xarray as xr

from common.conventions import annotate
from common.job import start
from common.model_surfaces import cell_size, grid_points, make_heights, model_spectrum
from stickiness import datasets
from stickiness import surface as synthesis

SOURCES = ["continuum", "lattice", "heights"]
MOMENTS = ("h_rms", "rms_slope", "rms_curvature")
VARIABLES = {
    "x": "position times q0",
    "y": "position times q0",
    "height": "height over h_rms",
    "window_length": "side of the window times q0",
    "source": "what the moments are taken from",
    "h_rms": "rms height over the prescribed one",
}


def main(job):
    surface, seeds, pixels = job.params.surface, job.params.seeds, job.params.pixels_per_wavelength
    spectrum, length, n = model_spectrum(surface), cell_size(surface), grid_points(surface, pixels)
    lattice = synthesis.lattice_spectrum(spectrum, length)
    logging.info("n = %d, %d shells", n, len(lattice.q))
    heights = np.array([make_heights(surface, n, seed) for seed in seeds])
    sources = [(spectrum, lattice, synthesis.moments(h, length)) for h in heights]
    moments = {name: [[getattr(s, name) for s in row] for row in sources] for name in MOMENTS}
    x = np.arange(n) * (length / n)
    dataset = xr.Dataset(
        {
            "height": (("seed", "x", "y"), heights),
            "window_length": ((), length),
            **{name: (("seed", "source"), values) for name, values in moments.items()},
        },
        coords={"seed": list(seeds), "x": x, "y": x, "source": SOURCES},
    )
    datasets.write(
        annotate(dataset, **VARIABLES),
        job.output[0],
        title="random surfaces on a periodic window",
        parameters={
            **surface,
            "seeds": list(seeds),
            "pixels_per_wavelength": pixels,
            "grid_points": n,
            "prescribed": spectrum.prescribed,
        },
    )


if __name__ == "__main__":
    main(start(globals(), "synthesise_surface", model_surface="H0.8_zeta64", grid="", part="1-4"))
