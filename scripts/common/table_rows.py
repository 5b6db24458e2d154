"""Verdicts, criteria and sizes of surfaces as rows of tables, for all pages."""

import numpy as np

from common import provided
from common import verdict_texts as texts
from common.materials import show_modulus
from stickiness import formatting
from stickiness.criteria.formulas import PRINTED_A_V
from stickiness.criteria.pair import (
    BROAD_A_V,
    DEPENDS,
    MOST_STRAIN,
    NOT_JUDGED,
    REGIMES,
    WORDS,
)
from stickiness.criteria.registry import CRITERIA, EDGES, REMAINING
from stickiness.formatting import (
    FAR,
    NOTHING,
    amount,
    interval,
    number,
    percent,
    quantity,
    with_error,
)
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.statistics import COVERS
from stickiness.verdicts.judgement import BY_GAUSSIAN_THEORY, BY_SHAPED_THEORY, DECIDED_BY
from stickiness.verdicts.limits import read_limited

THRESHOLD = "modulus_threshold"
TONES = ("no", "open", "partly", "yes", "yes", "open")  #: of the verdicts, in the order of codes
NEAR = 0.1  # relative, within which more digits tell a modulus from its threshold
LEAST_EFFECT = 0.05  # relative, of a layer's thickness on the energy of full contact
COLUMNS = (
    "remaining",
    "pull_off",
    "threshold",
    "energy_ratio",
    "margin",
    "onset",
    "probability",
    "errors",
    "modulus",
)


def arrange_pairs(verdicts, materials, labels):
    """Rows of all pairs, the user's first, by entries of `materials` and `labels` of surfaces."""
    rows = []
    for material in provided.user_defined_first(verdicts.material.values, provided.MATERIALS):
        for surface in provided.user_defined_first(verdicts.surface.values, provided.SURFACES):
            pair = verdicts.sel(material=material, surface=surface)
            row = describe_pair(pair, materials[material])
            row["key"] = material
            row["material"] = materials[material]["label"]
            row["name"] = surface
            row["surface"] = labels[surface]
            row["mine"] = False
            rows.append(row)
    for row in provided.choose_mine(rows):
        row["mine"] = True
    return rows


def describe_pair(pair, entry):
    """Verdict on a `pair`: `text` by column for readers, `sort` by column for sorting.

    `entry` is that of its material in the configuration. A pair that is not judged has no numbers
    and comes last in every order.
    """
    code = int(pair.verdict)
    row = {
        "pair": pair,
        "code": code,
        "word": WORDS[code],
        "tone": TONES[code],
        "modulus": show_modulus(float(pair.modulus_quoted), entry, digits=3),
        "moment": texts.describe_moment(pair),
        "decided_by": DECIDED_BY[int(pair.decided_by)],
        "threshold": NOTHING,
        "stiffening": "",
        "strain": "",
        "rates": [],
        "not_judged": str(pair.not_judged.item()),
    }
    if code == NOT_JUDGED:
        row["text"] = dict.fromkeys(COLUMNS, NOTHING)
        row["sort"] = dict.fromkeys((*COLUMNS, "verdict"), -1.0)
        return row
    if abs(pair.stiffening - 1).max() >= LEAST_EFFECT:
        row["stiffening"] = interval(*pair.stiffening.values, 2)
    if pair.layer_strain.max() > MOST_STRAIN:
        row["strain"] = number(pair.layer_strain.max(), 2)
    row["unknown"] = find_largest_unknown(pair) if code == DEPENDS else ""
    row |= describe_bounds(pair, entry)
    row["rates"] = list_rates(pair)
    cells = describe_cells(pair)
    row["text"] = {name: text for name, (text, _) in cells.items()}
    row["sort"] = {name: float(value) for name, (_, value) in cells.items()}
    row["sort"]["verdict"] = code
    return row


def describe_cells(pair):
    """Text of every one of `COLUMNS`, and the value by which it is sorted."""
    onset = pair.margin_by_criterion.sel(criterion=EDGES)
    _, low, high = read_limited(pair.margin)
    modulus = float(pair.modulus_quoted)
    by_value = {
        name: read_limited(pair[name]).value for name in ("remaining", "pull_off", THRESHOLD)
    }
    # A measured surface has spectra drawn from the errors of the measurement.
    is_drawn = bool(np.isfinite(pair.probability))
    errors = (
        f"spectrum {percent(pair.error_of_spectrum)}, model {percent(pair.error_of_model)}"
        if is_drawn
        else NOTHING
    )
    probability = texts.show_probability(pair) if is_drawn else NOTHING
    return {
        "remaining": (texts.describe_share(pair), by_value["remaining"]),
        "pull_off": (texts.describe_pull_off(pair), by_value["pull_off"]),
        "threshold": (texts.describe_quantity(pair, THRESHOLD), by_value[THRESHOLD]),
        "energy_ratio": (interval(*pair.energy_ratio.values, 2), pair.energy_ratio.mean()),
        "margin": (f"{number(low, 2)} to {number(high, 2)}", np.sqrt(low * high)),
        "onset": (interval(*onset.values, 2), onset.mean()),
        "probability": (probability, pair.probability),
        "errors": (errors, np.hypot(pair.error_of_spectrum, pair.error_of_model)),
        "modulus": (number(modulus / texts.MPA, 2), modulus),
    }


