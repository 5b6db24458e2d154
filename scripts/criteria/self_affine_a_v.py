"""a_V of self-affine surfaces without a roll-off, by Persson's theory."""

from functools import cache

import numpy as np

from stickiness.criteria.a_v_theory import SurfaceAv, surface_a_v
from stickiness.spectrum.kinds import SelfAffine


def find_a_v(hurst, load, range_over_h_rms, magnification):
    """Value, low and high limit of a_V, ``(3, …)``; range and magnification are arrays alike.

    The load is over E* q0 h_rms.
    """
    ranges, magnifications = np.broadcast_arrays(range_over_h_rms, magnification)
    found = np.empty((3, *ranges.shape))
    for zeta in np.unique(magnifications):
        chosen = magnifications == zeta
        found[:, chosen] = _make(hurst, load, float(zeta)).at(ranges[chosen])
    return found


@cache
def _make(hurst: float, load: float, magnification: float) -> SurfaceAv:
    spectrum = SelfAffine(hurst=hurst, q0=1.0, q1=magnification, h_rms=1.0)
    known = {
        "q0": 1.0,
        "h_rms": 1.0,
        "rms_slope": spectrum.rms_slope,
        "rms_curvature": spectrum.rms_curvature,
    }
    return surface_a_v(spectrum, known, load)
