"""Universal functions of Persson's contact theory, tabulated once per correction of the theory.

A correction slows the diffusion of pressure by a factor S(A) of the relative contact area A, and
makes the elastic energy of a scale A S(A) times that of full contact. With K = d(A S)/dA:

- T(y), twice the full-contact pressure variance over the mean pressure squared, at A = erf(y);
- F(x) = int_x^inf (dt/t) K(t) exp(-t^2), the inner integral of the mean gap;
- kappa(x) = x int_x^inf F(t)/t^2 dt, its average over the scales that contribute.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import erf, exp1

CorrectionName = Literal["yang2008", "wang2017", "xu2024"]

# Ends of the tables, and where their sums begin.
_X_LOW = 1e-11  # below, F is its logarithmic limit
_X_HIGH = 25.0  # above, exp(-x^2) < 1e-271
_X_START = 26.0  # what lies above is worth exp(-51) at _X_HIGH
_Y_LOW = 1e-11  # below, T is its power-law limit
_Y_HIGH = 6.5  # above, erf(y) = 1
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)


@dataclass(frozen=True)
class Correction(ABC):
    """How lost contact slows the diffusion of pressure and takes elastic energy from each scale."""

    gamma: float
    own_gamma: ClassVar[float] = 0.45  #: the source's
    lowest_gamma: ClassVar[float] = 0.0  #: not itself allowed

    @abstractmethod
    def diffusion(self, y: ArrayLike) -> NDArray:
        """S = dV_eff/dV at the area A = erf(y): gamma at A = 0, 1 in full contact."""

    @abstractmethod
    def energy(self, y: ArrayLike) -> NDArray:
        """K = d(A S)/dA at the area A = erf(y)."""


class Yang2008(Correction):
    """S = gamma + (1 - gamma) A^2, of Yang & Persson 2008 (doi:10.1088/0953-8984/20/21/215214).

    The theory of 2001 at gamma = 1. Sources take 0.42 to 0.5. Where 0.45 comes from is not
    verified (Almqvist et al. 2011, doi:10.1016/j.jmps.2011.08.004, and Afferrante et al. 2018,
    doi:10.1007/s11249-018-1026-x, use the correction); the code that Xu et al. published beside
    `Xu2024` has 0.42 as the default of this one.
    """

    def diffusion(self, y: ArrayLike) -> NDArray:
        return self.gamma + (1 - self.gamma) * erf(y) ** 2

    def energy(self, y: ArrayLike) -> NDArray:
        return self.gamma + 3 * (1 - self.gamma) * erf(y) ** 2


class Wang2017(Correction):
    """S = gamma - (2/9) A^2 + (11/9 - gamma) A^4, of Wang & Mueser 2017 (Tribol. Lett. 65:103).

    The source's gamma is 5/9. Below 0.0185 a scale's energy would fall with growing area.
    """

    own_gamma = 5 / 9
    lowest_gamma = 0.0185

    def diffusion(self, y: ArrayLike) -> NDArray:
        a2 = erf(y) ** 2
        return self.gamma + a2 * (-2 / 9 + (11 / 9 - self.gamma) * a2)

    def energy(self, y: ArrayLike) -> NDArray:
        a2 = erf(y) ** 2
        return self.gamma + a2 * (-2 / 3 + 5 * (11 / 9 - self.gamma) * a2)


class Xu2024(Correction):
    """A = erf(p/sqrt(2 g V)), g = gamma + (1 - gamma) A, of Xu et al. 2024.

    Xu, Zhu, Xiao & Zhou (doi:10.1007/s11249-024-01838-4) correct the variance itself,
    V_eff = g V, so that the area depends on the present scale only and T = 1/(y^2 g) in closed
    form. The factor of its growth follows: S = dV_eff/dV = g^2/(g + (y/2) dg/dy), which is
    gamma + (1 - gamma) A/2 for small A. Their energy int (A/q) dV_eff is the one A S stands for.
    That the mean gap follows from K as it does for Yang & Persson, with the area of the
    uncorrected theory in K, is this project's extension: the source gives areas, pressures and
    energies. It takes gamma = 0.45 for areas and pressures and 0.42 for energies.
    """

    def _parts(self, y: ArrayLike) -> tuple[NDArray, NDArray, NDArray]:
        """Return g, dg/dy and g + (y/2) dg/dy."""
        lacking = 1 - self.gamma
        g = self.gamma + lacking * erf(y)
        slope = lacking * 2 / np.sqrt(np.pi) * np.exp(-(y**2))
        return g, slope, g + 0.5 * y * slope

    def diffusion(self, y: ArrayLike) -> NDArray:
        g, _, below = self._parts(y)
        return g**2 / below

    def energy(self, y: ArrayLike) -> NDArray:
        g, slope, below = self._parts(y)
        # 2 below - g (3/2 - y^2), without the terms that cancel
        change = (0.5 + y**2) * g + y * slope
        return g**2 / below + erf(y) * (1 - self.gamma) * g * change / below**2


_KINDS: dict[str, type[Correction]] = {"yang2008": Yang2008, "wang2017": Wang2017, "xu2024": Xu2024}
CORRECTIONS = tuple(_KINDS)


def correction_of(name: CorrectionName, gamma: float | None = None) -> Correction:
    """Correction of that name with `gamma` in (0, 1], above 0.0185 for "wang2017".

    The source's gamma by default. ValueError if the name is unknown or gamma out of range.
    """
    if name not in _KINDS:
        raise ValueError(f"correction must be one of {CORRECTIONS}, got {name!r}")
    kind = _KINDS[name]
    gamma = kind.own_gamma if gamma is None else gamma
    if not kind.lowest_gamma < gamma <= 1:
        raise ValueError(f"gamma must be in ({kind.lowest_gamma:g}, 1] for {name}, got {gamma!r}")
    return kind(gamma)


class EvenTable:
    """Cubic Hermite interpolation between even steps: found by division, not by search.

    Beyond its ends the outermost cubics go on. Six times as fast as SciPy's splines.
    """

    def __init__(self, x: NDArray, value: NDArray, slope: NDArray):
        self._first = x[0]
        self._last = len(x) - 2
        self._step = (x[-1] - x[0]) / (len(x) - 1)
        rise = np.diff(value)
        slope_start = slope[:-1] * self._step
        slope_end = slope[1:] * self._step
        # Factors of the powers 3 to 0 of the distance in steps, a row for each step.
        cubic = slope_start + slope_end - 2 * rise
        square = 3 * rise - 2 * slope_start - slope_end
        self._rows = np.stack([cubic, square, slope_start, value[:-1]], axis=1)

    def __call__(self, x: NDArray) -> NDArray:
        """Return the values at `x`."""
        distance = (x - self._first) / self._step
        place = np.minimum(np.maximum(distance, 0.0).astype(np.intp), self._last)
        distance = distance - place
        rows = self._rows.take(place, axis=0)
        value = rows[..., 0] * distance
        for power in (1, 2):
            value += rows[..., power]
            value *= distance
        return value + rows[..., 3]


class Kernels:
    """The functions T, F and kappa for one correction; `kernels` keeps them."""

    def __init__(self, correction: Correction):
        self.correction = correction
        self._log_t = _area_table(correction)
        self._gap = _gap_table(correction)
        self._mean = _mean_table(self._gap)

    def area_scale(self, y: ArrayLike) -> NDArray:
        """T(y) = 2 int_y^inf dt / (t^3 diffusion(t)), which is 1/y^2 without a correction."""
        log_y = np.log(np.asarray(y, dtype=float))
        inside = np.clip(log_y, np.log(_Y_LOW), np.log(_Y_HIGH))
        return np.exp(self._log_t(inside) - 2 * (log_y - inside))

    def area_scale_step(self, y: ArrayLike, step: ArrayLike) -> NDArray:
        """T(y) - T(y + step) without cancellation for steps of any size."""
        y, step = np.broadcast_arrays(np.asarray(y, dtype=float), np.asarray(step, dtype=float))
        log_step = np.log1p(step / y)
        result = self.area_scale(y) - self.area_scale(y + step)
        # Eight nodes integrate over a quarter of a unit of ln y to rounding; beyond, the
        # difference loses less than a digit.
        small = log_step < 0.25
        half = 0.5 * log_step[small]
        t = y[small][:, None] * np.exp(half[:, None] * (1 + _NODES))
        result[small] = half * np.sum(_WEIGHTS * 2 / (t**2 * self.correction.diffusion(t)), axis=-1)
        return result

    def invert_area_scale(self, t: ArrayLike) -> NDArray:
        """Return y with T(y) = t, by Newton's method in the logarithms."""
        log_t = np.log(np.asarray(t, dtype=float))
        # 1/(gamma y^2) is T for small y and 1/y^2 for large y, and in between T is nearly that.
        log_y = -0.5 * log_t
        for _ in range(60):
            value = self.area_scale(np.exp(log_y))
            slope = -2 / (np.exp(2 * log_y) * self.correction.diffusion(np.exp(log_y)) * value)
            step = (np.log(value) - log_t) / slope
            log_y = log_y - step
            if np.all(np.abs(step) < 1e-14 * (1 + np.abs(log_y))):
                break
        return np.exp(log_y)

    def gap_kernel(self, x2: ArrayLike) -> NDArray:
        """Return exp(x^2) F(x) for x^2, with F(x) = int_x^inf (dt/t) K(t) exp(-t^2)."""
        return self._evaluate(self._gap, x2)

    def mean_kernel(self, x2: ArrayLike) -> NDArray:
        """Return exp(x^2) kappa(x) for x^2, with kappa(x) = x int_x^inf F(t)/t^2 dt."""
        return self._evaluate(self._mean, x2)

    def energy_kept(self, p: NDArray, m: NDArray) -> tuple[NDArray, NDArray]:
        """Energy A S of the scale m over that in full contact, and its mean over scales up to m."""
        x = np.clip(p / np.sqrt(m), 1e-150, 20.0)
        kept = erf(x) * self.correction.diffusion(x)
        weight = 2 / np.sqrt(np.pi) * x * np.exp(-(x**2))
        return kept, kept + weight * (self.gap_kernel(x**2) - self.mean_kernel(x**2))

    def _evaluate(self, table: EvenTable, x2: ArrayLike) -> NDArray:
        log_x = 0.5 * np.log(np.asarray(x2, dtype=float))
        inside = np.clip(log_x, np.log(_X_LOW), np.log(_X_HIGH))
        return table(inside) - np.minimum(log_x - inside, 0.0) * self.correction.gamma


