"""Make one random surface and record the spectrum and moments that its window really holds."""

import logging

import numpy as np
import xarray as xr

from pipeline.conventions import annotate, cell_size, grid_points, make_heights, model_spectrum
from pipeline.job import start
from stickiness.core import datasets
from stickiness.surfaces import synthesis

SOURCES = ["continuum", "lattice", "heights"]


def main(job):
    asked = job.params.surface
    spectrum, length = model_spectrum(asked), cell_size(asked)
    n = grid_points(asked, job.params.pixels_per_wavelength)
    seed = int(job.wildcards.seed)
    heights = make_heights(asked, n, seed)
    lattice = synthesis.lattice_spectrum(spectrum, length)
    realised = synthesis.realised_spectrum(heights, length)
    logging.info("n = %d, %d shells, rms slope %.6g", n, len(lattice.q), realised.rms_slope)
    datasets.write(
        to_dataset(heights, length, spectrum, lattice, realised),
        job.output[0],
        title="random surface on a periodic window",
        parameters={
            **asked,
            "seed": seed,
            "pixels_per_wavelength": job.params.pixels_per_wavelength,
            "grid_points": n,
            "prescribed": spectrum.prescribed,
        },
    )


def to_dataset(heights, length, spectrum, lattice, realised):
    n = len(heights)
    x = np.arange(n) * (length / n)
    spectra = (spectrum, lattice, synthesis.moments(heights, length))
    moments = ("h_rms", "rms_slope", "rms_curvature", "nayak")
    dataset = xr.Dataset(
        {
            "height": (("x", "y"), heights),
            "window_length": ((), length),
            "lattice_variance": ("wave_number", lattice.variance),
            "realised_variance": ("wave_number", realised_on(lattice, realised)),
            **{name: ("source", [getattr(s, name) for s in spectra]) for name in moments},
            **{name: ((), getattr(spectra[2], name)) for name in ("m40", "m22", "m04")},
        },
        coords={"x": x, "y": x, "wave_number": lattice.q, "source": SOURCES},
    )
    return annotate(
        dataset,
        x=("1", "position times q0"),
        y=("1", "position times q0"),
        height=("1", "height over h_rms"),
        window_length=("1", "side of the window times q0"),
        wave_number=("1", "wave number of the shell over q0"),
        lattice_variance=("1", "expected height variance on the shell over h_rms^2"),
        realised_variance=("1", "height variance of this surface on the shell over h_rms^2"),
        source=("1", "what the moments are taken from"),
        h_rms=("1", "rms height over the prescribed one"),
        nayak=("1", "Nayak's bandwidth parameter m0 m4/m2^2"),
        m40=("1", "mean square of d2h/dx2 over q0^4 h_rms^2, from the heights"),
        m22=("1", "mean square of d2h/dxdy over q0^4 h_rms^2, from the heights"),
        m04=("1", "mean square of d2h/dy2 over q0^4 h_rms^2, from the heights"),
    )


def realised_on(lattice, realised):
    """Realised variances on the lattice's shells, zero where the surface holds nothing."""
    index = np.searchsorted(lattice.q * (1 - 1e-9), realised.q) - 1
    variance = np.zeros(len(lattice.q))
    np.add.at(variance, index, realised.variance)
    return variance


if __name__ == "__main__":
    main(start(globals(), "synthesise_surface", model_surface="H0.8_zeta64", grid="", seed=1))
