"""A pair as a row of a table: texts by column, and the values by which they are sorted."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from stickiness.criteria.formulas import PRINTED_A_V
from stickiness.criteria.pair import BROAD_A_V, DEPENDS, REGIMES
from stickiness.criteria.registry import CRITERIA, EDGES, REMAINING
from stickiness.formatting import (
    NOTHING,
    amount,
    interval,
    number,
    percent,
    quantity,
    quantity_with_error,
    with_error,
)
from stickiness.statistics import COVERS
from stickiness.verdicts import wording
from stickiness.verdicts.limits import read_limited
from stickiness.verdicts.pair_variables import BY_GAUSSIAN_THEORY, BY_SHAPED_THEORY, DECIDED_BY

TONES = ("no", "open", "partly", "yes", "yes", "open")  #: of the verdicts, in the order of codes
LEAST_ROOM = 0.3  #: decades of the bar of a threshold beside what it shows
MOST_DECADES = 6  #: named on this bar
LEAST_EFFECT = 0.05  # relative, of a layer's thickness on the energy of full contact
SOURCES = ("spectrum", "map", "model")  #: of the error of a margin on a measured surface
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


def describe_pair(pair: xr.Dataset) -> dict[str, Any]:
    """Verdict on a pair, a cell of what `judge` returns, as a row of a table.

    `text` has texts by column for readers, `sort` values by column for sorting. A pair that is not
    judged has no numbers and comes last in every order.
    """
    code = int(pair.verdict)
    row: dict[str, Any] = {
        "pair": pair,
        "code": code,
        "word": wording.tell_verdict(pair),
        "tone": TONES[code],
        "material": pair.material_label.item(),
        "properties": pair.properties.item(),
        "moment": wording.tell_moment(pair),
        "decided_by": DECIDED_BY[int(pair.decided_by)],
        "not_judged": pair.not_judged.item(),
        "stiffening": "",
    }
    if not wording.is_judged(pair):
        row["text"] = dict.fromkeys(COLUMNS, NOTHING)
        row["sort"] = dict.fromkeys((*COLUMNS, "verdict"), -1.0)
        return row
    if abs(pair.stiffening - 1).max() >= LEAST_EFFECT:
        row["stiffening"] = _tell_ends(pair.stiffening)
    row |= {
        "remaining": wording.tell_remaining(pair),
        "change": wording.tell_change(pair),
        "dwell": wording.tell_dwell(pair),
        "rates": wording.tell_rates(pair),
        "improbable": wording.tell_improbable(pair),
        "widest": wording.tell_widest(pair) if code == DEPENDS else "",
        "questions": [
            {
                "question": asked["question"],
                "answers": [wording.tell_answer(answer, pair) for answer in asked["answers"]],
            }
            for asked in wording.list_questions(pair)
        ],
    }
    cells = describe_cells(pair)
    row["text"] = {name: text for name, (text, _) in cells.items()}
    row["sort"] = {name: float(value) for name, (_, value) in cells.items()}
    row["sort"]["verdict"] = code
    row["bar"] = place_threshold(pair)
    return row


def describe_cells(pair: xr.Dataset) -> dict[str, tuple[str, Any]]:
    """Text of every one of `COLUMNS`, and the value by which it is sorted."""
    onset = pair.margin_by_criterion.sel(criterion=EDGES)
    _, low, high = read_limited(pair.margin)
    by_value = {
        name: read_limited(pair[name]).value
        for name in ("remaining", "pull_off", "modulus_threshold")
    }
    # A measured surface has spectra drawn from the errors of the measurement.
    is_drawn = bool(np.isfinite(pair.probability))
    errors = (
        ", ".join(f"{name} {percent(float(pair[f'error_of_{name}']))}" for name in SOURCES)
        if is_drawn
        else NOTHING
    )
    probability = show_probability(pair) if is_drawn else NOTHING
    return {
        "remaining": (wording.tell_share(*read_limited(pair.remaining)), by_value["remaining"]),
        "pull_off": (wording.tell_pull_off(pair), by_value["pull_off"]),
        "threshold": (wording.tell_threshold(pair), by_value["modulus_threshold"]),
        "energy_ratio": (_tell_ends(pair.energy_ratio), pair.energy_ratio.mean()),
        "margin": (f"{number(low, 2)} to {number(high, 2)}", np.sqrt(low * high)),
        "onset": (_tell_ends(onset), onset.mean()),
        "probability": (probability, pair.probability),
        "errors": (errors, np.hypot.reduce([pair[f"error_of_{name}"] for name in SOURCES])),
        "modulus": (wording.tell_modulus(pair), pair.quoted_modulus),
    }


def place_threshold(pair: xr.Dataset) -> dict[str, Any]:
    """Where limits of the threshold, the modulus and decades stand on a bar, in % of its length.

    The bar is logarithmic. It begins and ends at decades, or where thresholds mean nothing.
    """
    modulus = float(pair.quoted_modulus)
    _, *limits = np.clip(
        read_limited(pair.modulus_threshold), wording.LEAST_STRESS, wording.MOST_STRESS
    )
    powers = np.log10([*limits, modulus])
    start, end = np.floor(powers.min() - LEAST_ROOM), np.ceil(powers.max() + LEAST_ROOM)
    low, high, own = 100 * (powers - start) / (end - start)
    step = int(np.ceil((end - start) / MOST_DECADES))
    decades = {
        100 * (power - start) / (end - start): amount(10.0**power, "Pa", 1)
        for power in np.arange(start, end + 1, step)
    }
    return {"low": low, "high": high, "own": own, "decades": decades}


def show_probability(pair: xr.Dataset) -> str:
    """Share of the draws that stick.

    An interval where a layer may not withstand all heights, which the draws do not know.
    """
    low = percent(pair.probability_low)
    high = percent(pair.probability)
    return high if low == high else f"{low.removesuffix(' %')} to {high}"


def explain(pair: xr.Dataset) -> list[dict[str, Any]]:
    """What every criterion says of a judged pair, with its margins.

    The reason of each is in reasons.html.j2, which quotes the `facts`.
    """
    facts = gather_facts(pair)
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
                "margins": _tell_ends(pair.margin_by_criterion.sel(criterion=name)),
                "disagrees": bool((says != sticky.sel(criterion=REMAINING)).any()),
                "facts": facts,
            }
        )
    return rows


def gather_facts(pair: xr.Dataset) -> dict[str, str]:
    """Texts that the reasons quote; intervals are over both ends of the surface."""
    rough = pair.sel(end="rough")
    curvature = float(rough.pair_rms_curvature)
    work = float(pair.work_of_adhesion)
    h_rms = pair.pair_h_rms.values
    intervals = ("attractive_over_contact", "edge_strength", "over_dmt")
    beyond = float(pair.extrapolation.max())
    by_theory = int(pair.decided_by) in (BY_GAUSSIAN_THEORY, BY_SHAPED_THEORY)
    return {name: _tell_ends(pair[name]) for name in intervals} | {
        "remaining": wording.tell_remaining(pair),
        "regime": " to ".join(dict.fromkeys(REGIMES[int(code)] for code in pair.regime)),
        "h_rms": quantity(h_rms[0], h_rms[-1], "m"),
        "q0": number(rough.pair_q0),
        "a_v": number(read_limited(pair.pair_a_v).value, 2),
        "constant_a_v": number(BROAD_A_V, 2),
        "printed_a_v": number(PRINTED_A_V),
        "rms_slope": number(rough.pair_rms_slope, 2),
        "rms_curvature": number(curvature, 2),
        "summit_radius": amount(2 / curvature, "m", 2),
        "energy": f"{number(work / float(rough.energy_ratio), 2)} J/m²",
        "work_of_adhesion": f"{number(work, 2)} J/m²",
        "extrapolation": number(beyond, 2) if beyond > 0 and by_theory else "",
        "modulus": amount(pair.plane_strain_modulus, "Pa", 2),
    }


def describe_surface(surface: xr.Dataset) -> dict[str, str]:
    """Rms height, rms slope and C0 at H = 0.8 of a surface, rounded to what is known of them."""
    height = surface.h_rms.values
    slope = surface.rms_slope.values
    if "draw" in surface.dims:  # both ends are one standard error off; errors shown cover 90 %
        height_error = COVERS * np.ptp(height) / 2
        height_text = quantity_with_error(height.mean(), height_error, "m")
        slope_text = with_error(slope.mean(), COVERS * np.ptp(slope) / 2)
    else:
        height_text = quantity(height[0], height[-1], "m")
        slope_text = interval(*slope)
    if "C0_reference" in surface:
        line = with_error(surface.C0_reference, surface.C0_reference_total_error)
    else:  # the highest line with H = 0.8 that the spectrum touches
        bound = "" if np.isclose(float(surface.get("hurst", np.nan)), 0.8) else "≤ "
        line = bound + _tell_ends(surface.C0_reference_upper)
    return {"height": height_text, "slope": slope_text, "line": line}


def _tell_ends(numbers: xr.DataArray) -> str:
    """Interval of a number between both ends of the surface."""
    smooth, rough = numbers.values
    return interval(smooth, rough, 2)
