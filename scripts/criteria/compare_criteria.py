"""Adhesion that each criterion requires, over roughness and over the shortest wavelength.

Surfaces with one Hurst exponent, the range as unit of length: once over h_rms at a fixed
magnification, once over the magnification at fixed h_rms and longest wavelength. The second shows
the influence of the finest waves on each criterion.
"""

from dataclasses import replace

import numpy as np
import xarray as xr

from common.conventions import logarithmic_grid
from criteria.budgets import CLOSED, between
from stickiness import datasets
from stickiness.criteria.pair import Pair
from stickiness.criteria.registry import CRITERIA, REMAINING
from stickiness.error_budget import with_budget
from stickiness.spectrum.kinds import SelfAffine

LIMITS = {REMAINING: 0, f"{REMAINING}_low": 1, f"{REMAINING}_high": -1}  # names and signs
TEXT = "adhesion length over range above which the criterion calls the surface sticky"
VARIABLES = {
    "h_rms_over_range": ("1", "rms height over range"),
    "magnification": ("1", "highest over lowest wave number"),
    "criterion": ("1", "stickiness criterion; of what remains also its low and high limit"),
    "against_roughness": ("1", TEXT),
    "against_magnification": ("1", TEXT),
}


def write_comparison(asked, load, table, constant, output):
    """Write the thresholds; `constant` is the constant a_V of a broad spectrum."""
    dataset = datasets.annotate(compare(asked, load, table, constant), **VARIABLES)
    title = "adhesion at the threshold of stickiness by every criterion"
    parameters = {**asked, "pressure": load, "constant_a_v": constant}
    datasets.write(add_budgets(dataset), output, title=title, parameters=parameters)


def compare(asked, load, table, constant):
    """Thresholds over roughness and over magnification, each with the other held."""
    heights, zetas = (logarithmic_grid(asked[key]) for key in ("h_rms_over_range", "magnification"))
    height, zeta = asked["quoted_h_rms_over_range"], asked["quoted_magnification"]
    over_h, over_zeta = (
        find_thresholds(asked, *np.broadcast_arrays(*at), load, table, constant)
        for at in ((heights, float(zeta)), (float(height), zetas))
    )
    return xr.Dataset(
        {
            "against_roughness": (("criterion", "h_rms_over_range"), list(over_h.values())),
            "against_magnification": (("criterion", "magnification"), list(over_zeta.values())),
        },
        coords={"h_rms_over_range": heights, "magnification": zetas, "criterion": list(over_h)},
    )


def find_thresholds(asked, h_rms, magnification, load, table, constant):
    """Adhesion length over range at which each criterion begins to call surfaces sticky."""
    hurst, q0 = asked["hurst"], asked["range_times_q0"]
    spectra = [
        SelfAffine(hurst=hurst, q0=q0, q1=q0 * zeta, h_rms=h)
        for h, zeta in zip(h_rms, magnification, strict=True)
    ]
    pair = Pair(  # with the range and the adhesion length as unit of length
        h_rms=h_rms,
        q0=q0,
        rms_slope=np.array([s.rms_slope for s in spectra]),
        rms_curvature=np.array([s.rms_curvature for s in spectra]),
        elastic_energy=np.array([s.elastic_energy() for s in spectra]),
        **dict.fromkeys(("modulus", "work_of_adhesion", "range"), 1.0),
        a_v=table.a_v_at(hurst, load, 1 / h_rms, magnification).value,
        constant_a_v=constant,
    )
    others = {
        name: criterion.adhesion_length_threshold(pair)
        for name, criterion in CRITERIA.items()
        if criterion.has_length and name != REMAINING
    }
    return others | {name: pair.remaining_threshold(sign) for name, sign in LIMITS.items()}


def add_budgets(dataset):
    """Add error budgets to the thresholds; only that of what remains states an error."""
    for name in ("against_roughness", "against_magnification"):
        value = dataset[name]
        low, high = (value.sel(criterion=end, drop=True) for end in list(LIMITS)[1:])
        model = between(value, low, high)
        model = replace(model, error=model.error.where(value.criterion == REMAINING))
        dataset = with_budget(dataset, name, model=model, **CLOSED)
    return dataset
