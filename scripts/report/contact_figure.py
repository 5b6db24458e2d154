"""Contact and pull-off of measured heights: for print, and with a slider over the loads."""

import numpy as np
from bokeh.layouts import column, row
from bokeh.models import (
    ColorBar,
    ColumnDataSource,
    CustomJS,
    DataRange1d,
    Div,
    HoverTool,
    LinearColorMapper,
    Slider,
    Span,
)
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, Normalize, to_hex

from common import plotting
from common.formatting import amount, number, percent, quantity_with_error, unit_for, with_error
from common.plotting import BLUE, GREY, RED
from report.interactive import make_plot
from stickiness.solids import HALF_SPACE

CONTACT = 255  # code of a pixel in contact; lower ones are gaps
GAPS = [to_hex(colormaps["bone_r"](code / (CONTACT - 1))) for code in range(CONTACT)]
WAYS = ((0, "approach", BLUE), (1, "separation", RED))
PRINTED_LOADS = 4  # beside one another
FIRST_LOAD = 4  # that the slider shows at first
SHOW_LOAD = """
const k = slider.value;
shown.data = {code: [stored[k]]};
text.text = texts[k];
"""


def draw_still(contact, pull_off, output):
    """Write contact at some of the loads and, below, the curve of tension.

    Where nothing was simulated the picture says why.
    """
    if contact.attrs["left_out"]:
        with plotting.open_figure([output], [["text"]], 0.6) as panels:
            panels["text"].axis("off")
            reason = f"Not simulated: {contact.attrs['left_out']}."
            panels["text"].text(0, 0.5, reason, va="center", wrap=True)
        return
    codes, widest = code_maps(contact)
    (width, height), unit = sides_of(contact)
    ratios = [min(max(1.5 * height / width, 0.8), 3.0), 2.2]
    rows = ["ABCD", ".EE."]
    if pull_off.attrs["left_out"]:
        rows, ratios = rows[:1], ratios[:1]
    heights = {"height_ratios": ratios}
    with plotting.open_figure([output], ";".join(rows), sum(ratios) + 0.9, **heights) as panels:
        loads = np.linspace(1, len(codes) - 1, PRINTED_LOADS).round().astype(int)
        look = {"cmap": ListedColormap([*GAPS, RED]), "vmin": 0, "vmax": CONTACT}
        look |= {"extent": [0, width, 0, height], "origin": "lower", "interpolation": "nearest"}
        for letter, index in zip(rows[0], loads, strict=True):
            panels[letter].imshow(codes[index], **look)
            area = percent(contact.area_fraction[index])
            panels[letter].set_title(f"{area} contact", loc="right")
            panels[letter].set_xlabel(f"x [{unit}]")
            panels[letter].tick_params(labelleft=letter == "A")
        per_gap, unit = unit_for(widest, "m")
        scale = ScalarMappable(Normalize(0, widest * per_gap), ListedColormap(GAPS))
        axes = [panels[letter] for letter in rows[0]]
        axes[0].figure.colorbar(scale, ax=axes, shrink=0.8, label=f"gap [{unit}]")
        if "E" in panels:
            curves, gap, tension, limits = follow_tension(pull_off)
            for name, colour, curve in curves:
                panels["E"].plot(curve["gap"], curve["tension"], color=colour, label=name)
            panels["E"].axhline(0, color=GREY, linewidth=0.7)
            panels["E"].set(ylim=limits, xlabel=gap, ylabel=tension)
            panels["E"].legend(loc="lower right")


def code_maps(contact):
    """Code of every pixel by load, y and x, and the gap [m] of the highest code of gaps.

    A few gaps at the smallest load are wider. A pixel is a block of two by two points, and in
    contact if half of them are.
    """
    widest = float(contact.gap.isel(pressure=0).quantile(0.995))
    codes = np.rint((CONTACT - 1) * np.clip(contact.gap / widest, 0, 1))
    codes = codes.where(contact.contact < 0.5, CONTACT).transpose("pressure", "y", "x")
    return codes.values.astype("u1"), widest


def sides_of(dataset):
    """Sides of the map along x and y in a unit that suits them; positions are pixel centres."""
    sides = [float(dataset[axis][0] + dataset[axis][-1]) for axis in ("x", "y")]
    factor, unit = unit_for(max(sides), "m")
    return [factor * side for side in sides], unit


def follow_tension(pull_off):
    """Curves of tension against gap with their names and colours, labels, and limits of tension."""
    per_gap, gap = unit_for(float(pull_off.mean_gap.max()), "m")
    largest = float(pull_off.mean_traction.max())
    per_tension, tension = unit_for(max(largest, 1.0), "Pa")
    curves = []
    for way, name, colour in WAYS:
        states = pull_off.isel(state=pull_off.separating.values == way)
        columns = {
            "gap": states.mean_gap.values * per_gap,
            "tension": states.mean_traction.values * per_tension,
            "contact": list(map(percent, states.contact_area.values)),
            "attracted": list(map(percent, states.attracted_area.values)),
        }
        curves.append((name, colour, columns))
    # The squeeze may press far harder than the surfaces attract each other.
    lowest = max(-2 * largest, 1.1 * float(pull_off.mean_traction.min()))
    limits = lowest * per_tension, 1.3 * largest * per_tension
    return curves, f"mean gap [{gap}]", f"mean tension [{tension}]", limits


