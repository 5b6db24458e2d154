"""Figures of a surface: heights and spectrum, and the adhesion that remains on it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap

from stickiness.formatting import unit_for
from stickiness.measured.levelling import detrend
from stickiness.pages import plotting
from stickiness.pages.plotting import BLACK, COLOURS, GREY, MARKERS
from stickiness.verdicts.limits import LIMITS
from stickiness.verdicts.wording import is_judged, name_modulus

HURST = 0.8  # of the paper's lines
LINES = {1e-3: r"$C_0$ = $10^{-3}$ and $10^{-5}$ m$^{0.4}$", 1e-5: None}
LEAST_CHANGE = 0.02  # of the rms height that a picture shows
SHOWN = 3  # materials in print: more is a bundle
DASHES = ("solid", "dashed", "dotted", "dotdash", "dashdot", [8, 3, 2, 3, 2, 3], [12, 3])
MATTERS = 0.99, 1e-3  # shares beyond which a curve along the modulus says nothing more
LEAST_PERCENT = 0.1  # that a logarithmic axis shows
ROOM = 3.0  # factor on the modulus by which its curve goes on there
LABELS = {
    "modulus": "{symbol} [{unit}]",
    "roughness": "factor on the heights",
    "rate": "frequency [Hz]",
    "dwell": "dwell time [s]",
}
MODULI = {"E": "Young's modulus E", "E*": "plane-strain modulus E*"}
REMAINS = "remaining share [%]"


def draw_surface(surface: xr.Dataset, output: str | Path) -> None:
    """Write a figure with the heights, if there are any, and the spectrum."""
    pictured = [name for name in ("heights", "profile") if name in surface]
    row = "AB" if pictured else "AA"
    with plotting.open_figure([output], row, 3.3) as panels:
        if pictured:
            draw_heights(panels["A"], surface[pictured[0]])
        draw_spectrum(panels[row[1]], surface)


def shows_change(surface: xr.Dataset) -> bool:
    """Whether a map as it was read and as it is used look different when both are level."""
    before = surface.heights_as_read.values
    if surface.unused.any() or not np.isfinite(before).all():
        return True
    thin = max(1, max(surface.heights.shape) // max(before.shape))
    after = surface.heights.values[::thin, ::thin]
    if after.shape != before.shape:
        return True
    difference = detrend(before, "plane") - detrend(after, "plane")
    return bool(np.std(difference) > LEAST_CHANGE * np.std(after))


def draw_reading(surface: xr.Dataset, output: str | Path) -> None:
    """Write small pictures of a map as it was read, with what is not used, and as it is used."""
    with plotting.open_figure([output], "AB", 2.2) as panels:
        before = surface.heights_as_read.values
        per_h, unit = unit_for(np.nanmax(np.abs(before)), "m")
        look = {"origin": "lower", "interpolation": "nearest"}
        panels["A"].set_facecolor(GREY)  # seen where points are missing
        image = panels["A"].imshow(before.T * per_h, cmap="cividis", **look)
        panels["A"].figure.colorbar(image, ax=panels["A"], label=f"height [{unit}]", shrink=0.8)
        unused = np.ma.masked_equal(surface.unused.values.T, 0)
        panels["A"].imshow(unused, cmap=ListedColormap([COLOURS[1]]), **look)
        panels["A"].set(xticks=[], yticks=[])
        thin = max(1, max(surface.heights.shape) // max(before.shape))
        draw_heights(panels["B"], surface.heights[::thin, ::thin])


def draw_heights(ax: Axes, heights: xr.DataArray) -> None:
    """Levelled heights, as colours or as a profile, in units that suit them."""
    per_x, unit_x = unit_for(max(float(heights[axis][-1]) for axis in heights.dims), "m")
    low, high = np.percentile(heights, [0.2, 99.8])  # a few outliers must not take all the colours
    per_h, unit_h = unit_for(max(abs(low), abs(high)), "m")
    ax.set_xlabel(f"x [{unit_x}]")
    if heights.ndim == 1:
        ax.plot(heights.x * per_x, heights * per_h, color=COLOURS[0], linewidth=0.7)
        ax.set_ylabel(f"height [{unit_h}]")
        return
    image = ax.imshow(
        heights.values.T * per_h,
        cmap="cividis",
        vmin=low * per_h,
        vmax=high * per_h,
        origin="lower",
        extent=(0, float(heights.x[-1]) * per_x, 0, float(heights.y[-1]) * per_x),
        interpolation="nearest",
    )
    ax.figure.colorbar(image, ax=ax, label=f"height [{unit_h}]", shrink=0.8)
    ax.set_ylabel(f"y [{unit_x}]")


def draw_spectrum(ax: Axes, surface: xr.Dataset) -> None:
    """Spectrum with errors, fit, the paper's lines and the ends of the instrument's band."""
    q = surface.wave_number.values
    if "psd_standard_error" in surface:
        draw_measured(ax, surface, q)
    else:
        plotting.draw_spectrum(ax, surface, COLOURS[0])
    for c0, label in LINES.items():
        line = c0 * q ** (-2 * (HURST + 1))
        ax.plot(q, line, "--", color=GREY, linewidth=0.8, label=label)
    ax.set(xscale="log", yscale="log", xlabel="wave number $q$ [1/m]", ylabel="$C(q)$ [m$^4$]")
    room = 1e9 if "psd_measurement" in surface else 1e3  # for the legend
    ax.set_ylim(bottom=float(surface.psd.isel(end=0).min()) / room)
    ax.legend(loc="lower left" if surface.hurst > -1 else "center left")  # clear of the points


def draw_measured(ax: Axes, surface: xr.Dataset, q: np.ndarray) -> None:
    """Rings within the band of the instrument, the fit with its band beyond, and the cutoff."""
    beyond = ~plotting.find_rings(surface)
    plotting.draw_assumed(ax, surface, GREY)
    if "psd_measurement" in surface:  # those behind a stitched spectrum
        names = plotting.name_measurements(surface)
        for index, levels in enumerate(surface.psd_measurement.values):
            colour = COLOURS[1 + index % (len(COLOURS) - 1)]
            text = names[index] if surface.is_used[index] else f"{names[index]}, not used"
            q_measured = surface.wave_number_measured
            ax.plot(q_measured, levels, color=colour, linewidth=0.8, label=text)
    plotting.draw_spectrum(ax, surface, COLOURS[0], "measured")
    fit = surface.psd_fit.where((surface.fitted == 1) | beyond)
    text = f"fit: $H$ = {float(surface.hurst):.2f} ± {float(surface.hurst_total_error):.2f}"
    text += ", roll-off" if "q_rolloff" in surface else ""
    ax.plot(q, fit, color=BLACK, linewidth=0.9, zorder=5, label=text)
    # The instrument's cutoff and, if found, the end of the plateau.
    text = "cutoff (found)" if int(surface.cutoff_detected) else "cutoff"
    cutoff = float(surface.q_cutoff)
    ax.axvline(cutoff, color=COLOURS[1], linewidth=0.9, linestyle=":", label=text)
    if "q_rolloff" in surface:
        corner = float(surface.q_rolloff)
        error = float(surface.q_rolloff_total_error)
        lowest = max(corner - error, corner / 3)
        ax.axvspan(lowest, corner + error, color=COLOURS[2], alpha=0.25, linewidth=0)


class Curve(NamedTuple):
    """Remaining share of one material along an axis."""

    label: str
    place: int  # among all materials of the page, for its look
    points: pd.DataFrame  # x, and low limit, value and high limit of the share [%]
    own: pd.Series  # the point of the pair as it is
    shown: bool  # at first


class Axis(NamedTuple):
    """An axis along which the remaining share is followed."""

    label: str
    wanted: float  # share from which on a pair sticks
    curves: list[Curve]


def find_curves(
    pairs: xr.Dataset, names: Sequence[str], at_first: Sequence[str]
) -> dict[str, Axis]:
    """Curves of the judged materials by axis, in the order of their `names`.

    Those of the materials `at_first` are shown at first.
    """
    cells = {name: pairs.sel(material=name) for name in names}
    judged = {name: cell for name, cell in cells.items() if is_judged(cell)}
    if not judged:
        return {}
    # Moduli are in the unit of those shown at first, as they were given.
    first = [judged[name] for name in at_first if name in judged] or list(judged.values())
    per_pascal, unit = unit_for(max(float(cell.quoted_modulus) for cell in first), "Pa")
    symbols = {name_modulus(cell) for cell in judged.values()}
    symbol = MODULI[symbols.pop()] if len(symbols) == 1 else "modulus E or E*, as given"
    axes = {}
    for axis, label in LABELS.items():
        curves = []
        for place, (name, cell) in enumerate(judged.items()):
            is_known = bool(np.isfinite(cell[f"remaining_by_{axis}"]).any())
            if is_known and (axis != "rate" or int(cell.depends_on_rate)):
                points, own = follow(axis, cell, per_pascal)
                curve = Curve(
                    label=cell.material_label.item(),
                    place=place,
                    points=points,
                    own=own,
                    shown=name in at_first,
                )
                curves.append(curve)
        if curves:
            label = label.format(symbol=symbol, unit=unit)
            axes[axis] = Axis(label, float(pairs.wanted_share), curves)
    return axes


def follow(axis: str, pair: xr.Dataset, per_pascal: float) -> tuple[pd.DataFrame, pd.Series]:
    """Points of the curve along an axis, where it is known and says something, and the pair's."""
    share = pair[f"remaining_by_{axis}"]
    (dim,) = set(share.dims) - {"limit"}
    factor = pair[dim].values  # a rate of 1 Hz, at which the modulus is quoted, counts as 1
    scale = {"modulus": float(pair.quoted_modulus) * per_pascal, "dwell": float(pair.dwell)}
    x = factor * scale.get(axis, 1.0)
    percents = 100 * share.transpose(dim, "limit").values
    points = pd.DataFrame(percents, index=x, columns=list(LIMITS)).rename_axis("x").reset_index()
    own = points.loc[np.argmin(abs(np.log(factor)))]
    kept = points.low.notna()
    if axis == "modulus":
        telling = (points.low < 100 * MATTERS[0]) & (points.high > 100 * MATTERS[1])
        reach = [own.x, *points.x[telling]]
        kept &= points.x.between(min(reach) / ROOM, max(reach) * ROOM)
    return points[kept], own