@lru_cache(maxsize=128)
def kernels(gamma: float | None = None, correction: CorrectionName = "yang2008") -> Kernels:
    """Tabulate the universal functions; arguments and errors as in `correction_of`."""
    return Kernels(correction_of(correction, gamma))


def _panels(low: float, high: float) -> tuple[NDArray, NDArray, NDArray]:
    """Even logarithms, and Gauss-Legendre nodes and weights, `(panels, 8)`, between them."""
    # At steps of 0.005 Hermite interpolation errs by less than 1e-10.
    log_x = np.linspace(np.log(low), np.log(high), 1 + int(np.log(high / low) / 0.005))
    half = 0.5 * np.diff(log_x)[:, None]
    return log_x, log_x[:-1, None] + half * (1 + _NODES), half * _WEIGHTS


def _from_the_right(terms: NDArray, start: float = 0.0) -> NDArray:
    """Sum of the panels' integrals to the right of every edge, plus `start`."""
    return start + np.append(np.cumsum(np.sum(terms, axis=1)[::-1])[::-1], 0.0)


def _area_table(correction: Correction) -> EvenTable:
    """Ln T against ln y."""
    log_y, log_t, weights = _panels(_Y_LOW, _Y_HIGH)
    y = np.exp(log_y)
    t = np.exp(log_t)
    value = _from_the_right(weights * 2 / (t**2 * correction.diffusion(t)), _Y_HIGH**-2.0)
    slope = -2 / (y**2 * correction.diffusion(y) * value)
    return EvenTable(log_y, np.log(value), slope)


def _gap_table(correction: Correction) -> EvenTable:
    """exp(x^2) F(x) against ln x."""
    log_x, log_t, weights = _panels(_X_LOW, _X_START)
    x = np.exp(log_x)
    t = np.exp(log_t)
    # The gamma in K alone gives gamma E1(x^2)/2.
    rest = (correction.energy(t) - correction.gamma) * np.exp(-(t**2))
    value = 0.5 * correction.gamma * exp1(x**2) + _from_the_right(weights * rest)
    value *= np.exp(x**2)
    return EvenTable(log_x, value, 2 * x**2 * value - correction.energy(x))


def _mean_table(gap: EvenTable) -> EvenTable:
    """exp(x^2) kappa(x) against ln x, by integrating F."""
    log_x, log_t, weights = _panels(_X_LOW, _X_START)
    x = np.exp(log_x)
    value = _from_the_right(weights * gap(log_t) * np.exp(-np.exp(2 * log_t) - log_t))
    value *= x * np.exp(x**2)
    return EvenTable(log_x, value, value * (1 + 2 * x**2) - gap(log_x))
