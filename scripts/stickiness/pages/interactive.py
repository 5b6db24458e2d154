"""Interactive figures in a page of one file that needs no network: Bokeh, written into the page."""

import numpy as np
import pandas as pd
from bokeh import models
from bokeh.embed import components
from bokeh.plotting import figure
from bokeh.resources import Resources
from markupsafe import Markup

from stickiness.pages.plotting import BLUE, GREEN, ORANGE, RED
from stickiness.pages.surface_figures import REMAINS
from stickiness.remaining.roughness import SHORT_RANGE, Roughness
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.verdicts.limits import read_limited

LOOKS = (  # of the verdicts, in the order of their codes
    ("x", RED),
    ("diamond", ORANGE),
    ("triangle", "#555555"),
    ("circle", GREEN),
    ("square", BLUE),
)
LEAST_RATIO = 1e-6  # w/U_full; pairs beyond these two stand at the edges
MOST_RATIO = 1e3
TOLD_OF_PAIR = [
    ("", "@material on @surface"),
    ("verdict", "@word"),
    ("remains", "@remaining"),
    ("pull-off", "@pull_off"),
    ("sticks below", "@threshold; the material: @modulus"),
]


def library():
    """Bokeh itself as script elements, once a page, for its head: 1.3 MB."""
    scripts = Resources(mode="inline", components=["bokeh"]).js_raw[:-1]
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


def plot_shares(label, wanted, **settings):
    """Empty plot of remaining shares, with a dashed line at the wanted one."""
    plot = make_plot(x_axis_type="log", x_axis_label=label, y_axis_label=REMAINS, **settings)
    look = {"dimension": "width", "line_dash": "dashed", "line_color": "#666"}
    plot.add_layout(models.Span(location=100 * wanted, **look))
    return plot


def draw_pairs(pairs):
    """Remaining share of `pairs`, rows of `rows.describe_pair`, with limits, by w/U_full."""
    ranges = {"x_range": (LEAST_RATIO / 1.5, MOST_RATIO * 1.5), "y_range": (-3, 103)}
    label = "work of adhesion over energy of full contact"
    plot = plot_shares(label, DEFAULT_SHARE, height=460, **ranges)
    # Many decades of waves with the Hurst exponent 0.8.
    rough = Roughness(h_rms=1.0, q0=1.0, elastic_energy=2 / 3)
    ratios = np.geomspace(LEAST_RATIO, MOST_RATIO, 500)
    model = {"line_color": "#999999", "line_dash": "dotted", "line_width": 1.5}
    line = plot.line(ratios, 100 * rough.share(ratios * rough.elastic_energy, SHORT_RANGE), **model)
    items = [("the model, short range", [line])]
    for code, (marker, colour) in enumerate(LOOKS):
        points = [locate(pair) for pair in pairs if pair["code"] == code]
        if not points:
            continue
        source = models.ColumnDataSource(pd.DataFrame(points).to_dict("list"))
        look = {"line_color": colour, "line_alpha": 0.6}
        bars = plot.segment("ratio", "low", "ratio", "high", source=source, **look)
        look = {"marker": marker, "size": 9, "color": colour, "fill_alpha": 0.8}
        marks = plot.scatter("ratio", "share", source=source, **look)
        plot.add_tools(models.HoverTool(renderers=[marks], tooltips=TOLD_OF_PAIR, visible=False))
        items.append((points[0]["word"], [marks, bars]))
    plot.add_layout(models.Legend(items=items, click_policy="hide", location="top_left"))
    return plot


def locate(row):
    """Point of a pair: w/U_full at the rough end, share [%] and its limits."""
    pair = row["pair"]
    told = {name: row[name] for name in ("material", "surface", "word")} | row["text"]
    ratio = np.clip(float(pair.energy_ratio.sel(end="rough")), LEAST_RATIO, MOST_RATIO)
    share, low, high = (min(100 * each, 100) for each in read_limited(pair.remaining))
    return told | {"ratio": ratio, "share": share, "low": low, "high": high}
