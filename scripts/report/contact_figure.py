"""Interactive contact and pull-off of measured heights, with a slider over the loads."""

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

from common.contact_picture import CONTACT, GAPS, code_maps, follow_tension, sides_of
from common.formatting import amount, number, quantity_with_error, unit_for, with_error
from common.plotting import RED
from report.interactive import make_plot
from stickiness.solids import HALF_SPACE

FIRST_LOAD = 4  # that the slider shows at first
SHOW_LOAD = """
const k = slider.value;
shown.data = {code: [stored[k]]};
text.text = texts[k];
"""


def list_loads(contact, materials):
    """Texts of every load: pressure over E* and for each suited material, area and mean gap."""
    # Suited are materials that are deep and smooth, as the simulated solid is.
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
    texts = []
    for load in loads:
        pressures = [f"{pressure} for {label}" for label, pressure in load["pressures"].items()]
        pressure = ", ".join(pressures) or f"{load['pressure']} E* q₀ hᵣₘₛ"
        area, gap = load["area"], load["gap"]
        texts.append(f"Mean pressure: {pressure}. Contact area: {area}. Mean gap: {gap}.")
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
