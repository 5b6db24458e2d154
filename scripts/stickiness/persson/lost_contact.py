"""Scales at which contact is lost under one load, and the gap u1 that each loss opens.

u1 is a sum over all finer scales, far dearer than anything else that the distribution of gaps
needs, yet smooth: a shell of a discrete spectrum sets in with all its derivatives zero. Quadrature
nodes on the other hand keep to every step of q(m), for the widths of the Gaussians have kinks
there. So ln u1 is summed at Chebyshev points of panels that are halved until the series has
converged, and interpolated at the nodes. All variants of the theory share it.
"""

from __future__ import annotations

import logging
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.special import erf

from stickiness.persson.kernels import Kernels
from stickiness.persson.scale_quadrature import ScaleNodes
from stickiness.spectrum.kinds import Spectrum

SMALLEST_LOG = 45.0  #: gaps below exp(-45) of the others count as zero
TAIL_LOG = 38.0  #: area lost beyond holds less than exp(-38) of what is lost in all
_ORDER = 16  # Chebyshev points of a panel
_WIDTH, _NARROWEST = 1.5, 1e-3  # of panels in ln(y - y_end): the first ones, and where halving ends
_ANGLES = np.pi * (np.arange(_ORDER) + 0.5) / _ORDER
_POINTS = -np.cos(_ANGLES)
_TO_SERIES = np.polynomial.chebyshev.chebvander(_POINTS, _ORDER - 1).T * (2 / _ORDER)
_TO_SERIES[0] /= 2


@dataclass(frozen=True)
class Setting:
    """A surface as the theory sees it, at no particular load."""

    spectrum: Spectrum
    kernels: Kernels
    scales: ScaleNodes
    m2: float  #: profile variance of the gradient of the whole surface
    variant: str  #: see `persson.Persson`
    nodes: float  #: multiplies the number of quadrature nodes
    curves: dict[float, GapCurve] = field(default_factory=dict)  #: by load, whatever the variant

    def curve(self, p: float) -> GapCurve:
        """u1 at the load `p`, made once."""
        if p not in self.curves:
            if len(self.curves) >= 64:
                self.curves.clear()
            self.curves[p] = GapCurve.at(self, p)
        return self.curves[p]


@dataclass(frozen=True)
class LostContact:
    """Contact lost at the scales where A = erf(y), y = y_end + step: what P(u) is made of."""

    y: NDArray
    step: NDArray
    m: NDArray
    rest: NDArray  #: M - m

    @classmethod
    def at(cls, setting: Setting, p: float, y_end: float, log_step: NDArray) -> LostContact:
        """At values of ln(y - y_end), in order."""
        step = np.exp(log_step)
        rest = p**2 * setting.kernels.area_scale_step(y_end, step)
        y = y_end + step
        return cls(y, step, p**2 * setting.kernels.area_scale(y), rest)

    def __getitem__(self, part: slice) -> LostContact:
        return LostContact(self.y[part], self.step[part], self.m[part], self.rest[part])


