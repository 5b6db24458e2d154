"""Bearing-area model: Gaussian heights within the range of the mean plane, and its pull-off."""

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.special import ndtr

from stickiness.core.arguments import positive

_GAUSS_NODES, _GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(8)


def bearing_area_pull_off(
    h_rms: float, q0: float, adhesion_length: float, range: float, repulsion: float = 1.0
) -> tuple[float, float]:
    """Minimum of the external pressure over the mean gap in the bearing-area model.

    Parameters as in `bearing_area`, scalars.

    Returns
    -------
    pressure : float
        Smallest p_rep - p_ad [E*] over gaps up to 8 h_rms beyond the range, negative if sticky.
    mean_gap : float
        Mean gap [length] where it is reached.
    """
    h, q0, adhesion_length, range, repulsion = (
        float(a)
        for a in positive(
            h_rms=h_rms, q0=q0, adhesion_length=adhesion_length, range=range, repulsion=repulsion
        )
    )
    relative = range / h

    def pressure(x: float) -> float:
        attraction = adhesion_length / range * bearing_fraction(x, relative)
        return repulsion * q0 * h * np.exp(-2 * x) - attraction

    # Below range/2 the attraction rises and the repulsion falls, so the minimum lies above. A
    # grid first: towards infinity the pressure vanishes from above and is a second trough.
    grid = relative / 2 + np.linspace(0, relative / 2 + 8, 400)
    best = int(np.argmin([pressure(x) for x in grid]))
    bounds = grid[max(best - 1, 0)], grid[min(best + 1, grid.size - 1)]
    found = minimize_scalar(pressure, bounds=bounds, method="bounded", options={"xatol": 1e-10})
    return float(found.fun), float(found.x * h)


def bearing_fraction(x: float, width: float) -> float:
    """Fraction of standard normal heights in (x - width, x), without cancellation."""
    if width > 0.5:
        return float(ndtr(width - x) - ndtr(-x))
    z = x - width / 2 * (1 - _GAUSS_NODES)
    density = np.exp(-(z**2) / 2) / np.sqrt(2 * np.pi)
    return float(width / 2 * np.sum(_GAUSS_WEIGHTS * density))


@np.vectorize
def log_maximum(width: float) -> float:
    """Maximum over x of 2 x + ln(fraction of normal heights in (x - width, x)).

    The fraction is log-concave, and the slope 2 - E[z | x - width < z < x] changes sign between
    x = 2 and x = 2 + width: one maximum, bracketed.
    """
    found = minimize_scalar(
        lambda x: -2 * x - np.log(bearing_fraction(x, width)),
        bounds=(2.0, 2.0 + width),
        method="bounded",
        options={"xatol": 1e-9},
    )
    return -float(found.fun)
