"""a_V of a surface against the range of attraction, by Persson's theory on its spectrum."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.criteria.a_v_table import edge_range, local_a_v
from stickiness.persson.theory import Persson
from stickiness.surfaces.spectrum import Spectrum

VARIANTS = ("afferrante2018", "almqvist2011")  # P(0) infinite and finite: limits on the truth
EDGE_LAW = "pastewka_robbins"  # independent estimate of what the edges alone give


@dataclass(frozen=True)
class SurfaceAv:
    """a_V of a surface against the range, with limits.

    Attributes
    ----------
    ranges : (n,) array
        Ranges over h_rms, increasing.
    theory : (m, n) array
        a_V by every variant of the theory and by the edge law below the edge range.
    quoted : int
        Which of them is quoted; the others are limits.
    ratio : float
        Ratio of simulation to theory, by which all are multiplied.
    relative_error : float
        Error of that ratio, which widens the limits.
    """

    ranges: NDArray
    theory: NDArray
    quoted: int
    ratio: float
    relative_error: float

    def at(self, range_over_h_rms: float) -> tuple[float, float, float]:
        """Value, low and high limit at a range over h_rms, interpolated in logarithms."""
        logs = [
            np.interp(np.log(range_over_h_rms), np.log(self.ranges), np.log(a)) for a in self.theory
        ]
        every = self.ratio * np.exp(logs)
        return (
            float(every[self.quoted]),
            float(every.min() * max(1 - self.relative_error, 0.01)),
            float(every.max() * (1 + self.relative_error)),
        )


def theory_a_v(
    spectrum: Spectrum,
    ranges: ArrayLike,
    pressure: float,
    edge_a_v: float,
    *,
    q0: float | None = None,
    gamma: float = 0.45,
) -> tuple[list[str], list[NDArray], float]:
    """a_V by both variants of Persson's theory and by the edge law.

    Parameters
    ----------
    spectrum : Spectrum
    ranges : (n,) array
        Ranges over h_rms, increasing.
    pressure : float
        Mean pressure over E* q0 h_rms.
    edge_a_v : float
        a_V of the edges by the edge law, see `formulas.pastewka_robbins_a_v`.
    q0 : float, optional
        Lowest wave number [1/length] in the load; that of the spectrum by default.
    gamma : float
        Correction of the theory's elastic energy.

    Returns
    -------
    names : list of str
        `VARIANTS` and `EDGE_LAW`.
    a_v : list of (n,) arrays
        Below the edge range the variants are held constant, and the edge law takes its own value.
    edge_range : float
        Over h_rms, see `a_v_table.edge_range`.
    """
    ranges = np.asarray(ranges, dtype=float)
    h_rms, q0 = spectrum.h_rms, float(spectrum.q0 if q0 is None else q0)
    resolved = [
        local_a_v(
            Persson(spectrum, variant=variant, gamma=gamma).gap_cumulative(
                ranges * h_rms, pressure * q0 * h_rms
            ),
            pressure,
            ranges,
        )
        for variant in VARIANTS
    ]
    edge = edge_range(ranges, *resolved)
    at_edge = np.exp(np.interp(np.log(edge), np.log(ranges), np.log(resolved[0])))
    a_v = [np.where(ranges < edge, at_edge, a) for a in resolved]
    a_v.append(np.where(ranges < edge, edge_a_v, a_v[0]))
    return [*VARIANTS, EDGE_LAW], a_v, edge
