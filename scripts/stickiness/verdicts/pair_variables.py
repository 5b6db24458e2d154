"""What `judge` returns: every variable with its dimensions, its unit and its description."""

from typing import NamedTuple

from stickiness.criteria.pair import LIMITED, QUANTITIES, WORDS
from stickiness.verdicts.limits import LIMIT_TEXT


class Axis(NamedTuple):
    """An axis along which the share is followed."""

    dimension: str
    description: str
    nan_means: str


AXES = {
    "modulus": Axis("modulus_factor", "for E* times a factor", "not judged"),
    "roughness": Axis("roughness_factor", "for the pair's heights times a factor", "not judged"),
    "rate": Axis("frequency", "at a frequency", "beyond the material's table, or dwell"),
    "dwell": Axis("dwell_factor", "for the dwell times a factor", "no dwell, or beyond the table"),
}

CONTACT_AREA = 0.05  #: share of the nominal area, for the pressure that brings it into contact
THRESHOLDS = {  #: unit, description, and why a value may be missing
    "rms_height_threshold": (
        "m",
        "rms height below which the wanted share remains; of two rough solids that of the pair",
        "not known",
    ),
    "thickness_threshold": ("m", "thickness above which the wanted share remains", "no layer"),
    "rate_threshold": ("Hz", "frequency below which the wanted share remains", "elastic, or dwell"),
    "contact_pressure": (
        "Pa",
        f"mean pressure that makes {CONTACT_AREA:.0%} contact without adhesion",
        "not judged",
    ),
}

#: What decides a verdict, by code: theory of the spectrum, alone or with the skewness of the
#: heights, or contact simulated on the heights.
DECIDED_BY = (
    "theory for Gaussian heights",
    "theory for the spectrum and the skewness of the heights",
    "simulated contact without adhesion, a lower bound",
    "simulated contact with adhesion",
)
BY_GAUSSIAN_THEORY, BY_SHAPED_THEORY, BY_BOUND, BY_SIMULATION = range(4)
#: What is given of a pair, also of one that is not judged.
GIVEN = ("work_of_adhesion", "range", "plane_strain_modulus", "quoted_modulus", "instant_ratio")
PER_PAIR = ("material", "surface")  #: dimensions of what has one value for every pair
#: Dimensions of what has more, after those of the pair.
DIMENSIONS = {
    **dict.fromkeys((*LIMITED, *THRESHOLDS, "pair_a_v"), ("limit",)),
    **dict.fromkeys((*QUANTITIES, "stiffening"), ("end",)),
    **dict.fromkeys(("margin_by_criterion", "threshold_by_criterion"), ("end", "criterion")),
    "disagrees": ("criterion",),
    **{f"remaining_by_{name}": (axis.dimension, "limit") for name, axis in AXES.items()},
}

_UNMEASURED = "not measured"
_ANY_MODULUS = "not judged; infinite where any modulus would do"
#: Unit, description and, where a value may be missing, what that means.
PAIR_VARIABLES: dict[str, tuple[str, ...]] = {
    **LIMITED,
    **{name: (*LIMITED[name], _ANY_MODULUS) for name in LIMITED if "modulus" in name},
    **QUANTITIES,
    **THRESHOLDS,
    "material": ("1", "material"),
    "surface": ("1", "real surface"),
    "end": ("1", "smooth or rough end of what is known of the surface"),
    "criterion": ("1", "stickiness criterion"),
    "limit": LIMIT_TEXT,
    "frequency": ("Hz", "frequency of loading"),
    "modulus_factor": ("1", "factor on the plane-strain modulus"),
    "roughness_factor": ("1", "factor on the heights, at unchanged shape of the spectrum"),
    "dwell_factor": ("1", "factor on the dwell"),
    "probability": ("1", "share of draws that stick", _UNMEASURED),
    "probability_low": ("1", "share of draws that stick within linear elasticity", _UNMEASURED),
    "error_of_spectrum": (
        "1",
        "standard deviation of ln margin by the spectrum and its unresolved waves",
        _UNMEASURED,
    ),
    "error_of_map": ("1", "standard deviation of ln margin by how its parts differ", _UNMEASURED),
    "error_of_model": ("1", "standard deviation of ln margin by the model", _UNMEASURED),
    "margin_by_criterion": (
        "1",
        "threshold over actual value in the criterion's usual form; sticky above 1",
    ),
    "threshold_by_criterion": ("Pa", "plane-strain modulus below which a criterion says sticky"),
    "pair_a_v": ("1", "a_V of the pair: its surface's spectrum, its range over h_rms"),
    "wanted_share": ("1", "share of the work of adhesion that must remain to stick"),
    "material_label": ("1", "name of the material for readers"),
    "material_doubts": ("1", "doubts about the material, a line each"),
    "properties": ("1", "properties of the material for readers"),
    "law": ("1", "traction law"),
    "range": ("m", "range of the attraction"),
    "work_of_adhesion": ("J/m^2", "work of adhesion"),
    "work_on_smooth": ("1", "1 where the work of adhesion was measured on smooth surfaces"),
    "half_space": ("1", "1 of a material that is deep, without a skin, and smooth itself"),
    "stiffening": ("1", "energy of full contact over that of a half-space"),
    "modulus": ("Pa", "plane-strain storage modulus", "beyond the material's table"),
    "plane_strain_modulus": (
        "Pa",
        "plane-strain modulus at 1 Hz or after the dwell, which all margins are for",
    ),
    "quoted_modulus": ("Pa", "the same as it was given: Young's, or E* without Poisson's ratio"),
    "poisson_ratio": ("1", "Poisson's ratio", "E* is given"),
    "dwell": ("s", "time for which contact is made", "judged at one frequency"),
    "instant_ratio": ("1", "instantaneous modulus over that after the dwell, 1 without one"),
    "depends_on_rate": ("1", "1 where the modulus is given as a function of the frequency"),
    "verdict": ("1", "verdict: " + ", ".join(f"{i} {word}" for i, word in enumerate(WORDS))),
    "decided_by": ("1", "decided by: " + ", ".join(f"{i} {x}" for i, x in enumerate(DECIDED_BY))),
    "disagrees": ("1", "1 where a criterion disagrees with what remains, at either end"),
    "not_judged": ("1", "why a pair is not judged, a line each; empty if it is"),
    "doubts": ("1", "why the answer is probably to another question, a line each"),
    "questions": ("1", "questions that decide, with the verdict by each answer, as JSON"),
    "rms_height": (
        "m",
        "rms height: as levelled, of several scans by their spectrum, or of the rough end",
    ),
    "scan": ("m", "side of the largest scan", _UNMEASURED),
    "contact": ("m", "side of the contact that is judged", _UNMEASURED),
    **{
        f"remaining_by_{name}": (
            "1",
            f"{LIMITED['remaining'][1]}, {axis.description}",
            axis.nan_means,
        )
        for name, axis in AXES.items()
    },
}
