"""Contact and pull-off of measured heights: for print, and with a slider over the loads."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr
from bokeh.layouts import column, row
from bokeh.models import (
    ColorBar,
    ColumnDataSource,
    CustomJS,
    CustomJSHover,
    DataRange1d,
    Div,
    HoverTool,
    LayoutDOM,
    LinearColorMapper,
    Slider,
    Span,
)
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, Normalize, to_hex, to_rgba
from matplotlib.patches import Patch

from common import plotting
from common.formatting import amount, number, percent, unit_for, with_rough_error
from common.plotting import BLACK, BLUE, GREY, RED, SKY
from report.interactive import make_plot
from stickiness.solids import HALF_SPACE

GAPS = colormaps["bone_r"]
ZONES = {"open": "#f2f2f2", "attracted": SKY, "in contact": RED}  # in the order of the codes
WAYS = ((0, "approach", BLUE), (1, "separation", RED))
PRINTED_LOADS, PRINTED_POINTS = 4, 128  # beside one another, and along their longer side
FIRST_LOAD = 4  # that the slider shows at first
HIGHEST_CODE = 255
SHARES = [f"{RED}{alpha}" for alpha in ("00", "73", "a6", "d9", "ff")]  # by points of four
SHOW_LOAD = """
const k = slider.value;
shown.data = {gap: [stored.data.gap[k]], contact: [stored.data.contact[k]]};
text.text = texts[k];
"""


def draw_still(contact: xr.Dataset, pull_off: xr.Dataset, output: str) -> None:
    """Write contact at some of the loads and, below, the curve of tension with two states.

    Where nothing was simulated the picture says why.
    """
    if contact.attrs["left_out"]:
        with plotting.open_figure([output], [["text"]], 0.6) as panels:
            panels["text"].axis("off")
            reason = f"Not simulated: {contact.attrs['left_out']}."
            panels["text"].text(0, 0.5, reason, va="center", wrap=True)
        return
    sides = sides_of(contact)
    map_height = min(max(1.5 * sides[1] / sides[0], 0.8), 3.0)
    separated = not pull_off.attrs["left_out"]
    rows, height = ["ABCD", "EEFG"][: 1 + separated], map_height + 0.9 + 2.4 * separated
    ratios = [map_height, 2.2][: len(rows)]
    with plotting.open_figure([output], ";".join(rows), height, height_ratios=ratios) as panels:
        count = contact.sizes["pressure"]
        loads = np.linspace(1, count - 1, PRINTED_LOADS).round().astype(int)
        widest = widest_gap(contact)
        for letter, index in zip(rows[0], loads, strict=True):
            draw_contact(panels[letter], contact.isel(pressure=index), widest)
            panels[letter].tick_params(labelleft=letter == "A")
        per_gap, unit = unit_for(widest, "m")
        scale = ScalarMappable(Normalize(0, widest * per_gap), GAPS)
        bar = panels["A"].figure.colorbar(scale, ax=[panels[name] for name in rows[0]], shrink=0.8)
        bar.set_label(f"gap [{unit}]")
        if separated:
            draw_separation(panels, pull_off)


def draw_contact(ax: Any, at: xr.Dataset, widest: float) -> None:
    """Gap as a shade of grey, and contact in orange on top of it."""
    gap, share = (thin(at[name].values.T) for name in ("gap", "contact"))
    share = share[..., None]
    colours = (1 - share) * GAPS(gap / widest) + share * to_rgba(RED)
    extent, unit = extent_of(at)
    ax.imshow(colours, extent=extent, origin="lower", interpolation="nearest")
    ax.set_title(f"{percent(float(at.area_fraction))} contact", loc="right")
    ax.set_xlabel(f"x [{unit}]")


def thin(field):
    """Field of at most `PRINTED_POINTS` a side, by means of two by two points."""
    if max(field.shape) <= PRINTED_POINTS:
        return field
    return field.reshape(field.shape[0] // 2, 2, field.shape[1] // 2, 2).mean(axis=(1, 3))


def draw_separation(panels: Mapping[str, Any], pull_off: xr.Dataset) -> None:
    """Tension against gap, and the zones of the squeezed state and at pull-off."""
    ax = panels["E"]
    per_gap, unit_gap = unit_for(float(pull_off.mean_gap.max()), "m")
    per_tension, unit = tension_unit(pull_off)
    for way, name, colour in WAYS:
        curve = pull_off.isel(state=pull_off.separating.values == way)
        ax.plot(
            curve.mean_gap * per_gap,
            curve.mean_traction * per_tension,
            color=colour,
            label=name,
        )
    ax.axhline(0, color=GREY, linewidth=0.7)
    ax.set_ylim(*(limit * per_tension for limit in tension_limits(pull_off)))
    ax.set(xlabel=f"mean gap [{unit_gap}]", ylabel=f"mean tension [{unit}]")
    ax.legend(loc="lower right")
    extent, unit_x = extent_of(pull_off)
    for letter, (name, index) in zip("FG", find_moments(pull_off).items(), strict=True):
        at = pull_off.isel(state=index)
        place = float(at.mean_gap) * per_gap, float(at.mean_traction) * per_tension
        ax.plot(*place, "o", color=BLACK, clip_on=True)
        ax.annotate(letter, place, xytext=(4, 4), textcoords="offset points", annotation_clip=True)
        colours = ListedColormap(list(ZONES.values()))
        look = {"vmin": 0, "vmax": 2, "origin": "lower", "cmap": colours}
        panels[letter].imshow(at.zone.values.T, extent=extent, **look)
        panels[letter].set_title(name, loc="right")
        panels[letter].set_xlabel(f"x [{unit_x}]")
    keys = [Patch(facecolor=c, edgecolor=GREY, linewidth=0.5, label=n) for n, c in ZONES.items()]
    ax.figure.legend(handles=keys, loc="outside lower right", ncols=3)


def find_moments(pull_off: xr.Dataset) -> dict[str, int]:
    """Indices of two states: pressed together without load on approach, and pull-off."""
    tension, back = pull_off.mean_traction.values, pull_off.separating.values.astype(bool)
    there = np.flatnonzero(~back)
    attracted = there[tension[there] > 0]
    around = there[np.isin(there, attracted[-1] + np.arange(2))] if attracted.size else there
    return {
        "unloaded": int(min(around, key=lambda index: abs(tension[index]))),
        "pull-off": int(np.flatnonzero(back)[np.argmax(tension[back])]),
    }


def sides_of(dataset: xr.Dataset) -> tuple[float, float]:
    """Sides of the map along x and y [m]; positions are middles of pixels."""
    return tuple(float(dataset[axis][0] + dataset[axis][-1]) for axis in ("x", "y"))


def extent_of(dataset: xr.Dataset) -> tuple[list[float], str]:
    """Ends of the map as matplotlib takes them, and the unit that suits them."""
    sides = sides_of(dataset)
    factor, unit = unit_for(max(sides), "m")
    return [0, sides[0] * factor, 0, sides[1] * factor], unit


def widest_gap(contact: xr.Dataset) -> float:
    """Gap [m] at the end of the colours, which few points exceed at the smallest load."""
    return float(contact.gap.isel(pressure=0).quantile(0.995))


def tension_unit(pull_off: xr.Dataset) -> tuple[float, str]:
    """Factor and unit that suit the largest tension; pascals at least."""
    return unit_for(max(float(pull_off.mean_traction.max()), 1.0), "Pa")


def tension_limits(pull_off: xr.Dataset) -> tuple[float, float]:
    """Ends of an axis [Pa] that shows the tension; the squeeze may be far beyond."""
    largest = float(pull_off.mean_traction.max())
    return max(-2 * largest, 1.1 * float(pull_off.mean_traction.min())), 1.3 * largest


def list_loads(contact: xr.Dataset, materials: Mapping[str, Any]) -> list[dict[str, Any]]:
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
    for pressure in contact.pressure.values:
        at = contact.sel(pressure=pressure)
        gap, gap_error = float(at.mean_gap), float(at.mean_gap_discretisation_error)
        factor, unit = unit_for(gap, "m")
        area, area_error = float(at.area_fraction), float(at.area_fraction_discretisation_error)
        rows.append(
            {
                "pressure": number(float(pressure), 2),
                "pressures": {
                    label: amount(float(at.mean_pressure) * modulus, "Pa", 2)
                    for label, modulus in suited.items()
                },
                "area": with_rough_error(100 * area, 100 * area_error, "%"),
                "gap": with_rough_error(gap * factor, gap_error * factor, unit),
            }
        )
    return rows


def draw_interactive(
    contact: xr.Dataset, pull_off: xr.Dataset, loads: list[Mapping[str, Any]]
) -> LayoutDOM:
    """Contact under a slider over the `loads` of `list_loads`, and the curve of tension."""
    widest, first = widest_gap(contact), min(FIRST_LOAD, len(loads) - 1)
    codes = np.rint(HIGHEST_CODE * np.clip(contact.gap.values / widest, 0, 1)).astype("u1")
    stored = ColumnDataSource(
        {
            "gap": [field.T for field in codes],
            "contact": [np.uint8(np.rint(4 * share.T)) for share in contact.contact.values],
        }
    )
    shown = ColumnDataSource({name: [fields[first]] for name, fields in stored.data.items()})
    texts = [describe_load(load) for load in loads]
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
    passed = {"slider": slider, "shown": shown, "stored": stored, "text": text, "texts": texts}
    slider.js_on_change("value", CustomJS(args=passed, code=SHOW_LOAD))
    plots = [draw_map(contact, shown, widest)]
    if not pull_off.attrs["left_out"]:
        plots.append(draw_curve(pull_off))
    for plot in plots:
        plot.styles = {"flex": "1 1 20rem", "min-width": "0", "max-width": "40rem"}
    beside = row(*plots, sizing_mode="stretch_width", styles={"flex-wrap": "wrap"})
    return column(slider, text, beside, sizing_mode="stretch_width")


def describe_load(load: Mapping[str, Any]) -> str:
    pressures = [f"{pressure} for {label}" for label, pressure in load["pressures"].items()]
    pressure = ", ".join(pressures) or f"{load['pressure']} E* q₀ hᵣₘₛ"
    return f"Mean pressure: {pressure}. Contact area: {load['area']}. Mean gap: {load['gap']}."


def draw_map(contact: xr.Dataset, source: ColumnDataSource, widest: float) -> Any:
    """Gap as a shade of grey and contact in orange, in a box with the shape of the map."""
    (_, width, _, height), unit = extent_of(contact)
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
    box = {"x": 0, "y": 0, "dw": width, "dh": height, "source": source}
    palette = [to_hex(GAPS(code / HIGHEST_CODE)) for code in range(HIGHEST_CODE + 1)]
    coded = LinearColorMapper(palette=palette, low=0, high=HIGHEST_CODE)
    plot.image("gap", color_mapper=coded, **box)
    shares = LinearColorMapper(palette=SHARES, low=0, high=4)
    top = plot.image("contact", color_mapper=shares, **box)
    per_gap, unit_gap = unit_for(widest, "m")
    scale = LinearColorMapper(palette=palette, low=0, high=widest * per_gap)
    plot.add_layout(ColorBar(color_mapper=scale, title=f"gap [{unit_gap}]", height=12), "below")
    decode = f"return ({widest * per_gap / HIGHEST_CODE} * value).toPrecision(3)"
    tips = [
        ("x, y", f"$x{{0.000}}, $y{{0.000}} {unit}"),
        ("gap", f"@gap{{custom}} {unit_gap}"),
        ("in contact", "@contact of 4 points"),
    ]
    formatters = {"@gap": CustomJSHover(code=decode)}
    plot.add_tools(HoverTool(renderers=[top], tooltips=tips, formatters=formatters))
    return plot


def draw_curve(pull_off: xr.Dataset) -> Any:
    """Mean tension against mean gap, on approach and separation."""
    per_gap, unit_gap = unit_for(float(pull_off.mean_gap.max()), "m")
    per_tension, unit = tension_unit(pull_off)
    plot = make_plot(
        sizing_mode="stretch_width",
        height=400,
        y_range=tuple(limit * per_tension for limit in tension_limits(pull_off)),
        x_axis_label=f"mean gap [{unit_gap}]",
        y_axis_label=f"mean tension [{unit}]",
    )
    plot.add_layout(Span(location=0, dimension="width", line_color="#737373"))
    lines = []
    for way, name, colour in WAYS:
        curve = pull_off.isel(state=pull_off.separating.values == way)
        source = ColumnDataSource(
            {
                "gap": curve.mean_gap.values * per_gap,
                "tension": curve.mean_traction.values * per_tension,
                "contact": [percent(float(share)) for share in curve.contact_area],
                "attracted": [percent(float(share)) for share in curve.attracted_area],
                "way": [name] * curve.sizes["state"],
            }
        )
        look = {"color": colour, "line_width": 2, "legend_label": name}
        lines.append(plot.line("gap", "tension", source=source, **look))
    tips = [
        ("", "@way"),
        ("mean gap", f"@gap{{0.000}} {unit_gap}"),
        ("mean tension", f"@tension{{0.000}} {unit}"),
        ("in contact", "@contact"),
        ("within the range", "@attracted"),
    ]
    plot.add_tools(HoverTool(renderers=lines, tooltips=tips, visible=False))
    plot.legend.location = "bottom_right"
    return plot
