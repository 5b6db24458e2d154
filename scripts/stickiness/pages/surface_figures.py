"""Figures of a surface: heights and spectrum, and the adhesion that remains on it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.patches import Polygon

from stickiness.formatting import unit_for
from stickiness.measured.levelling import detrend
from stickiness.pages import plotting
from stickiness.pages.plotting import BLACK, COLOURS, GREY, MARKERS
from stickiness.verdicts.limits import LIMITS
from stickiness.verdicts.wording import LEAST_STRESS, MOST_STRESS, is_judged, name_modulus

HURST = 0.8  # of the paper's lines
LINES = {1e-3: r"$C_0$ = $10^{-3}$ and $10^{-5}$ m$^{0.4}$", 1e-5: None}
LEAST_CHANGE = 0.02  # of the rms height that a picture shows
SHOWN = 3  # curves in a panel: more is a bundle
DASHES = ("solid", "dashed", "dotted", "dotdash", "dashdot", [8, 3, 2, 3, 2, 3], [12, 3])
LEAST_PERCENT = 0.1  # that a logarithmic axis shows
ROOM = 10.0  # factor by which a curve along the modulus goes beyond the threshold and the pair
PANEL = (plotting.WIDTH / 2, 3.3)  # inches
LABELS = {
    "modulus": "{symbol} [{unit}]",
    "roughness": "factor on the heights",
    "rate": "frequency [Hz]",
    "dwell": "dwell time [s]",
}
MODULI = {"E": "Young's modulus E", "E*": "plane-strain modulus E*"}
REMAINS = "remaining share [%]"


def draw_panel(draw: Callable[..., None], *shown: Any, output: str | Path) -> None:
    """Write one panel, which a page shows beside others or, if it is narrow, below them."""
    with plotting.open_figure([output], [["panel"]], 3.3, figsize=PANEL) as panels:
        draw(panels["panel"], *shown)


def shows_change(surface: xr.Dataset) -> bool:
    """Whether a map as it was read and as it is used look different when both are level."""
    before = surface.heights_as_read.values
    if surface.unused.any() or not np.isfinite(before).all():
        return True
    thin = -(-max(surface.heights.shape) // max(before.shape))
    after = surface.heights.values[::thin, ::thin]
    if after.shape != before.shape:
        return True
    difference = detrend(before, "plane") - detrend(after, "plane")
    return bool(np.std(difference) > LEAST_CHANGE * np.std(after))


def draw_as_read(ax: Axes, surface: xr.Dataset) -> None:
    """Draw a map as it was read, with what is not used."""
    before = surface.heights_as_read.values
    per_h, unit = unit_for(np.nanmax(np.abs(before)), "m")
    ax.set_facecolor(GREY)  # seen where points are missing
    image = ax.imshow(before.T * per_h, cmap="cividis", interpolation="nearest")
    ax.figure.colorbar(image, ax=ax, label=f"height [{unit}]", shrink=0.8)
    unused = np.ma.masked_equal(surface.unused.values.T, 0)
    ax.imshow(unused, cmap=ListedColormap([COLOURS[1]]), interpolation="nearest")
    ax.set(xticks=[], yticks=[], title="as read")


def draw_as_used(ax: Axes, surface: xr.Dataset) -> None:
    """Draw a map as it is used, about as coarse as it is kept as read."""
    thin = max(1, max(surface.heights.shape) // max(surface.heights_as_read.shape))
    draw_heights(ax, surface.heights[::thin, ::thin])
    ax.set_title("as used")


def draw_heights(ax: Axes, heights: xr.DataArray, outline: xr.DataArray | None = None) -> None:
    """Levelled heights, as colours or as a profile, in units that suit them.

    The first row of a map is on top, as programs of instruments show it. A feature of the map has
    an `outline`, ``(corner, 2)``, in m.
    """
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
        extent=(0, float(heights.x[-1]) * per_x, float(heights.y[-1]) * per_x, 0),
        interpolation="nearest",
    )
    if outline is not None:
        corners = outline.values * per_x
        ax.add_patch(Polygon(corners, fill=False, color=COLOURS[1], linewidth=2))
    ax.figure.colorbar(image, ax=ax, label=f"height [{unit_h}]", shrink=0.8)
    ax.set_ylabel(f"y [{unit_x}]")


def draw_spectrum(ax: Axes, surface: xr.Dataset) -> None:
    """Spectrum: measured with its errors and fit, or as assumed beside the paper's lines."""
    q = surface.wave_number.values
    ax.set(xscale="log", yscale="log", xlabel="wave number $q$ [1/m]", ylabel="$C(q)$ [m$^4$]")
    if "psd_standard_error" in surface:
        draw_measured(ax, surface, q)
    else:
        plotting.draw_spectrum(ax, surface, COLOURS[0], "this surface")
        for c0, label in LINES.items():
            line = c0 * q ** (-2 * (HURST + 1))
            ax.plot(q, line, "--", color=GREY, linewidth=0.8, label=label)
    ax.figure.legend(loc="outside lower center", ncols=2)


