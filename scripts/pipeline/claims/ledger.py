"""The paper's claims in the order of the ledger.

Each is a function that takes the files of the ledger as datasets by name and returns a `Claim`;
none knows a number that it could have read from a file.
"""

from __future__ import annotations

from collections.abc import Callable

from pipeline.claims import adhesion, contact, criterion
from pipeline.claims.claim import Claim, Files

CLAIMS: tuple[Callable[[Files], Claim], ...] = (
    contact.area_slope,
    contact.density_converges,
    contact.small_gap_exponent,
    contact.load_separation,
    adhesion.kappa_threshold,
    contact.area_against_range,
    contact.area_against_load,
    contact.a_v_against_magnification,
    contact.a_v_against_load,
    adhesion.hysteresis,
    adhesion.inverse_kappa_ad,
    criterion.slope_angle,
    criterion.roughness_limits,
    criterion.real_surfaces,
    criterion.polished_steel,
    criterion.crystal_strength,
    criterion.pastewka_robbins,
    criterion.spectral_moments,
)