def list_loads(contact, materials):
    """Texts of every load: pressure, contact area and mean gap.

    Pressures [Pa] are given for those of the `materials`, by label, that are deep and smooth, as
    the simulated solid is. A modulus that depends on the rate is that at 1 Hz.
    """
    suited = {
        f"{label} at 1 Hz" if solid.depends_on_rate else label: solid.modulus
        for label, solid in materials.items()
        if solid.solid == HALF_SPACE and solid.surface is None
    }
    rows = []
    for at in (contact.isel(pressure=index) for index in range(contact.sizes["pressure"])):
        area = with_error(100 * at.area_fraction, 100 * at.area_fraction_discretisation_error)
        gap, gap_error = float(at.mean_gap), float(at.mean_gap_discretisation_error)
        rows.append(
            {
                "pressure": number(at.pressure, 2),
                "pressures": {
                    label: amount(float(at.mean_pressure) * modulus, "Pa", 2)
                    for label, modulus in suited.items()
                },
                "area": f"({area}) %",
                "gap": quantity_with_error(gap, gap_error, "m"),
            }
        )
    return rows


def draw_interactive(contact, pull_off, loads):
    """Contact under a slider over the `loads` of `list_loads`, and the curve of tension."""
    codes, widest = code_maps(contact)
    texts = [describe_load(load) for load in loads]
    first = min(FIRST_LOAD, len(loads) - 1)
    shown = ColumnDataSource({"code": [codes[first]]})
    text = Div(text=texts[first], sizing_mode="stretch_width")
    slider = Slider(
        name="load",
        title="Load, from light to heavy",
        start=0,
        end=len(loads) - 1,
        value=first,
        show_value=False,
        sizing_mode="stretch_width",
    )
    passed = {"slider": slider, "shown": shown, "stored": list(codes), "text": text, "texts": texts}
    slider.js_on_change("value", CustomJS(args=passed, code=SHOW_LOAD))
    plots = [draw_map(contact, shown, widest)]
    if not pull_off.attrs["left_out"]:
        plots.append(draw_tension(pull_off))
    for plot in plots:
        plot.styles = {"flex": "1 1 20rem", "min-width": "0", "max-width": "40rem"}
    beside = row(*plots, sizing_mode="stretch_width", styles={"flex-wrap": "wrap"})
    return column(slider, text, beside, sizing_mode="stretch_width")


def describe_load(load):
    pressures = [f"{pressure} for {label}" for label, pressure in load["pressures"].items()]
    pressure = ", ".join(pressures) or f"{load['pressure']} E* q₀ hᵣₘₛ"
    return f"Mean pressure: {pressure}. Contact area: {load['area']}. Mean gap: {load['gap']}."


def draw_map(contact, source, widest):
    """Gap as a shade of grey and contact in orange, in a box with the shape of the map."""
    (width, height), unit = sides_of(contact)
    plot = make_plot(
        x_range=DataRange1d(range_padding=0),  # of fixed ranges a narrow window changes the shape
        y_range=DataRange1d(range_padding=0),
        match_aspect=True,
        sizing_mode="scale_width",
        aspect_ratio=max(width / height, 0.3) * 0.86,
        x_axis_label=f"x [{unit}]",
        y_axis_label=f"y [{unit}]",
    )
    plot.grid.visible = False
    colours = LinearColorMapper(palette=[*GAPS, RED], low=0, high=CONTACT)
    plot.image("code", x=0, y=0, dw=width, dh=height, source=source, color_mapper=colours)
    per_gap, unit = unit_for(widest, "m")
    scale = LinearColorMapper(palette=GAPS, low=0, high=widest * per_gap)
    plot.add_layout(ColorBar(color_mapper=scale, title=f"gap [{unit}]", height=12), "below")
    return plot


def draw_tension(pull_off):
    """Mean tension against mean gap, on approach and separation."""
    curves, gap, tension, limits = follow_tension(pull_off)
    plot = make_plot(height=400, y_range=limits, x_axis_label=gap, y_axis_label=tension)
    plot.add_layout(Span(location=0, dimension="width", line_color="#737373"))
    for name, colour, curve in curves:
        look = {"color": colour, "line_width": 2, "legend_label": name, "name": name}
        line = plot.line("gap", "tension", source=ColumnDataSource(curve), **look)
        told = [
            ("", "$name"),
            (gap, "@gap{0.000}"),
            (tension, "@tension{0.000}"),
            ("in contact", "@contact"),
            ("within the range", "@attracted"),
        ]
        plot.add_tools(HoverTool(renderers=[line], tooltips=told, visible=False))
    plot.legend.location = "bottom_right"
    return plot
