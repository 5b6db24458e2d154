"""One surface as a figure: heights, spectrum with fit and lines, margins against the rate."""

import numpy as np

from pipeline.pages.style import BLACK, COLOURS, GREY, canvas, letters

HURST = 0.8  # of the lines
LINES = (1e-3, 1e-5)  # m^0.4
PREFIXES = ((1e3, 1e-3, "km"), (1, 1, "m"), (1e-3, 1e3, "mm"), (1e-6, 1e6, "µm"), (0, 1e9, "nm"))


def draw_surface(surface, pairs):
    """Figure with a panel for everything that the surface and its pairs have to show."""
    pictured = next((name for name in ("heights", "profile") if name in surface), None)
    depending = pairs.isel(material=np.flatnonzero(pairs.depends_on_rate.values == 1))
    names = iter("ABC")
    first, spectrum = (next(names), next(names)) if pictured else 2 * (next(names),)
    rows = [first + spectrum]
    if depending.sizes["material"]:
        rows.append(2 * next(names))
    figure, panels = canvas(";".join(rows), (3.3, 5.6)[len(rows) - 1])
    if pictured:
        (picture if pictured == "heights" else line)(figure, panels[first], surface)
    psd(panels[spectrum], surface)
    if len(rows) > 1:
        rates(panels[rows[1][0]], depending)
    letters(panels)
    return figure


def picture(figure, ax, surface):
    """Levelled heights as colours, in units that suit them."""
    per_x, unit_x = unit_of(float(max(surface.x.max(), surface.y.max())))
    heights = surface.heights.values
    # A few outliers must not take all the colours.
    low, high = np.percentile(heights, [0.2, 99.8])
    per_h, unit_h = unit_of(max(abs(low), abs(high)))
    extent = [0, float(surface.x[-1]) * per_x, 0, float(surface.y[-1]) * per_x]
    look = {"origin": "lower", "extent": extent, "cmap": "cividis", "interpolation": "nearest"}
    image = ax.imshow(heights.T * per_h, vmin=low * per_h, vmax=high * per_h, **look)
    figure.colorbar(image, ax=ax, label=f"height [{unit_h}]", shrink=0.8)
    ax.set(xlabel=f"x [{unit_x}]", ylabel=f"y [{unit_x}]")


def line(_, ax, surface):
    """Levelled heights of a profile."""
    per_x, unit_x = unit_of(float(surface.x.max()))
    per_h, unit_h = unit_of(float(np.abs(surface.profile).max()))
    ax.plot(surface.x * per_x, surface.profile * per_h, color=COLOURS[0], linewidth=0.7)
    ax.set(xlabel=f"x [{unit_x}]", ylabel=f"height [{unit_h}]")


def unit_of(value):
    """Factor and name of the unit that suits a length."""
    return next((factor, name) for least, factor, name in PREFIXES if value >= least)


def psd(ax, surface):
    """Spectrum with errors, law, the paper's lines and the ends of the instrument's band."""
    q = surface.wave_number.values
    low, high = surface.psd.values
    if "psd_standard_error" in surface:
        error = surface.psd_standard_error.values
        measured = np.ones_like(q, dtype=bool)
        if float(surface.q1) > float(surface.q_cutoff) * (1 + 1e-9):
            measured = q <= float(surface.q_cutoff) * (1 + 1e-9)
            ax.fill_between(q, low, high, where=~measured, color=GREY, alpha=0.3, linewidth=0)
        below = np.minimum(error, 0.9 * low)
        bars = [below[measured], error[measured]]
        look = {"color": COLOURS[0], "marker": "o", "linestyle": "none", "markersize": 2.5}
        each(ax, surface)
        ax.errorbar(q[measured], low[measured], bars, elinewidth=0.7, label="measured", **look)
        law = surface.psd_fit.where((surface.fitted == 1) | ~measured)
        ax.plot(q, law, color=BLACK, linewidth=0.9, zorder=5, label=law_text(surface))
        limits(ax, surface)
    else:
        ax.fill_between(q, low, high, color=COLOURS[0], alpha=0.3, linewidth=0)
        ax.plot(q, low, q, high, color=COLOURS[0], linewidth=0.9)
    for c0 in LINES:
        ax.plot(q, c0 * q ** (-2 * (HURST + 1)), "--", color=GREY, linewidth=0.8)
    text = " and ".join(f"$10^{{{np.log10(c0):.0f}}}$" for c0 in LINES)
    ax.plot([], [], "--", color=GREY, linewidth=0.8, label=rf"$C_0$ = {text} m$^{{0.4}}$")
    ax.set(xscale="log", yscale="log", xlabel="wave number $q$ [1/m]", ylabel="$C(q)$ [m$^4$]")
    ax.set_ylim(bottom=low.min() / 1e3)  # room for the legend
    ax.legend(loc="lower left")


def each(ax, surface):
    """Spectra of the single measurements behind a stitched one."""
    if "psd_measurement" in surface:
        for index, levels in enumerate(surface.psd_measurement.values):
            colour = COLOURS[1 + index % (len(COLOURS) - 1)]
            q = surface.wave_number_measured
            ax.plot(q, levels, color=colour, linewidth=0.8, label=f"measurement {index + 1}")


def law_text(surface):
    text = f"fit: $H$ = {float(surface.hurst):.2f} ± {float(surface.hurst_total_error):.2f}"
    if "q_rolloff" in surface:
        text += ", roll-off"
    return text


def limits(ax, surface):
    """The instrument's cutoff and, if found, the end of the plateau."""
    cutoff = float(surface.q_cutoff)
    ax.axvline(cutoff, color=COLOURS[1], linewidth=0.9, linestyle=":")
    text = "cutoff (found)" if int(surface.cutoff_detected) else "cutoff"
    ax.plot([], [], color=COLOURS[1], linewidth=0.9, linestyle=":", label=text)
    if "q_rolloff" in surface:
        q, error = float(surface.q_rolloff), float(surface.q_rolloff_total_error)
        ax.axvspan(max(q - error, q / 3), q + error, color=COLOURS[2], alpha=0.25, linewidth=0)


def rates(ax, pairs):
    """Margins of materials whose modulus depends on the rate, between their limits."""
    for index, name in enumerate(pairs.material.values):
        pair, colour = pairs.sel(material=name), COLOURS[index % len(COLOURS)]
        low, high = pair.margin_low_at_rate, pair.margin_high_at_rate
        ax.fill_between(pair.frequency, low, high, color=colour, alpha=0.3, linewidth=0)
        ax.plot(pair.frequency, np.sqrt(low * high), color=colour, label=str(name))
    ax.axhline(1, color=GREY, linewidth=0.9, linestyle="--")
    ax.axvline(1, color=GREY, linewidth=0.9, linestyle=":")
    ax.set(xscale="log", yscale="log", xlabel="frequency [Hz]", ylabel="margin (above 1 sticks)")
    ax.legend()
