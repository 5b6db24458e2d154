"""Columns that several campaigns have, and the side of their topographies."""

import numpy as np

from common.conventions import Q0

OF_SET = {
    "set": "as in the configuration of the campaign",
    "role": "fitted: constants of the theory may have been fitted to these rows; unseen: none were",
}
SEED = {"seed": "of the realisation"}
#: Columns of synthetic topographies.
OF_TOPOGRAPHY = {
    **OF_SET,
    "family": "of topographies",
    "hurst": "Hurst exponent, if not that of the family",
    "points": "of the grid, along a side",
    "waves": "longest waves, or features, along a side",
    "shortest": "shortest wave in pixels",
    **SEED,
}
#: Columns of model surfaces, which are Gaussian.
OF_MODEL_SURFACE = {
    **OF_SET,
    "hurst": "Hurst exponent",
    "magnification": "longest wave over the shortest",
    "window": "longest waves along a side",
    "points": "of the grid, along a side",
    **SEED,
}


def find_side(setting):
    """Side of a synthetic topography, in units of 1/q0."""
    return setting["waves"] * 2 * np.pi / Q0
