"""Whether a grid resolves the attraction at the edge of an adhesive contact.

Next to the edge of a contact the gap opens as ``u = C x^(3/2)``. Attraction of range epsilon and
adhesion length l_a acts over a zone of width ``d = (epsilon/C)^(2/3)``; it deforms the half-space
there by about ``l_a d/epsilon``, as much as its own range if d is ``epsilon^2/l_a``. On coarser
grids single points snap in and out of contact, and the edge does not show at all.
"""

import numpy as np

from stickiness.arguments import positive

# Pixels up to this share of epsilon^2/l_a count as fine enough. For the exponential law the mean
# pressure at a given gap then hardly changes with the grid any more. The traction of Maugis is
# another matter: its jump pins on the grid, and approach and separation differ by that much more.
COARSEST = 0.5


def resolution(pixel: float, range: float, adhesion_length: float) -> float:
    """Pixel over epsilon^2/l_a, all in one unit; the grid resolves the edge up to `COARSEST`."""
    positive(pixel=pixel, range=range, adhesion_length=adhesion_length)
    return pixel * adhesion_length / np.square(range)


def is_lost(resolution: float, strength: float) -> bool:
    """Whether the grid alone, and not the attraction, sets the edges of contact.

    `strength` of the law over the rms pressure that flattens the surface. At a `resolution` of 4,
    8, 16, 32 and 64 the grid keeps 0.85, 0.65, 0.5, 0.3 and 0.2 of what adhesion takes from the
    load. Below the root of resolution/20 that is 1.5 % of the load at most, but from 30 on points
    stick wherever a descent leaves them. All measured at a given mean gap.
    """
    return resolution > 50 and strength > min(30, np.sqrt(resolution / 20))
