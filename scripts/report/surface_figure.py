"""One surface as a figure: heights, and spectrum with fit and lines."""

import numpy as np

from common import plotting
from common.plotting import BLACK, COLOURS, GREY
from stickiness.statistics import COVERS

HURST = 0.8  # of the lines
LINES = (1e-3, 1e-5)  # m^0.4
PREFIXES = ((1e3, 1e-3, "km"), (1, 1, "m"), (1e-3, 1e3, "mm"), (1e-6, 1e6, "µm"), (0, 1e9, "nm"))


def draw_surface(surface, output):
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
    per_x, unit_x = unit_of(float(max(surface.x.max(), surface.y.max())))
    heights = surface.heights.values
    # A few outliers must not take all the colours.
    low, high = np.percentile(heights, [0.2, 99.8])
    per_h, unit_h = unit_of(max(abs(low), abs(high)))
    extent = [0, float(surface.x[-1]) * per_x, 0, float(surface.y[-1]) * per_x]
    look = {"origin": "lower", "extent": extent, "cmap": "cividis", "interpolation": "nearest"}
    image = ax.imshow(heights.T * per_h, vmin=low * per_h, vmax=high * per_h, **look)
    ax.figure.colorbar(image, ax=ax, label=f"height [{unit_h}]", shrink=0.8)
    ax.set(xlabel=f"x [{unit_x}]", ylabel=f"y [{unit_x}]")


def draw_profile(ax, surface):
    """Levelled heights of a profile."""
    per_x, unit_x = unit_of(float(surface.x.max()))
    per_h, unit_h = unit_of(float(np.abs(surface.profile).max()))
    ax.plot(surface.x * per_x, surface.profile * per_h, color=COLOURS[0], linewidth=0.7)
    ax.set(xlabel=f"x [{unit_x}]", ylabel=f"height [{unit_h}]")


def unit_of(value):
    """Factor and name of the unit that suits a length."""
    return next((factor, name) for least, factor, name in PREFIXES if value >= least)


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
