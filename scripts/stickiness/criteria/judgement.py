"""The judgement on pairs of material and surface, for numbers or arrays.

`QUANTITIES` is the one list of what is said of a pair. To add a quantity, give it an entry:
`judge` computes it, and the stages write it to their files with its unit and its description.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.criteria import formulas
from stickiness.criteria.pair import Pair, classify_edges
from stickiness.criteria.registry import CRITERIA
from stickiness.remaining.prediction import Roughness

SIGNS = {"": 0, "_low": -1, "_high": 1}  #: value, low and high limit, by the ending of a name


@dataclass(frozen=True)
class Quantity:
    """One quantity of a pair."""

    find: Callable[[Pair], ArrayLike]
    units: str
    long_name: str


def _with_limits(name, find, units, long_name, signs=SIGNS) -> dict[str, Quantity]:
    """Value and limits of a quantity; `find` takes a pair and a sign as `Pair.remaining` does."""
    return {
        f"{name}{ending}": Quantity(
            lambda pair, sign=sign: find(pair, sign),
            units,
            f"{long_name}, {ending[1:]} limit of the model" if ending else long_name,
        )
        for ending, sign in signs.items()
    }


QUANTITIES = {
    **_with_limits("remaining", Pair.remaining, "1", "share of the work of adhesion that remains"),
    **_with_limits("pull_off", Pair.pull_off, "Pa", "largest mean tension on separation"),
    **_with_limits(
        "margin",  # its value is that of the first criterion
        lambda pair, sign: pair.adhesion_length / pair.remaining_threshold(sign),
        "1",
        "adhesion length over the one at which the wanted share remains",
        {"_low": -1, "_high": 1},
    ),
    **_with_limits(
        "modulus_threshold",
        lambda pair, sign: pair.work_of_adhesion / pair.remaining_threshold(sign),
        "Pa",
        "plane-strain modulus below which the wanted share remains",
    ),
    "energy_ratio": Quantity(
        lambda pair: pair.adhesion_length / pair.elastic_energy,
        "1",
        "work of adhesion over the elastic energy of full contact",
    ),
    "range_over_h_rms": Quantity(
        lambda pair: pair.range / pair.h_rms, "1", "range of attraction over rms height"
    ),
    "pair_h_rms": Quantity(
        lambda pair: pair.h_rms, "m", "rms height of the pair, of both solids if both are rough"
    ),
    "pair_q0": Quantity(
        lambda pair: pair.q0, "1/m", "wave number of the longest waves of the pair that matter"
    ),
    "pair_rms_slope": Quantity(lambda pair: pair.rms_slope, "1", "rms gradient of the pair"),
    "pair_rms_curvature": Quantity(
        lambda pair: pair.rms_curvature, "1/m", "rms Laplacian of the pair"
    ),
    "pair_a_v": Quantity(
        lambda pair: pair.a_v, "1", "a_V of the pair: its surface's spectrum, its range over h_rms"
    ),
    "pair_a_v_low": Quantity(lambda pair: pair.a_v_low, "1", "low limit of the pair's a_V"),
    "pair_a_v_high": Quantity(lambda pair: pair.a_v_high, "1", "high limit of the pair's a_V"),
    "edge_strength": Quantity(
        lambda pair: pair.edges.strength,
        "1",
        "Tabor's parameter of the edges of contact, l_a d/range^2",
    ),
    "attractive_over_contact": Quantity(
        lambda pair: pair.edges.attractive_over_contact,
        "1",
        "area within the range over area of contact",
    ),
    "over_dmt": Quantity(
        lambda pair: pair.edges.effect,
        "1",
        "attraction over that of the DMT limit, at equal area of contact",
    ),
    "regime": Quantity(
        lambda pair: classify_edges(pair.edges).astype("i1"),
        "1",
        "edges: 0 weak, 1 between, 2 tough (JKR), 3 strong, not JKR",
    ),
    "simulated": Quantity(
        lambda pair: np.asarray(pair.edges.simulated).astype("i1"),
        "1",
        "1 where full simulation bears the model out",
    ),
    "jtb_margin": Quantity(
        lambda pair: (
            formulas.dmt_validity(pair.h_rms, pair.q0, pair.adhesion_length, pair.range).margin
        ),
        "1",
        "rms height over the smallest at which the DMT limit holds (JTB)",
    ),
}


def judge(pair: Pair) -> dict[str, NDArray]:
    """Compute every quantity of `QUANTITIES` for a pair, by name."""
    return {name: np.asarray(quantity.find(pair)) for name, quantity in QUANTITIES.items()}


def find_margins(pair: Pair) -> dict[str, NDArray]:
    """Compute the margin of a pair by every criterion; it sticks above 1."""
    return {name: np.asarray(criterion.margin(pair)) for name, criterion in CRITERIA.items()}


def find_modulus_thresholds(pair: Pair) -> dict[str, NDArray]:
    """Compute the plane-strain modulus [Pa] below which every criterion says that a pair sticks."""
    return {
        name: np.asarray(criterion.modulus_threshold(pair)) for name, criterion in CRITERIA.items()
    }


@dataclass(frozen=True)
class SampledJudgement:
    """Judgement on one material and the samples of a measured surface, arrays ``(n,)``."""

    margins: NDArray  #: of what remains, with the error of the model
    remaining: NDArray  #: share of the work of adhesion, with the error of the model
    pull_off: NDArray  #: [Pa], with the error of the model
    from_spectrum: float  #: standard deviation of ln(margin) by the spectrum alone
    from_model: float  #: the same by the model alone
    share_from_spectrum: float  #: standard deviation of the share by the spectrum alone

    @property
    def probability(self) -> float:
        """Share of the samples that stick."""
        return float(np.mean(self.margins > 1))


def judge_samples(
    rough: Roughness, modulus: float, work_of_adhesion: float, range: float, errors: NDArray
) -> SampledJudgement:
    """Judge a material on every sample of a surface.

    Parameters
    ----------
    rough : Roughness
        Of the samples, arrays ``(n,)``.
    modulus, work_of_adhesion, range : float
        E* [Pa], work of adhesion [J/m^2] and range of the attraction [m].
    errors : (n,) array
        Errors of the model, in units of its limits.
    """
    length = work_of_adhesion / modulus
    at_value = length / rough.threshold(range)
    margins = length / rough.threshold(range, sign=errors)
    return SampledJudgement(
        margins=margins,
        remaining=rough.share(length, range, errors),
        pull_off=modulus * rough.tension(length, range, errors),
        from_spectrum=float(np.std(np.log(at_value))),
        from_model=float(np.std(np.log(margins / at_value))),
        share_from_spectrum=float(np.std(rough.share(length, range))),
    )
