"""Whittle's likelihood of power laws, with weights limited by the misfit.

`self_affine_fit` says why, and puts the parts together.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy import optimize

from stickiness.measured.psd import RadialPSD, merge_rings, wide_rings

COARSE = 10  #: rings per decade for the misfit

_ALTERNATIONS = 20
_SLOPES = (-1e3, 1e3)  # bracket of the exponent s in C ~ q^-s; wide, plateaus are tried anywhere


def fit_power_law(x: NDArray, rings: RadialPSD) -> tuple[float, float]:
    """Maximise the likelihood of ln C = a - s x: (a, s). The likelihood has one maximum."""
    weight = rings.dof / rings.dof.sum()
    centre = float(weight @ x)
    log_psd = np.log(rings.psd)

    def moments(s: float) -> tuple[float, float]:
        exponent = log_psd + s * (x - centre)
        level = exponent.max()
        share = weight * np.exp(exponent - level)
        return float(np.log(share.sum()) + level), float(share @ (x - centre) / share.sum())

    s = optimize.brentq(lambda s: moments(s)[1], *_SLOPES, xtol=1e-12)
    return moments(s)[0] + s * centre, s


def rolloff_room(x: NDArray, rings: RadialPSD) -> tuple[float, float] | None:
    """Interval in which a plateau may end: above four modes, a tenth of a decade below the top."""
    inside = x[(np.cumsum(rings.dof) > 4) & (x < x[-1] - np.log(10) / 10)]
    return (float(inside[0]), float(inside[-1])) if len(inside) > 1 else None


def fit_rolloff(
    room: tuple[float, float], x: NDArray, rings: RadialPSD
) -> tuple[float, float, float]:
    """Maximise the likelihood of ln C = a - s max(x, c), c within `room`: (a, s, c)."""

    def cost(c: float) -> float:
        return deviance(x, rings, *fit_power_law(np.maximum(x, c), rings), c)

    # The likelihood has kinks and several maxima in c: scan, then refine.
    grid = np.linspace(*room, 40)
    best = int(np.argmin([cost(c) for c in grid]))
    bounds = grid[max(best - 1, 0)], grid[min(best + 1, len(grid) - 1)]
    c = float(optimize.minimize_scalar(cost, bounds=bounds, method="bounded").x)
    return *fit_power_law(np.maximum(x, c), rings), c


def weighted_fit(fit: Callable, x: NDArray, rings: RadialPSD) -> tuple[tuple[float, ...], float]:
    """Alternate between fitting with limited weights and the misfit that limits them."""
    misfit = 0.0
    parameters = fit(x, rings)
    for _ in range(_ALTERNATIONS):
        new = rms_misfit(rings, power_law(x, *parameters), len(parameters))
        if abs(new - misfit) <= 0.01 * new:  # far below the error of the misfit
            return parameters, new
        misfit = new
        parameters = fit(x, limit_weight(rings, misfit))
    return parameters, misfit


def rms_misfit(rings: RadialPSD, model: NDArray, parameters: int) -> float:
    """Return tau for which wide rings scatter as var(mean/C) = 1/dof + tau^2."""
    _, ratio, dof = merge_rings(rings, rings.psd / model, COARSE)
    square = (ratio - 1) ** 2

    def excess(variance: float) -> float:
        return float(np.sum(square / (1 / dof + variance))) - (len(ratio) - parameters)

    if excess(0.0) <= 0:
        return 0.0
    highest = float(square.sum())  # there every term is below 1, and their sum below 1
    return float(np.sqrt(optimize.brentq(excess, 0.0, highest)))


def limit_weight(rings: RadialPSD, misfit: float) -> RadialPSD:
    """Return narrow rings that count nu/(1 + nu tau^2), nu of the wide ring they belong to."""
    index = wide_rings(rings, COARSE)
    wide = np.bincount(index, weights=rings.dof)[index]
    return replace(rings, dof=rings.dof / (1 + wide * misfit**2))


def power_law(x: NDArray, a: float, s: float, c: float = -np.inf) -> NDArray:
    """C at ln q = x: exp(a - s x), and constant below x = c."""
    return np.exp(a - s * np.maximum(x, c))


def deviance(x: NDArray, rings: RadialPSD, a: float, s: float, c: float = -np.inf) -> float:
    """Negative logarithm of the likelihood, up to a constant."""
    ratio = rings.psd / power_law(x, a, s, c)
    return float(rings.dof @ (ratio - np.log(ratio)))


def dispersion(rings: RadialPSD, model: NDArray, parameters: int) -> float:
    """Pearson's chi-square of ring means (variance 1/dof for a Gamma law) per degree of freedom."""
    _, ratio, dof = merge_rings(rings, rings.psd / model, COARSE)
    return float(np.sum(dof * (ratio - 1) ** 2) / (len(ratio) - parameters))
