"""Scales of a rough surface on a layer, for Persson's contact theory.

With ``m(q) = pi int q'^3 C/S^2 dq'``, S of `solids`, the area A(m) is that of the half-space; waves
dm cost the energy ``(1/2) (S/q) dm``: ``ubar(p) = (2/sqrt(pi)) int ds F(p/s) S/q``, ``s^2 = m(q)``.
Unlike 1/q, S/q may rise with q. So this integral is not taken by parts, as in `theory`, and the
distribution of gaps is left out: u1 may be negative. The mean gap is within 6 % of simulations. The
area is too small, by up to a half on thin incompressible layers.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from stickiness.persson.kernels import Kernels
from stickiness.persson.scale_quadrature import scale_edges
from stickiness.solids import Layer
from stickiness.spectrum.interface import Spectrum

_ORDER = 8  # of Gauss quadrature on panels
_FINE, _MOST_PARTS = 0.1, 20  # parts of panels, in ln m


class LayeredScales:
    """Variance m of a spectrum on a layer, and the mean gap that its scales make."""

    def __init__(self, spectrum: Spectrum, solid: Layer, nodes: float = 1.0):
        self.spectrum, self.solid = spectrum, solid
        if spectrum.is_discrete:
            self._q = spectrum.q
            self._m = np.cumsum(0.5 * spectrum.variance * self._slope_weight(self._q))
        else:
            self._q, self._m, self._growth = self._gauss_nodes(nodes)

    def variance_below(self, q: float) -> float:
        """Return m of the waves up to `q`."""
        return 0.5 * self.spectrum.integrate(self._slope_weight, self.spectrum.q0, q)

    def mean_gap(self, p: NDArray, universal: Kernels) -> NDArray:
        """Mean gap [length] at mean pressures `p` > 0 [E*]."""
        s, per_pressure = np.sqrt(self._m), self.solid.factor(self._q) / self._q
        x2 = (p[..., None] / s) ** 2
        faded = np.exp(-x2)
        # within a shell S/q stands still: int F(p/s) ds = s kappa(p/s)
        if self.spectrum.is_discrete:
            terms = np.diff(s * faded * universal.mean_kernel(x2), axis=-1, prepend=0.0)
        else:
            terms = faded * universal.gap_kernel(x2) * self._growth / (2 * s)
            terms[..., 0] = s[0] * faded[..., 0] * universal.mean_kernel(x2[..., 0])
        return 2 / np.sqrt(np.pi) * np.sum(per_pressure * terms, axis=-1)

    def _slope_weight(self, q: NDArray) -> NDArray:
        return (q / self.solid.factor(q)) ** 2

    def _gauss_nodes(self, nodes: float) -> tuple[NDArray, NDArray, NDArray]:
        """Wave numbers, m there, and what m grows by with the weight of each."""
        edges = self.spectrum.q0 * np.exp(scale_edges(self.spectrum))
        edges[-1] = self.spectrum.q1
        # so close that ln m grows by little between them
        m = np.array([self.variance_below(q) for q in edges])
        growth = np.log(m[1:]) - np.log(np.maximum(m[:-1], 1e-300))
        parts = np.clip(np.ceil(growth / (_FINE / nodes)), 1, _MOST_PARTS).astype(int)
        start = np.concatenate([[0], np.cumsum(parts)])
        edges = np.exp(np.interp(np.arange(start[-1] + 1), start, np.log(edges)))
        x, w = np.polynomial.legendre.leggauss(max(2, round(_ORDER * nodes)))
        start, half = np.log(edges[:-1, None]), 0.5 * np.diff(np.log(edges))[:, None]
        q = np.exp(start + half * (1 + x))
        growth = half * w * np.pi * q**2 * self.spectrum.psd(q) * self._slope_weight(q)
        before = np.concatenate([[0.0], np.cumsum(growth.sum(axis=1))[:-1]])
        # up to a node: the integral of the interpolating polynomial
        within = growth / w @ _partial_weights(x).T
        # The first panel, of relative width 1e-8 at most: F(p/s) changes there at small loads.
        shell = self.spectrum.q0, growth[0].sum(), 0.0
        rest = q[1:], before[1:, None] + within[1:], growth[1:]
        return tuple(np.append(one, all_else) for one, all_else in zip(shell, rest, strict=True))


def _partial_weights(x: NDArray) -> NDArray:
    """Weights, row by row, of the integral of a polynomial from -1 to each of the nodes."""
    legendre = np.polynomial.legendre
    values = legendre.legvander(x, len(x) - 1)
    integrals = np.stack(
        [legendre.legval(x, legendre.legint(unit, lbnd=-1)) for unit in np.eye(len(x))], axis=1
    )
    return integrals @ np.linalg.inv(values)
