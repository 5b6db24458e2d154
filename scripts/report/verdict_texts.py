"""Texts of a verdict: numbers of the pair, what sorts it, and the reason of every criterion."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from common.formatting import NOTHING, amount, interval, number, percent, quantity
from criteria.classification import find_limits
from criteria.texts import (
    MPA,
    describe_layer,
    describe_pull_off,
    describe_share,
    describe_threshold,
    show_probability,
    show_stress,
)
from stickiness import error_budget as budget
from stickiness.criteria.pair import NOT_JUDGED, WORDS
from stickiness.criteria.registry import CRITERIA, EDGES, REMAINING
from stickiness.criteria.verdict import BROAD_A_V
from stickiness.remaining.prediction import DEFAULT_SHARE

WORD_TONES = ("no", "open", "partly", "yes", "yes", "open")
REGIME_TEXTS = ("weak", "between weak and tough", "tough, near JKR", "strong, but not near JKR")


def describe_pair(pair: xr.Dataset) -> dict[str, Any]:
    """Texts and numbers of a pair on the pages; intervals go from the rough to the smooth end."""
    code = int(pair.verdict)
    if code == NOT_JUDGED:
        return withheld_texts()
    margins = ends(pair.margin.sel(criterion=REMAINING))
    limits = map(float, find_limits(pair, "margin"))
    return {
        "verdict": WORDS[code],
        "tone": WORD_TONES[code],
        "grade": code,
        "remaining": describe_share(pair),
        "layer": describe_layer(pair),
        "remaining_value": float(pair.remaining.mean()),
        "pull_off": describe_pull_off(pair),
        "pull_off_value": float(pair.pull_off.mean()),
        "energy_ratio": interval(*ends(pair.energy_ratio), digits=2),
        "energy_ratio_value": float(pair.energy_ratio.mean()),
        "margin": interval(*margins, digits=2),
        "order": float(np.sqrt(np.prod(margins))),
        "limits": interval(*limits, digits=2),
        "by": find_dominant(pair),
        "onset": interval(*ends(pair.margin.sel(criterion=EDGES)), digits=2),
        "onset_value": float(pair.margin.sel(criterion=EDGES).mean()),
        "own_modulus": show_stress(float(pair.modulus_quoted), MPA),
        "threshold": describe_threshold(pair),
        "threshold_value": float(pair.modulus_threshold.sel(end="rough")),
        **describe_draws(pair),
    }


def withheld_texts() -> dict[str, Any]:
    """The same of a pair that is not judged: no number, last in every order."""
    numbers = ("grade", "remaining_value", "pull_off_value", "energy_ratio_value", "order")
    numbers += ("onset_value", "threshold_value", "share", "error")
    texts = ("remaining", "pull_off", "energy_ratio", "margin", "limits", "by", "onset")
    texts += ("own_modulus", "threshold", "probability", "errors")
    return {
        "verdict": WORDS[NOT_JUDGED],
        "tone": WORD_TONES[NOT_JUDGED],
        "layer": "",
        **dict.fromkeys(numbers, -1.0),
        **dict.fromkeys(texts, NOTHING),
        "grade": -1,
    }


def find_dominant(pair: xr.Dataset) -> str:
    """Source of the largest error of the margin, at the end of the surface with the larger."""
    margin = pair.sel(criterion=REMAINING)
    worst = (margin.margin_total_error / margin.margin).argmax("end")
    return budget.dominant(margin.isel(end=worst), "margin")


def ends(values: xr.DataArray) -> tuple[float, float]:
    """Values at the rough and at the smooth end of the surface."""
    return float(values.sel(end="rough")), float(values.sel(end="smooth"))


def describe_draws(pair: xr.Dataset) -> dict[str, Any]:
    """Shares and errors from spectra drawn within the errors of a measurement, if there are any."""
    share = float(pair.probability)
    numbers = {
        "share": share,
        "error": float(np.hypot(pair.error_of_spectrum, pair.error_of_model)),
    }
    if not np.isfinite(share):
        return numbers | {"probability": NOTHING, "errors": NOTHING}
    return numbers | {
        "probability": show_probability(pair),
        "errors": f"spectrum {percent(float(pair.error_of_spectrum))}, model "
        f"{percent(float(pair.error_of_model))}",
    }


def explain(pair: xr.Dataset, surface: xr.Dataset, work_of_adhesion: float) -> list[dict[str, Any]]:
    """One row for every criterion: what it says of a pair, its margins and its reason.

    None of a pair that is not judged.
    """
    if int(pair.verdict) == NOT_JUDGED:
        return []
    facts = gather_facts(pair, surface, work_of_adhesion)
    ours = pair.margin.sel(criterion=REMAINING) > 1
    rows = []
    for name in map(str, pair.criterion.values):
        margin = pair.margin.sel(criterion=name)
        sticky = margin > 1
        says = "sticks" if sticky.all() else "depends" if sticky.any() else "does not stick"
        rows.append(
            {
                "name": CRITERIA[name].label,
                "says": says,
                "margins": interval(*ends(margin), 2),
                "disagrees": bool((sticky != ours).any()),
                "reason": CRITERIA[name].reason.format(**facts),
            }
        )
    return rows


def gather_facts(pair: xr.Dataset, surface: xr.Dataset, work_of_adhesion: float) -> dict[str, str]:
    """Texts by the names of `registry.FACTS`; intervals go from the smooth to the rough end."""
    curvature = float(pair.pair_rms_curvature.sel(end="rough"))
    modulus = float(pair.modulus_quoted)
    energy = work_of_adhesion / float(pair.energy_ratio.sel(end="rough"))
    of_edges = {
        name: interval(*sorted(map(float, pair[name].values)), 2)
        for name in ("attractive_over_contact", "edge_strength", "over_dmt")
    }
    return of_edges | {
        "remaining": describe_share(pair),
        "wanted": percent(DEFAULT_SHARE),
        "regime": " to ".join(dict.fromkeys(REGIME_TEXTS[int(code)] for code in pair.regime)),
        "h_rms": quantity(*sorted(map(float, pair.pair_h_rms.values)), "m"),
        "q0": number(float(pair.pair_q0.sel(end="rough"))),
        "a_v": number(float(pair.pair_a_v.mean()), 2),
        "constant_a_v": number(BROAD_A_V, 2),
        "rms_slope": number(float(pair.pair_rms_slope.sel(end="rough")), 2),
        "rms_curvature": number(curvature, 2),
        "summit_radius": amount(2 / curvature, "m", 2),
        "energy": f"{number(energy, 2)} J/m²",
        "work_of_adhesion": f"{number(work_of_adhesion, 2)} J/m²",
        "modulus": amount(modulus, "Pa", 2),
    }
