"""Every pair of a material and a surface on one axis, with Bokeh."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from bokeh.models import ColumnDataSource, HoverTool, Legend, Span
from bokeh.plotting import figure

from pipeline.pages.interactive import make_plot
from pipeline.plotting import BLUE, GREEN, ORANGE, RED
from pipeline.verdicts.words import find_limits
from stickiness.criteria.pair import (
    DEPENDS,
    NOT_STICKY,
    STICKS_FULLY,
    STICKY,
    TOUCHES,
    WORDS,
)
from stickiness.remaining.prediction import DEFAULT_SHARE
from stickiness.remaining.share import tough_share

LOOKS = {  # of a verdict
    STICKS_FULLY: ("square", BLUE),
    STICKY: ("circle", GREEN),
    DEPENDS: ("triangle", "#555555"),
    TOUCHES: ("diamond", ORANGE),
    NOT_STICKY: ("x", RED),
}
LEAST_RATIO, MOST_RATIO = 1e-6, 1e3  # w/U_full; pairs beyond stand at the edges
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
        x_axis_label="work of adhesion over the elastic energy of full contact",
        y_axis_label="remaining share [%]",
    )
    plot.add_layout(
        Span(location=100 * DEFAULT_SHARE, dimension="width", line_dash="dashed", line_color="#666")
    )
    ratios = np.geomspace(LEAST_RATIO, MOST_RATIO, 500)
    look = {"line_color": "#999999", "line_dash": "dotted", "line_width": 1.5}
    items = [("short range", [plot.line(ratios, 100 * tough_share(ratios), **look)])]
    for code, (marker, colour) in LOOKS.items():
        rows = [row for row in pairs if row["grade"] == code]
        if rows:
            items.append((WORDS[code], draw_group(plot, verdicts, rows, marker, colour)))
    plot.add_layout(Legend(items=items, click_policy="hide", location="top_left"))
    return plot


def draw_group(plot, verdicts, rows, marker, colour):
    """Pairs of one verdict with their limits, as renderers."""
    places = [locate(verdicts.sel(material=row["key"], surface=row["name"])) for row in rows]
    columns = {name: [place[name] for place in places] for name in places[0]}
    columns |= {name: [row[name] for row in rows] for name in TEXTS}
    source = ColumnDataSource(columns)
    look = {"source": source, "line_color": colour}
    across = plot.segment("left", "share", "right", "share", line_alpha=0.6, **look)
    up = plot.segment("ratio", "low", "ratio", "high", line_alpha=0.6, **look)
    fill = {"fill_color": colour, "fill_alpha": 0.8}
    points = plot.scatter("ratio", "share", marker=marker, size=10, line_width=1.5, **fill, **look)
    plot.add_tools(HoverTool(renderers=[points], tooltips=TOLD, visible=False))
    return [points, across, up]


def locate(pair: xr.Dataset) -> dict[str, float]:
    """Middle and limits of the share [%], and of w/U_full between both ends of the surface."""
    ends = np.clip(np.sort(pair.energy_ratio.values), LEAST_RATIO, MOST_RATIO)
    low, high = find_limits(pair)
    return {
        "left": float(ends[0]),
        "right": float(ends[-1]),
        "ratio": float(np.sqrt(ends[0] * ends[-1])),
        "share": 100 * float(pair.remaining.mean()),
        "low": 100 * float(low),
        "high": 100 * float(high),
    }
