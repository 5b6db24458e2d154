"""Verdicts, criteria and sizes of surfaces as rows of tables, for both kinds of page."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from common.formatting import (
    NOTHING,
    amount,
    interval,
    number,
    percent,
    quantity,
    quantity_with_error,
    with_error,
)
from criteria.classification import MOST_STRAIN, find_limits
from criteria.texts import (
    MPA,
    describe_pull_off,
    describe_share,
    describe_threshold,
    round_share,
    show_probability,
    show_stress,
)
from stickiness.criteria.pair import DEPENDS, NOT_JUDGED, TOUCHES, WORDS
from stickiness.criteria.registry import CRITERIA, EDGES, REMAINING
from stickiness.criteria.verdict import BROAD_A_V
from stickiness.remaining.prediction import DEFAULT_SHARE
from stickiness.statistics import COVERS

TONES = ("no", "open", "partly", "yes", "yes", "open")  # of the verdicts, in the order of codes
REGIME_TEXTS = ("weak", "between weak and tough", "tough, near JKR", "strong, but not near JKR")
LEAST_EFFECT = 0.05  # relative, of a layer's thickness on the energy of full contact
COLUMNS = ("remaining", "pull_off", "threshold", "energy_ratio", "margin", "onset", "probability")
COLUMNS += ("errors", "modulus")


def describe_pair(pair: xr.Dataset) -> dict[str, Any]:
    """Verdict on a pair: `text` by column for readers, `sort` by column for sorting.

    Intervals go from the rough to the smooth end of the surface. A pair that is not judged has no
    numbers and comes last in every order.
    """
    code = int(pair.verdict)
    row = {
        "code": code,
        "word": WORDS[code],
        "tone": TONES[code],
        "depends": code == DEPENDS,
        "adheres_locally": code == TOUCHES,
        "not_judged": "",
        "stiffening": "",
        "strain": "",
    }
    if code == NOT_JUDGED:
        return row | {
            "code": -1,
            "not_judged": str(pair.not_judged.item()),
            "text": dict.fromkeys(COLUMNS, NOTHING),
            "sort": dict.fromkeys(COLUMNS, -1.0),
        }
    stiffening, strain = pair.stiffening.values, float(pair.layer_strain.max())
    if max(stiffening.max() - 1, 1 - stiffening.min()) >= LEAST_EFFECT:
        row["stiffening"] = interval(*map(float, stiffening), 2)
    if strain > MOST_STRAIN:
        row["strain"] = number(strain, 2)
    margin, onset = (pair.margin.sel(criterion=name) for name in (REMAINING, EDGES))
    drawn = bool(np.isfinite(pair.probability))  # spectra from the errors of a measurement
    errors = [
        f"{name} {percent(float(pair[f'error_of_{name}']))}" for name in ("spectrum", "model")
    ]
    return row | {
        "nothing": round_share(find_limits(pair)[1]) == 0,
        "text": {
            "remaining": describe_share(pair),
            "pull_off": describe_pull_off(pair),
            "threshold": describe_threshold(pair),
            "energy_ratio": interval(*ends(pair.energy_ratio), 2),
            "margin": interval(*map(float, find_limits(pair, "margin")), 2),
            "onset": interval(*ends(onset), 2),
            "probability": show_probability(pair) if drawn else NOTHING,
            "errors": ", ".join(errors) if drawn else NOTHING,
            "modulus": show_stress(float(pair.modulus_quoted), MPA),
        },
        "sort": {
            "remaining": float(pair.remaining.mean()),
            "pull_off": float(pair.pull_off.mean()),
            "threshold": float(pair.modulus_threshold.sel(end="rough")),
            "energy_ratio": float(pair.energy_ratio.mean()),
            "margin": float(np.sqrt(margin.prod("end"))),
            "onset": float(onset.mean()),
            "probability": float(pair.probability),
            "errors": float(np.hypot(pair.error_of_spectrum, pair.error_of_model)),
        },
    }


def ends(values: xr.DataArray) -> tuple[float, float]:
    """Values at the rough and at the smooth end of the surface."""
    return float(values.sel(end="rough")), float(values.sel(end="smooth"))


def explain(pair: xr.Dataset, work_of_adhesion: float) -> list[dict[str, Any]]:
    """What every criterion says of a judged pair, with its margins and its reason."""
    facts = gather_facts(pair, work_of_adhesion)
    ours = pair.margin.sel(criterion=REMAINING) > 1
    rows = []
    for name in map(str, pair.criterion.values):
        margin = pair.margin.sel(criterion=name)
        sticky = margin > 1
        rows.append(
            {
                "name": CRITERIA[name].label,
                "answer": ("does not stick", "depends", "sticks")[
                    int(sticky.any()) + int(sticky.all())
                ],
                "margins": interval(*ends(margin), 2),
                "disagrees": bool((sticky != ours).any()),
                "reason": CRITERIA[name].reason.format(**facts),
            }
        )
    return rows


def gather_facts(pair: xr.Dataset, work_of_adhesion: float) -> dict[str, str]:
    """Texts that the reasons in `registry` quote; intervals go from the smooth to the rough end."""
    rough = pair.sel(end="rough")
    curvature = float(rough.pair_rms_curvature)
    energy = work_of_adhesion / float(rough.energy_ratio)
    of_edges = {
        name: interval(*sorted(map(float, pair[name].values)), 2)
        for name in ("attractive_over_contact", "edge_strength", "over_dmt")
    }
    return of_edges | {
        "remaining": describe_share(pair),
        "wanted": percent(DEFAULT_SHARE),
        "regime": " to ".join(dict.fromkeys(REGIME_TEXTS[int(code)] for code in pair.regime)),
        "h_rms": quantity(*sorted(map(float, pair.pair_h_rms.values)), "m"),
        "q0": number(float(rough.pair_q0)),
        "a_v": number(float(pair.pair_a_v.mean()), 2),
        "constant_a_v": number(BROAD_A_V, 2),
        "rms_slope": number(float(rough.pair_rms_slope), 2),
        "rms_curvature": number(curvature, 2),
        "summit_radius": amount(2 / curvature, "m", 2),
        "energy": f"{number(energy, 2)} J/m²",
        "work_of_adhesion": f"{number(work_of_adhesion, 2)} J/m²",
        "modulus": amount(float(pair.modulus_quoted), "Pa", 2),
    }


def describe_surface(surface: xr.Dataset) -> dict[str, str]:
    """Rms height, rms slope and C0 at H = 0.8 of a surface, rounded to what is known of them.

    Both ends of a measured surface are one standard error off; errors shown cover 90 %.
    """
    height, slope = (
        tuple(map(float, surface[name].sel(end=["smooth", "rough"])))
        for name in ("h_rms", "rms_slope")
    )
    if "draw" in surface.dims:
        texts = {
            "height": quantity_with_error(*middle(height), "m"),
            "slope": with_error(*middle(slope)),
        }
    else:
        texts = {"height": quantity(*height, "m"), "slope": interval(*slope)}
    if "C0_reference" in surface:
        error = float(surface.C0_reference_total_error)
        return texts | {"line": with_error(float(surface.C0_reference), error)}
    # The highest line with H = 0.8 that the spectrum touches.
    bound = "" if np.isclose(float(surface.hurst), 0.8) else "≤ "
    low, high = map(float, surface.C0_reference_upper.sel(end=["smooth", "rough"]))
    return texts | {"line": bound + interval(low, high, digits=2)}


def middle(ends: tuple[float, float]) -> tuple[float, float]:
    """Value between two ends that are one standard error off, and its error, which covers 90 %."""
    low, high = ends
    return (low + high) / 2, COVERS * (high - low) / 2
