"""Stickiness criteria: which contacts sustain tension, and below which modulus.

- `formulas`: the criteria, whose names are here, too
- `a_v_fit`: the prefactor a_V fitted to attractive areas
- `a_v_table`: a_V of Hurst exponent, load, range and magnification
- `moduli`: moduli that depend on the rate
- `errata`: errors of the manuscript, as data that recompute themselves
"""

from stickiness.criteria.formulas import *  # noqa: F403
from stickiness.criteria.formulas import __all__ as __all__
