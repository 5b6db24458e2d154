"""Integrals over the band of a spectrum that have no closed form: roughness on a layer."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from stickiness.spectrum.interface import Spectrum
from stickiness.spectrum.kinds import Shells

# Of Gauss quadrature on panels in ln q. What layers make of a wave has its nearest singularity
# about one unit of ln q off the real axis: such panels err by less than 1e-13.
_ORDER, _WIDEST = 12, 0.7


def integrate_band(
    spectrum: Spectrum, function: Callable[[NDArray], NDArray], low: float, high: float
) -> float:
    """Return 2 pi * integral from `low` to `high` of q f(q) C(q) dq for a smooth f.

    That is the mean of f over the waves in between, a shell at `high` counted, times their height
    variance.
    """
    if isinstance(spectrum, Shells):
        inside = (spectrum.q >= low) & (spectrum.q <= high)
        q = spectrum.q[inside]
        return float(np.sum(spectrum.variance[inside] * function(q)))
    low, high = max(low, spectrum.q0), min(high, spectrum.q1)
    if not high > low:
        return 0.0
    kinks = getattr(spectrum, "knots", np.empty(0))
    knots = np.concatenate([[low], kinks[(kinks > low) & (kinks < high)], [high]])
    x, w = np.polynomial.legendre.leggauss(_ORDER)
    parts = np.ceil(np.diff(np.log(knots)) / _WIDEST).astype(int)
    start = np.concatenate([[0], np.cumsum(parts)])
    edges = np.interp(np.arange(start[-1] + 1), start, np.log(knots))
    half = 0.5 * np.diff(edges)[:, None]
    q = np.exp(edges[:-1, None] + half * (1 + x))
    return float(2 * np.pi * np.sum(half * w * q**2 * spectrum.psd(q) * function(q)))
