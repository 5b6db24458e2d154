"""All stickiness criteria: name, margin, threshold, reason and line in figure 9, in one table.

To add a criterion, write its function and give it an entry in `CRITERIA`. Verdicts, thresholds,
pages and figure 9 read this table.
"""

from __future__ import annotations

import string
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from stickiness.criteria import formulas
from stickiness.criteria.pair import Pair

EDGES = "edge_adhesion"
FULL_CONTACT = "persson_tosatti"
FACTS = frozenset(  # what a reason can quote of a pair, as texts with units
    (
        "attractive_over_contact",
        "edge_strength",
        "regime",
        "over_dmt",
        "h_rms",
        "q0",
        "rms_slope",
        "rms_curvature",
        "summit_radius",
        "energy",
        "work_of_adhesion",
        "modulus",
        "a_v",
        "constant_a_v",
    )
)


@dataclass(frozen=True)
class Line:
    """Line of a criterion in figure 9.

    Attributes
    ----------
    colour : str
        Name of a colour of the palette.
    style : str
        As matplotlib has it.
    width : float
        [pt].
    filled : bool
        Whether its symbols are filled.
    """

    colour: str = "grey"
    style: str = "-"
    width: float = 1.4
    filled: bool = True


@dataclass(frozen=True)
class Criterion:
    """One criterion. It has exactly one of `power`, `length` and `modulus`.

    Attributes
    ----------
    name, label : str
        In datasets, and for people.
    margin : function of a `Pair`
        Threshold over actual value in the criterion's own form; sticky above 1.
    reason : str
        What the criterion looks at, a template for `str.format` with the names in `FACTS`.
    power : float, optional
        Power of the adhesion length that the margin is proportional to.
    length : function of a `Pair`, optional
        Adhesion length [m] above which the pair sticks, of a margin that is no power of it.
    modulus : float, optional
        Modulus [Pa] below which everything sticks, of a criterion without adhesion length.
    line : Line
        Look in figure 9.

    Raises
    ------
    ValueError
        If a name, label or reason is empty, if the reason quotes a fact that is not in `FACTS`, or
        if there is not exactly one threshold.
    """

    name: str
    label: str
    margin: Callable[[Pair], NDArray]
    reason: str
    power: float | None = None
    length: Callable[[Pair], NDArray] | None = None
    modulus: float | None = None
    line: Line = Line()

    def __post_init__(self):
        for entry in ("name", "label", "reason"):
            if not getattr(self, entry):
                raise ValueError(f"criterion {self.name!r} has no {entry}")
        quoted = {field for _, field, _, _ in string.Formatter().parse(self.reason) if field}
        if unknown := sorted(quoted - FACTS):
            raise ValueError(
                f"reason of criterion {self.name!r} quotes {unknown[0]!r}; facts of a pair are "
                f"{', '.join(sorted(FACTS))}"
            )
        given = [x for x in ("power", "length", "modulus") if getattr(self, x) is not None]
        if len(given) != 1:
            raise ValueError(
                f"criterion {self.name!r} needs exactly one of power, length and modulus for its "
                f"threshold, got {', '.join(given) or 'none'}"
            )

    @property
    def has_length(self) -> bool:
        """Whether there is an adhesion length above which the criterion says sticky."""
        return self.modulus is None

    def adhesion_length_threshold(self, pair: Pair) -> NDArray:
        """Adhesion length [m] above which the pair sticks."""
        if self.length is not None:
            return self.length(pair)
        if self.power is None:
            raise ValueError(f"criterion {self.name!r} knows no adhesion length")
        return pair.adhesion_length * self.margin(pair) ** (-1 / self.power)

    def modulus_threshold(self, pair: Pair) -> NDArray:
        """Plane-strain modulus [Pa] below which the pair sticks."""
        if self.modulus is not None:
            return np.full_like(pair.work_of_adhesion, self.modulus, dtype=float)
        return pair.work_of_adhesion / self.adhesion_length_threshold(pair)


def _violano(pair):
    at = pair.h_rms, pair.q0, pair.adhesion_length, pair.range
    return formulas.violano(*at, pair.a_v).margin


