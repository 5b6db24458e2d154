"""Conventions shared by the stages: units, model surfaces, grids, and what variables mean.

Model surfaces have q0 = 1, h_rms = 1 and E* = 1: pressures come out in units of E* q0 h_rms.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.fft import next_fast_len

from stickiness.core import datasets
from stickiness.surfaces.spectrum import SelfAffine
from stickiness.surfaces.synthesis import synthesise

Q0 = 1.0
VARIANT = "afferrante2018"  # of the theory, where one is quoted
LOAD = 0.065  # over E* q0 h_rms, the load of the paper's Figures 3A and 3C
GAPS_MEASURED = (0.01, 1.0)  # over h_rms, where the error model of P(u) was measured
FIT_MEASURED = (0.01, 0.1)  # over h_rms, fit interval of the a_V that has an error model
LINEAR_UP_TO = 0.3  # area fraction up to which the paper calls the area linear in load

# Units and long_name of variables that mean the same wherever they occur.
VARIABLES = {
    "pressure": ("1", "mean pressure over E* q0 h_rms"),
    "range": ("1", "range of attraction over h_rms"),
    "gap": ("1", "gap over h_rms"),
    "area_fraction": ("1", "repulsive contact area over nominal area"),
    "mean_gap": ("1", "mean gap over h_rms"),
    "attractive_area": ("1", "area with gaps between 0 and the range, over nominal area"),
    "gap_density": ("1", "probability density of the gap, times h_rms"),
    "pixel_area_fraction": ("1", "repulsive contact area as counted in pixels, over nominal area"),
    "pixel_attractive_area": ("1", "attractive area as counted in pixels, over nominal area"),
    "edges": ("1", "pixel sides between contact and gap"),
    "edge_gap": ("1", "gap of the pixels next to the contact over h_rms: smallest range resolved"),
    "residual": ("1", "complementarity residual over h_rms"),
    "iterations": ("1", "conjugate gradient iterations"),
    "fft_pairs": ("1", "pairs of Fourier transforms in units of this grid"),
    "resolution": ("1", "grid points per shortest wavelength"),
    "seed": ("1", "seed of the realisation"),
    "hurst": ("1", "Hurst exponent"),
    "magnification": ("1", "magnification q1/q0"),
    "rms_slope": ("1", "rms gradient over q0 h_rms"),
    "rms_curvature": ("1", "rms Laplacian over q0^2 h_rms"),
    "variant": ("1", "variant of the theory, and its correction if not that of Yang & Persson"),
    "q0_h_rms": ("1", "lowest wave number times rms height"),
    "adhesion_length_over_range": ("1", "adhesion length over range, sigma0/E*"),
    "range_over_h_rms": ("1", "range of attraction over h_rms"),
    "dmt_valid": ("1", "1 where the JTB condition for the DMT limit holds"),
}

RMS_SLOPE = ("1", "rms gradient of this realisation over q0 h_rms")


def annotate(dataset: xr.Dataset, **own: tuple[str, ...]) -> xr.Dataset:
    """Describe every variable that `own` or else `VARIABLES` has texts for.

    Texts are units, `long_name` and, if values may be missing, what that means. Those of variables
    that the dataset lacks are left out.
    """
    texts = {name: text for name, text in (VARIABLES | own).items() if name in dataset.variables}
    return datasets.annotate(dataset, **texts)


def model_spectrum(surface: Mapping[str, Any]) -> SelfAffine:
    """Spectrum of a model surface of the configuration, in units of q0 and h_rms."""
    rolloff = surface.get("rolloff")
    return SelfAffine(
        hurst=surface["hurst"],
        q0=Q0,
        q1=Q0 * surface["magnification"],
        h_rms=1.0,
        q_rolloff=None if rolloff is None else Q0 * rolloff,
        anisotropy=surface.get("anisotropy", 1.0),
        angle=np.radians(surface.get("angle", 0.0)),
    )


def cell_size(surface: Mapping[str, Any]) -> float:
    """Side of a model surface's periodic cell, in units of 1/q0."""
    return surface.get("window", 1.0) * 2 * np.pi / Q0


def waves_across(surface: Mapping[str, Any]) -> float:
    """Shortest wavelengths along the side of a model surface's cell."""
    return surface["magnification"] * surface.get("window", 1.0)


def make_heights(surface: Mapping[str, Any], points: int, seed: int) -> NDArray:
    """Heights over h_rms of one realisation of a model surface on a grid of `points` a side."""
    amplitudes = surface.get("amplitudes", "gaussian")
    return synthesise(model_spectrum(surface), points, cell_size(surface), int(seed), amplitudes)


def at_load(data: xr.Dataset) -> xr.Dataset:
    """The point next to `LOAD`."""
    return data.sel(pressure=LOAD, method="nearest")


def logarithmic_grid(grid: Mapping[str, float] | None) -> NDArray:
    """Points from `minimum` to `maximum` with about `per_decade` a decade; none of None."""
    if grid is None:
        return np.array([])
    decades = np.log10(grid["maximum"] / grid["minimum"])
    return np.geomspace(grid["minimum"], grid["maximum"], round(decades * grid["per_decade"]) + 1)


def pixels(surface: xr.Dataset) -> float:
    """Grid points per shortest wavelength of a surface's file, as realised by the grid."""
    made = datasets.parameters(surface)
    return made["grid_points"] / waves_across(made)


def middles(edges: NDArray) -> NDArray:
    """Geometric middles of neighbouring points."""
    return np.sqrt(edges[1:] * edges[:-1])


def grid_points(asked, pixels_per_wavelength):
    """Number of grid points, good for the FFT, with at least the pixels asked for.

    A multiple of the even number that does so for 2 pixels, so that the coarser grids of the
    solutions are part of it.
    """
    waves = int(np.ceil(waves_across(asked) - 1e-9))
    return pixels_per_wavelength * next_fast_len(waves, real=True)
