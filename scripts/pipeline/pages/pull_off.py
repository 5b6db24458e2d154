"""Approach and separation with adhesion on measured heights: a curve, a map, and the model."""

from pathlib import Path

import numpy as np
from bokeh.layouts import column, row
from bokeh.models import ColumnDataSource, CustomJS, Div, LinearColorMapper, Slider, Span

from pipeline.numbers import NOTHING, number, percent, quantity
from pipeline.pages import captions, interactive
from pipeline.pages.contact_looks import (
    ZONES,
    limits_of_tension,
    scale_of_tension,
    sides_of,
    unit_of_map,
)
from pipeline.pages.pull_off_states import moments
from pipeline.pages.surface_figure import unit_of
from pipeline.pages.touch import draw_map
from pipeline.pictured_heights import NO_MAP, NOT_JUDGED
from pipeline.plotting import BLACK, BLUE, RED
from pipeline.verdicts.texts import describe_share, show_shares
from stickiness.core import datasets

MOST_STATES = 80  # on a page
WIDEST_ZONE = 0.2  # q0 range^2/(adhesion length) of most simulations behind the model
CAPTION = """Mean tension against the mean gap, on approach and on separation, and the surface at
the same moment: in contact (orange), within the range of the attraction (blue), open (grey).

The squeeze in between goes beyond the axis. Heights on {grid} points, waves down to {shortest}.
"""
CHANGE = """
const k = slider.value;
const at = stored.data;
shown.data = {zone: [at.zone[k]]};
marker.data = {gap: [at.gap[k]], tension: [at.tension[k]]};
text.text = at.text[k];
"""
ENDS = ("", "_low", "_high")
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
        "range": metres(dataset.range),
        "material_range": metres(dataset.material_range),
        "longer": float(dataset.range) > 1.001 * float(dataset.material_range),
        "file": Path(path),
    }


def metres(length):
    return quantity(float(length), float(length), "m", 2)


def thin(dataset):
    """At most `MOST_STATES` states, those of the moments among them."""
    count = dataset.sizes["state"]
    kept = set(np.linspace(0, count - 1, min(count, MOST_STATES), dtype=int))
    return dataset.isel(state=sorted(kept | set(moments(dataset).values())))


def write_caption(dataset):
    """The caption with the numbers of this simulation."""
    points = " by ".join(str(dataset.sizes[axis]) for axis in ("x", "y"))
    return CAPTION.format(grid=points, shortest=metres(dataset.shortest_wavelength))


def compare(dataset, pair):
    """Rows of what remains and of the pull-off: simulated, by the model, and as the verdict has."""
    both = [
        {
            "remains": say_share(dataset, prefix),
            "pull_off": say_tension(*(dataset[f"{prefix}pull_off{end}"] for end in ENDS)),
        }
        for prefix in ("", "predicted_")
    ]
    verdict = {
        "remains": describe_share(pair),
        "pull_off": say_tension(*(pair[f"pull_off{end}"] for end in ENDS)),
    }
    names = (
        f"Simulation, range {metres(dataset.range)}",
        "Model, the same heights and range",
        f"Model, all of the spectrum, range {metres(dataset.material_range)}: the verdict",
    )
    return [{"name": name, **row} for name, row in zip(names, (*both, verdict), strict=True)]


def say_share(dataset, prefix):
    """Works of approach and separation as shares of the work of adhesion, with their limits."""
    both = [float(dataset[f"{prefix}{name}"]) for name in ("approach", "separation")]
    low = float(dataset[f"{prefix}approach_low"])
    high = float(dataset[f"{prefix}separation_high"])
    return f"{show_shares(*sorted(both))} ({show_shares(low, high, ' to ')})"


def say_tension(value, low, high):
    """Tension [Pa], or both ends of a range, with limits; a dash where nothing holds."""
    if float(high.max()) == 0:
        return NOTHING
    text = quantity(float(value.min()), float(value.max()), "Pa", 2)
    least, most = (
        quantity(limit, limit, "Pa", 2) for limit in (float(low.min()), float(high.max()))
    )
    return f"{text} ({least} to {most})"


def judge(dataset):
    """Whether the simulation lies within the limits of the model, as a sentence."""
    names = {"separation": "share that remains on separation", "pull_off": "pull-off"}
    beyond = [text for name, text in names.items() if not overlap(dataset, name)]
    if not beyond:
        return "Simulation and model for the same heights and range agree within their limits."
    width = float(dataset.zone_width)
    why = "These hold for surfaces of many long waves with Gaussian heights, and this is one patch."
    if width > WIDEST_ZONE:
        why = (
            f"Most simulations behind it have cohesive zones of {WIDEST_ZONE}/q0 at most, and "
            f"here the zone is {number(width, 2)}/q0 wide."
        )
    return f"The {' and the '.join(beyond)} lies beyond the limits of the model. {why}"


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
    slider = Slider(
        start=0,
        end=len(states) - 1,
        value=first,
        step=1,
        title="Moment, from approach through squeeze to separation",
        show_value=False,
        sizing_mode="stretch_width",
        name="moment",
    )
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
        f"{quantity(abs(tension), abs(tension), 'Pa', 2)}. In contact: "
        f"{percent(float(state.contact_area))}. Within the range of attraction: "
        f"{percent(float(state.attracted_area))}."
    )
