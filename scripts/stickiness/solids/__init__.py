"""Elastic solids that a rough surface presses on: half-space, layer of finite thickness, or skin.

- `layers`: compliance of all, wave by wave
- `moduli`: moduli that depend on the rate
"""

from stickiness.solids.layers import HALF_SPACE, Film, HalfSpace, Layer, Skin, Solid, check_solid
from stickiness.solids.moduli import Prony, Table

__all__ = [
    "HALF_SPACE",
    "Film",
    "HalfSpace",
    "Layer",
    "Prony",
    "Skin",
    "Solid",
    "Table",
    "check_solid",
]
