"""Quadrature over the scales of a rough surface, for Persson's contact theory.

The theory integrates over d(-1/q) functions of m(q), the profile variance of the gradient up to q.
They set in at some m like exp(-c m/(m(q) - m)). With c about a third, at small loads, Gauss
quadrature takes some hundred nodes per unit of ln m across the onset, and seven for any panel
farther away than a third of its width. Hence two sets of nodes.

Nodes are arrays `(3, n)` of m, of M - m, M being m of the whole surface, both free of cancellation,
and of weights [length]: the integral of f d(-1/q) is sum(weight f).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from stickiness.spectrum.interface import Spectrum

_ORDER = 7  # of Gauss quadrature on panels
_MOST_COARSE = 700  # coarse nodes; more are put together


@dataclass(frozen=True)
class ScaleNodes:
    """Two quadratures, fine and coarse, over the same panels of scales, in order of m."""

    fine: NDArray
    coarse: NDArray
    edge: NDArray  #: (k + 1,): m at the edges of the panels
    fine_start: NDArray  #: (k + 1,): first node of each panel, then that beyond the last panel,
    coarse_start: NDArray  #: which is the jump of -1/q at q1
    margin: float  #: the coarse nodes of a panel will do at so many times its width from it

    def beyond(self, lowest: float, highest: float) -> NDArray:
        """Nodes for functions that set in at some m from `lowest` to `highest`."""
        remote = self.edge[:-1] - self.margin * np.diff(self.edge)
        remote = np.minimum.accumulate(remote[::-1])[::-1]
        far = int(np.searchsorted(remote, highest))
        near = min(max(int(np.searchsorted(self.edge, lowest, side="right")) - 1, 0), far)
        fine = self.fine[:, self.fine_start[near] : self.fine_start[far]]
        return np.hstack([fine, self.coarse[:, self.coarse_start[far] :]])


def scale_nodes(spectrum: Spectrum, nodes: float = 1.0) -> ScaleNodes:
    """Quadratures over the scales of a spectrum; `nodes` multiplies their numbers of nodes.

    Gauss quadrature for continuous spectra; every shell is a node. Where there are very
    many shells or points of a table, neighbours are put together.
    """
    if spectrum.is_discrete:
        gradient = 0.5 * spectrum.variance * spectrum.q**2
        above = np.append(np.cumsum(gradient[::-1])[::-1][1:], 0.0)
        weight = -np.diff(1 / spectrum.q, append=0.0)
        return _grouped_nodes(np.array([np.cumsum(gradient), above, weight]), nodes)
    edges = scale_edges(spectrum)
    order = max(2, round(_ORDER * nodes))
    coarse = _gauss_nodes(spectrum, edges, order)
    if coarse.shape[1] > 2 * _MOST_COARSE * max(nodes, 1.0):
        return _grouped_nodes(_gauss_nodes(spectrum, edges, max(2, round(4 * nodes))), nodes)
    edge = 0.5 * spectrum.variance_below(spectrum.q0 * np.exp(edges), 2)
    fine_edges, start = split_panels(edges, edge)
    fine = _gauss_nodes(spectrum, fine_edges, order)
    panels = np.arange(len(edges))
    return ScaleNodes(fine, coarse, edge, order * start, order * panels, margin=0.35)


def scale_edges(spectrum: Spectrum) -> NDArray:
    """Edges of panels in ln(q/q0), graded towards both ends and split at kinks of C.

    The integrand is like a square root near q0 at small loads and changes within small steps
    from q1 where the last contact is lost.
    """
    span = np.log(spectrum.q1 / spectrum.q0)
    width = min(0.5, span / 2)
    count = int(np.ceil((span - 2 * width) / 0.7))
    middle = np.linspace(width, span - width, count + 1) if count else [width]
    low = width * 4.0 ** np.arange(-13, 0)
    high = width * 4.0 ** np.arange(-1, -10, -1)
    edges = np.concatenate([[0.0], low, middle, span - high, [span]])
    return np.union1d(edges, np.log(spectrum.knots[1:-1] / spectrum.q0))


def split_panels(edges: NDArray, m: NDArray) -> tuple[NDArray, NDArray]:
    """Split panels into parts over which ln m grows little, and where each panel's begin."""
    growth = np.log(m[1:]) - np.log(np.maximum(m[:-1], 1e-300))  # a ratio may overflow
    parts = np.clip(np.ceil(growth / 0.1), 1, 10).astype(int)
    start = np.append(0, np.cumsum(parts))
    return np.interp(np.arange(start[-1] + 1), start, edges), start


