"""a_V by Persson's theory: of a spectrum, and tabulated for self-affine surfaces, with its error.

A_ad/A_nom = (3/2) a_V p/(E* q0 h_rms) (range/h_rms)^(2/3) defines a local a_V at every range, for
theory does not have it constant. Between the finest scale and the rms height it goes as
range^((3-5H)/(3H)) for H > 1/2; next to the edges of contact, where gaps grow by their 3/2 law, it
does not depend on the range. There the variants of the theory part, see `edge_range`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, get_args

import numpy as np
import scipy
import xarray as xr
from numpy.typing import ArrayLike, NDArray
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
_NUMBERS = (
    "smallest_magnification",
    "largest_magnification",
    "quadrature_error",
    "extrapolation_error",
)
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
    # Between two ranges the ratio is a power law.
    fraction = logs[last] / (logs[last] - logs[last + 1])
    start, end = np.log(ranges[last : last + 2])
    return float(np.exp(start + fraction * (end - start)))


@dataclass(frozen=True)
class SurfaceAv:
    """a_V of a surface against the range, with limits."""

    ranges: NDArray  #: (n,), over h_rms, increasing
    #: (m, n), a_V by every variant of the theory and by the edge law below the edge range; the
    #: first is quoted, the others are limits
    theory: NDArray
    relative_error: float  #: of theory against simulation; widens the limits

    def at(self, range_over_h_rms: ArrayLike) -> tuple[float | NDArray, ...]:
        """Value, low and high limit at ranges over h_rms, interpolated in logarithms."""
        log_range = np.log(range_over_h_rms)
        log_ranges = np.log(self.ranges)
        estimates = np.exp([np.interp(log_range, log_ranges, np.log(a_v)) for a_v in self.theory])
        low = estimates.min(axis=0) * max(1 - self.relative_error, 0.01)
        high = estimates.max(axis=0) * (1 + self.relative_error)
        return plain(estimates[0]), plain(low), plain(high)


def surface_a_v(spectrum: Spectrum, known: dict[str, float]) -> SurfaceAv:
    """a_V of a spectrum at every range, by both variants of Persson's theory and by the edge law.

    `known` has q0 and the moments. Below the edge range, where the variants part, they are held
    constant, and Pastewka and Robbins' estimate is the edge law.
    """
    # By theory.
    theory = Persson(spectrum)
    h_rms = spectrum.h_rms
    load = LOAD * float(known["q0"]) * h_rms
    by_variant = []
    for variant in VARIANTS:
        area = theory.with_variant(variant).gap_cumulative(RANGES * h_rms, load)
        by_variant.append(local_a_v(area, LOAD, RANGES))
    quoted, other = by_variant

    # Next to the edges of contact.
    edge = edge_range(RANGES, infinite=quoted, finite=other)
    is_edge = edge > RANGES
    at_edge = np.exp(np.interp(np.log(edge), np.log(RANGES), np.log(quoted)))
    edge_law = pastewka_robbins_a_v(
        q0=known["q0"],
        h_rms=known["h_rms"],
        rms_slope=known["rms_slope"],
        rms_curvature=known["rms_curvature"],
    )
    quoted = np.where(is_edge, at_edge, quoted)
    other = np.where(is_edge, at_edge, other)
    by_edge_law = np.where(is_edge, float(edge_law), quoted)
    return SurfaceAv(RANGES, np.array([quoted, other, by_edge_law]), THEORY_ERROR)


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


class _Theory(NamedTuple):
    """a_V by theory at `n` points; see `AvEstimate`."""

    log_a_v: NDArray
    below: NDArray
    above: NDArray
    edge: NDArray

    def put(self, chosen: NDArray, values: _Theory) -> None:
        """Put in the values of some points."""
        for column, part in zip(self, values, strict=True):
            column[chosen] = part


class AvTable:
    """Interpolates the file ``fits/a_v_table.nc``, with the variables `NEEDED`, in logarithms.

    The error of the interpolation is below 3 % (0.5 % root mean square).
    """

    def __init__(self, table: xr.Dataset):
        #: ends of hurst, magnification, pressure and range (over h_rms) in the table
        self.bounds = {name: (float(table[name].min()), float(table[name].max())) for name in _AXES}
        logarithms = table[list(_CUBIC)].map(np.log)
        self._theory = {name: _interpolate(logarithms[name], "cubic") for name in _CUBIC}
        self._theory |= {name: _interpolate(table[name]) for name in _LINEAR}
        self._ratio = _hold(np.log(table.simulation_ratio))
        self._ratio_error = _hold(table.simulation_error)
        self._trend = _hold(table.simulation_trend)
        self._numbers = {name: float(table[name]) for name in _NUMBERS}
        self._simulated = float(table.simulated_range.min())

    def a_v_at(self, hurst, pressure, range_over_h_rms, magnification=np.inf) -> AvEstimate:
        """a_V of a self-affine surface without roll-off; ValueError outside the table.

        The pressure is the mean one over E* q0 h_rms, the magnification q1/q0.
        """
        h, zeta, p, eps = np.broadcast_arrays(
            np.asarray(hurst, dtype=float),
            np.asarray(magnification, dtype=float),
            np.asarray(pressure, dtype=float),
            np.asarray(range_over_h_rms, dtype=float),
        )
        shape = h.shape
        for name, values in zip(_AXES, (h, zeta, p, eps), strict=True):
            self._check(name, values)
        h = h.ravel()
        zeta = zeta.ravel()
        log_p = np.log(p.ravel())
        log_eps = np.log(eps.ravel())

        # By theory; spectra without an end have tables of their own.
        theory = _Theory(np.zeros(h.size), np.zeros(h.size), np.zeros(h.size), np.zeros(h.size))
        broad = np.isinf(zeta)
        finite = ~broad
        if broad.any():
            position = np.stack([h[broad], log_p[broad], log_eps[broad]], axis=-1)
            theory.put(broad, self._look_up(position, ending="_limit"))
        if finite.any():
            log_zeta = np.log(zeta[finite])
            theory.put(
                finite, self._look_up_finite(h[finite], log_zeta, log_p[finite], log_eps[finite])
            )

        # By simulation over theory.
        load_and_range = np.stack([log_p, log_eps], axis=-1)
        trend = self._trend(log_eps[:, None])
        least = np.log2(self._numbers["smallest_magnification"])
        most = np.log2(self._numbers["largest_magnification"])
        doublings = np.clip(np.log2(zeta), least, most) - most
        value = np.exp(theory.log_a_v + self._ratio(load_and_range) + trend * doublings)
        # The ratio has a limit, because simulation and theory both converge. Its trend does not
        # level off where it was simulated; it is taken to go on for half as many doublings.
        unseen = np.clip(np.log2(zeta) - most, 0, (most - least) / 2)
        simulation = np.hypot(self._ratio_error(load_and_range), trend * unseen)
        # Below the simulated ranges theory and simulation follow the same power laws, self-affine
        # scaling and then the 3/2 law of the gap next to edges. Their ratio therefore has no trend,
        # but from one simulated decade to the next its drift changes size, and at small loads sign:
        # a step a decade.
        decades = np.clip(np.log10(self._simulated / eps.ravel()), 0, None)
        drift = self._numbers["extrapolation_error"] * np.sqrt(decades)
        simulation = np.hypot(simulation, drift)

        other_errors = (NORMAL_90 * simulation) ** 2 + self._numbers["quadrature_error"] ** 2
        low = value * np.exp(-np.sqrt(theory.below**2 + other_errors))
        high = value * np.exp(np.sqrt(theory.above**2 + other_errors))
        return AvEstimate(
            value=value.reshape(shape)[()],
            low=low.reshape(shape)[()],
            high=high.reshape(shape)[()],
            theory_below=theory.below.reshape(shape)[()],
            theory_above=theory.above.reshape(shape)[()],
            simulation=simulation.reshape(shape)[()],
            edge=theory.edge.astype(bool).reshape(shape)[()],
        )

    def _look_up(self, position: NDArray, ending: str = "") -> _Theory:
        """Theory at points `(n, axis)` of a table."""
        return _Theory(
            log_a_v=self._theory[f"a_v{ending}"](position),
            below=self._theory[f"theory_below{ending}"](position),
            above=self._theory[f"theory_above{ending}"](position),
            edge=np.zeros(len(position)),
        )

    def _look_up_finite(self, h, log_zeta, log_p, log_eps) -> _Theory:
        """Theory at finite magnifications, held constant below the edge range."""
        log_edge = self._theory["edge_range"](np.stack([h, log_zeta, log_p], axis=-1))
        edge = log_eps < log_edge
        log_resolved = np.clip(
            np.where(edge, log_edge, log_eps), None, np.log(self.bounds["range"][1])
        )
        theory = self._look_up(np.stack([h, log_zeta, log_p, log_resolved], axis=-1))
        # The variants part here by definition; another estimate of what edges give takes over.
        log_ratio = self._theory["edge_a_v"](np.stack([h, log_zeta], axis=-1)) - theory.log_a_v
        return _Theory(
            log_a_v=theory.log_a_v,
            below=np.where(edge, np.maximum(-log_ratio, 0), theory.below),
            above=np.where(edge, np.maximum(log_ratio, 0), theory.above),
            edge=edge,
        )

    def _check(self, name: str, values: NDArray) -> None:
        low, high = self.bounds[name]
        inside = (values >= low * (1 - 1e-9)) & (values <= high * (1 + 1e-9))
        infinite = ""
        if name == "magnification":
            infinite = " or infinite"
            inside = inside | np.isposinf(values)
        if not inside.all():
            raise ValueError(
                f"{name} must lie between {low:g} and {high:g}{infinite}, where a_V is "
                f"tabulated, got {values[~inside].flat[0]:g}"
            )


def _interpolate(
    table: xr.DataArray, method: str = "linear"
) -> scipy.interpolate.RegularGridInterpolator:
    """Interpolator along those of `_AXES` that the table has, all but hurst as logarithms."""
    axes = [name for name in _AXES if name in table.dims]
    grid = [table[name].values.astype(float) for name in axes]
    grid = [x if name == "hurst" else np.log(x) for name, x in zip(axes, grid, strict=True)]
    # Points within rounding of an end count as inside; a_v_at has checked the rest.
    return scipy.interpolate.RegularGridInterpolator(
        grid, table.transpose(*axes).values, method, bounds_error=False, fill_value=None
    )


def _hold(table: xr.DataArray) -> Callable[[NDArray], NDArray]:
    """Linear between simulated loads and ranges, or ranges alone, held constant beyond them."""
    names = {"simulated_pressure": "pressure", "simulated_range": "range"}
    interpolator = _interpolate(table.rename({n: x for n, x in names.items() if n in table.dims}))
    low = np.array([np.min(axis) for axis in interpolator.grid])
    high = np.array([np.max(axis) for axis in interpolator.grid])
    return lambda position: interpolator(np.clip(position, low, high))
