"""Universal functions of Persson's contact theory, tabulated once per correction factor gamma.

Nothing here depends on a surface or a load. With the elastic energy corrected by
gamma + (1 - gamma) P^2 (Yang & Persson 2008, doi:10.1088/0953-8984/20/21/215214) the theory
needs three functions:

- T(y), twice the full-contact pressure variance over the mean pressure squared, at which the
  relative contact area has shrunk to erf(y);
- F(x), the inner integral of the mean gap;
- kappa(x) = x int_x^inf F(t)/t^2 dt, its average over the scales that contribute.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicHermiteSpline
from scipy.special import erf, exp1

_STEP = 0.005  # of the tables in ln x: Hermite interpolation then errs by less than 1e-9
_X_LOW, _X_HIGH = 1e-9, 25.0  # below, F is its logarithmic limit; above, exp(-x^2) < 1e-271
_Y_LOW, _Y_HIGH = 1e-6, 6.5  # below, T is its power-law limit; above, erf(y) = 1
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)


@dataclass(frozen=True)
class Kernels:
    """The functions T, F and kappa for one gamma. Made by `kernels`.

    Attributes
    ----------
    gamma : float
        Correction factor, 0 < gamma <= 1; 1 is the uncorrected theory.
    """

    gamma: float
    _log_t: CubicHermiteSpline
    _gap: CubicHermiteSpline
    _mean: CubicHermiteSpline

    def diffusion(self, y: ArrayLike) -> NDArray:
        """Correction gamma + (1 - gamma) A^2 of pressure diffusion at the area A = erf(y)."""
        return self.gamma + (1 - self.gamma) * erf(y) ** 2

    def area_scale(self, y: ArrayLike) -> NDArray:
        """T(y) = 2 int_y^inf dt / (t^3 diffusion(t)), which is 1/y^2 for gamma = 1."""
        log_y = np.log(np.asarray(y, dtype=float))
        low, high = np.log(_Y_LOW), np.log(_Y_HIGH)
        inside = np.clip(log_y, low, high)
        return np.exp(self._log_t(inside) - 2 * (log_y - inside))

    def area_scale_step(self, y: ArrayLike, step: ArrayLike) -> NDArray:
        """T(y) - T(y + step) without cancellation for steps of any size."""
        y, step = np.broadcast_arrays(np.asarray(y, dtype=float), np.asarray(step, dtype=float))
        log_step = np.log1p(step / y)
        t = y[..., None] * np.exp(0.5 * log_step[..., None] * (1 + _NODES))
        near = 0.5 * log_step * np.sum(_WEIGHTS * 2 / (t**2 * self.diffusion(t)), axis=-1)
        # Eight nodes integrate over a quarter of a unit of ln y to rounding; beyond, the
        # difference loses less than a digit.
        return np.where(log_step < 0.25, near, self.area_scale(y) - self.area_scale(y + step))

    def invert_area_scale(self, t: ArrayLike) -> NDArray:
        """Return y with T(y) = t, by Newton's method in the logarithms."""
        log_t = np.log(np.asarray(t, dtype=float))
        # T lies between 1/y^2 and 1/(gamma y^2) and d ln T/d ln y between -2 and -2 gamma.
        log_y = -0.5 * log_t
        for _ in range(60):
            value = self.area_scale(np.exp(log_y))
            slope = -2 / (np.exp(2 * log_y) * self.diffusion(np.exp(log_y)) * value)
            step = (np.log(value) - log_t) / slope
            log_y = log_y - step
            if np.all(np.abs(step) < 1e-14 * (1 + np.abs(log_y))):
                break
        return np.exp(log_y)

    def gap_kernel(self, x2: ArrayLike) -> NDArray:
        """Return exp(x^2) F(x) for x^2.

        F(x) = int_x^inf (dt/t) [gamma + 3 (1 - gamma) erf^2(t)] exp(-t^2).
        """
        return self._evaluate(self._gap, x2)

    def mean_kernel(self, x2: ArrayLike) -> NDArray:
        """Return exp(x^2) kappa(x) for x^2, with kappa(x) = x int_x^inf F(t)/t^2 dt."""
        return self._evaluate(self._mean, x2)

    def _evaluate(self, table: CubicHermiteSpline, x2: ArrayLike) -> NDArray:
        log_x = 0.5 * np.log(np.asarray(x2, dtype=float))
        inside = np.clip(log_x, np.log(_X_LOW), np.log(_X_HIGH))
        return table(inside) - self.gamma * np.minimum(log_x - inside, 0.0)


