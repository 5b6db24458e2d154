"""Persson's theory of contact: area, mean gap and distribution of gaps of a spectrum.

- `theory`: the class `Persson`
- `gaps`: gaps that open where contact is lost, scale by scale, and their distribution
- `kernels`: universal functions, tabulated once
- `scale_quadrature`: quadrature over the scales
- `layered_scales`: the same on a layer of finite thickness
"""

from stickiness.persson.theory import Persson

__all__ = ["Persson"]
