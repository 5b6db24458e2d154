"""Conventions shared by the stages: units, lists of points, and what variables mean.

Model surfaces have q0 = 1, h_rms = 1 and E* = 1: pressures come out in units of E* q0 h_rms.
"""

import numpy as np

from stickiness import datasets

Q0 = 1.0
VARIANT = "afferrante2018"  # of the theory, where one is quoted
GAPS_MEASURED = (0.01, 1.0)  # over h_rms, where the error model of P(u) was measured
FIT_MEASURED = (0.01, 0.1)  # over h_rms, fit interval of the a_V that has an error model
LINEAR_UP_TO = 0.3  # area fraction up to which the paper calls the area linear in load

# Units and long_name of variables that mean the same wherever they occur.
SHARED_VARIABLES = {
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


def annotate(dataset, **texts):
    """Describe the variables of a dataset by `texts` or else by `SHARED_VARIABLES`.

    A text is the `long_name` of a dimensionless variable, or a tuple of units, `long_name` and, if
    values may be missing, what that means. Texts of variables that the dataset lacks are ignored.
    """
    described = {
        name: text for name, text in (SHARED_VARIABLES | texts).items() if name in dataset.variables
    }
    described = {n: ("1", text) if isinstance(text, str) else text for n, text in described.items()}
    return datasets.annotate(dataset, **described)


def add_convergence(dataset, tolerance, prefix=""):
    """Add whether the residual of every state is within the tolerance."""
    met = (dataset[f"{prefix}residual"] <= tolerance).astype("i1")
    text = f"1 where the residual is at most {tolerance:g}, 0 where there is no state"
    return dataset.assign({f"{prefix}converged": met.assign_attrs(units="1", long_name=text)})


def logarithmic_grid(grid):
    """List points from `minimum` to `maximum`, about `per_decade` a decade; none for None."""
    if grid is None:
        return np.array([])
    decades = np.log10(grid["maximum"] / grid["minimum"])
    return np.geomspace(grid["minimum"], grid["maximum"], round(decades * grid["per_decade"]) + 1)


def middles(edges):
    """Geometric middles of neighbouring points."""
    return np.sqrt(edges[1:] * edges[:-1])
