"""Make a few random surfaces and record the spectra and moments that their cells really hold."""

import logging

import numpy as np
import xarray as xr

from common.conventions import annotate
from common.job import start
from common.model_surfaces import cell_size, grid_points, make_heights, model_spectrum
from stickiness import datasets
from stickiness import surface as synthesis

SURFACE_VARIABLES = {
    "x": "position times q0",
    "y": "position times q0",
    "height": "height over h_rms",
    "window_length": "side of the window times q0",
    "wave_number": "wave number of the shell over q0",
    "lattice_variance": "expected height variance on the shell over h_rms^2",
    "realised_variance": "height variance of this surface on the shell over h_rms^2",
    "source": "what the moments are taken from",
    "h_rms": "rms height over the prescribed one",
    "nayak": "Nayak's bandwidth parameter m0 m4/m2^2",
    "m40": "mean square of d2h/dx2 over q0^4 h_rms^2, from the heights",
    "m22": "mean square of d2h/dxdy over q0^4 h_rms^2, from the heights",
    "m04": "mean square of d2h/dy2 over q0^4 h_rms^2, from the heights",
}


def main(job):
    surface = job.params.surface
    seeds = job.params.seeds
    pixels = job.params.pixels_per_wavelength
    spectrum = model_spectrum(surface)
    length = cell_size(surface)
    n = grid_points(surface, pixels)
    lattice = synthesis.lattice_spectrum(spectrum, length)
    logging.info("n = %d, %d shells", n, len(lattice.q))
    heights = np.array([make_heights(surface, n, seed) for seed in seeds])
    realised = [variance_on_shells(h, length, lattice) for h in heights]
    measured = [synthesis.moments(h, length) for h in heights]
    sources = [(spectrum, lattice, moments_of_seed) for moments_of_seed in measured]
    moment_names = ("h_rms", "rms_slope", "rms_curvature", "nayak")
    moments = {name: [[getattr(s, name) for s in row] for row in sources] for name in moment_names}
    x = np.arange(n) * (length / n)
    derivatives = ("m40", "m22", "m04")
    source_names = ["continuum", "lattice", "heights"]
    dataset = xr.Dataset(
        {
            "height": (("seed", "x", "y"), heights),
            "window_length": ((), length),
            "lattice_variance": ("wave_number", lattice.variance),
            "realised_variance": (("seed", "wave_number"), realised),
            **{name: (("seed", "source"), values) for name, values in moments.items()},
            **{
                name: ("seed", [getattr(moments_of_seed, name) for moments_of_seed in measured])
                for name in derivatives
            },
        },
        {"seed": list(seeds), "x": x, "y": x, "wave_number": lattice.q, "source": source_names},
    )
    title = "random surfaces on a periodic window"
    parameters = {
        **surface,
        "seeds": list(seeds),
        "pixels_per_wavelength": pixels,
        "grid_points": n,
        "prescribed": spectrum.prescribed,
    }
    dataset = annotate(dataset, **SURFACE_VARIABLES)
    datasets.write(dataset, job.output[0], title=title, parameters=parameters)


def variance_on_shells(heights, length, lattice):
    """Height variance of a surface on the shells of a lattice, zero on shells without waves."""
    spectrum = synthesis.realised_spectrum(heights, length)
    variance = np.zeros(len(lattice.q))
    index = np.searchsorted(lattice.q * (1 - 1e-9), spectrum.q) - 1
    np.add.at(variance, index, spectrum.variance)
    return variance


if __name__ == "__main__":
    main(start(globals()))
