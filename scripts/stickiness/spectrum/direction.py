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
_ALIKE = 1e-4  # ratios nearer to 1 change no average by more than 1e-8
_NODES = 64  # of averages over whole ellipses
_PIECE = 32  # nodes of those over the part of an ellipse between two knots
_CELLS = 56  # power laws for each knot
# Nodes and weights on 0 to 1, of a cell, for functions that are like a square root at both ends.
_TURN, _GAUSS = np.polynomial.legendre.leggauss(16)
_TURN = 0.5 * np.pi * (1 + _TURN)
_SHARE, _WEIGHT = 0.5 * (1 - np.cos(_TURN)), 0.25 * np.pi * np.sin(_TURN) * _GAUSS
_CLOSEST = 1e-10  # ends of cells in ln q
# Angles of the amplitude of cos 2 phi, and the ratio beyond which it hardly changes.
_ANGLES, _LARGEST_FOUND = 2000, 20.0
_STEEPEST = 60.0  # change of ln(q^2 C) over a cell

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
        qx, qy = np.asarray(qx, dtype=float), np.asarray(qy, dtype=float)
        c, s = np.cos(self.angle), np.sin(self.angle)
        return np.hypot((c * qx + s * qy) * self.reach, (c * qy - s * qx) / self.reach)

    def mean_stretch(self, power: float) -> float:
        """Average of g^power, i.e. of ``|q|^power``/Q^power, over an ellipse."""
        if self.is_circle:
            return 1.0
        w = np.pi * (np.arange(_NODES) + 0.5) / _NODES
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
        x, weight = np.polynomial.legendre.leggauss(_PIECE)
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
        around = -self._log_reach * np.cos(np.linspace(0, np.pi, _CELLS + 1))
        edges = np.unique(np.add.outer(np.log(laws[0]), around))
        edges = edges[np.append(True, np.diff(edges) > _CLOSEST)]
        width, start = np.diff(edges), np.exp(edges[:-1])
        at = width[:, None] * _SHARE
        density = np.exp(2 * at) * self.mean_psd(laws, start[:, None] * np.exp(at))
        empty = density @ _WEIGHT == 0  # between the bands of a spectrum that has a gap
        density[empty] = 1.0
        high = np.expm1(2 * at) / np.expm1(2 * width)[:, None]
        centre = (density * high) @ _WEIGHT / (density @ _WEIGHT)
        slope = _find_slopes(centre, width) / width
        level = (density @ _WEIGHT) / (np.exp(slope[:, None] * at) @ _WEIGHT)
        return np.exp(edges), np.where(empty, 0.0, level), slope - 2

    @property
    def _log_reach(self) -> float:
        return float(np.log(self.ratio)) / 2

    def _fill(self, w: NDArray) -> NDArray:
        """dt/dw, its mean over w from 0 to pi being a half."""
        length = self._log_reach
        s2, c2 = np.sin(w / 2) ** 2, np.cos(w / 2) ** 2
        low, high = 4 * length * s2, 4 * length * c2
        # Each of the roots vanishes with the sine of one end.
        ends = expm1_over(low, 1.0) * expm1_over(-high, 1.0)
        return 0.5 * np.exp(-2 * length * np.cos(w)) / np.sqrt(ends)


CIRCLE = Ellipse()


def find_ratio(amplitude: float, hurst: float) -> float:
    """Ratio of the correlation lengths, at most `_LARGEST_FOUND`, of a self-affine spectrum.

    `amplitude` is A of C ~ 1 + A cos 2 phi, as `measured.psd.PowerSpectrum.anisotropy` finds it.
    """
    hurst = min(max(hurst, 0.1), 1.0)
    phi = np.pi * (np.arange(_ANGLES) + 0.5) / _ANGLES

    def excess(log_ratio: float) -> float:
        ratio = np.exp(log_ratio)
        density = (ratio * np.cos(phi) ** 2 + np.sin(phi) ** 2 / ratio) ** (-1 - hurst)
        return float(-2 * np.mean(np.cos(2 * phi) * density) / np.mean(density)) - amplitude

    if excess(np.log(_LARGEST_FOUND)) <= 0:
        return _LARGEST_FOUND
    if amplitude <= 0:
        return 1.0
    return float(np.exp(scipy.optimize.brentq(excess, 0, np.log(_LARGEST_FOUND))))


def expm1_over(beta: NDArray, x: NDArray | float) -> NDArray:
    """Integral of exp(beta t) from 0 to x, that is expm1(beta x)/beta, regular at beta = 0."""
    safe = np.where(beta == 0, 1.0, beta)
    return np.where(beta == 0, x, np.expm1(safe * x) / safe)


def _find_slopes(centre: NDArray, width: NDArray) -> NDArray:
    """Change over each cell of ln(q^2 C) that puts the gradient's centre where it is."""

    def excess(slope, centre, width):
        density = np.exp(slope[..., None] * (_SHARE - 0.5)) * _WEIGHT
        high = np.expm1(2 * width[..., None] * _SHARE) / np.expm1(2 * width[..., None])
        return np.sum(density * high, axis=-1) / np.sum(density, axis=-1) - centre

    ends = np.full_like(centre, -_STEEPEST), np.full_like(centre, _STEEPEST)
    return scipy.optimize.elementwise.find_root(excess, ends, args=(centre, width)).x
