"""Model surfaces of the configuration, in units of `conventions`, and files of realisations."""

import numpy as np
import xarray as xr
from scipy.fft import next_fast_len

from common.conventions import Q0, add_convergence, annotate
from stickiness import datasets
from stickiness.spectrum.kinds import SelfAffine
from stickiness.surface import synthesise

SOLVED = ("mean_gap", "residual", "iterations")  # of the states whose fields are kept


def model_spectrum(surface):
    """Spectrum of a model surface of the configuration, in units of q0 and h_rms."""
    rolloff = surface["rolloff"]
    return SelfAffine(
        hurst=surface["hurst"],
        q0=Q0,
        q1=Q0 * surface["magnification"],
        h_rms=1.0,
        q_rolloff=None if rolloff is None else Q0 * rolloff,
        anisotropy=surface["anisotropy"],
        angle=np.radians(surface["angle"]),
    )


def make_spectrum(hurst, magnification):
    """Isotropic self-affine spectrum without a roll-off, in units of q0 and h_rms."""
    return SelfAffine(hurst=hurst, q0=Q0, q1=Q0 * magnification, h_rms=1.0)


def cell_size(surface):
    """Side of a model surface's periodic cell, in units of 1/q0."""
    return surface["window"] * 2 * np.pi / Q0


def waves_across(surface):
    """Shortest wavelengths along the side of a model surface's cell."""
    return surface["magnification"] * surface["window"]


def make_heights(surface, points, seed):
    """Heights over h_rms of one realisation of a model surface on a grid of `points` a side."""
    return synthesise(
        model_spectrum(surface),
        points,
        cell_size(surface),
        int(seed),
        surface["amplitudes"],
        skewness_of(surface),
    )


def skewness_of(surface):
    """Skewness of the heights of a model surface; 0 if they are Gaussian."""
    return surface["heights"]["skewness"] if "heights" in surface else 0.0


def grid_points(surface, pixels_per_wavelength):
    """Number of grid points, good for the FFT, with at least this many pixels per wave."""
    # A multiple of the number for one pixel: the coarser grids of the solutions are part of it.
    waves = int(np.ceil(waves_across(surface) - 1e-9))
    return pixels_per_wavelength * next_fast_len(waves, real=True)


def pixels(surface):
    """Grid points per shortest wavelength of a surface's file, as realised by the grid."""
    parameters = datasets.parameters(surface)
    return parameters["grid_points"] / waves_across(parameters)


def each_seed(solve, surfaces, seeds):
    """What `solve` makes of the heights of every seed, with the rms slope of the heights."""
    solved = [solve(surfaces.height.sel(seed=seed).values) for seed in seeds]
    dataset = xr.concat(solved, xr.DataArray(list(seeds), dims="seed", name="seed"))
    dataset["rms_slope"] = surfaces.rms_slope.sel(source="heights", seed=list(seeds), drop=True)
    return dataset


def read_first(path):
    return datasets.read(path, ["height", "window_length"]).isel(seed=0)


def read_all(paths, variables):
    """The realisations of all files, NaN where one lacks a grid; attributes of the first."""
    return xr.concat([datasets.read(path, variables) for path in paths], "seed", join="outer")


def gather_fields(states, pressures, surface, tolerance, **texts):
    """Fields of one state a pressure, and how well it is solved; `texts` describe variables."""
    dims = ("pressure", "x", "y")
    dataset = xr.Dataset(
        {
            "gap": (dims, [state.gap for state in states]),
            "contact_pressure": (dims, [state.pressure for state in states]),
            **{n: ("pressure", [getattr(state, n) for state in states]) for n in SOLVED},
        },
        coords={"pressure": pressures, "x": surface.x, "y": surface.y},
    )
    return add_convergence(annotate(dataset, **texts), tolerance)
