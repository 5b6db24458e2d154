"""Interactive figures in a page of one file that needs no network: Bokeh, written into the page."""

import numpy as np
from bokeh.embed import components
from bokeh.models import ColumnDataSource, HoverTool, Legend, Span
from bokeh.plotting import figure
from bokeh.resources import Resources
from markupsafe import Markup

from common.plotting import BLUE, GREEN, ORANGE, RED
from common.verdicts import find_limits
from stickiness.remaining.prediction import DEFAULT_SHARE, SHORT_RANGE, Roughness

LOOKS = (  # of the verdicts, in the order of their codes
    ("x", RED),
    ("diamond", ORANGE),
    ("triangle", "#555555"),
    ("circle", GREEN),
    ("square", BLUE),
)
LEAST_RATIO, MOST_RATIO = 1e-6, 1e3  # w/U_full; pairs beyond stand at the edges
TOLD = [
    ("", "@material on @surface"),
    ("verdict", "@word"),
    ("remains", "@remaining"),
    ("work over energy", "@energy_ratio"),
    ("pull-off [kPa]", "@pull_off"),
    ("E* threshold [MPa]", "@threshold; the material: @modulus"),
]


def library():
    """Bokeh itself as script elements, once a page, for its head: 1.7 MB."""
    scripts = Resources(mode="inline", components=["bokeh", "bokeh-widgets"]).js_raw[:-1]
    quiet = 'Bokeh.logger.set_level("error");'  # the last one would write to the console
    return Markup("\n").join(Markup(f"<script>{text}</script>") for text in (*scripts, quiet))


def embed(model):
    """The element and the script that draw one figure where they stand; needs `library`."""
    script, element = components(model)
    return Markup(element + script)


def make_plot(**settings):
    """Empty plot, as wide as the page; `settings` are further arguments of Bokeh's `figure`."""
    plot = figure(
        **{"sizing_mode": "stretch_width"} | settings,
        tools="pan,wheel_zoom,box_zoom,reset,save",
        active_drag=None,  # dragging and scrolling move the page until a tool is chosen
        active_scroll=None,
        toolbar_location="above",
    )
    plot.toolbar.logo = None
    return plot


def draw_wanted_share(plot):
    """Dashed line at the share from which a pair sticks."""
    look = {"dimension": "width", "line_dash": "dashed", "line_color": "#666"}
    plot.add_layout(Span(location=100 * DEFAULT_SHARE, **look))


def draw_pairs(verdicts, pairs):
    """Remaining share of the `pairs` of `write_report.arrange_pairs`, with limits, by w/U_full."""
    plot = make_plot(
        height=460,
        x_axis_type="log",
        x_range=(LEAST_RATIO / 1.5, MOST_RATIO * 1.5),
        y_range=(-3, 103),
        x_axis_label="work of adhesion over energy of full contact",
        y_axis_label="remaining share [%]",
    )
    draw_wanted_share(plot)
    rough = Roughness(h_rms=1.0, q0=1.0, elastic_energy=1.0)
    ratios = np.geomspace(LEAST_RATIO, MOST_RATIO, 500)
    model = {"line_color": "#999999", "line_dash": "dotted", "line_width": 1.5}
    line = plot.line(ratios, 100 * rough.share(ratios, SHORT_RANGE), **model)
    items = [("the model, short range", [line])]
    for code, (marker, colour) in enumerate(LOOKS):
        rows = [row for row in pairs if row["code"] == code]
        if not rows:
            continue
        ends = [locate(verdicts.sel(material=row["key"], surface=row["name"])) for row in rows]
        points = [
            end | {name: row[name] for name in ("material", "surface", "word")} | row["text"]
            for row, pair in zip(rows, ends, strict=True)
            for end in pair
        ]
        source = ColumnDataSource({name: [point[name] for point in points] for name in points[0]})
        look = {"line_color": colour, "line_alpha": 0.6}
        joined = plot.multi_line(
            *([[end[name] for end in pair] for pair in ends] for name in ("ratio", "share")), **look
        )
        bars = plot.segment("ratio", "low", "ratio", "high", source=source, **look)
        look = {"marker": marker, "size": 9, "color": colour, "fill_alpha": 0.8}
        marks = plot.scatter("ratio", "share", source=source, **look)
        plot.add_tools(HoverTool(renderers=[marks], tooltips=TOLD, visible=False))
        items.append((rows[0]["word"], [marks, bars, joined]))
    plot.add_layout(Legend(items=items, click_policy="hide", location="top_left"))
    return plot


def locate(pair):
    """Ends of what is known, the less share first: w/U_full, share [%] and its bar."""
    ratios = np.clip(pair.energy_ratio.values, LEAST_RATIO, MOST_RATIO)
    ends = sorted(zip(100 * pair.remaining.values, ratios, strict=True))
    ends = [{"ratio": ratio, "share": share, "low": share, "high": share} for share, ratio in ends]
    ends[0]["low"], ends[-1]["high"] = (100 * float(limit) for limit in find_limits(pair))
    return ends
