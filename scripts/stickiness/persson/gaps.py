"""Where Persson's theory loses contact, scale by scale, and the distribution of gaps it opens.

Symbols are those of `theory`: m, M, p(m), y and u1. Contact lost on resolving a scale opens the gap
u1, a smooth but expensive sum over all finer scales. P(u) needs many nodes, because the widths of
its Gaussians have a kink at every step of q(m). So ln u1 is summed at Chebyshev points (`GapCurve`,
which all variants of the theory share) and interpolated at the nodes of P(u) (`GapProfile`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.special import erf, erfc

from stickiness.persson.kernels import Kernels
from stickiness.persson.scale_quadrature import ScaleNodes
from stickiness.spectrum.interface import Spectrum

_SMALLEST_LOG = 45.0  # gaps below exp(-45) of the others count as zero
_TAIL_LOG = 38.0  # area lost beyond holds less than exp(-38) of what is lost in all
_SERIES_ORDER = 16  # Chebyshev points of a panel
_POINTS = -np.cos(np.pi * (np.arange(_SERIES_ORDER) + 0.5) / _SERIES_ORDER)
_TO_SERIES = np.polynomial.chebyshev.chebvander(_POINTS, _SERIES_ORDER - 1).T * (2 / _SERIES_ORDER)
_TO_SERIES[0] /= 2
_PANEL = 1.4  # change over a panel, see `_panel_edges`
# Nodes and weights on panels that see less than each of `_CHANGES`, or more than all.
_CHANGES = (0.015, 0.08, 0.3)
_RULES = [np.polynomial.legendre.leggauss(order) for order in (2, 3, 5, 10)]
_FAR = 9.5  # widths from which on a Gaussian is nothing
_NARROWEST = 1e-150  # Gaussians that much narrower than the widest are points


@dataclass(frozen=True, eq=False)
class Setting:
    """A surface as the theory sees it, at no particular load."""

    spectrum: Spectrum
    kernels: Kernels
    scales: ScaleNodes
    m2: float  #: M: profile variance of the gradient of the whole surface
    nodes: float  #: multiplies the number of quadrature nodes


@dataclass(frozen=True)
class LostContact:
    """Contact lost at the scales where A = erf(y): what P(u) is made of."""

    y: NDArray
    m: NDArray
    rest: NDArray  #: M - m

    @classmethod
    def at(cls, setting: Setting, p: float, y_end: float, log_step: NDArray) -> LostContact:
        """Contact lost at values of ln(y - y_end)."""
        step = np.exp(log_step)
        y = y_end + step
        rest = p**2 * setting.kernels.area_scale_step(y_end, step)
        return cls(y, p**2 * setting.kernels.area_scale(y), rest)


@dataclass(frozen=True)
class GapCurve:
    """Ln u1 against ln(y - y_end) at one load: Chebyshev series of its smooth part on panels.

    Errs by some 1e-7 with the default number of nodes, like the sum over scales itself.
    """

    setting: Setting
    p: float
    y_end: float  #: A = erf(y_end) at the finest resolution
    edges: NDArray  #: (k + 1,), of the panels
    series: NDArray  #: (k, order)

    def log_gap(self, log_step: NDArray, lost: LostContact) -> NDArray:
        """Ln u1, free of underflow: u1 spans hundreds of orders of magnitude.

        Below the panels, where u1 is zero beside all others, its smooth part stays constant.
        """
        inside = np.clip(log_step, self.edges[0], self.edges[-1])
        panel = np.clip(np.searchsorted(self.edges, inside) - 1, 0, len(self.series) - 1)
        start = self.edges[panel]
        end = self.edges[panel + 1]
        x = (2 * inside - start - end) / (end - start)
        terms = np.polynomial.chebyshev.chebvander(x, _SERIES_ORDER - 1)
        smooth = np.einsum("ij,ij->i", terms, self.series[panel])
        return lost.y**2 - (self.p / erf(lost.y)) ** 2 / lost.rest + smooth


@lru_cache(maxsize=128)
def gap_curve(setting: Setting, p: float) -> GapCurve:
    """Sum u1 on panels halved until the last terms of each series are small."""
    y_end = float(setting.kernels.invert_area_scale(setting.m2 / p**2))
    low, high = _visible_range(setting, y_end)
    tolerance = max(1e-7 * setting.nodes**-6, 1e-10)
    # The first panels are at most 1.5 wide in ln(y - y_end).
    count = int(np.ceil((high - low) * setting.nodes / 1.5))
    edges = np.linspace(low, high, 1 + count)
    panels = np.stack([edges[:-1], edges[1:]], axis=1)
    finished: list[tuple] = []  # (start, series) of panels that are fine enough
    while len(panels):
        start, end = panels.T
        log_steps = 0.5 * ((start + end)[:, None] + (end - start)[:, None] * _POINTS)
        lost = LostContact.at(setting, p, y_end, log_steps)
        of_panels = map(LostContact, lost.y, lost.m, lost.rest)
        series = np.log([scaled_gap(setting, p, each) for each in of_panels]) @ _TO_SERIES.T
        is_fine = np.abs(series[:, -3:]).max(axis=1) < tolerance
        is_fine |= end - start < 1e-3  # where halving ends
        finished += zip(start[is_fine], series[is_fine], strict=True)
        middle = 0.5 * (start + end)
        panels = np.stack([start, middle, middle, end], axis=1)[~is_fine].reshape(-1, 2)
    finished.sort(key=lambda panel: panel[0])
    starts, series = zip(*finished, strict=True)
    return GapCurve(setting, p, y_end, np.array([*starts, high]), np.array(series))


def _visible_range(setting: Setting, y_end: float) -> tuple[float, float]:
    """Range of ln(y - y_end) over which gaps are not negligible beside all others."""
    high = np.log(_TAIL_LOG / (y_end + np.sqrt(y_end**2 + _TAIL_LOG)))
    # -1/T'(y_end), of the area lost.
    slope = y_end**3 * float(setting.kernels.correction.diffusion(y_end)) / 2
    low = float(np.log(slope / erf(y_end) ** 2 / (_SMALLEST_LOG + y_end**2)))
    return min(low, high - 1.0), high  # next to full contact all gaps are that small


def scaled_gap(setting: Setting, p: float, lost: LostContact) -> NDArray:
    """u1 over exp(y^2 - p(m)^2/(M - m)), by the sum over scales finer than each m."""
    below, above, weight = setting.scales.beyond(lost.m.min(), lost.m.max())
    coarse = lost.m[:, None] < 0.5 * setting.m2
    s2 = np.where(coarse, below - lost.m[:, None], lost.rest[:, None] - above)
    pressure2 = ((p / erf(lost.y)) ** 2)[:, None]
    finest = pressure2 / lost.rest[:, None]
    # Scales that are not finer than m get an exponent of -740, which is zero.
    np.maximum(s2, pressure2 / (finest + 740.0), out=s2)
    x2 = pressure2 / s2
    slope = lost.y**3 * setting.kernels.correction.diffusion(lost.y)
    # a of `theory` times exp(-y^2).
    a = np.sqrt(np.pi) * p**2 * erf(lost.y) / slope
    terms = np.exp(finest - x2)
    terms *= setting.kernels.gap_kernel(x2)
    terms *= s2 * np.exp(-(lost.y**2))[:, None] + 0.5 * a[:, None]
    terms /= np.sqrt(s2)
    return 2 / np.sqrt(np.pi) * (terms @ weight)


@dataclass(frozen=True)
class GapProfile:
    """Where contact is lost on the way from the coarsest to the finest resolution, at one load."""

    weight: NDArray  #: shares of the nominal area
    gap: NDArray  #: u1 of each share [length]
    width: NDArray  #: standard deviation of the Gaussian about it [length]
    closed: float  #: share whose gap and width are below exp(-45) of the others', not in `weight`


@lru_cache(maxsize=128)
def gap_profile(setting: Setting, variant: str, p: float, reach: float) -> GapProfile:
    """Quadrature of P(u) over the scales where contact is lost, for gaps up to `reach` h_rms.

    The variable is ln(y - y_end): logarithmic in M - m at the fine end, where u1 vanishes as
    exp(-p(m)^2/(M - m)), and in y at the coarse one, where it grows as exp(y^2). Panels are
    laid so that no Gaussian is much narrower than one of them.
    """
    curve = gap_curve(setting, p)
    y_end = curve.y_end
    edges, change, thinned = _panel_edges(curve, variant, reach)
    # Where panels are few, as next to a strong shell, all have the rule of the highest order.
    if len(change) < 100 * setting.nodes:
        change = np.full(len(change), np.inf)
    log_step, weight = _panel_nodes(edges, change)
    y, log_gap, width = _gaussians(curve, variant, log_step)
    gap = np.exp(log_gap)
    if thinned:  # narrower than they are apart they would make a comb of P(u)
        apart = np.where(gap < reach * setting.spectrum.h_rms, np.abs(np.gradient(gap)), 0.0)
        width = np.maximum(width, apart)
    area_per_log_step = 2 / np.sqrt(np.pi) * np.exp(-(y**2)) * np.exp(log_step)
    # of the two complementary differences the one with more digits
    ends = np.array([y_end, y_end + np.exp(edges[0])])
    closed = float(np.diff(erf(ends))[0] if y_end < 0.5 else -np.diff(erfc(ends))[0])
    return GapProfile(weight * area_per_log_step, gap, width, closed)


def _panel_nodes(edges: NDArray, change: NDArray) -> tuple[NDArray, NDArray]:
    """Gauss-Legendre nodes, in order, and weights; fewer on panels that see little change."""
    rule_of_panel = np.digitize(change, _CHANGES)
    nodes = []
    weights = []
    for rule, (x, w) in enumerate(_RULES):
        chosen = rule_of_panel == rule
        half = 0.5 * np.diff(edges)[chosen, None]
        nodes.append((edges[:-1][chosen, None] + half * (1 + x)).ravel())
        weights.append((half * w).ravel())
    all_nodes = np.concatenate(nodes)
    ascending = np.argsort(all_nodes)
    return all_nodes[ascending], np.concatenate(weights)[ascending]


def _gaussians(curve: GapCurve, variant: str, log_step: NDArray) -> tuple[NDArray, ...]:
    """y, ln u1 and standard deviation of the Gaussians at values of ln(y - y_end)."""
    spectrum = curve.setting.spectrum
    m2 = curve.setting.m2
    lost = LostContact.at(curve.setting, curve.p, curve.y_end, log_step)
    log_gap = curve.log_gap(log_step, lost)
    _, variance = spectrum.at_gradient_variance(2 * lost.m)
    # Next to the finest scale the height variance is the difference of nearly equal numbers;
    # there q hardly varies.
    finest = lost.rest < 1e-6 * m2
    rest = lost.rest[finest]
    q, _ = spectrum.at_gradient_variance(2 * (m2 - 0.5 * rest))
    variance[finest] = 2 * rest / q**2
    width = np.sqrt(variance)
    if variant == "afferrante2018":
        gap = np.exp(log_gap)
        width = gap * width / np.hypot(gap, width)
    return lost.y, log_gap, width


def _panel_edges(curve: GapCurve, variant: str, reach: float) -> tuple[NDArray, NDArray, bool]:
    """Edges of panels in ln(y - y_end), the change over each, and whether they are too few.

    A change of 1, some four widths of the Gaussians, needs ten nodes. Next to full contact of a
    broad spectrum the Gaussians are so narrow that they move by more of their widths.
    """
    setting = curve.setting
    y_end = curve.y_end
    low, high = _visible_range(setting, y_end)
    if variant == "almqvist2011":
        # u1 may vanish but the width goes as (M - m)^(1/2): that much must be negligible.
        low = np.log(y_end) - 42.0

    # A look at the Gaussians, on steps in ln(y - y_end) and in y^2: u1 grows as exp(y^2) where y is
    # large.
    probe = np.linspace(low, high, 300)
    number = (probe - low) / 0.2 + (y_end + np.exp(probe)) ** 2 / 0.5
    number -= number[0]
    grid = np.interp(np.linspace(0, number[-1], 2 + int(number[-1])), number, probe)
    breaks = _breaks(curve)
    breaks = breaks[(breaks > low) & (breaks < high)]
    grid = np.union1d(grid, breaks)
    y, log_gap, width = _gaussians(curve, variant, grid)
    width = np.maximum(width, 1e-300)

    # Their change from point to point. Where Gaussians move by many of their widths, at most 2000
    # panels follow them.
    visible_gap = np.minimum(np.exp(log_gap), reach * setting.spectrum.h_rms)
    mean_width = 0.5 * (width[1:] + width[:-1])
    change = 0.5 * np.diff(grid) + 0.6 * np.abs(np.diff(np.log(width)))
    moves = 0.3 * np.abs(np.diff(visible_gap)) / mean_width
    most_moves = 2000 * _PANEL
    is_thinned = bool(moves.sum() > most_moves)
    change += moves * (most_moves / moves.sum() if is_thinned else 1.0) + 0.3 * np.diff(y**2)
    change += 0.2 * np.abs(np.diff(np.maximum(log_gap, np.log(width))))

    # Panels of equal change, split at the breaks.
    total = np.append(0.0, np.cumsum(change))
    count = int(np.ceil(total[-1] * setting.nodes / _PANEL))
    even = np.interp(np.linspace(0, total[-1], count + 1), total, grid)
    edges = np.union1d(even, breaks)
    change_over_panel = np.diff(np.interp(edges, grid, total)) * setting.nodes / _PANEL
    return edges, change_over_panel, is_thinned


def _breaks(curve: GapCurve) -> NDArray:
    """Values of ln(y - y_end) where q(m) is not smooth, the strongest of those that matter.

    Where q jumps, values next to it are among them: on the coarse side of a shell its part in u1
    vanishes as exp(-p(m)^2/(m_shell - m)), and h falls to what the finer shells hold.
    """
    setting = curve.setting
    p = curve.p
    y_end = curve.y_end
    spectrum = setting.spectrum
    # How much q jumps from shell to shell, or the exponent of C bends at a knot.
    if spectrum.is_discrete:
        most = 600
        q = spectrum.q[:-1]
        jump = np.diff(np.log(spectrum.q))
    else:
        most = 250
        q = spectrum.knots[1:-1]
        ends = np.concatenate([[spectrum.q0], q, [spectrum.q1]])
        exponent = np.diff(np.log(spectrum.psd(ends))) / np.diff(np.log(ends))
        jump = np.abs(np.diff(exponent))
    m = 0.5 * spectrum.variance_below(q, 2)
    y = setting.kernels.invert_area_scale(m / p**2)
    matters = (y > y_end) & (y**2 < y_end**2 + _TAIL_LOG)
    chosen = np.flatnonzero(matters)[np.argsort(jump[matters])[::-1][:most]]

    # Next to strong shells: m at given negative exponents of exp(-p^2/(m_shell - m)), and at given
    # shares of the height variance left in the shell over that of the finer ones.
    strong = chosen[jump[chosen] > 0.02] if spectrum.is_discrete else chosen[:0]
    onset = (p / erf(y[strong])) ** 2 / np.geomspace(1.5, 96.0, 13)[:, None]
    finer = 0.5 * q[strong] ** 2 * spectrum.variance_above(q[strong])
    depth = np.concatenate([onset, finer * np.geomspace(0.03, 30.0, 7)[:, None]])
    before = np.maximum(m[strong] - depth, 1e-3 * m[strong]).ravel()
    breaks = np.append(y[chosen], setting.kernels.invert_area_scale(before / p**2))
    return np.log(breaks[breaks > y_end] - y_end)


def over_blocks(function: Callable, u: NDArray, profile: GapProfile) -> NDArray:
    """Evaluate `density` or `cumulative` at gaps `u`, `(k,)`, taking those near each other."""
    result = np.zeros(len(u))
    if len(u):
        for block in np.array_split(np.argsort(u), max(1, len(u) // 10)):
            result[block] = function(u[block], profile)
    return result


def density(u: NDArray, profile: GapProfile) -> NDArray:
    """P(u) [1/length] at gaps near each other: most Gaussians are too far off to count."""
    far = _FAR * profile.width
    near = (profile.gap - far < u.max()) & (profile.gap + far > u.min())
    near &= profile.width > _NARROWEST * profile.width.max()
    gap = profile.gap[near]
    width = profile.width[near]
    to_left = (u[:, None] - gap) / width
    pair = np.exp(-0.5 * to_left**2)
    to_left += 2 * gap / width
    pair += np.exp(-0.5 * to_left**2)
    return pair @ (profile.weight[near] / (np.sqrt(2 * np.pi) * width))


def cumulative(u: NDArray, profile: GapProfile) -> NDArray:
    """Integral of P to gaps near each other: Gaussians far off are within all or none of them."""
    far = _FAR * profile.width
    within = profile.gap + far <= u.min()
    near = ~within & (profile.gap - far < u.max())
    gap = profile.gap[near]
    weight = profile.weight[near]
    least = max(_NARROWEST * float(profile.width.max()), 1e-300)  # that may be divided by
    width = np.sqrt(2) * np.maximum(profile.width[near], least)
    to_left = (u[:, None] - gap) / width
    pair = erf(to_left)
    to_left += 2 * gap / width
    pair += erf(to_left)
    # Within a small part of the width about zero that is a difference of nearly equal numbers.
    tiny = u[:, None] < 1e-4 * width
    if tiny.any():
        small = np.where(tiny, u[:, None] / width, 0.0)
        centre2 = np.minimum((gap / width) ** 2, 700.0)
        series = small * np.exp(-centre2) * (1 + (2 * centre2 - 1) / 3 * small**2)
        pair = np.where(tiny, 4 / np.sqrt(np.pi) * series, pair)
    open_area = 0.5 * pair @ weight + profile.weight[within].sum()
    return open_area + np.where(u > 0, profile.closed, 0.0)
