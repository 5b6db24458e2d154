"""Length scales at the edge of an adhesive contact, and whether a grid resolves them.

Next to the edge of a contact the gap opens as ``u = C x^(3/2)``. Attraction of range epsilon and
adhesion length l_a acts over a zone of width ``d = (epsilon/C)^(2/3)``; it deforms the half-space
there by about ``l_a d/epsilon``, as much as its own range if d is ``epsilon^2/l_a``. On coarser
grids single points snap in and out of contact, and the edge does not show at all.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import plain, positive

# Pixels up to this share of epsilon^2/l_a count as fine enough. For the exponential law the mean
# pressure at a given gap then hardly changes with the grid any more. The traction of Maugis is
# another matter: its jump pins on the grid, and approach and separation differ by that much more.
COARSEST = 0.5
# Pixels across the zone of attraction below which an attraction is a statement about the grid.
NARROWEST = 1.5


def resolution(pixel: ArrayLike, range: ArrayLike, adhesion_length: ArrayLike) -> float | NDArray:
    """Pixel over the length epsilon^2/l_a at which attraction bends the surfaces together.

    All arguments [length], positive. The grid resolves the edge up to about `COARSEST`.
    """
    pixel, range, adhesion_length = positive(
        pixel=pixel, range=range, adhesion_length=adhesion_length
    )
    return plain(pixel * adhesion_length / range**2)


def zone_width(pixel: ArrayLike, edge_gap: ArrayLike, range: ArrayLike) -> float | NDArray:
    """Width of the zone of attraction at the edge of a contact without adhesion [length].

    `edge_gap` is the gap one pixel from the edge, see `dmt.edge_gap`. All arguments [length].
    """
    pixel, edge_gap, range = positive(pixel=pixel, edge_gap=edge_gap, range=range)
    return plain(pixel * np.cbrt(range / edge_gap) ** 2)
