"""Figures of a surface: heights and spectrum, and the adhesion that remains on it."""

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
from common.formatting import number, quantity, unit_for
from common.plotting import BLACK, COLOURS, GREY, MARKERS
from criteria.texts import MPA, describe_threshold, round_share, show_shares, show_stress
from report.interactive import make_plot
from stickiness.criteria.pair import NOT_JUDGED
from stickiness.remaining.prediction import DEFAULT_SHARE
from stickiness.statistics import COVERS

HURST = 0.8  # of the paper's lines
LINES = (1e-3, 1e-5)  # C0 of these [m^0.4]

SHOWN = 3  # materials at first, and in print: more is a bundle
DASHES = ("solid", "dashed", "dotted", "dotdash", "dashdot", [8, 3, 2, 3, 2, 3], [12, 3])
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
LEGEND_ROW = 17  # px
LEGEND = {  # one column below the figure: long names fit a phone
    "location": "left",
    "label_text_font_size": "12px",
    "glyph_height": LEGEND_ROW - 2,
    "label_height": LEGEND_ROW - 2,
    "spacing": 2,
    "padding": 2,
    "border_line_color": None,
}


def draw_surface(surface: xr.Dataset, output: str) -> None:
    """Write a figure with the heights, if there are any, and the spectrum."""
    pictures = {"heights": draw_heights, "profile": draw_profile}
    pictured = next((name for name in pictures if name in surface), None)
    row = "AB" if pictured else "AA"
    with plotting.open_figure([output], row, 3.3) as panels:
        if pictured:
            pictures[pictured](panels["A"], surface)
        draw_spectrum(panels[row[1]], surface)


def draw_heights(ax, surface):
    """Levelled heights as colours, in units that suit them."""
    per_x, unit_x = unit_for(float(max(surface.x.max(), surface.y.max())), "m")
    heights = surface.heights.values
    # A few outliers must not take all the colours.
    low, high = np.percentile(heights, [0.2, 99.8])
    per_h, unit_h = unit_for(max(abs(low), abs(high)), "m")
    extent = [0, float(surface.x[-1]) * per_x, 0, float(surface.y[-1]) * per_x]
    look = {"origin": "lower", "extent": extent, "cmap": "cividis", "interpolation": "nearest"}
    image = ax.imshow(heights.T * per_h, vmin=low * per_h, vmax=high * per_h, **look)
    ax.figure.colorbar(image, ax=ax, label=f"height [{unit_h}]", shrink=0.8)
    ax.set(xlabel=f"x [{unit_x}]", ylabel=f"y [{unit_x}]")


def draw_profile(ax, surface):
    """Levelled heights of a profile."""
    per_x, unit_x = unit_for(float(surface.x.max()), "m")
    per_h, unit_h = unit_for(float(np.abs(surface.profile).max()), "m")
    ax.plot(surface.x * per_x, surface.profile * per_h, color=COLOURS[0], linewidth=0.7)
    ax.set(xlabel=f"x [{unit_x}]", ylabel=f"height [{unit_h}]")


def draw_spectrum(ax, surface):
    """Spectrum with errors, fit, the paper's lines and the ends of the instrument's band."""
    q = surface.wave_number.values
    low, high = surface.psd.values
    if "psd_standard_error" in surface:
        draw_measured(ax, surface, q, low, high)
    else:
        plotting.draw_band(ax, q, low, high, COLOURS[0])
        ax.plot(q, low, q, high, color=COLOURS[0], linewidth=0.9)
    for c0 in LINES:
        ax.plot(q, c0 * q ** (-2 * (HURST + 1)), "--", color=GREY, linewidth=0.8)
    text = " and ".join(f"$10^{{{np.log10(c0):.0f}}}$" for c0 in LINES)
    ax.plot([], [], "--", color=GREY, linewidth=0.8, label=rf"$C_0$ = {text} m$^{{0.4}}$")
    ax.set(xscale="log", yscale="log", xlabel="wave number $q$ [1/m]", ylabel="$C(q)$ [m$^4$]")
    ax.set_ylim(bottom=low.min() / 1e3)  # room for the legend
    ax.legend(loc="lower left")