def _violano_constant(pair):
    at = pair.h_rms, pair.q0, pair.adhesion_length, pair.range
    return formulas.violano(*at, pair.constant_a_v).margin


def _violano_printed(pair):
    at = pair.h_rms, pair.q0, pair.adhesion_length, pair.range
    return formulas.violano_printed(*at).margin


def _pastewka_robbins(pair):
    at = pair.rms_slope, pair.rms_curvature, pair.adhesion_length, pair.range
    return formulas.pastewka_robbins(*at).margin


def _bearing_area(pair):
    at = pair.h_rms, pair.q0, pair.adhesion_length, pair.range
    return formulas.bearing_area(*at).margin


CRITERIA = {
    criterion.name: criterion
    for criterion in (
        Criterion(
            EDGES,
            "edges of contact",
            margin=lambda pair: pair.attraction().ratio,
            length=lambda pair: pair.edge_threshold(pair.a_v),
            reason="The attractive area is {attractive_over_contact} of the contact area. The "
            "Tabor parameter of the edges is {edge_strength} ({regime}). The attraction is "
            "{over_dmt} times that of the DMT limit.",
            line=Line("red", "-", 2.2),
        ),
        Criterion(
            "violano",
            "derived (DMT limit)",
            margin=_violano,
            power=3 / 5,
            reason="h_rms = {h_rms}, q0 = {q0}/m and a_V = {a_v}. Long waves set the repulsion; "
            "the attraction acts over the gaps of contact without adhesion.",
            line=Line("black", "-", 1.2),
        ),
        Criterion(
            "violano_constant",
            "derived (constant a_V)",
            margin=_violano_constant,
            power=3 / 5,
            reason="The same with a_V = {constant_a_v} of a broad spectrum instead of {a_v}.",
            line=Line("black", "-.", 1.2, filled=False),
        ),
        Criterion(
            "violano_printed",
            "derived (9/4 as printed)",
            margin=_violano_printed,
            power=3 / 5,
            reason=f"The same with a_V = {formulas.PRINTED_A_V:g} instead of {{a_v}}.",
            line=Line("black", ":", 1.2, filled=False),
        ),
        Criterion(
            "pastewka_robbins",
            "Pastewka–Robbins",
            margin=_pastewka_robbins,
            power=5 / 6,  # the width of the attraction grows with the root of l_a
            reason="Slope {rms_slope} and curvature {rms_curvature}/m, which the shortest waves "
            "set. Neither h_rms nor q0 matters.",
            line=Line("blue", "--"),
        ),
        Criterion(
            "fuller_tabor",
            "Fuller–Tabor",
            margin=lambda pair: (
                formulas.fuller_tabor(pair.h_rms, pair.rms_curvature, pair.adhesion_length).margin
            ),
            power=1.0,
            reason="h_rms = {h_rms} against asperities of radius {summit_radius}, which the "
            "shortest waves set.",
            line=Line("green", "--"),
        ),
        Criterion(
            "bearing_area",
            "bearing area (BAM)",
            margin=_bearing_area,
            power=1.0,
            reason="Heights within the range of the mean plane attract: h_rms = {h_rms} and q0 = "
            "{q0}/m. Finer waves do not matter.",
            line=Line("orange", "-"),
        ),
        Criterion(
            FULL_CONTACT,
            "Persson–Tosatti",
            margin=lambda pair: (
                formulas.persson_tosatti(pair.elastic_energy, pair.adhesion_length).margin
            ),
            power=1.0,
            reason="Full contact costs the energy {energy} and gains the work of adhesion "
            "{work_of_adhesion}. Contact need not be full to stick.",
            line=Line("purple", "-."),
        ),
        Criterion(
            "dahlquist",
            "Dahlquist",
            margin=lambda pair: formulas.dahlquist(pair.modulus).margin,
            modulus=formulas.DAHLQUIST_LIMIT,
            reason="E* = {modulus} at 1 Hz against 1 MPa. The criterion considers no roughness at "
            "all.",
            line=Line("grey", "-", 1.0),
        ),
    )
}