def draw_measured(ax: Axes, surface: xr.Dataset, q: np.ndarray) -> None:
    """Rings within the band of the instrument, the fit with its band beyond, and the cutoff.

    The axis ends below the fit and its band: single points far below would stretch it.
    """
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
    lowest_fit = min(fit.min(), surface.psd.isel(end=0).where(~np.isnan(fit)).min())
    ax.set_ylim(bottom=float(lowest_fit) / 10)
    text = f"fit: $H$ = {float(surface.hurst):.2f} ± {float(surface.hurst_total_error):.2f}"
    ax.plot(q, fit, color=BLACK, linewidth=0.9, zorder=5, label=text)
    # The instrument's cutoff and, if found, the end of the plateau.
    text = "cutoff (found)" if int(surface.cutoff_detected) else "cutoff"
    cutoff = float(surface.q_cutoff)
    ax.axvline(cutoff, color=COLOURS[1], linewidth=0.9, linestyle=":", label=text)
    if "q_rolloff" in surface:
        corner = float(surface.q_rolloff)
        error = float(surface.q_rolloff_total_error)
        lowest = max(corner - error, corner / 3)
        look: dict[str, Any] = {"color": COLOURS[2], "alpha": 0.25, "linewidth": 0}
        ax.axvspan(lowest, corner + error, label="roll-off", **look)


class Curve(NamedTuple):
    """Remaining share of one material along an axis."""

    label: str
    place: int  # among all materials of the page, for its look
    points: pd.DataFrame  # x, and low limit, value and high limit of the share [%]
    own: pd.Series  # the point of the pair as it is


class Axis(NamedTuple):
    """An axis along which the remaining share is followed."""

    label: str
    wanted: float  # share from which on a pair sticks
    curves: list[Curve]


def find_curves(pairs: xr.Dataset, names: Sequence[str]) -> dict[str, Axis]:
    """Curves of the judged materials by axis, in the order of their `names`."""
    cells = {name: pairs.sel(material=name) for name in names}
    judged = {name: cell for name, cell in cells.items() if is_judged(cell)}
    if not judged:
        return {}
    # Moduli are in the unit in which the threshold of the first material is told.
    first = next(iter(judged.values()))
    per_pascal, unit = unit_for(find_moduli(first)[-1], "Pa")
    symbols = {name_modulus(cell) for cell in judged.values()}
    symbol = MODULI[symbols.pop()] if len(symbols) == 1 else "modulus E or E*, as given"
    axes = {}
    for axis, label in LABELS.items():
        curves = []
        for place, cell in enumerate(judged.values()):
            is_known = bool(np.isfinite(cell[f"remaining_by_{axis}"]).any())
            if is_known and (axis != "rate" or int(cell.depends_on_rate)):
                points, own = follow(axis, cell, per_pascal)
                curve = Curve(
                    label=cell.material_label.item(),
                    place=place,
                    points=points,
                    own=own,
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
        reach = find_moduli(pair) * per_pascal
        kept &= points.x.between(reach.min() / ROOM, reach.max() * ROOM)
    return points[kept], own


def find_moduli(pair: xr.Dataset) -> np.ndarray:
    """Modulus of the material, then those limits of its threshold that have a meaning [Pa]."""
    limits = np.sort(pair.modulus_threshold.values)
    is_told = (limits > LEAST_STRESS) & (limits < MOST_STRESS)
    return np.append(float(pair.quoted_modulus), limits[is_told])


def find_scale(curves: Sequence[Curve]) -> tuple[str, tuple[float, float]]:
    """Scale and limits of shares [%]: logarithmic where some may exceed 100 %."""
    most = max(curve.points.high.max() for curve in curves)
    return ("linear", (-2, 102)) if most <= 100 else ("log", (LEAST_PERCENT, 1.5 * most))


def draw_curves(ax: Axes, axis: Axis) -> None:
    """Draw all curves along an axis."""
    for curve in axis.curves:
        draw_curve(ax, curve)
    ax.axhline(100 * axis.wanted, color=GREY, linewidth=0.9, linestyle="--")
    scale, limits = find_scale(axis.curves)
    ax.set(xscale="log", yscale=scale, ylim=limits, xlabel=axis.label, ylabel=REMAINS)
    ax.figure.legend(loc="outside lower center", handlelength=3)


def split_curves(axis: Axis) -> list[Axis]:
    """Split an axis into axes of at most `SHOWN` curves."""
    starts = range(0, len(axis.curves), SHOWN)
    return [axis._replace(curves=axis.curves[start : start + SHOWN]) for start in starts]


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