def _gauss_nodes(spectrum: Spectrum, edges: NDArray, order: int) -> NDArray:
    """Gauss-Legendre nodes between edges in ln(q/q0), and the jump of -1/q to zero at q1."""
    x, w = np.polynomial.legendre.leggauss(order)
    half = 0.5 * np.diff(edges)[:, None]
    q = spectrum.q0 * np.exp((edges[:-1, None] + half * (1 + x)).ravel())
    q = np.append(q, spectrum.q1)
    weight = np.append((half * w).ravel(), 1.0) / q
    return np.array(
        [0.5 * spectrum.variance_below(q, 2), 0.5 * spectrum.variance_above(q, 2), weight]
    )


def _grouped_nodes(discrete: NDArray, nodes: float) -> ScaleNodes:
    """Quadratures that put neighbours together, the last node, at M, excepted."""
    inner = discrete[:, :-1]
    last = discrete[:, -1:]
    below, above, _ = inner
    count = len(below)
    if count <= _MOST_COARSE:
        ends = np.array([0, count])
        return ScaleNodes(discrete, discrete, discrete[0, [0, -1]], ends, ends, margin=8.0)
    # Fine groups by ln(m/(M - m)), and coarse ones, each eight times as wide.
    label = np.floor(np.log(below / above) * nodes / 0.006)
    wide = np.floor(label / 8)
    first = np.flatnonzero(np.diff(wide, prepend=-np.inf))
    edge = np.append(below[first], below[-1])
    coarse, coarse_start = _grouped(inner, wide, first)
    fine = inner
    fine_start = np.append(first, count)
    if count > 4000 * nodes:
        fine, fine_start = _grouped(inner, label, first)
    fine = np.hstack([fine, last])
    coarse = np.hstack([coarse, last])
    return ScaleNodes(fine, coarse, edge, fine_start, coarse_start, margin=8.0)


def _grouped(nodes: NDArray, label: NDArray, first: NDArray) -> tuple[NDArray, NDArray]:
    """Replace all nodes of one label by two, and return where those of `first` have gone.

    They are the Gauss quadrature of the group's distribution over m, which keeps four moments
    and so errs by the fourth power of the group's width.
    """
    below, above, weight = nodes
    begin = np.flatnonzero(np.diff(label, prepend=-np.inf))
    size = np.diff(begin, append=len(label))
    origin = np.repeat(begin, size)
    offset = np.where(above < below, above[origin] - above, below - below[origin])
    total = np.add.reduceat(weight, begin)
    mean = np.add.reduceat(weight * offset, begin) / total
    rest = offset - np.repeat(mean, size)
    second = np.add.reduceat(weight * rest**2, begin) / total
    third = np.add.reduceat(weight * rest**3, begin) / total
    several = (size > 1) & (second > 0)
    lean = 0.5 * np.divide(third, second**1.5, out=np.zeros_like(third), where=several)
    spread = np.hypot(1.0, lean)
    sign = np.array([-1.0, 1.0])
    moved = mean[:, None] + np.sqrt(second)[:, None] * (lean[:, None] + sign * spread[:, None])
    share = 0.5 * total[:, None] * (1 - sign * (lean / spread)[:, None])
    share[~several] = np.stack([total, np.zeros_like(total)], axis=1)[~several]
    keep = share > 0
    below = np.maximum(below[begin, None] + moved, 0.0)[keep]
    above = np.maximum(above[begin, None] - moved, 0.0)[keep]
    start = np.append(0, np.cumsum(keep.sum(axis=1)))
    chosen = np.append(np.searchsorted(begin, first), len(begin))
    return np.array([below, above, share[keep]]), start[chosen]
