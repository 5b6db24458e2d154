"""Interactive figures in a page of one file that needs no network: Bokeh, written into the page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from bokeh.embed import components
from bokeh.models import ColumnDataSource, HoverTool, Legend, Span, UIElement
from bokeh.plotting import figure
from bokeh.resources import Resources
from markupsafe import Markup

from common.plotting import BLUE, GREEN, ORANGE, RED
from criteria.classification import find_limits
from stickiness.remaining.prediction import DEFAULT_SHARE, SHORT_RANGE, Roughness

LOOKS = (  # of the verdicts, in the order of their codes
    ("x", RED),
    ("diamond", ORANGE),
    ("triangle", "#555555"),
    ("circle", GREEN),
    ("square", BLUE),
)
LEAST_RATIO, MOST_RATIO = 1e-6, 1e3  # w/U_full; pairs beyond stand at the edges
SAME = 0.05, 0.2  # of log(w/U_full) and share [%]: differences of ends that nobody sees
TOLD = [
    ("", "@material on @surface"),
    ("verdict", "@word"),
    ("remains", "@remaining"),
    ("work over energy", "@energy_ratio"),
    ("margin", "@margin"),
    ("pull-off [kPa]", "@pull_off"),
    ("E* threshold [MPa]", "@threshold; the material: @modulus"),
]


def library() -> Markup:
    """Bokeh itself as script elements, once a page, for its head: 1.7 MB."""
    scripts = Resources(mode="inline", components=["bokeh", "bokeh-widgets"]).js_raw[:-1]
    quiet = 'Bokeh.logger.set_level("error");'  # in place of the last, which says its level
    return Markup("\n").join(Markup(f"<script>{text}</script>") for text in (*scripts, quiet))


def embed(figure: UIElement) -> Markup:
    """The element and the script that draw one figure where they stand; needs `library`."""
    script, element = components(figure)
    return Markup(element + script)


def make_plot(sizing_mode: str = "stretch_width", **asked: Any) -> figure:
    """Empty plot, as wide as the page; `asked` are further arguments of Bokeh's `figure`.

    Dragging and scrolling stay the page's until a tool is chosen.
    """
    plot = figure(
        sizing_mode=sizing_mode,
        tools="pan,wheel_zoom,box_zoom,reset,save",
        active_drag=None,
        active_scroll=None,
        toolbar_location="above",
        **asked,
    )
    plot.toolbar.logo = None
    return plot


def draw_pairs(verdicts: xr.Dataset, pairs: Sequence[Mapping[str, Any]]) -> figure:
    """Remaining share of all judged pairs, with its limits, against w/U_full.

    `pairs` are their rows, as `write_report.arrange_pairs` makes them.
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
    rough = Roughness(h_rms=1.0, q0=1.0, elastic_energy=1.0)
    ratios = np.geomspace(LEAST_RATIO, MOST_RATIO, 500)
    model = {"line_color": "#999999", "line_dash": "dotted", "line_width": 1.5}
    line = plot.line(ratios, 100 * rough.share(ratios, SHORT_RANGE), **model)
    items = [("the model, short range", [line])]
    for code, look in enumerate(LOOKS):
        if rows := [row for row in pairs if row["code"] == code]:
            items.append((rows[0]["word"], draw_group(plot, verdicts, rows, *look)))
    plot.add_layout(Legend(items=items, click_policy="hide", location="top_left"))
    return plot


def draw_group(
    plot: figure,
    verdicts: xr.Dataset,
    rows: Sequence[Mapping[str, Any]],
    marker: str,
    colour: str,
) -> list[Any]:
    """Pairs of one verdict with their limits, both ends of each joined, as renderers."""
    pairs = [locate(verdicts.sel(material=row["key"], surface=row["name"])) for row in rows]
    look = {"line_color": colour}
    joined = plot.multi_line(
        [[end["ratio"] for end in pair] for pair in pairs],
        [[end["share"] for end in pair] for pair in pairs],
        line_alpha=0.6,
        **look,
    )
    told = ({name: row[name] for name in ("material", "surface", "word")} for row in rows)
    points = [
        end | names | row["text"]
        for pair, names, row in zip(pairs, told, rows, strict=True)
        for end in pair
    ]
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
