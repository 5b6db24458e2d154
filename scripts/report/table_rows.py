"""Verdicts, criteria and sizes of surfaces as rows of tables, for all pages."""

import numpy as np

from common import formatting, provided
from common import verdicts as texts
from common.formatting import NOTHING, amount, interval, number, percent, quantity, with_error
from common.materials import read_material, show_modulus
from criteria.thresholds import find_rate
from stickiness.criteria.pair import BROAD_A_V, MOST_STRAIN, NOT_JUDGED, REGIMES, SIGNS, WORDS
from stickiness.criteria.registry import CRITERIA, EDGES, REMAINING
from stickiness.remaining.prediction import DEFAULT_SHARE
from stickiness.statistics import COVERS

TONES = ("no", "open", "partly", "yes", "yes", "open")  # of the verdicts, in the order of codes
NEAR = 0.1  # relative, within which more digits tell a modulus from its threshold
LEAST_EFFECT = 0.05  # relative, of a layer's thickness on the energy of full contact
COLUMNS = ("remaining", "pull_off", "threshold", "energy_ratio", "margin", "onset", "probability")
COLUMNS += ("errors", "modulus")


def arrange_pairs(verdicts, materials, labels):
    """Rows of all pairs, the user's first, by entries of `materials` and `labels` of surfaces."""
    rows = [
        describe_pair(verdicts.sel(material=material, surface=surface), materials[material])
        | {"key": material, "material": materials[material]["label"]}
        | {"name": surface, "surface": labels[surface], "mine": False}
        for material in provided.user_defined_first(verdicts.material.values, provided.MATERIALS)
        for surface in provided.user_defined_first(verdicts.surface.values, provided.SURFACES)
    ]
    for row in provided.choose_mine(rows):
        row["mine"] = True
    return rows


def describe_pair(pair, entry):
    """Verdict on a `pair`: `text` by column for readers, `sort` by column for sorting.

    `entry` is that of its material in the configuration. Texts in `ends` are values at both ends of
    the surface. A pair that is not judged has no numbers and comes last in every order.
    """
    code = int(pair.verdict)
    row = {"pair": pair, "code": code, "word": WORDS[code], "tone": TONES[code]}
    row |= {"modulus": show_modulus(float(pair.modulus_quoted), entry, 3), "threshold": NOTHING}
    row |= {"moment": texts.describe_moment(pair), "stiffening": "", "strain": ""}
    row |= {"rates": [], "ends": {}}
    if code == NOT_JUDGED:
        nothing = {"text": dict.fromkeys(COLUMNS, NOTHING), "sort": dict.fromkeys(COLUMNS, -1.0)}
        return row | nothing | {"code": -1, "not_judged": str(pair.not_judged.item())}
    if abs(pair.stiffening - 1).max() >= LEAST_EFFECT:
        row["stiffening"] = interval(*pair.stiffening.values, 2)
    if pair.layer_strain.max() > MOST_STRAIN:
        row["strain"] = number(pair.layer_strain.max(), 2)
    onset = pair.margin.sel(criterion=EDGES)
    low, high = texts.find_limits(pair, "margin")
    drawn = bool(np.isfinite(pair.probability))  # spectra from the errors of a measurement
    total = np.hypot(pair.error_of_spectrum, pair.error_of_model)
    errors = f"spectrum {percent(pair.error_of_spectrum)}, model {percent(pair.error_of_model)}"
    threshold, modulus = "modulus_threshold", float(pair.modulus_quoted)
    cells = {
        "remaining": (texts.describe_share(pair), texts.find_value(pair)),
        "pull_off": (texts.describe_pull_off(pair), texts.find_value(pair, "pull_off")),
        "threshold": (texts.describe_quantity(pair, threshold), texts.find_value(pair, threshold)),
        "energy_ratio": (interval(*pair.energy_ratio.values, 2), pair.energy_ratio.mean()),
        "margin": (f"{number(low, 2)} to {number(high, 2)}", np.sqrt(low * high)),
        "onset": (interval(*onset.values, 2), onset.mean()),
        "probability": (texts.show_probability(pair) if drawn else NOTHING, pair.probability),
        "errors": (errors if drawn else NOTHING, total),
        "modulus": (texts.SHOWN[threshold](modulus), modulus),
    }
    ends = {
        name: texts.join(*map(show, sorted(pair[name].values)))
        for name, show in texts.SHOWN.items()
    }
    return row | {
        "not_judged": "",
        "unknown": find_largest_unknown(pair) if WORDS[code] == "depends" else "",
        **describe_bounds(pair, entry),
        "rates": list_rates(read_material(entry), pair),
        "ends": ends,
        "text": {name: text for name, (text, _) in cells.items()},
        "sort": {name: float(value) for name, (_, value) in cells.items()},
    }


