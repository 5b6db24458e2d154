"""Surfaces with a direction: power laws of an elliptic norm of the wave vector.

C(q) = C(Q), where Q^2 = a k^2 + s^2/a, k and s being the components of q along the long correlation
length and across it, a the ratio of the correlation lengths. On an ellipse of constant Q the
stretch ``g = |q|/Q`` is g^2 = cos^2 t/a + a sin^2 t at evenly filled angles t. Averages over t take
the variable w in ln g = -ln(sqrt(a)) cos w, which leaves periodic smooth integrands at any ratio.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy  # its parts are loaded when first used, which reading a configuration does not
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import finite, nonnegative, number

MOST = 1e4  #: ratios up to which averages were checked
MOST_FOUND = 20.0  #: the largest ratio that heights are said to have
_ALIKE = 1e-4  # ratios nearer to 1 change no average by more than 1e-8
# Nodes and weights on 0 to 1, of a cell, for functions that are like a square root at both ends.
_TURN, _GAUSS = np.polynomial.legendre.leggauss(16)
_TURN = 0.5 * np.pi * (1 + _TURN)
_SHARE = 0.5 * (1 - np.cos(_TURN))
_WEIGHT = 0.25 * np.pi * np.sin(_TURN) * _GAUSS

PowerLaws = tuple[NDArray, NDArray, NDArray]  #: knots, levels and exponents, see `kinds`


@dataclass(frozen=True)
class Ellipse:
    """Norm of wave vectors, and the averages over directions that belong to it.

    Averaged over directions C is ``<C(q/g)/g^2>``. It is like a square root at the ends of the
    waves that the ellipse of a knot holds, and a power law away from them.
    """

    ratio: float = 1.0  #: of the correlation lengths, long over short, from 1 to 1e4
    angle: float = 0.0  #: direction of the long correlation length from x [rad]

    def __post_init__(self):
        if not 1 <= number("anisotropy", self.ratio) <= MOST:
            raise ValueError(
                f"anisotropy must be between 1 and {MOST:g}, got {self.ratio!r}: it is the long "
                "over the short correlation length"
            )
        if np.ndim(finite(angle=self.angle)[0]):
            raise ValueError(f"angle must be a number, got {self.angle!r}")

    @property
    def is_circle(self) -> bool:
        """Whether all directions are alike."""
        return self.ratio == 1

    @property
    def is_nearly_circle(self) -> bool:
        """Whether averages over directions leave power laws as they are."""
        return self.ratio - 1 < _ALIKE

    @property
    def reach(self) -> float:
        """Largest ``|q|`` on an ellipse over its norm; the smallest is the inverse of it."""
        return float(np.sqrt(self.ratio))

    def norm(self, qx: ArrayLike, qy: ArrayLike) -> NDArray:
        """Norm Q of wave vectors."""
        if self.is_circle:
            return np.hypot(qx, qy)
        qx = np.asarray(qx, dtype=float)
        qy = np.asarray(qy, dtype=float)
        cosine = np.cos(self.angle)
        sine = np.sin(self.angle)
        along = cosine * qx + sine * qy
        across = cosine * qy - sine * qx
        return np.hypot(along * self.reach, across / self.reach)

    def mean_stretch(self, power: float) -> float:
        """Average of g^power, i.e. of ``|q|^power``/Q^power, over an ellipse."""
        if self.is_circle:
            return 1.0
        w = np.pi * (np.arange(64) + 0.5) / 64
        log_g = -self._log_reach * np.cos(w)
        return float(np.mean(2 * self._fill(w) * np.exp(power * log_g)))

    def mean_psd(self, laws: PowerLaws, q: ArrayLike) -> NDArray:
        """C averaged over directions at wave numbers `q`, exactly."""
        knots, level, exponent = laws
        (q,) = nonnegative(q=q)
        low, high = knots[[0, -1]]
        # Beyond the band as just beyond it: nothing is infinite there.
        within = np.clip(q.reshape(-1, 1), 0.5 * low / self.reach, 2 * high * self.reach)
        log_ratio = np.log(within / knots)
        # Where the ellipses of the knots pass this wave number.
        at_knot = np.arccos(np.clip(-log_ratio / self._log_reach, -1, 1))
        x, weight = np.polynomial.legendre.leggauss(32)
        half = 0.5 * (at_knot[:, :-1] - at_knot[:, 1:])[..., None]
        w = at_knot[:, 1:, None] + half * (1 + x)
        log_g = -self._log_reach * np.cos(w)
        log_law = exponent[:, None] * (log_ratio[:, :-1, None] - log_g) - 2 * log_g
        terms = self._fill(w) * np.exp(log_law)
        mean = 2 / np.pi * np.sum((half * terms) @ weight * level, axis=-1)
        return mean.reshape(q.shape)

    def average(self, laws: PowerLaws) -> PowerLaws:
        """Power laws of ``|q|`` that follow the power laws of the norm, averaged over directions.

        Height and gradient variance between any two of their knots are exact. The energy of full
        contact errs by less than 1e-8 up to a ratio of 8, by 1e-7 at 100 and 1e-6 at 1e4.
        """
        if self.is_nearly_circle:
            return laws
        # Edges of cells in ln q, 56 cells about each knot.
        around = -self._log_reach * np.cos(np.linspace(0, np.pi, 57))
        edges = np.unique(np.add.outer(np.log(laws[0]), around))
        edges = edges[np.append(True, np.diff(edges) > 1e-10)]
        width = np.diff(edges)
        start = np.exp(edges[:-1])

        # C averaged over directions at the nodes of each cell, times (q/q at its start)^2.
        from_start = width[:, None] * _SHARE
        density = np.exp(2 * from_start) * self.mean_psd(laws, start[:, None] * np.exp(from_start))
        empty = density @ _WEIGHT == 0  # between the bands of a spectrum that has a gap
        density[empty] = 1.0

        # The power law of each cell has its height variance, and its gradient variance by the
        # centre of the density.
        high = np.expm1(2 * from_start) / np.expm1(2 * width)[:, None]
        centre = (density * high) @ _WEIGHT / (density @ _WEIGHT)
        slope = _find_slopes(centre, width) / width
        level = (density @ _WEIGHT) / (np.exp(slope[:, None] * from_start) @ _WEIGHT)
        return np.exp(edges), np.where(empty, 0.0, level), slope - 2

    @property
    def _log_reach(self) -> float:
        return float(np.log(self.ratio)) / 2

    def _fill(self, w: NDArray) -> NDArray:
        """dt/dw, its mean over w from 0 to pi being a half."""
        length = self._log_reach
        low = 4 * length * np.sin(w / 2) ** 2
        high = 4 * length * np.cos(w / 2) ** 2
        # Each of the roots vanishes with the sine of one end.
        ends = expm1_over(low, 1.0) * expm1_over(-high, 1.0)
        return 0.5 * np.exp(-2 * length * np.cos(w)) / np.sqrt(ends)


CIRCLE = Ellipse()


def find_ratio_of_modes(i: NDArray, j: NDArray, power: NDArray) -> float:
    """Ratio of the correlation lengths, at most 20, of heights with these modes.

    On an ellipse the gradient along the short correlation length is a times that along the long
    one, in the root mean square, whatever C(Q) is. Isotropic random heights have such a ratio by
    chance: if more than one in a thousand of them have it, it is taken for 1.

    Parameters
    ----------
    i, j, power : (n, n) arrays
        Integer components of the wave vectors and the height variance of each mode.
    """
    square = power * (i**2 + j**2)
    total = square.sum()
    difference = float(np.hypot(np.sum(power * (i**2 - j**2)), 2 * np.sum(power * i * j)) / total)

    # By chance squared differences are exponential with this mean, as the powers of random modes
    # are.
    by_chance = np.sum(square**2) / total**2
    if difference**2 < np.log(1000) * by_chance:
        return 1.0
    # The difference of both gradient variances over their sum is (a^2 - 1)/(a^2 + 1).
    squared_ratio = (1 + difference) / max(1 - difference, 1e-9)
    return min(float(np.sqrt(squared_ratio)), MOST_FOUND)


def find_ratio(amplitude: float, hurst: float) -> float:
    """Ratio of the correlation lengths, at most 20, of a self-affine spectrum.

    `amplitude` is A of C ~ 1 + A cos 2 phi, as `measured.psd.PowerSpectrum.anisotropy` finds it.
    It hardly changes at larger ratios.
    """
    hurst = min(max(hurst, 0.1), 1.0)
    phi = np.pi * (np.arange(2000) + 0.5) / 2000
    log_largest = np.log(MOST_FOUND)

    def excess(log_ratio: float) -> float:
        ratio = np.exp(log_ratio)
        density = (ratio * np.cos(phi) ** 2 + np.sin(phi) ** 2 / ratio) ** (-1 - hurst)
        return float(-2 * np.mean(np.cos(2 * phi) * density) / np.mean(density)) - amplitude

    if excess(log_largest) <= 0:
        return MOST_FOUND
    if amplitude <= 0:
        return 1.0
    return float(np.exp(scipy.optimize.brentq(excess, 0, log_largest)))


def expm1_over(beta: NDArray, x: NDArray | float) -> NDArray:
    """Integral of exp(beta t) from 0 to x, that is expm1(beta x)/beta, regular at beta = 0."""
    safe = np.where(beta == 0, 1.0, beta)
    return np.where(beta == 0, x, np.expm1(safe * x) / safe)


def _find_slopes(centre: NDArray, width: NDArray) -> NDArray:
    """Change over each cell of ln(q^2 C) that puts the gradient's centre where it is."""
    from scipy.optimize import elementwise  # not loaded with `scipy.optimize`

    def excess(slope, centre, width):
        density = np.exp(slope[..., None] * (_SHARE - 0.5)) * _WEIGHT
        high = np.expm1(2 * width[..., None] * _SHARE) / np.expm1(2 * width[..., None])
        return np.sum(density * high, axis=-1) / np.sum(density, axis=-1) - centre

    bracket = (np.full_like(centre, -60.0), np.full_like(centre, 60.0))
    return elementwise.find_root(excess, bracket, args=(centre, width)).x
