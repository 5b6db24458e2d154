"""All stickiness criteria: name, margin, threshold, reason and line in figure 9, in one table.

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
class Line:
    """Line of a criterion in figure 9."""

    colour: str = "grey"  #: name in the palette
    style: str = "-"  #: as matplotlib has it
    width: float = 1.4  #: [pt]
    filled: bool = True  #: whether its symbols are


@dataclass(frozen=True)
class Criterion:
    """One criterion; its threshold follows from one of `power`, `length` and `modulus`."""

    name: str  #: in datasets
    label: str  #: for people
    #: threshold over actual value in the criterion's usual form; sticky above 1
    margin: Callable[[Pair], float | NDArray]
    reason: str  #: what it looks at, for `str.format` with the facts of a pair on its page
    power: float | None = None  #: of the adhesion length, that the margin is proportional to
    #: adhesion length [m] above which the pair sticks, of a margin that is no power of it
    length: Callable[[Pair], float | NDArray] | None = None
    #: [Pa] below which everything sticks, of a criterion without adhesion length
    modulus: float | None = None
    line: Line = Line()  #: in figure 9

    @property
    def has_length(self) -> bool:
        """Whether there is an adhesion length above which the criterion says sticky."""
        return self.modulus is None

    def adhesion_length_threshold(self, pair: Pair) -> float | NDArray:
        """Adhesion length [m] above which the pair sticks."""
        if self.length is not None:
            return self.length(pair)
        return pair.adhesion_length * self.margin(pair) ** (-1 / self.power)

    def modulus_threshold(self, pair: Pair) -> NDArray:
        """Plane-strain modulus [Pa] below which the pair sticks."""
        if self.modulus is not None:
            return np.full_like(pair.work_of_adhesion, self.modulus, dtype=float)
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
        margin=lambda pair: pair.adhesion_length / pair.remaining_threshold(),
        length=Pair.remaining_threshold,
        reason="{remaining} the work of adhesion remains; {wanted} is wanted. Full contact "
        "would cost {energy} against the work of adhesion of {work_of_adhesion}.",
        line=Line("red", "-", 2.2),
    ),
    Criterion(
        EDGES,
        "onset at the finest wave",
        margin=lambda pair: pair.edges.ratio,
        length=Pair.edge_threshold,
        reason="Above 1 contact grows by itself at the finest wave, which is not to say that it "
        "holds. The attractive area is {attractive_over_contact} of the contact area. The "
        "Tabor parameter of the edges is {edge_strength} ({regime}). The attraction is "
        "{over_dmt} times its DMT sum at equal area of contact.",
        line=Line("red", "--", 1.2, filled=False),
    ),
    Criterion(
        "violano",
        "derived (DMT sum)",
        margin=_margin_of(formulas.violano, *_HEIGHTS, "a_v"),
        power=3 / 5,
        reason="h_rms = {h_rms}, q0 = {q0}/m and a_V = {a_v}. Long waves set the repulsion; "
        "the attraction acts over the gaps of contact without adhesion.",
        line=Line("black", "-", 1.2),
    ),
    Criterion(
        "violano_constant",
        "derived (constant a_V)",
        margin=_margin_of(formulas.violano, *_HEIGHTS, "constant_a_v"),
        power=3 / 5,
        reason="The same with a_V = {constant_a_v}, as the paper has it, instead of {a_v}.",
        line=Line("black", "-.", 1.2, filled=False),
    ),
    Criterion(
        "violano_printed",
        "derived (9/4 as printed)",
        margin=_margin_of(formulas.violano_printed, *_HEIGHTS),
        power=3 / 5,
        reason=f"The same with a_V = {formulas.PRINTED_A_V:g} instead of {{a_v}}.",
        line=Line("black", ":", 1.2, filled=False),
    ),
    Criterion(
        "pastewka_robbins",
        "Pastewka–Robbins",
        margin=_margin_of(formulas.pastewka_robbins, *_SLOPES),
        power=5 / 6,  # the width of the attraction grows with the root of l_a
        reason="Slope {rms_slope} and curvature {rms_curvature}/m, which the shortest waves "
        "set. Neither h_rms nor q0 matters.",
        line=Line("blue", "--"),
    ),
    Criterion(
        "fuller_tabor",
        "Fuller–Tabor",
        margin=_margin_of(formulas.fuller_tabor, "h_rms", "rms_curvature", "adhesion_length"),
        power=1.0,
        reason="h_rms = {h_rms} against asperities of radius {summit_radius}, which the "
        "shortest waves set.",
        line=Line("green", "--"),
    ),
    Criterion(
        "bearing_area",
        "bearing area (BAM)",
        margin=_margin_of(formulas.bearing_area, *_HEIGHTS),
        power=1.0,
        reason="Heights within the range of the mean plane attract: h_rms = {h_rms} and q0 = "
        "{q0}/m. Finer waves do not matter.",
        line=Line("orange", "-"),
    ),
    Criterion(
        FULL_CONTACT,
        "Persson–Tosatti",
        margin=_margin_of(formulas.persson_tosatti, "elastic_energy", "adhesion_length"),
        power=1.0,
        reason="Full contact costs the energy {energy} and gains the work of adhesion "
        "{work_of_adhesion}. Contact need not be full to stick.",
        line=Line("purple", "-."),
    ),
    Criterion(
        "dahlquist",
        "Dahlquist",
        margin=_margin_of(formulas.dahlquist, "modulus"),
        modulus=formulas.DAHLQUIST_LIMIT,
        reason="E* = {modulus} against 1 MPa, meant at 1 Hz. The criterion considers no roughness.",
        line=Line("grey", "-", 1.0),
    ),
)
CRITERIA = {criterion.name: criterion for criterion in _TABLE}
