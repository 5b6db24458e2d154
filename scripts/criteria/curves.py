"""What remains of adhesion against the modulus, the height of the roughness and the rate."""

from dataclasses import replace

import numpy as np
import xarray as xr

from common.verdicts import find_limits
from stickiness.criteria.pair import LIMITED, SIGNS
from stickiness.statistics import COVERS

DIMS = ("material", "surface", "end")
QUANTILES = (0.05, 0.5, 0.95)  # of the draws of a measured surface
SEED = 2
# Factors on E* and on the heights at an unchanged shape of the spectrum; 1 is among both.
MODULUS_FACTORS = 10.0 ** (np.arange(-60, 41) / 10)
ROUGHNESS_FACTORS = 10.0 ** (np.arange(-16, 17) / 16)
AXES = {  # dimension, description, and why a value may be missing, of every curve
    "modulus": ("modulus_factor", "for E* times a factor", "elastic backing"),
    "roughness": ("roughness_factor", "for the pair's heights times a factor", "not judged"),
    "rate": ("frequency", "at a frequency", "beyond the material's table, or elastic backing"),
}
CURVES = {  # units and descriptions of the variables
    "modulus_factor": ("1", "factor on the plane-strain modulus"),
    "roughness_factor": ("1", "factor on the heights, at unchanged shape of the spectrum"),
    **{
        f"remaining_by_{axis}{end}": (
            "1",
            f"{LIMITED['remaining'][1]}, {text}{f', {end[1:]} limit' if end else ''}",
            missing,
        )
        for axis, (_, text, missing) in AXES.items()
        for end in SIGNS
    },
}


def follow_remaining(pair, solids, draws, strain, rates):
    """Share that remains along factors on E* and on the heights, and along the rate.

    `draws` has a row of `read_draws` for every material, `rates` are moduli (material, frequency).
    """
    # With a film the modulus of the layer alone changes the response: only heights are followed.
    scalable = np.array([solid.is_scalable for solid in solids])
    quoted = np.array([solid.modulus for solid in solids])
    along = {
        "modulus": np.where(scalable, MODULUS_FACTORS[:, None] * quoted, np.nan),
        "roughness": np.broadcast_to(quoted, (len(ROUGHNESS_FACTORS), len(solids))),
        "rate": np.where(scalable, rates.T, np.nan),
    }
    found = {"modulus_factor": MODULUS_FACTORS, "roughness_factor": ROUGHNESS_FACTORS}
    for axis, moduli in along.items():
        heights = ROUGHNESS_FACTORS if axis == "roughness" else np.ones(len(moduli))
        curves = follow(pair, solids, draws, strain, AXES[axis][0], moduli, heights)
        found |= {f"remaining_by_{axis}{end}": x for end, x in zip(SIGNS, curves, strict=True)}
    return found


def follow(pair, solids, draws, strain, dim, moduli, heights):
    """Share with the limits that decide, for moduli (dim, material) and factors on heights (dim,).

    A modulus that is not known is NaN, and so are its shares.
    """
    known = xr.DataArray(~np.isnan(moduli), dims=(dim, "material"))
    moduli = np.where(known, moduli, pair.modulus[:, 0, 0])
    at = scale_heights(pair, heights[:, None, None, None])
    at = replace(at, modulus=moduli[..., None, None])
    found = xr.Dataset(
        {f"remaining{end}": ((dim, *DIMS), at.remaining(sign)) for end, sign in SIGNS.items()}
    )
    quantiles = [
        [follow_draws(solid, one, moduli[:, i], heights) for one in draws[i]]
        for i, solid in enumerate(solids)
    ]
    found["remaining_quantile"] = (*DIMS[:2], dim, "quantile"), np.array(quantiles)
    found["layer_strain"] = strain * xr.DataArray(heights, dims=dim)
    curves = (found.remaining, *find_limits(found))
    return tuple(x.where(known).transpose(*DIMS, dim, missing_dims="ignore") for x in curves)


def scale_heights(rough, factor):
    """A `Pair` or a `Roughness` with its heights times a factor: no spectrum is integrated."""
    return replace(
        rough,
        h_rms=rough.h_rms * factor,
        elastic_energy=rough.elastic_energy * factor**2,
        half_space_energy=rough.half_space_energy * factor**2,
    )


def follow_draws(solid, draws, moduli, heights):
    """Quantiles of the share over the draws of a surface, ``(dim, quantile)``; NaN without."""
    if draws is None:
        return np.full((len(moduli), len(QUANTILES)), np.nan)
    (moduli, heights), place = np.unique([moduli, heights], axis=1, return_inverse=True)
    length = solid.work_of_adhesion / moduli[:, None]
    rough = scale_heights(draws, heights[:, None])
    shares = rough.share(length, solid.range, draw_errors(draws))
    return np.quantile(shares, QUANTILES, axis=-1).T[place]


def draw_errors(draws):
    """Errors of the model for every draw, in units of its limits, which cover 90 %."""
    return np.random.default_rng(SEED).normal(size=len(draws.h_rms)) / COVERS