def describe_bounds(pair, entry):
    """Threshold of the modulus as that was given, and its limits, empty where nobody can use them.

    The verdict changes at the limits, so that they are told from the modulus of the material.
    """
    name, given = "modulus_threshold", float(pair.modulus_quoted)
    bounds = list(map(float, (texts.find_value(pair, name), *texts.find_limits(pair, name))))
    useful = [bound for bound in bounds if texts.LEAST_STRESS <= bound <= texts.MOST_STRESS]
    text, low, high = (
        show_modulus(bound, entry, 4 if abs(bound / given - 1) < NEAR else 2, beside=useful)
        if bound in useful
        else ""
        for bound in bounds
    )
    least, most = (bound.partition(" = ")[2] for bound in (low, high))
    least = least.removesuffix(most[most.rfind(" ") :])  # the unit
    text = f"{text} ({least or 0} to {most or 'any'})" if text else "none that matters"
    return {"threshold": text, "sticks_below": low, "fails_above": high}


def list_rates(material, pair):
    """Frequencies at which a pair sticks within all limits, and at which it may, as texts.

    Empty of a material whose modulus does not depend on the rate, or that is judged by its dwell.
    """
    words = {0.0: "at no frequency", np.inf: "at every frequency"}
    _, *limits = find_rate(material, pair) or (None,)
    return list(dict.fromkeys(words.get(x, f"below {number(x, 2)} Hz") for x in limits))


def find_largest_unknown(pair):
    """What widens the limits of a pair most: the strain of its layer, the surface or the model."""
    if float(texts.find_limits(pair, "margin")[0]) == 0:
        return "layer"
    spectrum, model = pair.error_of_spectrum, pair.error_of_model
    if np.isnan(spectrum):  # not measured, but known between two ends
        ends, low, high = (np.log(pair[f"modulus_threshold{x}"]) for x in SIGNS)
        spectrum, model = np.ptp(ends.values), (high - low).mean()
    return "surface" if spectrum > model else "model"


def explain(pair, work_of_adhesion):
    """What every criterion says of a judged pair, with its margins and its reason."""
    facts = gather_facts(pair, work_of_adhesion)
    sticky = pair.margin > 1
    return [
        {
            "name": CRITERIA[name].label,
            "answer": ("does not stick", "depends", "sticks")[int(says.any()) + int(says.all())],
            "margins": interval(*pair.margin.sel(criterion=name).values, 2),
            "disagrees": bool((says != sticky.sel(criterion=REMAINING)).any()),
            "reason": CRITERIA[name].reason.format(**facts),
        }
        for name in map(str, pair.criterion.values)
        for says in [sticky.sel(criterion=name)]
    ]


def gather_facts(pair, work_of_adhesion):
    """Texts that the reasons in `registry` quote; intervals are over both ends of the surface."""
    rough = pair.sel(end="rough")
    curvature = float(rough.pair_rms_curvature)
    intervals = ("attractive_over_contact", "edge_strength", "over_dmt")
    share = texts.describe_share(pair)
    return {name: interval(*pair[name].values, 2) for name in intervals} | {
        "remaining": share if share.endswith("times") else f"{share} of",
        "wanted": percent(DEFAULT_SHARE),
        "regime": " to ".join(dict.fromkeys(REGIMES[int(code)] for code in pair.regime)),
        "h_rms": quantity(*pair.pair_h_rms.values, "m"),
        "q0": number(rough.pair_q0),
        "a_v": number(pair.pair_a_v.mean(), 2),
        "constant_a_v": number(BROAD_A_V, 2),
        "rms_slope": number(rough.pair_rms_slope, 2),
        "rms_curvature": number(curvature, 2),
        "summit_radius": amount(2 / curvature, "m", 2),
        "energy": f"{number(work_of_adhesion / float(rough.energy_ratio), 2)} J/m²",
        "work_of_adhesion": f"{number(work_of_adhesion, 2)} J/m²",
        "modulus": amount(pair.modulus_quoted, "Pa", 2),
    }


def describe_surface(surface):
    """Rms height, rms slope and C0 at H = 0.8 of a surface, rounded to what is known of them."""
    height, slope = (surface[name].values for name in ("h_rms", "rms_slope"))
    if "draw" in surface.dims:  # both ends are one standard error off; errors shown cover 90 %
        found = {
            "height": formatting.quantity_with_error(
                height.mean(), COVERS * np.ptp(height) / 2, "m"
            ),
            "slope": with_error(slope.mean(), COVERS * np.ptp(slope) / 2),
        }
    else:
        found = {"height": quantity(*height, "m"), "slope": interval(*slope)}
    if "C0_reference" in surface:
        line = with_error(surface.C0_reference, surface.C0_reference_total_error)
    else:  # the highest line with H = 0.8 that the spectrum touches
        bound = "" if np.isclose(float(surface.hurst), 0.8) else "≤ "
        line = bound + interval(*surface.C0_reference_upper.values, 2)
    return found | {"line": line}
