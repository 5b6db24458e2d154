"""Adhesion in the DMT limit, from the gaps of a repulsive solution, and the fit of a_V to it."""

from stickiness.adhesive.dmt import adhesive_pressure, attraction_of_areas
from stickiness.criteria.a_v_fit import AvFit, fit_a_v, local_exponent
from stickiness.repulsive.gaps import attractive_area, gap_density
from stickiness.repulsive.subpixel import STRIP_WIDTH, boundary_strip, edge_gap

__all__ = [
    "STRIP_WIDTH",
    "AvFit",
    "adhesive_pressure",
    "attraction_of_areas",
    "attractive_area",
    "boundary_strip",
    "edge_gap",
    "fit_a_v",
    "gap_density",
    "local_exponent",
]
