"""Approach and separation with adhesion on measured heights: a curve, a map, and the model."""

from pathlib import Path

import numpy as np
import xarray as xr
from bokeh.layouts import column, row
from bokeh.models import ColumnDataSource, CustomJS, Div, LinearColorMapper, Span

from common.formatting import amount, percent
from common.plotting import BLACK, BLUE, RED
from criteria.materials import RATE_KEYS
from criteria.texts import describe_pull_off, describe_share
from real_surfaces.pictured_heights import NO_MAP, NOT_JUDGED
from report import captions, interactive
from report.contact_looks import ZONES, limits_of_tension, scale_of_tension, sides_of, unit_of_map
from report.pull_off_states import moments
from report.surface_figure import unit_of
from report.touch import draw_map
from stickiness import datasets

MOST_STATES = 80  # on a page
TOO_HIGH = 0.05  # share that remains, below which the model says more than simulations have
CAPTION = """Mean tension against the mean gap, on approach and on separation, and the surface at
the same moment: in contact (orange), within the range of the attraction (blue), open (grey).

The squeeze in between goes beyond the axis. {measurement}Heights on {grid} points, waves down to
{shortest}.
"""
CHANGE = """
const k = slider.value;
const at = stored.data;
shown.data = {zone: [at.zone[k]]};
marker.data = {gap: [at.gap[k]], tension: [at.tension[k]]};
text.text = at.text[k];
"""
ENDS = ("", "_low", "_high")
OF_PAIRS = {"remaining": "separation", "pull_off": "pull_off"}  # as a simulation calls them
WAYS = ((0, "approach", BLUE), (1, "separation", RED))


def describe(path, still, pair):
    """What the page shows of the file at `path`; only a reason if that is all it holds.

    `pair` is the verdict of the material simulated, by its name. None where a surface has no map.
    """
    dataset = datasets.read(path)
    made = datasets.parameters(dataset)
    left_out = dataset.attrs["left_out"]
    if left_out in (NO_MAP, NOT_JUDGED):
        return None
    if left_out:
        return {"material": made["label"], "left_out": left_out}
    shown = thin(dataset)
    return {
        "material": made["label"],
        "left_out": "",
        "figure": interactive.embed(draw(shown)),
        "still": captions.embed_figure(still, write_caption(dataset)),
        "rows": compare(dataset, pair(made["material"])),
        "agreement": judge(dataset),
        "rated": any(key in made for key in RATE_KEYS),
        "squeeze": amount(float(dataset.squeeze_pressure), "Pa", 2),
        "range": metres(dataset.range),
        "material_range": metres(dataset.material_range),
        "longer": exceeds(dataset.range, dataset.material_range),
        "coarser": exceeds(dataset.shortest_wavelength, dataset.judged_wavelength),
        "file": Path(path),
    }


def exceeds(length, other):
    """Whether a length is longer than another by more than rounding."""
    return float(length) > 1.001 * float(other)


def metres(length):
    return amount(float(length), "m", 2)


def thin(dataset):
    """At most `MOST_STATES` states, those of the moments among them."""
    count = dataset.sizes["state"]
    kept = set(np.linspace(0, count - 1, min(count, MOST_STATES), dtype=int))
    return dataset.isel(state=sorted(kept | set(moments(dataset).values())))


def write_caption(dataset):
    """The caption with the numbers of this simulation."""
    points = " by ".join(str(dataset.sizes[axis]) for axis in ("x", "y"))
    return CAPTION.format(
        grid=points,
        shortest=metres(dataset.shortest_wavelength),
        measurement=captions.say_measurement(dataset),
    )


def compare(dataset, pair):
    """Rows of what remains and of the pull-off: simulated, by the model, and as the verdict has."""
    rows = {
        f"Work of separation, simulated, range {metres(dataset.range)}": as_pair(dataset, ""),
        "Work of separation by the model, the same heights and range": as_pair(
            dataset, "predicted_"
        ),
        "The verdict: energy gained by the model, all of the spectrum, range "
        f"{metres(dataset.material_range)}": pair,
    }
    return [
        {"name": name, "remains": describe_share(of), "pull_off": describe_pull_off(of)}
        for name, of in rows.items()
    ]


