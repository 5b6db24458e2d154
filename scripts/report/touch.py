"""Where a measured surface touches: contact and gap under a slider of the load, and numbers."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from bokeh.layouts import column
from bokeh.models import (
    ColorBar,
    ColumnDataSource,
    CustomJS,
    CustomJSHover,
    DataRange1d,
    Div,
    HoverTool,
    LinearColorMapper,
    RadioButtonGroup,
)

from common.formatting import amount, number, percent, with_rough_error
from common.plotting import RED
from report import captions, interactive
from report.contact_looks import GAPS, HEIGHTS, palette, sides_of, unit_of_map, widest_gap
from report.surface_figure import unit_of
from stickiness import datasets
from stickiness.solids import HALF_SPACE

HIGHEST = 255  # code of a gap or a height
FIRST = 4  # load shown at first
SHARES = [f"{RED}{alpha}" for alpha in ("00", "73", "a6", "d9", "ff")]  # by points of four
CAPTION = """Where the surface touches an elastic half-space, without adhesion: contact in orange
on the gap. The heights have waves down to {shortest}{cutoff}. Finer waves split every contact into
smaller ones.

{measurement}The grid has {grid} points. To make the heights periodic they were changed by {change}
of their rms value, most of it next to the border. Errors of areas and gaps are their largest
relative change from a grid half as fine, at the load and its neighbours. What finer waves and the
change at the border do is no part of them.
"""
CHANGE = """
const k = slider.value;
shown.data = {...shown.data, gap: [stored.data.gap[k]], contact: [stored.data.contact[k]]};
text.text = texts[k];
"""
TOGGLE = """
const heights = toggle.active == 1;
for (const one of of_heights) one.visible = heights;
for (const one of of_gaps) one.visible = !heights;
"""


def describe(path, still, materials):
    """What the page shows of the file at `path`: figure, still, numbers; None if it holds nothing.

    `materials` are own ones, `Material` by their labels.
    """
    dataset = datasets.read(path)
    if dataset.attrs["left_out"]:
        return None
    rows = describe_loads(dataset, materials)
    return {
        "figure": interactive.embed(draw(dataset, [say(row) for row in rows])),
        "still": captions.embed_figure(still, write_caption(dataset)),
        "materials": list(rows[0]["pressures"]),
        "rows": rows,
        "file": Path(path),
    }


def write_caption(dataset):
    """The caption with the numbers of this surface."""
    shortest, cutoff = float(dataset.shortest_wavelength), float(dataset.cutoff_wavelength)
    finest = amount(cutoff, "m", 2)
    limit = f"; the instrument resolves {finest}" if shortest > 1.001 * cutoff else ""
    return CAPTION.format(
        grid=" by ".join(str(2 * dataset.sizes[axis]) for axis in ("x", "y")),
        shortest=amount(shortest, "m", 2),
        cutoff=limit,
        measurement=captions.say_measurement(dataset),
        change=percent(float(dataset.change)),
    )


def describe_loads(dataset, materials):
    """Texts of every load; pressures of the materials to which the contact applies.

    Those have no layer and no roughness of their own. A modulus that depends on the rate is that
    at 1 Hz.
    """
    suited = {
        f"{label} at 1 Hz" if solid.depends_on_rate else label: solid.modulus
        for label, solid in materials.items()
        if solid.solid == HALF_SPACE and solid.surface is None
    }
    rows = []
    for pressure in dataset.pressure.values:
        at = dataset.sel(pressure=pressure)
        area, gap = float(at.area_fraction), float(at.mean_gap)
        error, gap_error = (
            float(at[f"{name}_discretisation_error"]) for name in ("area_fraction", "mean_gap")
        )
        loads = {
            label: amount(float(at.mean_pressure) * modulus, "Pa", 2)
            for label, modulus in suited.items()
        }
        factor, unit = unit_of(gap)
        rows.append(
            {
                "pressure": number(float(pressure), 2),
                "pressures": loads,
                "area": with_rough_error(100 * area, 100 * error, "%"),
                "gap": with_rough_error(gap * factor, gap_error * factor, unit),
            }
        )
    return rows


def say(row):
    """One load in words."""
    loads = [f"{pressure} for {label}" for label, pressure in row["pressures"].items()]
    loads = loads or [f"p/(E* q0 h_rms) = {row['pressure']}"]
    pressure = captions.typeset("Mean pressure " + ", ".join(loads))
    return f"{pressure}. In contact: {row['area']}. Mean gap: {row['gap']}."


def draw(dataset, texts):
    """Bokeh figure with a slider over the loads."""
    sides, (per_x, unit_x) = sides_of(dataset), unit_of_map(dataset)
    scales = {
        "gap": Scale.of(0.0, widest_gap(dataset)),
        "height": Scale.of(*map(float, np.percentile(dataset.heights, [0.2, 99.8]))),
    }
    gaps = [scales["gap"].code(gap.T) for gap in dataset.gap.values]
    contacts = [np.uint8(np.rint(4 * share.T)) for share in dataset.contact.values]
    first = min(FIRST, len(gaps) - 1)
    stored = ColumnDataSource({"gap": gaps, "contact": contacts})
    shown = ColumnDataSource(
        {
            "gap": [gaps[first]],
            "contact": [contacts[first]],
            "height": [scales["height"].code(dataset.heights.values.T)],
        }
    )
    plot = draw_map(sides, unit_x, 0.86)
    look = {"x": 0, "y": 0, "dw": sides[0] * per_x, "dh": sides[1] * per_x, "source": shown}
    layers = {}
    for name, colours in (("gap", palette(GAPS)), ("height", palette(HEIGHTS))):
        image = plot.image(name, palette=colours, **look, name=name)
        image.glyph.color_mapper.update(low=0, high=HIGHEST)
        bar = scales[name].draw_bar(colours, name)
        plot.add_layout(bar, "below")
        layers[name] = [image, bar]
    for each in layers["height"]:
        each.visible = False
    shares = LinearColorMapper(palette=SHARES, low=0, high=4)
    top = plot.image("contact", color_mapper=shares, **look, name="contact")
    plot.add_tools(describe_point(top, scales, unit_x))
    text = Div(text=texts[first], sizing_mode="stretch_width")
    slider = interactive.make_slider("load", "Load, from light to heavy", len(gaps), first)
    passed = {"slider": slider, "shown": shown, "stored": stored, "text": text, "texts": texts}
    slider.js_on_change("value", CustomJS(args=passed, code=CHANGE))
    toggle = RadioButtonGroup(labels=["Gaps", "Heights"], active=0, name="layer")
    passed = {"toggle": toggle, "of_gaps": layers["gap"], "of_heights": layers["height"]}
    toggle.js_on_change("active", CustomJS(args=passed, code=TOGGLE))
    return column(slider, text, toggle, plot, sizing_mode="stretch_width", max_width=640)


@dataclass(frozen=True)
class Scale:
    """Codes 0 to `HIGHEST`, one byte each, of lengths [m] between two ends."""

    low: float
    high: float
    factor: float  # to the unit that suits the lengths
    unit: str

    @classmethod
    def of(cls, low, high):
        """Choose the unit."""
        return cls(low, high, *unit_of(max(abs(low), abs(high))))

    def code(self, field):
        """Nearest codes of a field; what is beyond an end has the code of that end."""
        share = (field - self.low) / (self.high - self.low)
        return np.uint8(np.rint(HIGHEST * np.clip(share, 0, 1)))

    def draw_bar(self, colours, name):
        """Bar of the colours in the unit."""
        ends = {"low": self.low * self.factor, "high": self.high * self.factor}
        mapper = LinearColorMapper(palette=colours, **ends)
        return ColorBar(color_mapper=mapper, title=f"{name} [{self.unit}]", height=12)

    def formatter(self):
        """What turns a code back into the length, for readers."""
        args = {"low": self.low * self.factor, "span": (self.high - self.low) * self.factor}
        code = f"return (low + span * value / {HIGHEST}).toPrecision(3)"
        return CustomJSHover(args=args, code=code)


def describe_point(image, scales, unit_x):
    """Tool that tells place, gap, height and contact of the point under the pointer."""
    tips = [("x, y", f"$x{{0.000}}, $y{{0.000}} {unit_x}")]
    tips += [(name, f"@{name}{{custom}} {scale.unit}") for name, scale in scales.items()]
    tips += [("in contact", "@contact of 4 points")]
    formatters = {f"@{name}": scale.formatter() for name, scale in scales.items()}
    return HoverTool(renderers=[image], tooltips=tips, formatters=formatters)


def draw_map(sides, unit, shape):
    """Empty plot of a map, in a box as wide as high, times `shape`, for a square map."""
    plot = interactive.make_plot(
        x_range=DataRange1d(range_padding=0),  # of fixed ranges a narrow window changes the shape
        y_range=DataRange1d(range_padding=0),
        match_aspect=True,
        sizing_mode="scale_width",
        aspect_ratio=max(sides[0] / sides[1], 0.3) * shape,
        x_axis_label=f"x [{unit}]",
        y_axis_label=f"y [{unit}]",
    )
    plot.grid.visible = False
    return plot
