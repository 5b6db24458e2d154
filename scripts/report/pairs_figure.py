"""Every pair of a material and a surface on one axis, with Bokeh."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from bokeh.models import ColumnDataSource, HoverTool, Legend, Span
from bokeh.plotting import figure

from common.plotting import BLUE, GREEN, ORANGE, RED
from criteria.classification import find_limits
from report.interactive import make_plot
from stickiness.criteria.pair import (
    DEPENDS,
    NOT_STICKY,
    STICKS_FULLY,
    STICKY,
    TOUCHES,
    WORDS,
)
from stickiness.remaining.prediction import DEFAULT_SHARE, SHORT_RANGE, Roughness

LOOKS = {  # of a verdict
    STICKS_FULLY: ("square", BLUE),
    STICKY: ("circle", GREEN),
    DEPENDS: ("triangle", "#555555"),
    TOUCHES: ("diamond", ORANGE),
    NOT_STICKY: ("x", RED),
}
LEAST_RATIO, MOST_RATIO = 1e-6, 1e3  # w/U_full; pairs beyond stand at the edges
SAME = 0.05, 0.2  # of log(w/U_full) and share [%]: differences of ends that nobody sees
TEXTS = ("material", "surface", "verdict", "remaining", "energy_ratio", "limits")
TEXTS += ("pull_off", "threshold", "own_modulus")
TOLD = [
    ("", "@material on @surface"),
    ("verdict", "@verdict"),
    ("remains", "@remaining"),
    ("work over energy", "@energy_ratio"),
    ("margin", "@limits"),
    ("pull-off [kPa]", "@pull_off"),
    ("E* threshold [MPa]", "@threshold; the material: @own_modulus"),
]


def draw_pairs(verdicts: xr.Dataset, pairs: Sequence[Mapping[str, Any]]) -> figure:
    """Share that remains with its limits against w/U_full.

    `pairs` are the texts of every pair, as `report.arrange_verdicts` makes them.
    """
    plot = make_plot(
        height=460,
        x_axis_type="log",
        x_range=(LEAST_RATIO / 1.5, MOST_RATIO * 1.5),
        y_range=(-3, 103),
        x_axis_label="work of adhesion over energy of full contact",
        y_axis_label="remaining share [%]",
    )
    plot.add_layout(
        Span(location=100 * DEFAULT_SHARE, dimension="width", line_dash="dashed", line_color="#666")
    )
    items = [("the model, short range", [draw_model(plot)])]
    for code, (marker, colour) in LOOKS.items():
        rows = [row for row in pairs if row["grade"] == code]
        if rows:
            items.append((WORDS[code], draw_group(plot, verdicts, rows, marker, colour)))
    plot.add_layout(Legend(items=items, click_policy="hide", location="top_left"))
    return plot


def draw_model(plot: figure) -> Any:
    """Line of the model for an attraction of short range, on a half-space."""
    rough = Roughness(h_rms=1.0, q0=1.0, elastic_energy=1.0)
    ratios = np.geomspace(LEAST_RATIO, MOST_RATIO, 500)
    look = {"line_color": "#999999", "line_dash": "dotted", "line_width": 1.5}
    return plot.line(ratios, 100 * rough.share(ratios, SHORT_RANGE), **look)


def draw_group(
    plot: figure,
    verdicts: xr.Dataset,
    rows: Sequence[Mapping[str, Any]],
    marker: str,
    colour: str,
) -> list[Any]:
    """Pairs of one verdict with their limits, both ends of each joined, as renderers."""
    ends = []  # of all pairs: texts, w/U_full, share, low and high limit
    for row in rows:
        texts = {name: row[name] for name in TEXTS}
        pair = verdicts.sel(material=row["key"], surface=row["name"])
        ends.append([texts | end for end in locate(pair)])
    look = {"line_color": colour}
    joined = plot.multi_line(
        [[end["ratio"] for end in pair] for pair in ends],
        [[end["share"] for end in pair] for pair in ends],
        line_alpha=0.6,
        **look,
    )
    points = [end for pair in ends for end in pair]
    source = ColumnDataSource({name: [point[name] for point in points] for name in points[0]})
    look["source"] = source
    bars = plot.segment("ratio", "low", "ratio", "high", line_alpha=0.6, **look)
    fill = {"fill_color": colour, "fill_alpha": 0.8}
    marks = plot.scatter("ratio", "share", marker=marker, size=9, line_width=1.5, **fill, **look)
    plot.add_tools(HoverTool(renderers=[marks], tooltips=TOLD, visible=False))
    return [marks, bars, joined]


def locate(pair: xr.Dataset) -> list[dict[str, float]]:
    """Ends of what is known, the less share first: w/U_full, share and bar [%].

    The bar of the first reaches down to the low limit, that of the last up to the high limit. Ends
    that the eye cannot tell apart are one.
    """
    ratios = np.clip(pair.energy_ratio.values, LEAST_RATIO, MOST_RATIO)
    shares = 100 * pair.remaining.values
    ends = [
        {"ratio": float(ratios[i]), "share": float(shares[i])} for i in np.lexsort((ratios, shares))
    ]
    same = np.allclose(np.log(ratios), np.log(ratios[0]), rtol=0, atol=SAME[0])
    if same and np.allclose(shares, shares[0], rtol=0, atol=SAME[1]):
        ends = ends[:1]
    ends = [end | {"low": end["share"], "high": end["share"]} for end in ends]
    low, high = find_limits(pair)
    ends[0]["low"], ends[-1]["high"] = 100 * float(low), 100 * float(high)
    return ends
