"""a_V of a spectrum by Persson's theory, with its error.

A_ad/A_nom = (3/2) a_V p/(E* q0 h_rms) (range/h_rms)^(2/3) defines a local a_V at every range, for
theory does not have it constant. Between the finest scale and the rms height it goes as
range^((3-5H)/(3H)) for H > 1/2; next to the edges of contact, where gaps grow by their 3/2 law, it
does not depend on the range. There the variants of the theory part, see `edge_range`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import plain, positive
from stickiness.criteria.formulas import pastewka_robbins_a_v
from stickiness.persson.theory import Persson, Variant
from stickiness.spectrum.interface import Spectrum

PARTED = 1.5  #: ratio of the theory's variants from which on neither resolves the edges of contact
VARIANTS = get_args(Variant)  #: P(0) infinite and finite: limits on the truth
LOAD = 0.065  #: mean pressure over E* q0 h_rms, amid those where area grows with load in proportion
RANGES = np.geomspace(1e-14, 10, 61)  #: over h_rms, where theory's a_V is evaluated
# Relative, of theory's a_V against simulation: the error model of config/accuracy.csv at this load,
# doubled as for all spectra broader than those measured.
THEORY_ERROR = 0.25


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


def surface_a_v(spectrum: Spectrum, known: dict[str, float], load: float = LOAD) -> SurfaceAv:
    """a_V of a spectrum at every range, by both variants of Persson's theory and by the edge law.

    `known` has q0 and the moments, `load` is over E* q0 h_rms. Below the edge range, where the
    variants part, they are held constant, and Pastewka and Robbins' estimate is the edge law.
    """
    # By theory.
    theory = Persson(spectrum)
    h_rms = spectrum.h_rms
    pressure = load * float(known["q0"]) * h_rms
    by_variant = []
    for variant in VARIANTS:
        area = theory.with_variant(variant).gap_cumulative(RANGES * h_rms, pressure)
        by_variant.append(local_a_v(area, load, RANGES))
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
