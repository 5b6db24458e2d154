"""Hurst exponent and prefactor of a measured spectrum, by Whittle's likelihood.

The mean of nu independent modes of the periodogram of a Gaussian surface has a Gamma distribution
of shape nu. Least squares on its logarithm are biased by digamma(nu) - ln(nu); the likelihood -sum
nu (ln C + I/C) (Whittle 1953, doi:10.1007/BF02590998) is not. So that the many modes at high q do
not determine the exponent alone, a ring has the weight nu/(1 + nu tau^2), with tau the rms misfit
beyond sampling, by the scatter of the rings (Paule & Mandel 1982, doi:10.6028/jres.087.022).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray
from scipy import special

from stickiness.measured.psd import RadialPSD, merge_rings, wide_rings

FINE = 200  #: narrow rings per decade: C varies by 4 % across one, its mean by 7e-5
ROLLOFF_AIC = 10.0  #: gain in AIC below which the simpler model is kept
COARSE = 10  #: rings per decade for the misfit
# A ring is empty below this share of the sum of C over all modes, the mean square of the heights.
# Levelled heights keep the rounding of those as read, in which an offset or a tilt may exceed the
# roughness a thousandfold: no mode can gather more of it than (1000 * 2e-16)^2.
_ROUNDING = 1e-24


class PowerLaw(NamedTuple):
    """ln C = level - exponent x of x = ln q, and constant below a corner."""

    level: float
    exponent: float
    corner: float = -np.inf  #: none

    @property
    def parameters(self) -> int:
        """Number of the parameters."""
        return 3 if self.is_bent else 2

    @property
    def is_bent(self) -> bool:
        """Whether it has a corner."""
        return self.corner > -np.inf

    def at(self, x: NDArray) -> NDArray:
        """C at ln q = x."""
        return np.exp(self.level - self.exponent * np.maximum(x, self.corner))


@dataclass(frozen=True)
class SelfAffineFit:
    """Power law C = C0 q^(-2(H+1)) fitted to a spectrum, with a plateau below `q_rolloff`."""

    hurst: float  #: as fitted; it may be outside 0 < H <= 1
    c0: float  #: [length^(2 - 2H)], so that its unit depends on H
    log_covariance: NDArray  #: of ln c0, hurst and, with a plateau, ln q_rolloff
    q_min: float  #: lowest and highest wave number used [1/length]
    q_max: float
    q_rolloff: float | None  #: end of the plateau [1/length]; None if the data show none
    misfit: float  #: relative rms departure from the fit beyond sampling noise
    rings: RadialPSD  #: narrow ones, that the fit used

    @property
    def hurst_se(self) -> float:
        """Standard error of `hurst`."""
        return float(np.sqrt(self.log_covariance[1, 1]))

    @property
    def c0_se(self) -> float:
        """Standard error of `c0`."""
        return self.c0 * float(np.sqrt(self.log_covariance[0, 0]))

    @property
    def q_rolloff_se(self) -> float:
        """Standard error of `q_rolloff`, if there is one [1/length]."""
        return self.q_rolloff * float(np.sqrt(self.log_covariance[2, 2]))

    @property
    def fall(self) -> float:
        """Exponent s of C ~ q^-s beyond the plateau."""
        return 2 * (self.hurst + 1)

    @property
    def is_self_affine(self) -> bool:
        """Whether 0 < H <= 1, as a self-affine surface needs."""
        return 0 < self.hurst <= 1

    def psd(self, q: ArrayLike) -> NDArray:
        """Fitted C(q) [length^4], at any `q` [1/length]."""
        q = np.asarray(q, dtype=float)
        return self.c0 * np.maximum(q, self.q_rolloff or 0.0) ** (-2 * (self.hurst + 1))

    def log_psd_se(self, q: ArrayLike) -> NDArray:
        """Standard error of the logarithm of the fitted C(q), at any `q` [1/length] (m,)."""
        q = np.asarray(q, dtype=float)
        corner = self.q_rolloff or 0.0
        gradient = [np.ones_like(q), -2 * np.log(np.maximum(q, corner))]
        if corner:
            gradient.append(np.where(q < corner, -2 * (self.hurst + 1), 0.0))
        return np.sqrt(np.einsum("im,ij,jm->m", gradient, self.log_covariance, gradient))

    def c0_at_hurst(self, hurst: float) -> tuple[float, float, float]:
        """C0 at an imposed exponent, its standard error, and the largest C q^(2(H+1)) of a ring."""
        level = self.rings.psd * self.rings.q ** (2 * (hurst + 1))
        q, mean, dof = merge_rings(self.rings, level, COARSE)
        # Least squares above `q_rolloff`, less the bias of the logarithm.
        logs = (np.log(mean) - special.digamma(dof) + np.log(dof))[q >= (self.q_rolloff or 0.0)]
        scatter = np.std(logs, ddof=1) if len(logs) > 1 else np.nan
        c0 = float(np.exp(logs.mean()))
        return c0, c0 * float(scatter / np.sqrt(len(logs))), float(mean.max())


def fit_rings(
    rings: RadialPSD, q_min: float, q_max: float, rolloff: bool | None = None, demand: bool = True
) -> SelfAffineFit:
    """Fit a self-affine spectrum to narrow rings; AIC decides on a plateau if `rolloff` is None.

    Without `demand` two rings are enough, and empty ones, which rounding may fill, are left out.
    """
    if not 0 < q_min < q_max:
        raise ValueError(f"need 0 < q_min < q_max, got q_min = {q_min:.6g}, q_max = {q_max:.6g}")
    rounding = _ROUNDING * float(rings.dof @ rings.psd)
    # The slack keeps modes exactly on a limit, whatever the rounding of |q|.
    rings = rings.between(q_min * (1 - 1e-9), q_max * (1 + 1e-9))
    if not demand:
        has_power = rings.psd > rounding
        rings = RadialPSD(rings.q[has_power], rings.psd[has_power], rings.dof[has_power])
    wide = len(merge_rings(rings, rings.psd, COARSE)[0]) if len(rings) else 0
    if len(rings) < 2 or (demand and (wide < 5 or rings.dof.sum() < 20)):
        raise ValueError(
            f"too few modes between q_min = {q_min:.6g} and q_max = {q_max:.6g} for a fit: "
            f"{rings.dof.sum():.0f} independent ones in {wide} rings, need 20 in 5"
        )
    # Empty rings below a roll-off or beyond the last wave tell the likelihood that C is small. If
    # they hold most of the modes from the first wave to the strongest, single waves stand alone and
    # there is no spectrum to fit. Only rounding decides which of them vanish exactly.
    filled = rings.psd > rounding
    rising = slice(int(np.argmax(filled)), int(np.argmax(rings.psd)) + 1)
    alone = rings.dof[rising] @ filled[rising] < rings.dof[rising].sum() / 2
    if alone or np.count_nonzero(filled) < 2:
        raise ValueError(f"the spectrum vanishes at q = {rings.q[np.argmin(rings.psd)]:.6g}")
    rings = replace(rings, psd=np.where(rings.psd > 0, rings.psd, rounding))
    # ln q about the middle of the data, where exponent and level are least correlated.
    scale = float(np.exp(np.average(np.log(rings.q), weights=rings.dof)))
    x = np.log(rings.q / scale)
    law, misfit = weighted_fit(x, rings)

    # A plateau is kept if it explains the data much better. It may end above four modes, a tenth of
    # a decade below the top.
    room = x[(np.cumsum(rings.dof) > 4) & (x < x[-1] - np.log(10) / 10)]
    if rolloff and len(room) < 2:
        raise ValueError("rolloff=True needs a wider range of q: lower q_min or raise q_max")
    if rolloff is not False and len(room) > 1:
        bent, bent_misfit = weighted_fit(x, rings, (room[0], room[-1]))
        limited = limit_weight(rings, bent_misfit)
        gain = 2 * (deviance(x, limited, law) - deviance(x, limited, bent)) - 2
        if rolloff or gain > ROLLOFF_AIC:
            law = bent
            misfit = bent_misfit

    # Covariance in the unit of the data: ln C = ln c0 - 2 (H + 1) max(ln q, ln q_r).
    log_q = np.maximum(x, law.corner) + np.log(scale)
    slopes = [np.ones_like(x), -2 * log_q]
    if law.is_bent:
        slopes.append(-law.exponent * (x < law.corner))
    design = np.array(slopes)
    information = (design * limit_weight(rings, misfit).dof) @ design.T
    return SelfAffineFit(
        hurst=law.exponent / 2 - 1,
        c0=float(np.exp(law.level + law.exponent * np.log(scale))),
        log_covariance=np.linalg.inv(information),
        q_min=float(rings.q[0]),
        q_max=float(rings.q[-1]),
        q_rolloff=scale * float(np.exp(law.corner)) if law.is_bent else None,
        misfit=misfit,
        rings=rings,
    )


def fit_power_law(x: NDArray, rings: RadialPSD) -> PowerLaw:
    """Maximise the likelihood of a law without a corner. The likelihood has one maximum."""
    weight = rings.dof / rings.dof.sum()
    centre = float(weight @ x)
    from_centre = x - centre
    log_psd = np.log(rings.psd)

    def flatten(exponent: float) -> tuple[NDArray, float]:
        """C without the power law, over its largest value, and the logarithm of that value."""
        log_flat = log_psd + exponent * from_centre
        highest = log_flat.max()
        return weight * np.exp(log_flat - highest), highest

    def tilt(exponent: float) -> float:
        """Centre of the flattened C, which the best exponent leaves where it is."""
        flat, _ = flatten(exponent)
        return float(flat @ from_centre / flat.sum())

    # The bracket is wide, because plateaus are tried anywhere.
    exponent = scipy.optimize.brentq(tilt, -1e3, 1e3, xtol=1e-12)
    flat, highest = flatten(exponent)
    return PowerLaw(float(np.log(flat.sum()) + highest) + exponent * centre, exponent)


def fit_rolloff(x: NDArray, rings: RadialPSD, room: tuple[float, float]) -> PowerLaw:
    """Maximise the likelihood of a law with a corner within `room`."""

    def fit_with(corner: float) -> PowerLaw:
        return fit_power_law(np.maximum(x, corner), rings)._replace(corner=corner)

    def cost(corner: float) -> float:
        return deviance(x, rings, fit_with(corner))

    # The likelihood has kinks and several maxima in c: scan, then refine.
    start, stop = room
    grid = np.linspace(start, stop, 40)
    best = int(np.argmin([cost(corner) for corner in grid]))
    bounds = (grid[max(best - 1, 0)], grid[min(best + 1, len(grid) - 1)])
    return fit_with(float(scipy.optimize.minimize_scalar(cost, bounds=bounds, method="bounded").x))


def weighted_fit(
    x: NDArray, rings: RadialPSD, room: tuple[float, float] | None = None
) -> tuple[PowerLaw, float]:
    """Alternate between a fit with limited weights, bent within a `room`, and their misfit."""

    def fit(limited: RadialPSD) -> PowerLaw:
        return fit_power_law(x, limited) if room is None else fit_rolloff(x, limited, room)

    law = fit(rings)
    misfit = 0.0
    for _ in range(20):
        before = misfit
        misfit = rms_misfit(rings, law.at(x), law.parameters)
        if abs(misfit - before) <= 0.01 * misfit:  # far below the error of the misfit
            break
        law = fit(limit_weight(rings, misfit))
    return law, misfit


def rms_misfit(rings: RadialPSD, model: NDArray, parameters: int) -> float:
    """Return tau for which wide rings scatter as var(mean/C) = 1/dof + tau^2."""
    _, ratio, dof = merge_rings(rings, rings.psd / model, COARSE)
    square = (ratio - 1) ** 2

    def excess(variance: float) -> float:
        return float(np.sum(square / (1 / dof + variance))) - (len(ratio) - parameters)

    if excess(0.0) <= 0 or len(ratio) <= parameters:
        return 0.0
    highest = float(square.sum())  # there every term is below 1, and their sum below 1
    return float(np.sqrt(scipy.optimize.brentq(excess, 0.0, highest)))


def limit_weight(rings: RadialPSD, misfit: float) -> RadialPSD:
    """Return narrow rings that count nu/(1 + nu tau^2), nu of the wide ring they belong to."""
    index = wide_rings(rings, COARSE)
    wide = np.bincount(index, weights=rings.dof)[index]
    return replace(rings, dof=rings.dof / (1 + wide * misfit**2))


def deviance(x: NDArray, rings: RadialPSD, law: PowerLaw) -> float:
    """Negative logarithm of the likelihood, up to a constant."""
    ratio = rings.psd / law.at(x)
    return float(rings.dof @ (ratio - np.log(ratio)))