def describe_bounds(pair, entry):
    """Threshold of the modulus as that was given, and its limits, empty where nobody can use them.

    The verdict changes at the limits, so that they are told from the modulus of the material.
    """
    actual = float(pair.modulus_quoted)
    bounds = read_limited(pair[THRESHOLD])
    useful = [bound for bound in bounds if texts.LEAST_STRESS <= bound <= texts.MOST_STRESS]

    far = len(useful) == len(bounds) and max(useful) > FAR * min(useful)

    def show(bound):
        if bound not in useful:
            return ""
        digits = 4 if abs(bound / actual - 1) < NEAR else 2
        return show_modulus(bound, entry, digits, beside=() if far else useful)

    text, low, high = map(show, bounds)
    return {
        "threshold": tell_bounds(text, low, high, far),
        "sticks_below": low,
        "fails_above": high,
    }


def tell_bounds(text, low, high, far):
    """Value and limits of a threshold in one text; each is empty where nobody can use it."""
    most = high.partition(" = ")[2]
    if low and high and (far or not text):
        return f"{low} to {most}"
    if text:
        unit = most[most.rfind(" ") :]
        least = low.partition(" = ")[2].removesuffix(unit)
        return f"{text} ({least or 0} to {most or 'any'})"
    if low or high:
        return f"at least {low}" if low else f"none, or {high} at most"
    return "none that matters"


def list_rates(pair):
    """Frequencies [Hz] below which a pair sticks within all limits, and below which it may.

    0 and infinity stand for none and any. Empty of a material whose modulus does not depend on the
    rate, or that is judged by its dwell.
    """
    _, low, high = read_limited(pair.rate_threshold)
    return [] if np.isnan(low) or np.isnan(high) else [low, high]


def find_largest_unknown(pair):
    """What widens the limits of a pair most: the strain of its layer, the surface or the model."""
    _, low, high = read_limited(pair.margin)
    if low == 0:
        return "layer"
    if np.isfinite(pair.error_of_spectrum):
        return "surface" if pair.error_of_spectrum > pair.error_of_model else "model"
    # A surface that was not measured is known between two ends.
    ends = pair.margin_by_criterion.sel(criterion=REMAINING).values
    between_ends = np.ptp(np.log(ends))
    return "surface" if between_ends > np.log(high / low) - between_ends else "model"


def explain(pair, work_of_adhesion):
    """What every criterion says of a judged pair, with its margins.

    The reason of each is in reasons.html.j2, which quotes the `facts`.
    """
    facts = gather_facts(pair, work_of_adhesion)
    sticky = pair.margin_by_criterion > 1
    rows = []
    for name in map(str, pair.criterion.values):
        says = sticky.sel(criterion=name)
        answers = ("does not stick", "depends", "sticks")
        rows.append(
            {
                "criterion": name,
                "name": CRITERIA[name].label,
                "answer": answers[int(says.any()) + int(says.all())],
                "margins": interval(*pair.margin_by_criterion.sel(criterion=name).values, 2),
                "disagrees": bool((says != sticky.sel(criterion=REMAINING)).any()),
                "facts": facts,
            }
        )
    return rows


def gather_facts(pair, work_of_adhesion):
    """Texts that the reasons quote; intervals are over both ends of the surface."""
    rough = pair.sel(end="rough")
    curvature = float(rough.pair_rms_curvature)
    intervals = ("attractive_over_contact", "edge_strength", "over_dmt")
    share = texts.describe_share(pair)
    beyond = float(pair.extrapolation.max())
    by_theory = int(pair.decided_by) in (BY_GAUSSIAN_THEORY, BY_SHAPED_THEORY)
    return {name: interval(*pair[name].values, 2) for name in intervals} | {
        "remaining": share if share.endswith("times") else f"{share} of",
        "wanted": percent(DEFAULT_SHARE),
        "regime": " to ".join(dict.fromkeys(REGIMES[int(code)] for code in pair.regime)),
        "h_rms": quantity(*pair.pair_h_rms.values, "m"),
        "q0": number(rough.pair_q0),
        "a_v": number(read_limited(pair.pair_a_v).value, 2),
        "constant_a_v": number(BROAD_A_V, 2),
        "printed_a_v": number(PRINTED_A_V),
        "rms_slope": number(rough.pair_rms_slope, 2),
        "rms_curvature": number(curvature, 2),
        "summit_radius": amount(2 / curvature, "m", 2),
        "energy": f"{number(work_of_adhesion / float(rough.energy_ratio), 2)} J/m²",
        "work_of_adhesion": f"{number(work_of_adhesion, 2)} J/m²",
        "extrapolation": number(beyond, 2) if beyond > 0 and by_theory else "",
        "modulus": amount(pair.modulus_quoted, "Pa", 2),
    }


def describe_surface(surface):
    """Rms height, rms slope and C0 at H = 0.8 of a surface, rounded to what is known of them."""
    height = surface.h_rms.values
    slope = surface.rms_slope.values
    if "draw" in surface.dims:  # both ends are one standard error off; errors shown cover 90 %
        height_error = COVERS * np.ptp(height) / 2
        height_text = formatting.quantity_with_error(height.mean(), height_error, "m")
        slope_text = with_error(slope.mean(), COVERS * np.ptp(slope) / 2)
    else:
        height_text = quantity(*height, "m")
        slope_text = interval(*slope)
    if "C0_reference" in surface:
        line = with_error(surface.C0_reference, surface.C0_reference_total_error)
    else:  # the highest line with H = 0.8 that the spectrum touches
        bound = "" if np.isclose(float(surface.hurst), 0.8) else "≤ "
        line = bound + interval(*surface.C0_reference_upper.values, 2)
    return {"height": height_text, "slope": slope_text, "line": line}