def as_pair(dataset, prefix):
    """Simulated or predicted numbers as a verdict has those of a pair, at ends that agree."""
    found = {
        f"{to}{end}": dataset[f"{prefix}{name}{end}"]
        for to, name in OF_PAIRS.items()
        for end in ENDS
    }
    # Where this is large the model knows no pull-off. A simulation does.
    ratio = dataset.energy_ratio if prefix else xr.zeros_like(dataset.energy_ratio)
    return xr.Dataset(found | {"energy_ratio": ratio}).expand_dims(end=2)


def judge(dataset):
    """Whether the simulation lies within the limits of the model, as a sentence."""
    names = {"separation": "share that remains on separation", "pull_off": "pull-off"}
    beyond = {name: text for name, text in names.items() if not overlap(dataset, name)}
    if not beyond:
        return "Simulation and model for the same heights and range agree within their limits."
    below = all(float(dataset[name]) < float(dataset[f"predicted_{name}"]) for name in beyond)
    known = (
        f", which is known to be too high where less than {percent(TOO_HIGH)} remains"
        if below and float(dataset.separation) < TOO_HIGH
        else ""
    )
    lie = "lie" if len(beyond) > 1 else "lies"
    return f"The {' and the '.join(beyond.values())} {lie} beyond the limits of the model{known}."


def overlap(dataset, name):
    """Whether the limits of simulation and model have values in common."""
    simulated, model = (
        [float(dataset[f"{prefix}{name}{end}"]) for end in ("_low", "_high")]
        for prefix in ("", "predicted_")
    )
    return simulated[0] <= model[1] and model[0] <= simulated[1]


def draw(dataset):
    """Bokeh curve and map under one slider over the states."""
    per_gap, unit_gap = unit_of(float(dataset.mean_gap.max()))
    per_tension, unit = scale_of_tension(dataset)
    per_x, unit_x = unit_of_map(dataset)
    gap, tension = dataset.mean_gap.values * per_gap, dataset.mean_traction.values * per_tension
    states = [dataset.isel(state=index) for index in range(dataset.sizes["state"])]
    texts = [say_state(state) for state in states]
    zones = [zone.T for zone in dataset.zone.values]
    first = moments(dataset)["pull-off"]
    stored = ColumnDataSource({"zone": zones, "gap": gap, "tension": tension, "text": texts})
    shown = ColumnDataSource({"zone": [zones[first]]})
    marker = ColumnDataSource({"gap": [gap[first]], "tension": [tension[first]]})
    curve = interactive.make_plot(
        sizing_mode="stretch_width",
        height=360,
        y_range=tuple(limit * per_tension for limit in limits_of_tension(dataset)),
        x_axis_label=f"mean gap [{unit_gap}]",
        y_axis_label=f"mean tension [{unit}]",
    )
    curve.add_layout(Span(location=0, dimension="width", line_color="#737373"))
    for way, name, colour in WAYS:
        part = dataset.separating.values == way
        curve.line(gap[part], tension[part], color=colour, line_width=2, legend_label=name)
    curve.scatter("gap", "tension", source=marker, size=11, color=BLACK)
    curve.legend.location = "bottom_right"
    plot = draw_map(sides_of(dataset), unit_x, 0.97)
    box = dict(zip(("dw", "dh"), (side * per_x for side in sides_of(dataset)), strict=True))
    mapper = LinearColorMapper(palette=list(ZONES.values()), low=0, high=2)
    plot.image("zone", x=0, y=0, **box, source=shown, color_mapper=mapper)
    text = Div(text=texts[first], sizing_mode="stretch_width")
    title = "Moment, from approach through squeeze to separation"
    slider = interactive.make_slider("moment", title, len(states), first)
    passed = {"slider": slider, "shown": shown, "stored": stored, "marker": marker, "text": text}
    slider.js_on_change("value", CustomJS(args=passed, code=CHANGE))
    for each in (curve, plot):
        each.styles = {"flex": "1 1 20rem", "min-width": "0"}
    beside = row(curve, plot, sizing_mode="stretch_width", styles={"flex-wrap": "wrap"})
    return column(slider, text, beside, sizing_mode="stretch_width")


def say_state(state):
    """One moment in words."""
    way = "Separation" if int(state.separating) else "Approach"
    tension = float(state.mean_traction)
    kind = "tension" if tension >= 0 else "pressure"
    return (
        f"{way}. Mean gap {metres(state.mean_gap)}, mean {kind} "
        f"{amount(abs(tension), 'Pa', 2)}. In contact: "
        f"{percent(float(state.contact_area))}. Within the range of attraction: "
        f"{percent(float(state.attracted_area))}."
    )
