"""What `judge` returns: every variable with its dimensions, its unit and its description."""

from stickiness.criteria.pair import LIMITED, QUANTITIES, WORDS
from stickiness.verdicts.curves import AXES
from stickiness.verdicts.limits import LIMIT_TEXT
from stickiness.verdicts.thresholds import THRESHOLDS

#: What decides a verdict, by code: theory of the spectrum, alone or with the skewness of the
#: heights, or contact simulated on the heights.
DECIDED_BY = (
    "theory for Gaussian heights",
    "theory for the spectrum and the skewness of the heights",
    "simulated contact without adhesion, a low bound",
    "simulated contact with adhesion",
)
BY_GAUSSIAN_THEORY, BY_SHAPED_THEORY, BY_BOUND, BY_SIMULATION = range(4)
#: Judged for a larger contact, too, with limits.
LARGER = ("remaining", "modulus_threshold", "plane_strain_modulus_threshold")
PER_PAIR = ("material", "surface")  #: dimensions of what has one value for every pair
#: Dimensions of what has more, after those of the pair.
DIMENSIONS = {
    **dict.fromkeys((*LIMITED, *THRESHOLDS, "pair_a_v"), ("limit",)),
    **{f"larger_{name}": ("limit",) for name in LARGER},
    **dict.fromkeys((*QUANTITIES, "stiffening"), ("end",)),
    **dict.fromkeys(("margin_by_criterion", "threshold_by_criterion"), ("end", "criterion")),
    "disagrees": ("criterion",),
    **{f"remaining_by_{name}": (axis.dimension, "limit") for name, axis in AXES.items()},
}

_UNMEASURED = "not measured"
_NO_LONGER = "no waves longer than the scan are expected or known"
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
    "rms_height": (
        "m",
        "rms height: as levelled, of several scans by their spectrum, or of the rough end",
    ),
    "scan": ("m", "side of the largest scan", _UNMEASURED),
    "contact": ("m", "side of the contact that is judged", _UNMEASURED),
    "larger_contact": ("m", "side of a larger contact that is judged, too", _NO_LONGER),
    "larger_verdict": ("1", "verdict for the larger contact"),
    **{
        f"larger_{name}": (
            LIMITED[name][0],
            f"{LIMITED[name][1]}, of the larger contact",
            _NO_LONGER,
        )
        for name in LARGER
    },
    **{
        f"remaining_by_{name}": (
            "1",
            f"{LIMITED['remaining'][1]}, {axis.description}",
            axis.nan_means,
        )
        for name, axis in AXES.items()
    },
}