def find_scale(curves: Sequence[Curve]) -> tuple[str, tuple[float, float]]:
    """Scale and limits of shares [%]: logarithmic where some may exceed 100 %."""
    most = max(curve.points.high.max() for curve in curves)
    return ("linear", (-2, 102)) if most <= 100 else ("log", (LEAST_PERCENT, 1.5 * most))


def draw_still(axes: Mapping[str, Axis], output: str | Path) -> None:
    """Write the curves of the first materials for print; say so if nothing is judged."""
    rows = ("A", "AB", "ABC", "AB;CD")[max(len(axes), 1) - 1]
    height = 2.9 * len(rows.split(";"))
    with plotting.open_figure([output], rows, height) as panels:
        if not axes:
            panels["A"].set_axis_off()
            panels["A"].text(0.5, 0.5, "not judged", ha="center")
            return
        for ax, (label, wanted, curves) in zip(panels.values(), axes.values(), strict=True):
            for curve in [curve for curve in curves if curve.shown][:SHOWN]:
                draw_curve(ax, curve)
            ax.axhline(100 * wanted, color=GREY, linewidth=0.9, linestyle="--")
            scale, limits = find_scale(curves)
            ax.set(xscale="log", yscale=scale, ylim=limits, xlabel=label, ylabel=REMAINS)
        handles, texts = panels["A"].get_legend_handles_labels()
        look = {"loc": "outside lower center", "ncols": SHOWN, "handlelength": 3}
        panels["A"].figure.legend(handles, texts, **look)


def draw_curve(ax: Axes, curve: Curve) -> None:
    """Draw a `Curve` with its limits and the pair itself."""
    colour = COLOURS[curve.place % len(COLOURS)]
    marker = MARKERS[curve.place % len(MARKERS)]
    points = curve.points
    plotting.draw_band(ax, points.x, points.low, points.high, colour, alpha=0.15)
    dashes = DASHES[curve.place % SHOWN]
    ax.plot(points.x, points.value, color=colour, linestyle=dashes)
    ax.plot(curve.own.x, curve.own.value, marker, color=colour)
    ax.plot([], [], color=colour, linestyle=dashes, marker=marker, label=curve.label)
