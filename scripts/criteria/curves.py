"""What remains of adhesion against the modulus, the height of the roughness and the rate."""

from dataclasses import replace

import numpy as np
import xarray as xr

from common.verdicts import find_limits
from stickiness.criteria.verdict import LIMITED, SIGNS
from stickiness.statistics import COVERS

DIMS = ("material", "surface", "end")
QUANTILES = (0.05, 0.5, 0.95)  # of the samples of a measured surface
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


def follow_remaining(pair, solids, roughness, rates):
    """Share that remains along factors on E* and on the heights, and along the rate.

    `rates` are moduli ``(material, frequency)``. Limits are those that decide
    (`find_limits`), so that at a factor of 1 they are the pair's. U_full goes with
    E* and with the square of the heights: no spectrum is integrated again. With a film the modulus
    of the layer alone changes the response, which is withheld.
    """
    scalable = np.array([solid.is_scalable for solid in solids])
    quoted = np.array([solid.modulus for solid in solids])
    along = {
        "modulus": np.where(scalable, MODULUS_FACTORS[:, None] * quoted, np.nan),
        "roughness": np.broadcast_to(quoted, (len(ROUGHNESS_FACTORS), len(solids))),
        "rate": np.where(scalable, rates.T, np.nan),
    }
    found = {"modulus_factor": MODULUS_FACTORS, "roughness_factor": ROUGHNESS_FACTORS}
    for axis, moduli in along.items():
        dim = AXES[axis][0]
        heights = ROUGHNESS_FACTORS if axis == "roughness" else np.ones(len(moduli))
        curves = follow(pair, solids, roughness, dim, moduli, heights)
        for end, values in zip(SIGNS, curves, strict=True):
            found[f"remaining_by_{axis}{end}"] = values
    return found


def follow(pair, solids, roughness, dim, moduli, heights):
    """Share with both limits for moduli ``(dim, material)`` and factors on heights ``(dim,)``.

    A modulus that is not known is NaN, and so are its shares.
    """
    known = xr.DataArray(~np.isnan(moduli), dims=(dim, "material"))
    moduli = np.where(known, moduli, pair.modulus[:, 0, 0])
    factor = heights[:, None, None, None]
    at = replace(
        pair,
        modulus=moduli[..., None, None],
        h_rms=pair.h_rms * factor,
        elastic_energy=pair.elastic_energy * factor**2,
        half_space_energy=pair.half_space_energy * factor**2,
    )
    strain = np.array([[rough.layer_strain for rough in row] for row in roughness])
    quantiles = [
        [follow_samples(solid, rough.samples, moduli[:, i], heights) for rough in roughness[i]]
        for i, solid in enumerate(solids)
    ]
    found = xr.Dataset(
        {f"remaining{end}": ((dim, *DIMS), at.remaining(sign)) for end, sign in SIGNS.items()}
        | {
            "remaining_quantile": ((*DIMS[:2], dim, "quantile"), np.array(quantiles)),
            "layer_strain": ((dim, *DIMS), strain * factor),
        }
    )
    curves = (found.remaining, *find_limits(found))
    return tuple(x.where(known).transpose(*DIMS, dim, missing_dims="ignore") for x in curves)


def follow_samples(solid, samples, moduli, heights):
    """Quantiles of the share over the samples of a surface, ``(dim, quantile)``; NaN without."""
    if samples is None:
        return np.full((len(moduli), len(QUANTILES)), np.nan)
    (moduli, heights), place = np.unique([moduli, heights], axis=1, return_inverse=True)
    factor = heights[:, None]
    bound = samples.half_space_energy
    rough = replace(
        samples,
        h_rms=samples.h_rms * factor,
        elastic_energy=samples.elastic_energy * factor**2,
        half_space_energy=None if bound is None else bound * factor**2,
    )
    length = solid.work_of_adhesion / moduli[:, None]
    shares = rough.share(length, solid.range, sample_errors(samples))
    return np.quantile(shares, QUANTILES, axis=-1).T[place]


def sample_errors(samples):
    """Errors of the model for every sample, in units of its limits, which cover 90 %."""
    return np.random.default_rng(SEED).normal(size=len(samples.h_rms)) / COVERS
