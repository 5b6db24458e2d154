"""Adhesion that each criterion requires, over roughness and over the shortest wavelength.

Surfaces with one Hurst exponent, the range as unit of length: once over h_rms at a fixed
magnification, once over the magnification at fixed h_rms and longest wavelength. The second shows
the influence of the finest waves on each criterion.
"""

import numpy as np
import xarray as xr

from common.conventions import logarithmic_grid
from criteria.self_affine_a_v import find_a_v
from stickiness import datasets
from stickiness.criteria.pair import Pair
from stickiness.criteria.registry import CRITERIA
from stickiness.remaining.errors import find_limits
from stickiness.remaining.roughness import Roughness
from stickiness.spectrum.kinds import SelfAffine
from stickiness.verdicts.limits import LIMIT_TEXT, LIMITS

COMPARED = [criterion for criterion in CRITERIA.values() if criterion.has_length]
TEXT = "adhesion length over range above which the criterion calls the surface sticky"
COMPARED_VARIABLES = {
    "h_rms_over_range": ("1", "rms height over range"),
    "magnification": ("1", "highest over lowest wave number"),
    "criterion": ("1", "stickiness criterion"),
    "limit": LIMIT_TEXT,
    "against_roughness": ("1", TEXT),
    "against_magnification": ("1", TEXT),
    "remaining_against_roughness": ("1", f"{TEXT}, by what remains"),
    "remaining_against_magnification": ("1", f"{TEXT}, by what remains"),
}


def write_comparison(settings, load, constant, output):
    """Write the thresholds; `constant` is the constant a_V of a broad spectrum."""
    dataset = datasets.annotate(compare(settings, load, constant), **COMPARED_VARIABLES)
    datasets.write(
        dataset,
        output,
        title="adhesion at the threshold of stickiness by every criterion",
        parameters={**settings, "pressure": load, "constant_a_v": constant},
    )


def compare(settings, load, constant):
    """Thresholds over roughness and over magnification, the other being fixed."""
    heights = logarithmic_grid(settings["h_rms_over_range"])
    zetas = logarithmic_grid(settings["magnification"])
    fixed_height = np.full(zetas.shape, float(settings["quoted_h_rms_over_range"]))
    fixed_zeta = np.full(heights.shape, float(settings["quoted_magnification"]))
    pairs = {
        "roughness": make_pair(settings, heights, fixed_zeta, load, constant),
        "magnification": make_pair(settings, fixed_height, zetas, load, constant),
    }
    axes = {"roughness": "h_rms_over_range", "magnification": "magnification"}
    variables = {}
    for name, pair in pairs.items():
        thresholds = [each.adhesion_length_threshold(pair) for each in COMPARED]
        # The threshold is low where the share is high.
        value, high, low = find_limits(pair, lambda deviating: deviating.remaining_threshold)
        variables[f"against_{name}"] = ("criterion", axes[name]), thresholds
        variables[f"remaining_against_{name}"] = ("limit", axes[name]), [low, value, high]
    return xr.Dataset(
        variables,
        coords={
            "h_rms_over_range": heights,
            "magnification": zetas,
            "criterion": [each.name for each in COMPARED],
            "limit": list(LIMITS),
        },
    )


def make_pair(settings, h_rms, magnification, load, constant):
    """`Pair` of surfaces of these rms heights and magnifications.

    The range and the adhesion length are the units of length.
    """
    hurst = settings["hurst"]
    q0 = settings["range_times_q0"]
    spectra = [
        SelfAffine(hurst=hurst, q0=q0, q1=q0 * zeta, h_rms=h)
        for h, zeta in zip(h_rms, magnification, strict=True)
    ]
    rough = Roughness(
        h_rms=h_rms,
        q0=q0,
        q1=np.array([spectrum.q1 for spectrum in spectra]),
        rms_slope=np.array([spectrum.rms_slope for spectrum in spectra]),
        elastic_energy=np.array([spectrum.elastic_energy() for spectrum in spectra]),
    )
    return Pair(
        rough=rough,
        modulus=1.0,
        work_of_adhesion=1.0,
        range=1.0,
        rms_curvature=np.array([spectrum.rms_curvature for spectrum in spectra]),
        a_v=find_a_v(hurst, load, 1 / h_rms, magnification)[0],
        constant_a_v=constant,
    )