def draw_measured(ax, surface, q, low, high):
    """Rings within the band of the instrument; `low` and `high` are one standard error off."""
    measured = np.ones_like(q, dtype=bool)
    if float(surface.q1) > float(surface.q_cutoff) * (1 + 1e-9):
        measured = q <= float(surface.q_cutoff) * (1 + 1e-9)
        fit, factor = np.sqrt(low * high), np.sqrt(high / low) ** COVERS
        look = {"where": ~measured, "color": GREY, "alpha": 0.3, "linewidth": 0}
        ax.fill_between(q, fit / factor, fit * factor, **look)
    if "psd_measurement" in surface:  # those behind a stitched spectrum
        for index, levels in enumerate(surface.psd_measurement.values):
            look = {"color": COLOURS[1 + index % (len(COLOURS) - 1)], "linewidth": 0.8}
            ax.plot(surface.wave_number_measured, levels, **look, label=f"measurement {index + 1}")
    look = {"color": COLOURS[0], "label": "measured"}
    error = surface.psd_standard_error.values[measured]
    plotting.draw_spectrum(ax, q[measured], low[measured], error, **look)
    fit = surface.psd_fit.where((surface.fitted == 1) | ~measured)
    text = f"fit: $H$ = {float(surface.hurst):.2f} ± {float(surface.hurst_total_error):.2f}"
    text += ", roll-off" if "q_rolloff" in surface else ""
    ax.plot(q, fit, color=BLACK, linewidth=0.9, zorder=5, label=text)
    draw_limits(ax, surface)


def draw_limits(ax, surface):
    """The instrument's cutoff and, if found, the end of the plateau."""
    look = {"color": COLOURS[1], "linewidth": 0.9, "linestyle": ":"}
    ax.axvline(float(surface.q_cutoff), **look)
    ax.plot([], [], **look, label="cutoff (found)" if int(surface.cutoff_detected) else "cutoff")
    if "q_rolloff" in surface:
        q, error = float(surface.q_rolloff), float(surface.q_rolloff_total_error)
        ax.axvspan(max(q - error, q / 3), q + error, color=COLOURS[2], alpha=0.25, linewidth=0)


@dataclass(frozen=True)
class Curve:
    """Remaining share [%] of one material along an axis."""

    label: str
    place: int  # among all materials of the page, for its look
    x: NDArray
    rough: NDArray  # at the rough end of the surface
    smooth: NDArray
    low: NDArray  # limits
    high: NDArray
    at: list[str]  # abscissae in words
    pair: int  # place of the pair as it is
    thresholds: NDArray  # abscissae where the wanted share remains
    threshold: str

    @property
    def ends(self) -> tuple[str, ...]:
        """Ends of the surface that are drawn: one where the eye could not tell them apart."""
        same = np.allclose(self.rough, self.smooth, rtol=0, atol=SAME)
        return ("rough",) if same else ("rough", "smooth")


def find_curves(pairs: xr.Dataset, labels: dict[str, str]) -> dict[str, list[Curve]]:
    """Curves of the materials that are judged, by axis; along the rate where the modulus varies.

    `labels` are those of the materials in order.
    """
    judged = [name for name in labels if int(pairs.verdict.sel(material=name)) != NOT_JUDGED]
    found = {}
    for axis in TABS:
        curves = []
        for place, name in enumerate(judged):
            pair = pairs.sel(material=name)
            known = bool(np.isfinite(pair[f"remaining_by_{axis}_low"]).any())
            if known and (axis != "rate" or int(pair.depends_on_rate)):
                curves.append(follow(axis, pair, labels[name], place))
        if curves:
            found[axis] = curves
    return found


def follow(axis: str, pair: xr.Dataset, label: str, place: int) -> Curve:
    """Curve of one material along an axis, where it is known and says something."""
    share = pair[f"remaining_by_{axis}"]
    low, high = (pair[f"remaining_by_{axis}_{end}"].values for end in ("low", "high"))
    x, at, own = locate(axis, pair)
    kept = np.isfinite(low)
    of_modulus = axis == "modulus"
    if of_modulus:
        telling = (low < MATTERS[0]) & (high > MATTERS[1])
        telling[own] = True
        kept &= (x >= x[telling].min() / ROOM) & (x <= x[telling].max() * ROOM)
    return Curve(
        label=label,
        place=place,
        x=x[kept],
        rough=100 * share.sel(end="rough").values[kept],
        smooth=100 * share.sel(end="smooth").values[kept],
        low=100 * low[kept],
        high=100 * high[kept],
        at=[at[i] for i in np.flatnonzero(kept)],
        pair=int(np.count_nonzero(kept[:own])),
        thresholds=pair.modulus_threshold.values / MPA if of_modulus else np.array([]),
        threshold=f"{describe_threshold(pair)} MPa" if of_modulus else "",
    )


