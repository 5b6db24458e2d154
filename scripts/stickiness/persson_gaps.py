"""Where contact is lost, scale by scale, in Persson's setting, and the gaps that opens.

The sums and integrals behind `persson.Persson`; see there for the relations.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.special import erf, erfc

from .persson_kernels import Kernels
from .spectrum import Shells, Spectrum

_SMALLEST_LOG = 45.0  # gaps below exp(-45) of the others count as zero
_TAIL_LOG = 38.0  # area lost beyond holds less than exp(-38) of what is lost in all
_MOST_KINKS = 256  # of a tabulated spectrum, that quadrature over scales keeps to
_NARROWEST = 1e-150  # Gaussians that much narrower than the widest are points


@dataclass(frozen=True)
class ScaleNodes:
    """Quadrature over the scales of a surface: the integral of K d(-1/q) is sum(weight K).

    Attributes
    ----------
    below, above : (k,) arrays
        m at the nodes and M - m, each free of cancellation.
    weight : (k,) array
        [length]
    """

    below: NDArray
    above: NDArray
    weight: NDArray


@dataclass(frozen=True)
class GapProfile:
    """Where contact is lost on the way from the coarsest to the finest resolution, at one load.

    Attributes
    ----------
    weight : (n,) array
        Shares of the nominal area.
    gap : (n,) array
        u1 of each share [length].
    width : (n,) array
        Standard deviation of the Gaussian about it [length].
    closed : float
        Share whose gap and width are below exp(-45) of the others', not in `weight`.
    """

    weight: NDArray
    gap: NDArray
    width: NDArray
    closed: float


@dataclass(frozen=True)
class Setting:
    """A surface as the theory sees it, at no particular load.

    Attributes
    ----------
    spectrum : Spectrum
    kernels : Kernels
    scales : ScaleNodes
    m2 : float
        Profile variance of the gradient of the whole surface.
    variant : str
        See `persson.Persson`.
    nodes : float
        Multiplies the number of quadrature nodes.
    """

    spectrum: Spectrum
    kernels: Kernels
    scales: ScaleNodes
    m2: float
    variant: str
    nodes: float


def scale_nodes(spectrum: Spectrum, nodes: float = 1.0) -> ScaleNodes:
    """Quadrature over the scales of a spectrum: exact for shells, composite Gauss otherwise."""
    if isinstance(spectrum, Shells):
        return _shell_nodes(spectrum, max_nodes=int(600 * nodes))
    log_q, weight = _panel_nodes(_scale_edges(spectrum), nodes)
    q = np.append(spectrum.q0 * np.exp(log_q), spectrum.q1)
    weight = np.append(weight, 1.0) / q  # and the jump of -1/q to zero
    below = 0.5 * spectrum.variance_below(q, 2)
    return ScaleNodes(below, 0.5 * spectrum.variance_above(q, 2), weight)


def _scale_edges(spectrum: Spectrum) -> NDArray:
    """Edges of panels in ln(q/q0), graded towards both ends and split at kinks of C.

    The integrand is like a square root near q0 at small loads and changes within small steps
    from q1 where the last contact is lost.
    """
    span = np.log(spectrum.q1 / spectrum.q0)
    width = min(0.5, span / 2)
    count = int(np.ceil((span - 2 * width) / 0.7))
    middle = np.linspace(width, span - width, count + 1) if count else [width]
    low, high = width * 4.0 ** np.arange(-13, 0), width * 4.0 ** np.arange(-1, -10, -1)
    edges = np.concatenate([[0.0], low, middle, span - high, [span]])
    inner = getattr(spectrum, "knots", np.empty(0))[1:-1]
    if len(inner) > _MOST_KINKS:
        kink = np.abs(np.diff(np.diff(np.log(spectrum.psd(spectrum.knots)))))
        inner = inner[np.sort(np.argsort(kink)[-_MOST_KINKS:])]
    return np.union1d(edges, np.log(inner / spectrum.q0))


def _panel_nodes(edges: NDArray, nodes: float) -> tuple[NDArray, NDArray]:
    """Gauss-Legendre nodes and weights on panels, fewer of them on narrow ones."""
    width = np.diff(edges)
    at, weight = [], []
    for chosen, order in ((width > 0.1, 10), (width <= 0.1, 6)):
        x, w = np.polynomial.legendre.leggauss(max(2, round(order * nodes)))
        half = 0.5 * width[chosen, None]
        at.append((edges[:-1][chosen, None] + half * (1 + x)).ravel())
        weight.append((half * w).ravel())
    return np.concatenate(at), np.concatenate(weight)


def _shell_nodes(shells: Shells, max_nodes: int) -> ScaleNodes:
    """One node per shell; where there are very many, neighbours are put together.

    A group's node sits at the weighted mean of m, which leaves an error of second order in the
    group's narrow width.
    """
    gradient = 0.5 * shells.variance * shells.q**2
    below = np.cumsum(gradient)
    above = np.append(np.cumsum(gradient[::-1])[::-1][1:], 0.0)
    weight = -np.diff(1 / shells.q, append=0.0)
    if len(below) <= max_nodes:
        return ScaleNodes(below, above, weight)
    half = max_nodes // 2
    edges = np.geomspace(half, len(below) - 1, max_nodes - half)
    start = np.unique(np.concatenate([np.arange(half), edges.astype(int)]))
    total = np.add.reduceat(weight, start)
    mean = [np.add.reduceat(weight * m, start) / total for m in (below, above)]
    return ScaleNodes(mean[0], mean[1], total)


@dataclass(frozen=True)
class _LostContact:
    """Contact lost at the scales where A = erf(y), y = y_end + step: what P(u) is made of."""

    y: NDArray
    step: NDArray
    m: NDArray
    rest: NDArray  # M - m

    @classmethod
    def at(cls, setting: Setting, p: float, y_end: float, log_step: NDArray) -> _LostContact:
        step = np.exp(log_step)
        rest = p**2 * setting.kernels.area_scale_step(y_end, step)
        y = y_end + step
        return cls(y, step, p**2 * setting.kernels.area_scale(y), rest)


def gap_profile(setting: Setting, p: float, reach: float) -> GapProfile:
    """Quadrature of P(u) over the scales where contact is lost.

    The variable is ln(y - y_end): logarithmic in M - m at the fine end, where u1 vanishes as
    exp(-p(m)^2/(M - m)), and in y at the coarse one, where it grows as exp(y^2). Panels are
    laid so that no Gaussian is narrower than one of them.

    Parameters
    ----------
    setting : Setting
    p : float
    reach : float
        Gaps up to this many h_rms are resolved.
    """
    kernel = setting.kernels
    y_end = float(kernel.invert_area_scale(setting.m2 / p**2))
    low, high = _step_range(setting, y_end)
    grid = _grid(y_end, low, high, setting.nodes)
    coarse = _LostContact.at(setting, p, y_end, grid)
    scaled = np.log(_scaled_gap(setting, p, coarse))
    smooth = CubicSpline(grid, scaled)
    edges = _panel_edges(setting, p, grid, coarse, scaled, reach)
    x, w = np.polynomial.legendre.leggauss(10)
    half = 0.5 * np.diff(edges)[:, None]
    log_step = (edges[:-1, None] + half * (1 + x)).ravel()
    fine = _LostContact.at(setting, p, y_end, log_step)
    gap = np.exp(smooth(log_step) + _gap_exponent(p, fine))
    area_per_log_step = 2 / np.sqrt(np.pi) * np.exp(-(fine.y**2)) * fine.step
    closed = float(erfc(y_end) - erfc(y_end + np.exp(low)))
    return GapProfile(
        (half * w).ravel() * area_per_log_step, gap, _width(setting, fine, gap), closed
    )


def _step_range(setting: Setting, y_end: float) -> tuple[float, float]:
    """Range of ln(y - y_end) that matters."""
    high = np.log(_TAIL_LOG / (y_end + np.sqrt(y_end**2 + _TAIL_LOG)))
    if setting.variant == "almqvist2011":
        # u1 may vanish but the width goes as (M - m)^(1/2): that much must be negligible.
        return np.log(y_end) - 42.0, high
    slope = y_end**3 * float(setting.kernels.diffusion(y_end)) / 2
    low = float(np.log(slope / erf(y_end) ** 2 / (_SMALLEST_LOG + y_end**2)))
    return min(low, high - 1.0), high  # next to full contact all gaps are that small


def _grid(y_end: float, low: float, high: float, nodes: float) -> NDArray:
    """Values of ln(y - y_end) to interpolate between: even in it, and at y > 1 in y^2 as well."""
    probe = np.linspace(low, high, 500)
    y2 = (y_end + np.exp(probe)) ** 2
    number = np.sqrt(nodes) * ((probe - low) / 0.018 + (y2 - y2[0]) / 0.25)
    return np.interp(np.linspace(0, number[-1], 2 + int(number[-1])), number, probe)


def _gap_exponent(p: float, lost: _LostContact) -> NDArray:
    """Exponent in which u1 spans hundreds of orders of magnitude; the rest of it is tame."""
    return lost.y**2 - (p / erf(lost.y)) ** 2 / lost.rest


def _scaled_gap(setting: Setting, p: float, lost: _LostContact) -> NDArray:
    """u1/exp(_gap_exponent) by the sum over scales finer than each m."""
    scales, kernel = setting.scales, setting.kernels
    s2 = np.where(
        lost.m[:, None] < 0.5 * setting.m2,
        scales.below - lost.m[:, None],
        lost.rest[:, None] - scales.above,
    )
    pressure2 = (p / erf(lost.y)) ** 2
    finest = pressure2 / lost.rest
    row, column = np.nonzero(s2 * (1 + 1e-12) > pressure2[:, None] / (finest[:, None] + 60.0))
    s2 = s2[row, column]
    x2 = pressure2[row] / s2
    a = np.sqrt(np.pi) * p**2 * erf(lost.y) / (lost.y**3 * kernel.diffusion(lost.y))
    factor = s2 * np.exp(-(lost.y[row] ** 2)) + 0.5 * a[row]
    terms = np.exp(finest[row] - x2) * kernel.gap_kernel(x2) * factor / np.sqrt(s2)
    total = np.bincount(row, scales.weight[column] * terms, minlength=len(lost.y))
    return 2 / np.sqrt(np.pi) * total


def _width(setting: Setting, lost: _LostContact, gap: NDArray) -> NDArray:
    """Standard deviation of the Gaussians."""
    spectrum, m2 = setting.spectrum, setting.m2
    _, variance = spectrum.at_gradient_variance(2 * lost.m)
    # Next to the finest scale the height variance is the difference of nearly equal numbers;
    # there q hardly varies.
    q, _ = spectrum.at_gradient_variance(2 * (m2 - 0.5 * lost.rest))
    h = np.sqrt(np.where(lost.rest < 1e-6 * m2, 2 * lost.rest / q**2, variance))
    if setting.variant == "almqvist2011":
        return h
    return gap * h / np.hypot(gap, h)


def _panel_edges(
    setting: Setting, p: float, grid: NDArray, lost: _LostContact, scaled: NDArray, reach: float
) -> NDArray:
    """Edges of panels over each of which the Gaussians move and widen by about half their width."""
    log_gap = scaled + _gap_exponent(p, lost)
    gap = np.exp(log_gap)
    width = np.maximum(_width(setting, lost, gap), 1e-300)
    seen = np.minimum(gap, reach * setting.spectrum.h_rms)
    centre = 0.5 * (width[1:] + width[:-1])
    change = 0.5 * np.diff(grid) + np.abs(np.diff(np.log(width))) + np.abs(np.diff(seen)) / centre
    change += 0.3 * np.abs(np.diff(np.maximum(log_gap, np.log(width))))
    total = np.append(0.0, np.cumsum(change))
    count = int(np.ceil(total[-1] / 0.8 * setting.nodes))
    return np.interp(np.linspace(0, total[-1], count + 1), total, grid)


def density(u: NDArray, profile: GapProfile) -> NDArray:
    """P(u) [1/length] at gaps `u`, `(k,)`."""
    result = np.zeros(len(u))
    order = np.argsort(u)
    for block in np.array_split(order, max(1, len(u) // 25)) if len(u) else ():
        result[block] = _density_of_neighbours(u[block], profile)
    return result


def _density_of_neighbours(u: NDArray, profile: GapProfile) -> NDArray:
    """P(u) of gaps near each other: most Gaussians are too far off to count."""
    far = 9.5 * profile.width
    near = (profile.gap - far < u.max()) & (profile.gap + far > u.min())
    near &= profile.width > _NARROWEST * profile.width.max()
    gap, width = profile.gap[near], profile.width[near]
    to_left = (u[:, None] - gap) / width
    pair = np.exp(-0.5 * to_left**2)
    to_left += 2 * gap / width
    pair += np.exp(-0.5 * to_left**2)
    return pair @ (profile.weight[near] / (np.sqrt(2 * np.pi) * width))


def _bounded(width: NDArray) -> NDArray:
    """Widths that may be divided by."""
    return np.maximum(width, max(_NARROWEST * float(width.max()), 1e-300))


def cumulative(u: NDArray, profile: GapProfile) -> NDArray:
    """Integral of P from 0 to `u`, `(k,)`."""
    width = np.sqrt(2) * _bounded(profile.width)
    to_left = (u[:, None] - profile.gap) / width
    pair = erf(to_left) + erf(to_left + 2 * profile.gap / width)
    return 0.5 * pair @ profile.weight + np.where(u > 0, profile.closed, 0.0)


def closure_error(profile: GapProfile) -> float:
    """Integral of u P over all u less the mean gap [length].

    The integral of u1 over the area is the mean gap. The pair of Gaussians about u1 and -u1,
    taken at positive gaps, has a larger mean by what this adds up.
    """
    width = _bounded(profile.width)
    ratio = profile.gap / width
    excess = np.sqrt(2 / np.pi) * width * np.exp(-0.5 * ratio**2)
    excess -= profile.gap * erfc(ratio / np.sqrt(2))
    return float(profile.weight @ excess)
