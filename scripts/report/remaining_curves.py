"""What remains of adhesion on one surface against modulus, height and rate: Bokeh and print."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr
from bokeh.models import ColumnDataSource, DataRange1d, HoverTool, Legend, Span, Tabs
from bokeh.models.layouts import TabPanel
from bokeh.plotting import figure
from matplotlib.ticker import FixedLocator, NullLocator
from numpy.typing import NDArray

from common import plotting
from common.formatting import number, quantity
from common.plotting import COLOURS, GREY, MARKERS
from criteria.texts import MPA, describe_threshold, round_share, show_shares, show_stress
from report.interactive import make_plot
from stickiness.criteria.pair import NOT_JUDGED
from stickiness.remaining.prediction import DEFAULT_SHARE

SHOWN = 3  # materials at first, and in print: more is a bundle
DASHES = ("solid", "dashed", "dotted", "dotdash", "dashdot", [8, 3, 2, 3, 2, 3], [12, 3])
STROKES = ("-", "--", ":", "-.", (0, (5, 1, 1, 1, 1, 1)), (0, (8, 2)), (0, (1, 3)))
POINTS = ("circle", "square", "triangle", "diamond", "inverted_triangle", "plus", "x")
FACTORS = (0.1, 0.2, 0.5, 1, 2, 5, 10)  # on the heights, that have a tick
MATTERS = 0.99, 1e-3  # shares beyond which a curve along the modulus says nothing more
SAME = 0.2  # %, difference of curves that nobody sees
ROOM = 3.0  # factor on the modulus by which its curve goes on there
TABS = {"modulus": "Modulus", "roughness": "Roughness", "rate": "Rate"}
LABELS = {
    "modulus": "plane-strain modulus E* [MPa]",
    "roughness": "factor on the heights, and rms height",
    "rate": "frequency [Hz]",
}
REMAINS = "remaining share [%]"
# One column below the figure: long names fit a phone.
LEGEND_ROW = 17  # px
LEGEND = {
    "location": "left",
    "label_text_font_size": "12px",
    "glyph_height": LEGEND_ROW - 2,
    "label_height": LEGEND_ROW - 2,
    "spacing": 2,
    "padding": 2,
    "border_line_color": None,
}


@dataclass(frozen=True)
class Trace:
    """Curve of one material; shares in %."""

    label: str
    place: int  # among all materials of the page, for its look
    x: NDArray
    rough: NDArray
    smooth: NDArray
    low: NDArray
    high: NDArray
    at: list[str]  # where, in words
    own: int  # place of the pair as it is
    thresholds: NDArray  # abscissae where the wanted share remains
    threshold: str

    @property
    def ends(self) -> tuple[str, ...]:
        """Ends of the surface that are drawn: one where the eye could not tell them apart."""
        same = np.allclose(self.rough, self.smooth, rtol=0, atol=SAME)
        return ("rough",) if same else ("rough", "smooth")


def draw_interactive(pairs: xr.Dataset, labels: dict[str, str]) -> Tabs | None:
    """Tabs with a figure each; `labels` of the materials in order. None if nothing is judged."""
    panels = [
        TabPanel(title=TABS[axis], child=draw_axis(axis, traces, pairs))
        for axis, traces in trace_all(pairs, labels).items()
    ]
    return Tabs(tabs=panels, sizing_mode="stretch_width") if panels else None


def trace_all(pairs: xr.Dataset, labels: dict[str, str]) -> dict[str, list[Trace]]:
    """Curves by axis; of the rate those of materials whose modulus depends on it."""
    judged = [name for name in labels if int(pairs.verdict.sel(material=name)) != NOT_JUDGED]
    found = {}
    for axis in TABS:
        traces = []
        for place, name in enumerate(judged):
            pair = pairs.sel(material=name)
            known = bool(np.isfinite(pair[f"remaining_by_{axis}_low"]).any())
            if known and (axis != "rate" or int(pair.depends_on_rate)):
                traces.append(trace(axis, pair, labels[name], place))
        if traces:
            found[axis] = traces
    return found


def trace(axis: str, pair: xr.Dataset, label: str, place: int) -> Trace:
    """Curve of one material along an axis, where it is known and says something."""
    share = pair[f"remaining_by_{axis}"]
    low, high = (pair[f"remaining_by_{axis}_{end}"].values for end in ("low", "high"))
    x, at, own = PLACES[axis](pair)
    kept = np.isfinite(low)
    if axis == "modulus":
        telling = (low < MATTERS[0]) & (high > MATTERS[1])
        telling[own] = True
        kept &= (x >= x[telling].min() / ROOM) & (x <= x[telling].max() * ROOM)
    of_modulus = axis == "modulus"
    return Trace(
        label=label,
        place=place,
        x=x[kept],
        rough=100 * share.sel(end="rough").values[kept],
        smooth=100 * share.sel(end="smooth").values[kept],
        low=100 * low[kept],
        high=100 * high[kept],
        at=[at[i] for i in np.flatnonzero(kept)],
        own=int(np.count_nonzero(kept[:own])),
        thresholds=pair.modulus_threshold.values / MPA if of_modulus else np.array([]),
        threshold=f"{describe_threshold(pair)} MPa" if of_modulus else "",
    )


def place_modulus(pair: xr.Dataset) -> tuple[NDArray, list[str], int]:
    """Abscissae, their words and the place of the pair as it is, along the modulus."""
    moduli = float(pair.modulus_quoted) * pair.modulus_factor.values
    at = [f"E* = {show_stress(modulus, MPA)} MPa" for modulus in moduli]
    return moduli / MPA, at, find_nearest(pair.modulus_factor)


def place_height(pair: xr.Dataset) -> tuple[NDArray, list[str], int]:
    """The same along the factor on the heights."""
    factors, heights = pair.roughness_factor.values, np.sort(pair.pair_h_rms.values)
    at = [f"rms height {quantity(*map(float, f * heights), 'm', 2)}" for f in factors]
    return factors, at, find_nearest(pair.roughness_factor)


def place_rate(pair: xr.Dataset) -> tuple[NDArray, list[str], int]:
    """The same along the frequency."""
    moduli = pair.modulus.values
    at = [
        f"{number(float(f), 2)} Hz, E* = {show_stress(modulus, MPA)} MPa"
        for f, modulus in zip(pair.frequency.values, map(float, moduli), strict=True)
    ]
    return pair.frequency.values, at, find_nearest(pair.frequency)


PLACES = {"modulus": place_modulus, "roughness": place_height, "rate": place_rate}


def find_nearest(values: xr.DataArray) -> int:
    """Place of the value nearest 1: factors, and the frequency of the quoted modulus in Hz."""
    return int(np.argmin(abs(np.log(values.values))))


def draw_axis(axis: str, traces: list[Trace], pairs: xr.Dataset) -> figure:
    """Interactive figure of all curves along one axis."""
    plot = make_plot(
        height=340 + LEGEND_ROW * len(traces),
        x_axis_type="log",
        x_range=DataRange1d(only_visible=True, range_padding=0.02),
        y_range=(-2, 102),
        x_axis_label=LABELS[axis],
        y_axis_label=REMAINS,
    )
    plot.add_layout(
        Span(location=100 * DEFAULT_SHARE, dimension="width", line_dash="dashed", line_color="#666")
    )
    shown = min(SHOWN, len(traces))
    items = [
        (one.label, draw_trace(plot, one, visible=place < shown))
        for place, one in enumerate(traces)
    ]
    plot.add_layout(Legend(items=items, click_policy="hide", **LEGEND), "below")
    if axis == "roughness":
        ticks = label_heights(pairs)
        plot.xaxis.ticker = list(ticks)
        plot.xaxis.major_label_overrides = ticks
    return plot


def draw_trace(plot: figure, one: Trace, visible: bool) -> list[Any]:
    """Limits, both ends of the surface, the pair as it is and its threshold, as renderers."""
    columns = {name: getattr(one, name) for name in ("x", "rough", "smooth", "low", "high", "at")}
    columns |= {
        "label": [one.label] * len(one.x),
        "share": tell_shares(one),
        "limits": tell_limits(one),
    }
    source = ColumnDataSource(columns)
    look = {"color": COLOURS[one.place % len(COLOURS)], "visible": visible}
    band = plot.varea("x", "low", "high", source=source, fill_alpha=0.15, **look)
    dash = DASHES[one.place % len(DASHES)]
    lines = [
        plot.line("x", end, source=source, line_dash=dash, line_width=2, **look) for end in one.ends
    ]
    told = [("", "@label"), ("at", "@at"), ("remains", "@share"), ("limits", "@limits")]
    plot.add_tools(HoverTool(renderers=lines, tooltips=told, visible=False))
    x, y = [one.x[one.own]] * len(one.ends), [getattr(one, end)[one.own] for end in one.ends]
    point = POINTS[one.place % len(POINTS)]
    marks = plot.scatter(x, y, marker=point, size=10, **look)
    return [*lines, marks, band, *draw_thresholds(plot, one, look)]


def draw_thresholds(plot: figure, one: Trace, look: dict[str, Any]) -> list[Any]:
    """Where the curve of each end passes the wanted share, if that is in sight."""
    at = one.thresholds[: len(one.ends)]
    at = at[(at >= one.x[0]) & (at <= one.x[-1])]
    if not at.size:
        return []
    texts = {"label": [one.label] * len(at), "threshold": [one.threshold] * len(at)}
    source = ColumnDataSource({"x": at, "y": np.full(len(at), 100 * DEFAULT_SHARE)} | texts)
    hollow = look | {"fill_color": "white", "line_width": 2, "size": 9}
    circles = plot.scatter("x", "y", source=source, marker="circle", **hollow)
    told = [("", "@label"), ("threshold of E*", "@threshold")]
    plot.add_tools(HoverTool(renderers=[circles], tooltips=told, visible=False))
    return [circles]


def tell_shares(one: Trace) -> list[str]:
    """Shares at both ends of the surface."""
    return [tell(*sorted(pair)) for pair in zip(one.rough, one.smooth, strict=True)]


def tell_limits(one: Trace) -> list[str]:
    """Limits of the share."""
    return [tell(*pair, " to ") for pair in zip(one.low, one.high, strict=True)]


def tell(low: float, high: float, between: str = " … ") -> str:
    return show_shares(round_share(low / 100), round_share(high / 100), between)


def label_heights(pairs: xr.Dataset) -> dict[float, str]:
    """Ticks of the factor on the heights, with the rms height that results."""
    smooth_solid = pairs.pair_h_rms.min("material")  # without the roughness of materials
    height = float(np.sqrt(smooth_solid.prod("end")))
    return {f: f"×{f:g}\n{quantity(f * height, f * height, 'm', 2)}" for f in FACTORS}


def draw_static(pairs: xr.Dataset, labels: dict[str, str], output: str) -> None:
    """The same for print, of the first materials; says so if nothing is judged."""
    found = trace_all(pairs, labels)
    rows = ["ABC"[: max(len(found), 1)]]
    with plotting.open_figure([output], ";".join(rows), 2.9) as panels:
        if not found:
            panels["A"].set_axis_off()
            panels["A"].text(0.5, 0.5, "not judged", ha="center")
        for ax, (axis, traces) in zip(panels.values(), found.items(), strict=False):
            for one in traces[:SHOWN]:
                draw_line(ax, one)
            ax.axhline(100 * DEFAULT_SHARE, color=GREY, linewidth=0.9, linestyle="--")
            ax.set(xscale="log", ylim=(-2, 102), xlabel=LABELS[axis], ylabel=REMAINS)
            if axis == "roughness":
                ticks = label_heights(pairs)
                few = [f for f in ticks if f in (0.1, 1, 10)]
                ax.xaxis.set_major_locator(FixedLocator(few))
                ax.xaxis.set_minor_locator(NullLocator())
                ax.set_xticklabels([ticks[f] for f in few])
        if found:
            handles, texts = panels["A"].get_legend_handles_labels()
            panels["A"].figure.legend(
                handles, texts, loc="outside lower center", ncols=SHOWN, handlelength=3
            )


def draw_line(ax: Any, one: Trace) -> None:
    """Curve of one material in print."""
    colour = COLOURS[one.place % len(COLOURS)]
    look = {"color": colour, "linestyle": STROKES[one.place % len(STROKES)]}
    plotting.draw_band(ax, one.x, one.low, one.high, colour, alpha=0.15)
    marker = MARKERS[one.place % len(MARKERS)]
    for end in one.ends:
        share = getattr(one, end)
        ax.plot(one.x, share, **look)
        ax.plot(one.x[one.own], share[one.own], color=colour, marker=marker)
    ax.plot([], [], marker=marker, **look, label=one.label)
