"""What remains of adhesion against the modulus, the height of the roughness and the rate."""

from dataclasses import replace

import numpy as np
import xarray as xr

from criteria.pairs import DIMS, LIMITS, is_scalable
from criteria.probabilities import QUANTILES, draw_signs
from criteria.words import find_limits

# Factors on E* and on the heights at an unchanged shape of the spectrum; 1 is among both.
MODULUS_FACTORS = 10.0 ** (np.arange(-60, 41) / 10)
ROUGHNESS_FACTORS = 10.0 ** (np.arange(-16, 17) / 16)
OF_RATE = "beyond the material's table, or elastic backing"


def follow_remaining(pair, materials, joints, frequencies):
    """Share that remains along factors on E* and on the heights, and along the rate.

    Limits are those that decide (`words.find_limits`), so that at a factor of 1 they are the
    pair's. U_full goes with E* and with the square of the heights: no spectrum is integrated again.
    With an elastic backing the modulus of the layer alone changes the response, which is withheld.
    """
    solids = list(materials.values())
    scalable = np.array([is_scalable(solid) for solid in solids])
    quoted = np.array([solid.modulus for solid in solids])
    by_factor = np.where(scalable, MODULUS_FACTORS[:, None] * quoted, np.nan)
    rates = np.transpose([np.atleast_1d(s.plane_strain.storage(frequencies)) for s in solids])
    by_rate = np.where(scalable, rates, np.nan)
    unchanged = np.broadcast_to(quoted, (len(ROUGHNESS_FACTORS), len(solids)))
    along = {
        "modulus_factor": ("modulus", by_factor, np.ones(len(by_factor))),
        "roughness_factor": ("roughness", unchanged, ROUGHNESS_FACTORS),
        "frequency": ("rate", by_rate, np.ones(len(by_rate))),
    }
    found = {}
    for dim, (name, moduli, heights) in along.items():
        share, low, high = follow(pair, solids, joints, dim, moduli, heights)
        found |= {f"remaining_by_{name}": share.transpose(*DIMS, dim)}
        found |= {
            f"remaining_by_{name}_{end}": limit.transpose(*DIMS[:2], dim)
            for end, limit in (("low", low), ("high", high))
        }
    return found | {
        "modulus_factor": ("modulus_factor", MODULUS_FACTORS),
        "roughness_factor": ("roughness_factor", ROUGHNESS_FACTORS),
    }


def follow(pair, solids, joints, dim, moduli, heights):
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
        deep_energy=pair.deep_energy * factor**2,
    )
    strain = np.array([[joint.layer_strain for joint in row] for row in joints])
    drawn = np.array(
        [
            [follow_draws(solid, joint.drawn, moduli[:, i], heights) for joint in joints[i]]
            for i, solid in enumerate(solids)
        ]
    )
    found = xr.Dataset(
        {f"remaining{end}": ((dim, *DIMS), at.remaining(sign)) for end, sign in LIMITS.items()}
        | {
            "remaining_quantile": ((*DIMS[:2], dim, "quantile"), drawn),
            "layer_strain": ((dim, *DIMS), strain * factor),
        }
    )
    return tuple(x.where(known) for x in (found.remaining, *find_limits(found)))


def follow_draws(solid, drawn, moduli, heights):
    """Quantiles of the share over the draws of a surface, ``(dim, quantile)``; NaN without."""
    if drawn is None:
        return np.full((len(moduli), len(QUANTILES)), np.nan)
    (moduli, heights), place = np.unique([moduli, heights], axis=1, return_inverse=True)
    factor = heights[:, None]
    deep = None if drawn.half_space_energy is None else drawn.half_space_energy * factor**2
    rough = replace(
        drawn,
        h_rms=drawn.h_rms * factor,
        elastic_energy=drawn.elastic_energy * factor**2,
        half_space_energy=deep,
    )
    length = solid.work_of_adhesion / moduli[:, None]
    shares = rough.share(length, solid.range, draw_signs(drawn))
    return np.quantile(shares, QUANTILES, axis=-1).T[place]