def locate(axis: str, pair: xr.Dataset) -> tuple[NDArray, list[str], int]:
    """Abscissae along an axis, the same in words, and the place of the pair as it is."""

    def say(moduli):
        return [f"E* = {show_stress(float(modulus), MPA)} MPa" for modulus in moduli]

    if axis == "modulus":
        factors = pair.modulus_factor.values
        moduli = float(pair.modulus_quoted) * factors
        x, at = moduli / MPA, say(moduli)
    elif axis == "roughness":
        x = factors = pair.roughness_factor.values
        heights = np.sort(pair.pair_h_rms.values)
        at = [f"rms height {quantity(*map(float, f * heights), 'm', 2)}" for f in factors]
    else:
        x = factors = pair.frequency.values  # the modulus is quoted at 1 Hz
        moduli = say(pair.modulus.values)
        at = [f"{number(float(f), 2)} Hz, {text}" for f, text in zip(x, moduli, strict=True)]
    return x, at, int(np.argmin(abs(np.log(factors))))


def draw_interactive(pairs: xr.Dataset, labels: dict[str, str]) -> Tabs | None:
    """Tabs with a figure for each axis; None if nothing is judged."""
    panels = [
        TabPanel(title=TABS[axis], child=draw_axis(axis, curves, pairs))
        for axis, curves in find_curves(pairs, labels).items()
    ]
    return Tabs(tabs=panels, sizing_mode="stretch_width") if panels else None


def draw_axis(axis: str, curves: list[Curve], pairs: xr.Dataset) -> figure:
    """Interactive figure of all curves along one axis."""
    plot = make_plot(
        height=340 + LEGEND_ROW * len(curves),
        x_axis_type="log",
        x_range=DataRange1d(only_visible=True, range_padding=0.02),
        y_range=(-2, 102),
        x_axis_label=LABELS[axis],
        y_axis_label=REMAINS,
    )
    plot.add_layout(
        Span(location=100 * DEFAULT_SHARE, dimension="width", line_dash="dashed", line_color="#666")
    )
    items = [
        (one.label, draw_curve(plot, one, visible=place < SHOWN))
        for place, one in enumerate(curves)
    ]
    plot.add_layout(Legend(items=items, click_policy="hide", **LEGEND), "below")
    if axis == "roughness":
        ticks = label_heights(pairs)
        plot.xaxis.ticker = list(ticks)
        plot.xaxis.major_label_overrides = ticks
    return plot


def draw_curve(plot: figure, one: Curve, visible: bool) -> list[Any]:
    """Limits, both ends of the surface, the pair as it is and its threshold, as renderers."""
    columns = {name: getattr(one, name) for name in ("x", "rough", "smooth", "low", "high", "at")}
    columns |= {
        "label": [one.label] * len(one.x),
        "share": [show(*sorted(pair)) for pair in zip(one.rough, one.smooth, strict=True)],
        "limits": [show(*pair, " to ") for pair in zip(one.low, one.high, strict=True)],
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
    x, y = [one.x[one.pair]] * len(one.ends), [getattr(one, end)[one.pair] for end in one.ends]
    point = POINTS[one.place % len(POINTS)]
    marks = plot.scatter(x, y, marker=point, size=10, **look)
    return [*lines, marks, band, *draw_thresholds(plot, one, look)]


def draw_thresholds(plot: figure, one: Curve, look: dict[str, Any]) -> list[Any]:
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


def show(low: float, high: float, between: str = " … ") -> str:
    """Two shares [%] as text."""
    return show_shares(round_share(low / 100), round_share(high / 100), between)


def label_heights(pairs: xr.Dataset) -> dict[float, str]:
    """Ticks of the factor on the heights, with the rms height that results."""
    smooth_solid = pairs.pair_h_rms.min("material")  # without the roughness of materials
    height = float(np.sqrt(smooth_solid.prod("end")))
    return {f: f"×{f:g}\n{quantity(f * height, f * height, 'm', 2)}" for f in FACTORS}


def draw_curves(pairs: xr.Dataset, labels: dict[str, str], output: str) -> None:
    """Write the curves of the first materials for print; say so if nothing is judged."""
    found = find_curves(pairs, labels)
    with plotting.open_figure([output], "ABC"[: max(len(found), 1)], 2.9) as panels:
        if not found:
            panels["A"].set_axis_off()
            panels["A"].text(0.5, 0.5, "not judged", ha="center")
        for ax, (axis, curves) in zip(panels.values(), found.items(), strict=False):
            for one in curves[:SHOWN]:
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


def draw_line(ax: Any, one: Curve) -> None:
    """Curve of one material in print."""
    colour = COLOURS[one.place % len(COLOURS)]
    look = {"color": colour, "linestyle": DASHES[one.place % len(DASHES)]}
    plotting.draw_band(ax, one.x, one.low, one.high, colour, alpha=0.15)
    marker = MARKERS[one.place % len(MARKERS)]
    for end in one.ends:
        share = getattr(one, end)
        ax.plot(one.x, share, **look)
        ax.plot(one.x[one.pair], share[one.pair], color=colour, marker=marker)
    ax.plot([], [], marker=marker, **look, label=one.label)
