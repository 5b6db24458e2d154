"""Adjoining power laws of the wave number, and their integrals in closed form.

All integrals are summed from the end where the terms are small, so that spectra of ten decades lose
no digits to cancellation.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import nonnegative

ROUNDING = 1e-12  #: q within this relative distance of the band's end still belongs to it


@dataclass(frozen=True, eq=False)
class PowerLaws:
    """C = C_i (q/q_i)^a_i between the knots q_i and q_(i+1); zero beyond the first and the last."""

    knots: NDArray  #: (m + 1,), increasing wave numbers
    level: NDArray  #: (m,), C at the left end of each segment
    exponent: NDArray  #: (m,), a of each segment

    @classmethod
    def of(cls, knots: ArrayLike, level: ArrayLike, exponent: ArrayLike) -> PowerLaws:
        """Power laws from anything that numpy takes for arrays."""
        return cls(*(np.asarray(values, dtype=float) for values in (knots, level, exponent)))

    @property
    def ends(self) -> tuple[float, float]:
        """First and last knot."""
        return float(self.knots[0]), float(self.knots[-1])

    def psd(self, q: ArrayLike) -> NDArray:
        """C(q); zero outside the band."""
        (q,) = nonnegative(q=q)
        low, high = self.ends
        inside = (q >= low * (1 - ROUNDING)) & (q <= high * (1 + ROUNDING))
        i = self._segment(q)
        ratio = np.where(inside, q, self.knots[i]) / self.knots[i]
        return np.where(inside, self.level[i] * ratio ** self.exponent[i], 0.0)

    def below(self, q: ArrayLike, power: float) -> NDArray:
        """2 pi * integral of q'^(1 + power) C from the first knot to `q`."""
        q = np.clip(*nonnegative(q=q), *self.ends)
        i = self._segment(q)
        before = np.concatenate([[0.0], np.cumsum(self._whole_segments(power))])
        return before[i] + self._integral(i, self.knots[i], q, power)

    def above(self, q: ArrayLike, power: float) -> NDArray:
        """2 pi * integral of q'^(1 + power) C from `q` to the last knot."""
        q = np.clip(*nonnegative(q=q), *self.ends)
        i = self._segment(q)
        after = np.concatenate([np.cumsum(self._whole_segments(power)[::-1])[::-1], [0.0]])
        return after[i + 1] + self._integral(i, q, self.knots[i + 1], power)

    def invert_gradient(self, variance: ArrayLike) -> NDArray:
        """Wave number at which ``below(q, 2)`` is `variance`."""
        (variance,) = nonnegative(variance=variance)
        before = np.concatenate([[0.0], np.cumsum(self._whole_segments(2))])
        i = np.clip(np.searchsorted(before, variance, side="right") - 1, 0, len(self.level) - 1)
        beta = self.exponent[i] + 4
        level = 2 * np.pi * self.level[i] * self.knots[i] ** 4
        q = self.knots[i] * np.exp(_log1p_over(beta, (variance - before[i]) / level))
        return np.clip(q, *self.ends)

    def truncated(self, end: float) -> PowerLaws:
        """Return the same power laws up to `end`."""
        keep = self.knots[:-1] < end
        knots = np.append(self.knots[:-1][keep], end)
        return PowerLaws(knots, self.level[keep], self.exponent[keep])

    def _segment(self, q: NDArray) -> NDArray:
        index = np.searchsorted(self.knots, q, side="right") - 1
        return np.clip(index, 0, len(self.level) - 1)

    def _integral(self, i: NDArray, a: NDArray, b: NDArray, power: float) -> NDArray:
        """2 pi * integral of q^(1 + power) C from a to b, both in segment i."""
        beta = self.exponent[i] + 2 + power
        from_knot = np.log(a / self.knots[i])
        level = self.level[i] * self.knots[i] ** (2 + power)
        return 2 * np.pi * level * np.exp(beta * from_knot) * _expm1_over(beta, np.log(b / a))

    def _whole_segments(self, power: float) -> NDArray:
        i = np.arange(len(self.level))
        return self._integral(i, self.knots[:-1], self.knots[1:], power)


def _expm1_over(beta: NDArray, x: NDArray) -> NDArray:
    """Integral of exp(beta t) from 0 to x, that is expm1(beta x)/beta, regular at beta = 0."""
    safe = np.where(beta == 0, 1.0, beta)
    return np.where(beta == 0, x, np.expm1(safe * x) / safe)


def _log1p_over(beta: NDArray, y: NDArray) -> NDArray:
    """Inverse of `_expm1_over`: log1p(beta y)/beta, regular at beta = 0."""
    safe = np.where(beta == 0, 1.0, beta)
    return np.where(beta == 0, y, np.log1p(np.maximum(safe * y, -1 + 1e-16)) / safe)
