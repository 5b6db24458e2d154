"""Persson's theory of contact: area, mean gap and distribution of gaps of a spectrum.

- `theory`: the class `Persson`
- `gaps`: distribution of gaps, from where contact is lost scale by scale
- `lost_contact`: the gap that opens where contact is lost
- `kernels`: universal functions, tabulated once
- `scale_quadrature`: quadrature over the scales
- `layered_scales`: the same on a layer of finite thickness
"""

from stickiness.persson.theory import Persson

__all__ = ["Persson"]
