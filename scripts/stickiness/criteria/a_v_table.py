"""a_V by Persson's theory: of a spectrum, and tabulated for self-affine surfaces, with its error.

A_ad/A_nom = (3/2) a_V p/(E* q0 h_rms) (range/h_rms)^(2/3) defines a local a_V at every range, for
theory does not have it constant. Between the finest scale and the rms height it goes as
range^((3-5H)/(3H)) for H > 1/2; next to the edges of contact, where gaps grow by their 3/2 law, it
does not depend on the range. There the variants of the theory part, see `edge_range`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import get_args

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import RegularGridInterpolator
from scipy.special import ndtri

from stickiness.arguments import plain, positive
from stickiness.criteria.formulas import pastewka_robbins_a_v
from stickiness.persson.theory import Persson, Variant
from stickiness.spectrum.interface import Spectrum

PARTED = 1.5  #: ratio of the theory's variants from which on neither resolves the edges of contact
VARIANTS = get_args(Variant)  #: P(0) infinite and finite: limits on the truth
NORMAL_90 = float(ndtri(0.95))  #: standard errors either side that cover 90 %
LOAD = 0.065  #: mean pressure over E* q0 h_rms, amid those where area grows with load in proportion
RANGES = np.geomspace(1e-14, 10, 61)  #: over h_rms, where theory's a_V is evaluated
# Relative, of theory's a_V against simulation: the error model of config/accuracy.csv at this load,
# doubled as for all spectra broader than those measured.
THEORY_ERROR = 0.25
_CUBIC = ("a_v", "a_v_limit", "edge_range", "edge_a_v")
_LINEAR = ("theory_below", "theory_above", "theory_below_limit", "theory_above_limit")
_NUMBERS = ("smallest_magnification", "largest_magnification")
_NUMBERS += ("quadrature_error", "extrapolation_error")
NEEDED = (*_CUBIC, *_LINEAR, *_NUMBERS, "simulation_ratio", "simulation_error", "simulation_trend")
_AXES = ("hurst", "magnification", "pressure", "range")


def local_a_v(area: ArrayLike, pressure: ArrayLike, ranges: ArrayLike) -> NDArray:
    """a_V of attractive areas, for pressures over E* q0 h_rms and ranges over h_rms."""
    pressure, ranges = positive(pressure=pressure, ranges=ranges)
    return np.asarray(area) / (1.5 * pressure * ranges ** (2 / 3))


def edge_range(ranges: ArrayLike, infinite: ArrayLike, finite: ArrayLike) -> float:
    """Range below which Persson's theory no longer resolves the edges of the contact.

    That is the largest at which the attractive area (or a_V) of the variant with `infinite` P(0) is
    `PARTED` times that with a `finite` one, between increasing `ranges` along a power law; the
    smallest if they never part. Theory there is 1.0 to 1.2 times what simulation finds at edges.
    """
    ranges, infinite, finite = positive(ranges=ranges, infinite=infinite, finite=finite)
    logs = np.log(infinite / finite) - np.log(PARTED)
    apart = np.flatnonzero(logs > 0)
    if apart.size == 0:
        return float(ranges[0])
    last = int(apart[-1])
    if last == len(logs) - 1:
        return float(ranges[-1])
    share = logs[last] / (logs[last] - logs[last + 1])
    steps = np.log(ranges[last : last + 2])
    return float(np.exp(steps[0] + share * (steps[1] - steps[0])))


@dataclass(frozen=True)
class SurfaceAv:
    """a_V of a surface against the range, with limits."""

    ranges: NDArray  #: (n,), over h_rms, increasing
    #: (m, n), a_V by every variant of the theory and by the edge law below the edge range; the
    #: first is quoted, the others are limits
    theory: NDArray
    relative_error: float  #: of theory against simulation; widens the limits

    def at(self, range_over_h_rms: ArrayLike) -> tuple[ArrayLike, ArrayLike, ArrayLike]:
        """Value, low and high limit at ranges over h_rms, interpolated in logarithms."""
        at, ranges = np.log(range_over_h_rms), np.log(self.ranges)
        every = np.exp([np.interp(at, ranges, np.log(a_v)) for a_v in self.theory])
        low = every.min(axis=0) * max(1 - self.relative_error, 0.01)
        high = every.max(axis=0) * (1 + self.relative_error)
        return plain(every[0]), plain(low), plain(high)


def surface_a_v(spectrum: Spectrum, known: dict[str, float]) -> SurfaceAv:
    """a_V of a spectrum at every range, by both variants of Persson's theory and by the edge law.

    `known` has q0 and the moments. Below the edge range, where the variants part, they are held
    constant, and Pastewka and Robbins' estimate is the edge law.
    """
    moments = (known[name] for name in ("q0", "h_rms", "rms_slope", "rms_curvature"))
    edge_a_v = float(pastewka_robbins_a_v(*moments))
    h_rms, theory = spectrum.h_rms, Persson(spectrum)
    load = LOAD * float(known["q0"]) * h_rms
    areas = [theory.with_variant(name).gap_cumulative(RANGES * h_rms, load) for name in VARIANTS]
    resolved = [local_a_v(area, LOAD, RANGES) for area in areas]
    edge = edge_range(RANGES, *resolved)
    at_edge = np.exp(np.interp(np.log(edge), np.log(RANGES), np.log(resolved[0])))
    a_v = [np.where(edge > RANGES, at_edge, a) for a in resolved]
    a_v.append(np.where(edge > RANGES, edge_a_v, a_v[0]))
    return SurfaceAv(RANGES, np.array(a_v), THEORY_ERROR)


@dataclass(frozen=True)
class AvEstimate:
    """a_V with its error; arrays of the common shape of the arguments.

    `value` is theory as quoted times simulation over theory. `low` and `high` cover about 90 %:
    the standard error of that ratio, the spread of the theories and the quadrature's error.
    """

    value: NDArray
    low: NDArray
    high: NDArray
    #: ln of how far other variants and corrections of the theory lie below and above the quoted
    #: one; below the edge range, the estimate of Pastewka and Robbins
    theory_below: NDArray
    theory_above: NDArray
    #: standard relative error of the ratio of simulation to theory, with what its trend may
    #: change beyond the simulated magnifications and its drift below the simulated ranges
    simulation: NDArray
    edge: NDArray  #: where the range is below the edge range, so that a_V no longer depends on it


class AvTable:
    """Interpolates the file ``fits/a_v_table.nc``, with the variables `NEEDED`, in logarithms.

    The error of the interpolation is below 3 % (0.5 % root mean square).
    """

    def __init__(self, table: xr.Dataset):
        #: ends of hurst, magnification, pressure and range (over h_rms) in the table
        self.bounds = {name: (float(table[name].min()), float(table[name].max())) for name in _AXES}
        self._theory = {name: _interpolate(np.log(table[name]), "cubic") for name in _CUBIC}
        self._theory |= {name: _interpolate(table[name]) for name in _LINEAR}
        self._ratio = _hold(np.log(table.simulation_ratio))
        self._ratio_error = _hold(table.simulation_error)
        self._trend = _hold(table.simulation_trend)
        self._known = {name: float(table[name]) for name in _NUMBERS}
        self._simulated = float(table.simulated_range.min())

    def a_v_at(self, hurst, pressure, range_over_h_rms, magnification=np.inf) -> AvEstimate:
        """a_V of a self-affine surface without roll-off; ValueError outside the table.

        The pressure is the mean one over E* q0 h_rms, the magnification q1/q0.
        """
        given = (hurst, magnification, pressure, range_over_h_rms)
        given = np.broadcast_arrays(*(np.asarray(x, dtype=float) for x in given))
        for name, values in zip(_AXES, given, strict=True):
            self._check(name, values)
        h, zeta, p, eps = (x.ravel() for x in given)
        at, broad = np.array([h, np.log(zeta), np.log(p), np.log(eps)]), np.isinf(zeta)
        # ln a_V, reach of the other theories below and above, and whether below the edge range
        found = np.zeros((4, h.size))
        if broad.any():
            found[:3, broad] = self._look_up(*at[[0, 2, 3]][:, broad], ending="_limit")
        if not broad.all():
            found[:, ~broad] = self._look_up_finite(*at[:, ~broad])
        logs, below, above, edge = found
        where = at[2:].T
        trend = self._trend(where[:, 1:])
        ends = self._known["smallest_magnification"], self._known["largest_magnification"]
        least, most = np.log2(ends)
        held = np.clip(np.log2(zeta), least, most) - most
        value = np.exp(logs + self._ratio(where) + trend * held)
        # The ratio has a limit, because simulation and theory both converge. Its trend does not
        # level off where it was simulated; it is taken to go on for half as many doublings.
        unseen = np.clip(np.log2(zeta) - most, 0, (most - least) / 2)
        simulation = np.hypot(self._ratio_error(where), trend * unseen)
        # Below the simulated ranges theory and simulation follow the same power laws, self-affine
        # scaling and then the 3/2 law of the gap next to edges. Their ratio therefore has no trend,
        # but from one simulated decade to the next its drift changes size, and at small loads sign:
        # a step a decade.
        decades = np.clip(np.log10(self._simulated / eps), 0, None)
        simulation = np.hypot(simulation, self._known["extrapolation_error"] * np.sqrt(decades))
        others = (NORMAL_90 * simulation) ** 2 + self._known["quadrature_error"] ** 2
        low = value * np.exp(-np.sqrt(below**2 + others))
        high = value * np.exp(np.sqrt(above**2 + others))
        parts = value, low, high, below, above, simulation, edge.astype(bool)
        return AvEstimate(*(part.reshape(given[0].shape)[()] for part in parts))

    def _look_up(self, *at, ending=""):
        names = ("a_v", "theory_below", "theory_above")
        return [self._theory[f"{name}{ending}"](np.stack(at, axis=-1)) for name in names]

    def _look_up_finite(self, h, log_zeta, log_p, log_eps):
        log_edge = self._theory["edge_range"](np.stack([h, log_zeta, log_p], axis=-1))
        edge = log_eps < log_edge
        held = np.clip(np.where(edge, log_edge, log_eps), None, np.log(self.bounds["range"][1]))
        logs, below, above = self._look_up(h, log_zeta, log_p, held)
        # The variants part here by definition; another estimate of what edges give takes over.
        other = self._theory["edge_a_v"](np.stack([h, log_zeta], axis=-1)) - logs
        below = np.where(edge, np.maximum(-other, 0), below)
        above = np.where(edge, np.maximum(other, 0), above)
        return logs, below, above, edge

    def _check(self, name: str, values: NDArray) -> None:
        low, high = self.bounds[name]
        inside = (values >= low * (1 - 1e-9)) & (values <= high * (1 + 1e-9))
        infinite = ""
        if name == "magnification":
            infinite, inside = " or infinite", inside | np.isposinf(values)
        if not inside.all():
            raise ValueError(
                f"{name} must lie between {low:g} and {high:g}{infinite}, where a_V is "
                f"tabulated, got {values[~inside].flat[0]:g}"
            )


def _interpolate(table: xr.DataArray, method: str = "linear") -> RegularGridInterpolator:
    """Interpolator along those of `_AXES` that the table has, all but hurst as logarithms."""
    axes = [name for name in _AXES if name in table.dims]
    grid = [table[name].values.astype(float) for name in axes]
    grid = [x if name == "hurst" else np.log(x) for name, x in zip(axes, grid, strict=True)]
    # Points within rounding of an end count as inside; a_v_at has checked the rest.
    return RegularGridInterpolator(
        grid, table.transpose(*axes).values, method, bounds_error=False, fill_value=None
    )


def _hold(table: xr.DataArray) -> Callable[[NDArray], NDArray]:
    """Linear between simulated loads and ranges, or ranges alone, held constant beyond them."""
    names = {"simulated_pressure": "pressure", "simulated_range": "range"}
    interpolator = _interpolate(table.rename({n: x for n, x in names.items() if n in table.dims}))
    low, high = (np.array([end(x) for x in interpolator.grid]) for end in (np.min, np.max))
    return lambda at: interpolator(np.clip(at, low, high))
