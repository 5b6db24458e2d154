"""Elastic solids that a rough surface presses on: half-space, or layer of finite thickness.

- `layers`: compliance of both, wave by wave
- `moduli`: moduli that depend on the rate
"""

from stickiness.solids.layers import HALF_SPACE, Film, HalfSpace, Layer, Solid, check_solid
from stickiness.solids.moduli import Prony, Table

__all__ = ["HALF_SPACE", "Film", "HalfSpace", "Layer", "Prony", "Solid", "Table", "check_solid"]
