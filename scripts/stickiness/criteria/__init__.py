"""Stickiness criteria: which contacts sustain tension, and below which modulus.

- `formulas`: the criteria, whose names are also here
- `equivalent_sphere`: attraction by the edges of contact, from weak to tough
- `pair`: a material on a surface, as all criteria see it, and every quantity of it
- `registry`: every criterion with its threshold, reason and line in figures, in one table
- `a_v_fit`: the prefactor a_V fitted to attractive areas
- `a_v_theory`: a_V from Persson's theory: of a spectrum, and tabulated for self-affine surfaces
"""

from stickiness.criteria import formulas
from stickiness.criteria.formulas import *  # noqa: F403

__all__ = [*formulas.__all__]