@dataclass(frozen=True)
class GapCurve:
    """Ln u1 against ln(y - y_end) at one load: Chebyshev series of its smooth part on panels.

    Errs by some 1e-7 with the default number of nodes, like the sum over scales itself.
    """

    p: float
    y_end: float  #: A = erf(y_end) at the finest resolution
    edges: NDArray  #: (k + 1,), of the panels
    series: NDArray  #: (k, order)

    @classmethod
    def at(cls, setting: Setting, p: float) -> GapCurve:
        """Sum u1 on panels halved until the last terms of each series are small."""
        y_end = float(setting.kernels.invert_area_scale(setting.m2 / p**2))
        low, high = visible_range(setting, y_end)
        tolerance = max(1e-7 * setting.nodes**-6, 1e-10)
        edges = np.linspace(low, high, 1 + int(np.ceil((high - low) * setting.nodes / _WIDTH)))
        panels, done = np.stack([edges[:-1], edges[1:]], axis=1), []
        while len(panels):
            start, end = panels.T
            series = _series(setting, p, y_end, start, end)
            ready = np.abs(series[:, -3:]).max(axis=1) < tolerance
            narrow = ~ready & (end - start < _NARROWEST)
            if narrow.any():
                logging.info("p = %g: %d panels of gaps not converged", p, narrow.sum())
            ready |= narrow
            done += zip(start[ready], series[ready], strict=True)
            middle = 0.5 * (start + end)
            halves = np.stack([start, middle, middle, end], axis=1)
            panels = halves[~ready].reshape(-1, 2)
        starts, series = zip(*sorted(done, key=lambda panel: panel[0]), strict=True)
        return cls(p, y_end, np.array([*starts, high]), np.array(series))

    def log_gap(self, log_step: NDArray, lost: LostContact) -> NDArray:
        """Ln u1, free of underflow: u1 spans hundreds of orders of magnitude.

        Below the panels, where u1 is zero beside all others, its smooth part is held.
        """
        inside = np.clip(log_step, self.edges[0], self.edges[-1])
        panel = np.clip(np.searchsorted(self.edges, inside) - 1, 0, len(self.series) - 1)
        start, end = self.edges[panel], self.edges[panel + 1]
        x = (2 * inside - start - end) / (end - start)
        terms = np.polynomial.chebyshev.chebvander(x, _ORDER - 1)
        smooth = np.einsum("ij,ij->i", terms, self.series[panel])
        return lost.y**2 - (self.p / erf(lost.y)) ** 2 / lost.rest + smooth


def visible_range(setting: Setting, y_end: float) -> tuple[float, float]:
    """Range of ln(y - y_end) over which gaps are not zero beside all others."""
    high = np.log(TAIL_LOG / (y_end + np.sqrt(y_end**2 + TAIL_LOG)))
    slope = y_end**3 * float(setting.kernels.diffusion(y_end)) / 2
    low = float(np.log(slope / erf(y_end) ** 2 / (SMALLEST_LOG + y_end**2)))
    return min(low, high - 1.0), high  # next to full contact all gaps are that small


def _series(setting: Setting, p: float, y_end: float, start: NDArray, end: NDArray) -> NDArray:
    """Chebyshev series, row by row, of the smooth part of ln u1 on panels."""
    log_step = 0.5 * ((start + end)[:, None] + (end - start)[:, None] * _POINTS)
    lost = LostContact.at(setting, p, y_end, log_step.ravel())
    parts = (lost[i : i + _ORDER] for i in range(0, log_step.size, _ORDER))
    return np.log([scaled_gap(setting, p, part) for part in parts]) @ _TO_SERIES.T


def scaled_gap(setting: Setting, p: float, lost: LostContact) -> NDArray:
    """u1 over exp(y^2 - p(m)^2/(M - m)), by the sum over scales finer than each m."""
    kernel = setting.kernels
    nodes = setting.scales.beyond(lost.m.min(), lost.m.max())
    coarse = lost.m < 0.5 * setting.m2
    s2 = np.empty((len(coarse), len(nodes.weight)))
    s2[coarse] = nodes.below - lost.m[coarse, None]
    s2[~coarse] = lost.rest[~coarse, None] - nodes.above
    pressure2 = ((p / erf(lost.y)) ** 2)[:, None]
    finest = pressure2 / lost.rest[:, None]
    # What is not finer ends where the exponential is zero.
    np.maximum(s2, pressure2 / (finest + 740.0), out=s2)
    x2 = pressure2 / s2
    a = np.sqrt(np.pi) * p**2 * erf(lost.y) / (lost.y**3 * kernel.diffusion(lost.y))
    terms = np.exp(finest - x2)
    terms *= kernel.gap_kernel(x2)
    terms *= s2 * np.exp(-(lost.y**2))[:, None] + 0.5 * a[:, None]
    terms /= np.sqrt(s2)
    return 2 / np.sqrt(np.pi) * (terms @ nodes.weight)
