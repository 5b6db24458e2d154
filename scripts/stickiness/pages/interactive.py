"""Interactive figures in a page of one file that needs no network: Bokeh, written into the page."""

from typing import Any

import numpy as np
import pandas as pd
from bokeh import models
from bokeh.embed import components
from bokeh.layouts import column, row
from bokeh.plotting import figure
from bokeh.resources import Resources
from markupsafe import Markup

from stickiness.formatting import unit_for
from stickiness.pages.contact_figure import CONTACT, GAPS, code_maps, follow_tension, sides_of
from stickiness.pages.plotting import BLUE, COLOURS, GREEN, ORANGE, RED
from stickiness.pages.surface_figures import DASHES, LEAST_PERCENT, REMAINS, find_scale
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
POINTS = ("circle", "square", "triangle", "diamond", "inverted_triangle", "plus", "x")
LEGEND_ROW = 17  # px
# One column below the figure: long names fit a phone.
LEGEND: dict[str, Any] = {
    "location": "left",
    "label_text_font_size": "12px",
    "border_line_color": None,
    "glyph_height": LEGEND_ROW - 2,
    "label_height": LEGEND_ROW - 2,
    "spacing": 2,
    "padding": 2,
}
FIRST_LOAD = 4  # that the slider shows at first
SHOW_LOAD = """
const k = slider.value;
shown.data = {code: [stored[k]]};
text.text = texts[k];
"""


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


def draw_curves(found):
    """Tabs with a figure of all `found` curves of a surface for each axis."""
    panels = {name.capitalize(): draw_axis(axis) for name, axis in found.items()}
    tabs = [models.TabPanel(title=title, child=panel) for title, panel in panels.items()]
    return models.Tabs(tabs=tabs, sizing_mode="stretch_width")


def draw_axis(axis):
    """Curves along one `Axis`: value, limits, and the pair as it is."""
    label, wanted, curves = axis
    shown = models.DataRange1d(only_visible=True, range_padding=0.02)
    height = 340 + LEGEND_ROW * len(curves)
    scale, limits = find_scale(curves)
    ranges = {"x_range": shown, "y_range": limits, "y_axis_type": scale}
    plot = plot_shares(label, wanted, height=height, **ranges)
    told = [("", "$name"), (label, "@x"), ("remains [%]", "@value{0.0}")]
    told.append(("limits [%]", "@low{0.0} to @high{0.0}"))
    items = []
    for name, place, points, own, shown_at_first in curves:
        if scale == "log":  # which has no zero
            points = points.assign(**points.drop(columns="x").clip(lower=LEAST_PERCENT / 10))
        source = models.ColumnDataSource(points.to_dict("list"))
        look = {"color": COLOURS[place % len(COLOURS)], "visible": shown_at_first}
        band = plot.varea("x", "low", "high", source=source, fill_alpha=0.15, **look)
        style = look | {"line_dash": DASHES[place % len(DASHES)], "line_width": 2, "name": name}
        line = plot.line("x", "value", source=source, **style)
        plot.add_tools(models.HoverTool(renderers=[line], tooltips=told, visible=False))
        marker = POINTS[place % len(POINTS)]
        mark = plot.scatter([own.x], [own.value], marker=marker, size=10, **look)
        items.append((name, [line, mark, band]))
    plot.add_layout(models.Legend(items=items, click_policy="hide", **LEGEND), "below")
    return plot


def draw_contact(contact, pull_off, texts):
    """Contact under a slider over the loads, each with its text, and the curve of tension."""
    codes, widest = code_maps(contact)
    first = min(FIRST_LOAD, len(texts) - 1)
    shown = models.ColumnDataSource({"code": [codes[first]]})
    # Labels of materials are the user's: as text, not as HTML.
    text = models.Div(text=texts[first], render_as_text=True, sizing_mode="stretch_width")
    look = {"title": "Load, from light to heavy", "show_value": False}
    look |= {"name": "load", "sizing_mode": "stretch_width"}
    slider = models.Slider(start=0, end=len(texts) - 1, value=first, **look)
    passed = {"slider": slider, "shown": shown, "stored": list(codes), "text": text, "texts": texts}
    slider.js_on_change("value", models.CustomJS(args=passed, code=SHOW_LOAD))
    plots = [draw_map(contact, shown, widest)]
    if not pull_off.attrs["left_out"]:
        plots.append(draw_tension(pull_off))
    for plot in plots:
        plot.styles = {"flex": "1 1 20rem", "min-width": "0", "max-width": "40rem"}
    beside = row(*plots, sizing_mode="stretch_width", styles={"flex-wrap": "wrap"})
    return column(slider, text, beside, sizing_mode="stretch_width")


def draw_map(contact, source, widest):
    """Gap as a shade of grey and contact in orange, in a box with the shape of the map."""
    (width, height), unit = sides_of(contact)
    plot = make_plot(
        # Of fixed ranges a narrow window changes the shape.
        x_range=models.DataRange1d(range_padding=0),
        y_range=models.DataRange1d(range_padding=0, flipped=True),
        match_aspect=True,
        sizing_mode="scale_width",
        aspect_ratio=max(width / height, 0.3) * 0.86,
        x_axis_label=f"x [{unit}]",
        y_axis_label=f"y [{unit}]",
    )
    plot.grid.visible = False
    colours = models.LinearColorMapper(palette=[*GAPS, RED], low=0, high=CONTACT)
    plot.image("code", x=0, y=0, dw=width, dh=height, source=source, color_mapper=colours)
    per_gap, unit = unit_for(widest, "m")
    scale = models.LinearColorMapper(palette=GAPS, low=0, high=widest * per_gap)
    plot.add_layout(models.ColorBar(color_mapper=scale, title=f"gap [{unit}]", height=12), "below")
    return plot


def draw_tension(pull_off):
    """Mean tension against mean gap, on approach and separation."""
    curves, gap, tension, limits = follow_tension(pull_off)
    plot = make_plot(height=400, y_range=limits, x_axis_label=gap, y_axis_label=tension)
    plot.add_layout(models.Span(location=0, dimension="width", line_color="#737373"))
    for name, colour, curve in curves:
        look = {"color": colour, "line_width": 2, "legend_label": name}
        plot.line("gap", "tension", source=models.ColumnDataSource(curve), **look)
    plot.legend.location = "bottom_right"
    return plot
