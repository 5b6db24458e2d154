"""Stickiness criteria: which contacts sustain tension, and below which modulus.

- `formulas`: the criteria, whose names are here, too
- `a_v_fit`: the prefactor a_V fitted to attractive areas
- `a_v_table`: a_V of Hurst exponent, load, range and magnification
- `moduli`: moduli that depend on the rate
- `errata`: errors of the manuscript, as data that recompute themselves
"""

from stickiness.criteria.formulas import (
    CRYSTAL_RANGE_RATIO,
    DAHLQUIST_LIMIT,
    PR_CONSTANT,
    PRINTED_A_V,
    DmtValidity,
    Verdict,
    bearing_area,
    bearing_area_pull_off,
    dahlquist,
    dmt_validity,
    fuller_tabor,
    h_rms_limit,
    inverse_kappa,
    inverse_kappa_ad,
    jtb_limit,
    kappa,
    modulus_threshold,
    nayak_summit_radius,
    pastewka_robbins,
    pastewka_robbins_a_v,
    pastewka_robbins_a_v_power_law,
    pastewka_robbins_range,
    persson_tosatti,
    slope_angle,
    traction_ratio,
    violano,
    violano_c0_limit,
    violano_printed,
)

__all__ = [
    "CRYSTAL_RANGE_RATIO",
    "DAHLQUIST_LIMIT",
    "PRINTED_A_V",
    "PR_CONSTANT",
    "DmtValidity",
    "Verdict",
    "bearing_area",
    "bearing_area_pull_off",
    "dahlquist",
    "dmt_validity",
    "fuller_tabor",
    "h_rms_limit",
    "inverse_kappa",
    "inverse_kappa_ad",
    "jtb_limit",
    "kappa",
    "modulus_threshold",
    "nayak_summit_radius",
    "pastewka_robbins",
    "pastewka_robbins_a_v",
    "pastewka_robbins_a_v_power_law",
    "pastewka_robbins_range",
    "persson_tosatti",
    "slope_angle",
    "traction_ratio",
    "violano",
    "violano_c0_limit",
    "violano_printed",
]
