"""Numbers behind the errata of the manuscript (`report/errata.j2`), by number and name.

"Printed" are formulas of Violano, Afferrante, Papangelo & Ciavarella, J. Adhesion (2019),
doi:10.1080/00218464.2019.1685384.
"""

import numpy as np
from scipy.integrate import quad

from common.paper import A_V, ASPHALT, CRYSTAL, RANGE, WORK_OF_ADHESION
from stickiness.criteria import formulas


def recompute():
    """Numbers that the statements quote or compare, by the number of the erratum."""
    # 3/2 of the value that the paper finds is the right coefficient.
    a_v = {"printed": formulas.PRINTED_A_V, "derived": A_V}
    second = {f"coefficient_{name}": 1.5 * value for name, value in a_v.items()}
    q0 = ASPHALT["q0"]
    hurst = ASPHALT["hurst"]
    h_rms = np.sqrt(np.pi * ASPHALT["C0"] / hurst) * q0**-hurst
    for name, value in a_v.items():
        for exponent in (6, 9, 12):
            limit = formulas.h_rms_threshold(10.0**-exponent, CRYSTAL, 1.0, value)
            second[f"h_over_range_limit_{name}_1e-{exponent}"] = limit
        threshold = formulas.modulus_threshold(h_rms, q0, WORK_OF_ADHESION, RANGE, value)
        second[f"asphalt_modulus_Pa_{name}"] = threshold
    # Edge in units u = x^(3/2): the strip up to gap u is x = u^(2/3) wide, so that its density is
    # f u^(-1/3) with f the integral of u^(1/3) (dx/du) du over a unit of gap.
    edge = quad(lambda u: u ** (1 / 3) * (2 / 3) * u ** (-1 / 3), 0, 1)[0]
    printed = (4 / 9) ** (1 / 3)
    sixth = {}
    for name, ratio in {"exact": formulas.CRYSTAL_RANGE_RATIO, "1.1": 1.1, "1": 1.0}.items():
        sixth[f"prefactor_ratio_{name}"] = formulas.pastewka_robbins_a_v(1, 1, 1, 1, ratio)
        # At zeta = 1 the power zeta^((5H - 3)/3) is 1 and the broad-band form is its prefactor.
        power_law = formulas.pastewka_robbins_a_v_power_law(0.8, 1.0, ratio)
        sixth[f"power_law_ratio_{name}"] = power_law
    return {
        # Dimension in lengths of (l_a)^k h_rms^(3/2) R^(-1/2).
        "1": {f"length_exponent_{n}": k + 1.0 for n, k in (("printed", 1), ("correct", -1))},
        "2": second,
        "3": {
            "edge_factor_printed": printed,
            "edge_factor_correct": edge,
            "beta_exponent_printed": -8 / 3,
            "beta_exponent_correct": 2 - 2 / 3,  # perimeter ~ B^2, strip ~ C^(-2/3), B, C ~ beta
            "printed_over_correct_at_beta_1": 1.5 * printed / edge,
        },
        # Powers of pressure in (B^2/2) p sqrt(2/(pi V^k)), V a variance of pressure; a length of
        # edge per area has none.
        "4": {f"pressure_exponent_{n}": 3 - k for n, k in (("printed", 1.5), ("correct", 3.0))},
        "5": {
            "h_over_range_limit_1e-12": formulas.h_rms_threshold(
                1e-12, CRYSTAL, 1.0, a_v["printed"]
            )
        },
        "6": sixth,
    }
