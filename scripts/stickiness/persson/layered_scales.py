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
from stickiness.persson.scale_quadrature import scale_edges, split_panels
from stickiness.solids import Solid
from stickiness.spectrum.interface import Spectrum


class LayeredScales:
    """Variance m of a spectrum on a layer, and the mean gap that its scales make."""

    def __init__(self, spectrum: Spectrum, solid: Solid, nodes: float = 1.0):
        self.spectrum = spectrum
        self.solid = solid
        if spectrum.is_discrete:
            self._q = spectrum.q
            self._growth = 0.5 * spectrum.variance * self._slope_weight(self._q)
            self._m = np.cumsum(self._growth)
        else:
            self._q, self._m, self._growth = self._gauss_nodes(nodes)

    def variance_below(self, q: float) -> float:
        """Return m of the waves up to `q`."""
        return 0.5 * float(self.spectrum.integrate(self._slope_weight, self.spectrum.q0, q))

    def mean_gap(self, p: NDArray, universal: Kernels) -> NDArray:
        """Mean gap [length] at mean pressures `p` > 0 [E*]."""
        s = np.sqrt(self._m)
        x2 = (p[..., None] / s) ** 2
        faded = np.exp(-x2)
        up_to_each = s * faded * universal.mean_kernel(x2)
        growth = faded * universal.gap_kernel(x2) * self._growth / (2 * s)
        return 2 / np.sqrt(np.pi) * self._sum(up_to_each, growth)

    def elastic_energy(self, p: NDArray, universal: Kernels) -> NDArray:
        """Elastic energy [length] at mean pressures `p` [E*], less the mean compression's."""
        kept, mean = universal.energy_kept(p[..., None], self._m)
        return 0.5 * self._sum(self._m * mean, kept * self._growth)

    def _sum(self, total: NDArray, growth: NDArray) -> NDArray:
        """Sum over scales of S/q times what an integral grows by; `total` is that up to each."""
        if self.spectrum.is_discrete:  # within a shell S/q stands still
            growth = np.diff(total, axis=-1, prepend=0.0)
        growth[..., 0] = total[..., 0]
        return np.sum(self.solid.factor(self._q) / self._q * growth, axis=-1)

    def _slope_weight(self, q: NDArray) -> NDArray:
        return (q / self.solid.factor(q)) ** 2

    def _growth_per_log_q(self, log_q: NDArray) -> NDArray:
        q = np.exp(log_q)
        return np.pi * q**2 * self.spectrum.psd(q) * self._slope_weight(q)

    def _gauss_nodes(self, nodes: float) -> tuple[NDArray, ...]:
        """Wave numbers, m there, and what m grows by with the weight of each."""
        edges = np.log(self.spectrum.q0) + scale_edges(self.spectrum)
        m = np.array([self.variance_below(q) for q in np.exp(edges)])
        edges, _ = split_panels(edges, m)
        # Gauss nodes and weights of a panel, on 0 to 1.
        x, w = np.polynomial.legendre.leggauss(max(2, round(8 * nodes)))
        share = 0.5 * (1 + x)
        w = 0.5 * w
        start = edges[:-1, None]
        width = np.diff(edges)[:, None]
        to_node = width * share
        growth = width * w * self._growth_per_log_q(start + to_node)
        before = np.append(0.0, np.cumsum(growth.sum(axis=1))[:-1])[:, None]
        parts = start[..., None] + to_node[..., None] * share
        m = before + to_node * (self._growth_per_log_q(parts) @ w)
        # The first panel, of relative width 1e-8 at most: F(p/s) changes there at small loads.
        # It is a shell at q0.
        q = np.append(self.spectrum.q0, np.exp(start + to_node)[1:])
        m_at_q = np.append(growth[0].sum(), m[1:])
        return q, m_at_q, np.append(0.0, growth[1:])
