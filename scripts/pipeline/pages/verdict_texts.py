"""Verdict on a pair of a material and a surface as texts, and the numbers that sort it."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from pipeline.numbers import NOTHING, interval, percent, quantity
from stickiness.core import budget

EDGES = "edge_adhesion"
STICKINESS = ("not sticky", "depends", "sticky", "undecided")  # by the code in the dataset
STICKINESS_TONES = ("no", "partly", "yes", "open")
GRADES = (0, 2, 3, 1)  # of the codes: an undecided pair stands next to one that does not stick


def pair_texts(pair: xr.Dataset) -> dict[str, Any]:
    """What the pages say of a pair; from the rough to the smooth end of the surface."""
    code = int(pair.verdict)
    margins = ends(pair.margin.sel(criterion=EDGES))
    thresholds = ends(pair.modulus_threshold)
    limits = float(pair.margin_low.min()), float(pair.margin_high.max())
    a_v = float(pair.pair_a_v_low.min()), float(pair.pair_a_v_high.max())
    return {
        "verdict": STICKINESS[code],
        "tone": STICKINESS_TONES[code],
        "grade": GRADES[code],
        "outside": not bool(pair.simulated.all()),
        "margin": interval(*margins, digits=2),
        "order": float(np.sqrt(np.prod(margins))),
        "limits": interval(*limits, digits=2),
        "lowest": limits[0],
        "by": dominating(pair),
        "threshold": quantity(*thresholds, "Pa", digits=2),
        "threshold_limits": quantity(
            float(pair.modulus_threshold_low.min()),
            float(pair.modulus_threshold_high.max()),
            "Pa",
            digits=2,
        ),
        "threshold_value": thresholds[0],
        "a_v": interval(*a_v, digits=2),
        "a_v_value": float(pair.pair_a_v.mean()),
        **drawn_texts(pair),
    }


def dominating(pair: xr.Dataset) -> str:
    """Source of the largest error of the margin, at the end of the surface with the larger."""
    margin = pair.sel(criterion=EDGES)
    worst = (margin.margin_total_error / margin.margin).argmax("end")
    return budget.dominant(margin.isel(end=worst), "margin")


def ends(values: xr.DataArray) -> tuple[float, float]:
    """Values at the rough and at the smooth end of the surface."""
    return float(values.sel(end="rough")), float(values.sel(end="smooth"))


def drawn_texts(pair: xr.Dataset) -> dict[str, Any]:
    """Shares and errors from spectra drawn within the errors of a measurement, if there are any."""
    share = float(pair.probability)
    numbers = {
        "share": share,
        "quantile": float(pair.margin_quantile[0]),
        "error": float(np.hypot(pair.error_of_spectrum, pair.error_of_model)),
    }
    if not np.isfinite(share):
        return numbers | {"probability": NOTHING, "drawn": NOTHING, "errors": NOTHING}
    return numbers | {
        "probability": percent(share),
        "drawn": interval(*map(float, pair.margin_quantile.values[[0, -1]]), 2),
        "errors": f"spectrum {percent(float(pair.error_of_spectrum))}, a_V and model "
        f"{percent(float(pair.error_of_model))}",
    }
