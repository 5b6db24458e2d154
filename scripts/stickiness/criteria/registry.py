"""All stickiness criteria: name, margin and threshold, in one table.

To add a criterion, write its function and give it an entry here. Verdicts, thresholds, pages and
figure 9 read this table.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from stickiness.criteria import formulas
from stickiness.criteria.pair import Pair

REMAINING = "remaining_adhesion"  #: that verdicts rest on
EDGES = "edge_adhesion"
FULL_CONTACT = "persson_tosatti"


@dataclass(frozen=True)
class Criterion:
    """One criterion; its threshold follows from one of `power`, `length` and `modulus`."""

    name: str  #: in datasets
    label: str  #: for people
    #: threshold over actual value in the criterion's usual form; sticky above 1
    margin: Callable[[Pair], float | NDArray]
    power: float | None = None  #: of the adhesion length, that the margin is proportional to
    #: adhesion length [m] above which the pair sticks, of a margin that is no power of it
    length: Callable[[Pair], float | NDArray] | None = None
    #: [Pa] below which everything sticks, of a criterion without adhesion length
    modulus: float | None = None

    @property
    def has_length(self) -> bool:
        """Whether there is an adhesion length above which the criterion says sticky."""
        return self.modulus is None

    def adhesion_length_threshold(self, pair: Pair) -> float | NDArray:
        """Adhesion length [m] above which the pair sticks."""
        if self.length is not None:
            return self.length(pair)
        return pair.adhesion_length * self.margin(pair) ** (-1 / self.power)

    def modulus_threshold(self, pair: Pair) -> float | NDArray:
        """Plane-strain modulus [Pa] below which the pair sticks."""
        if self.modulus is not None:
            return np.full_like(pair.work_of_adhesion, self.modulus, dtype=float)
        with np.errstate(divide="ignore"):  # infinite, if any adhesion makes the pair stick
            return pair.work_of_adhesion / self.adhesion_length_threshold(pair)


def _margin_of(formula: Callable, *names: str) -> Callable[[Pair], NDArray]:
    """Margin of a pair by a formula of these of its numbers."""
    return lambda pair: formula(*(getattr(pair, name) for name in names)).margin


_HEIGHTS = ("h_rms", "q0", "adhesion_length", "range")
_SLOPES = ("rms_slope", "rms_curvature", "adhesion_length", "range")

_TABLE = (
    Criterion(
        REMAINING,
        "remaining adhesion",
        margin=lambda pair: pair.adhesion_length / pair.remaining_threshold,
        length=lambda pair: pair.remaining_threshold,
    ),
    Criterion(
        EDGES,
        "onset at the finest wave",
        margin=lambda pair: pair.edges.ratio,
        length=Pair.edge_threshold,
    ),
    Criterion(
        "violano",
        "derived (DMT sum)",
        margin=_margin_of(formulas.violano, *_HEIGHTS, "a_v"),
        power=3 / 5,
    ),
    Criterion(
        "violano_constant",
        "derived (constant a_V)",
        margin=_margin_of(formulas.violano, *_HEIGHTS, "constant_a_v"),
        power=3 / 5,
    ),
    Criterion(
        "violano_printed",
        "derived (9/4 as printed)",
        margin=_margin_of(formulas.violano_printed, *_HEIGHTS),
        power=3 / 5,
    ),
    Criterion(
        "pastewka_robbins",
        "Pastewka–Robbins",
        margin=_margin_of(formulas.pastewka_robbins, *_SLOPES),
        power=5 / 6,  # the width of the attraction grows with the root of l_a
    ),
    Criterion(
        "fuller_tabor",
        "Fuller–Tabor",
        margin=_margin_of(formulas.fuller_tabor, "h_rms", "rms_curvature", "adhesion_length"),
        power=1.0,
    ),
    Criterion(
        "bearing_area",
        "bearing area (BAM)",
        margin=_margin_of(formulas.bearing_area, *_HEIGHTS),
        power=1.0,
    ),
    Criterion(
        FULL_CONTACT,
        "Persson–Tosatti",
        margin=_margin_of(formulas.persson_tosatti, "elastic_energy", "adhesion_length"),
        power=1.0,
    ),
    Criterion(
        "dahlquist",
        "Dahlquist",
        margin=_margin_of(formulas.dahlquist, "modulus"),
        modulus=formulas.DAHLQUIST_LIMIT,
    ),
)
CRITERIA = {criterion.name: criterion for criterion in _TABLE}