@lru_cache(maxsize=16)
def kernels(gamma: float) -> Kernels:
    """Tabulate the universal functions for one correction factor.

    Parameters
    ----------
    gamma : float
        0 < gamma <= 1.

    Raises
    ------
    ValueError
        If gamma is out of range.
    """
    if not 0 < gamma <= 1:
        raise ValueError(f"gamma must be in (0, 1], got {gamma!r}")
    gap = _gap_table(gamma)
    return Kernels(gamma, _area_table(gamma), gap, _mean_table(gap))


def _panels(edges: NDArray) -> tuple[NDArray, NDArray]:
    """Gauss-Legendre nodes and weights, `(panels, 8)`, between consecutive edges."""
    half = 0.5 * np.diff(edges)[:, None]
    return edges[:-1, None] + half * (1 + _NODES), half * _WEIGHTS


def _from_the_right(integrals: NDArray, start: float) -> NDArray:
    """Sum of the panels' integrals to the right of every edge, plus `start`."""
    return start + np.append(np.cumsum(integrals[::-1])[::-1], 0.0)


def _area_table(gamma: float) -> CubicHermiteSpline:
    """Ln T against ln y."""
    log_y = np.linspace(np.log(_Y_LOW), np.log(_Y_HIGH), 1 + int(np.log(_Y_HIGH / _Y_LOW) / _STEP))
    t, weights = _panels(log_y)
    t = np.exp(t)
    diffusion = gamma + (1 - gamma) * erf(t) ** 2
    value = _from_the_right(np.sum(weights * 2 / (t**2 * diffusion), axis=1), _Y_HIGH**-2.0)
    y = np.exp(log_y)
    slope = -2 / (y**2 * (gamma + (1 - gamma) * erf(y) ** 2) * value)
    return CubicHermiteSpline(log_y, np.log(value), slope)


def _gap_table(gamma: float) -> CubicHermiteSpline:
    """exp(x^2) F(x) against ln x."""
    log_x = np.linspace(np.log(_X_LOW), np.log(_X_HIGH), 1 + int(np.log(_X_HIGH / _X_LOW) / _STEP))
    t, weights = _panels(log_x)
    t = np.exp(t)
    # Without erf^2 the integral is E1(x^2)/2; what erf^2 takes away from it vanishes above x = 6.
    corrected = _from_the_right(
        np.sum(weights * erf(t) ** 2 * np.exp(-(t**2)), axis=1), 0.5 * exp1(_X_HIGH**2)
    )
    x2 = np.exp(2 * log_x)
    value = np.exp(x2) * (0.5 * gamma * exp1(x2) + 3 * (1 - gamma) * corrected)
    slope = 2 * x2 * value - (gamma + 3 * (1 - gamma) * erf(np.sqrt(x2)) ** 2)
    return CubicHermiteSpline(log_x, value, slope)


def _mean_table(gap: CubicHermiteSpline) -> CubicHermiteSpline:
    """exp(x^2) kappa(x) against ln x, by integrating F."""
    # A start one and a half units above the last node is worth exp(-77) there.
    above = np.log(_X_HIGH) + _STEP * np.arange(1, 13)
    log_x = np.append(gap.x, above)
    t, weights = _panels(log_x)
    x = np.exp(log_x)
    inside = np.minimum(t, gap.x[-1])
    # Above the table exp(x^2) F falls as 1/x^2.
    scaled = gap(inside) * np.exp(2 * (inside - t))
    integral = _from_the_right(np.sum(weights * scaled * np.exp(-np.exp(2 * t) - t), axis=1), 0.0)
    value = x * np.exp(x**2) * integral
    keep = slice(0, len(gap.x))
    slope = value[keep] * (1 + 2 * x[keep] ** 2) - gap(log_x[keep])
    return CubicHermiteSpline(log_x[keep], value[keep], slope)
