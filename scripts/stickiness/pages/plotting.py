"""Look of the figures: colours that the colour-blind can tell apart, error bars, files."""

import logging
import string
from contextlib import contextmanager

import matplotlib as mpl

mpl.use("Agg")  # no display on a cluster

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter

from stickiness import datasets
from stickiness.formatting import number
from stickiness.statistics import COVERS

# Okabe & Ito, Color Universal Design (2008).
BLACK = "#000000"
ORANGE = "#E69F00"
SKY = "#56B4E9"
GREEN = "#009E73"
YELLOW = "#F0E442"
BLUE = "#0072B2"
RED = "#D55E00"
PURPLE = "#CC79A7"
COLOURS = (BLUE, RED, GREEN, ORANGE, PURPLE, SKY, BLACK)
MARKERS = ("o", "s", "^", "D", "v", "P", "X")
GREY = "0.45"
# Places from back to front: error bars, open points, filled points.
BARS = 3
HOLLOW = 3.5
FILLED = 4
WIDTH = 7.1  # inches, two columns of a journal

# Labels of axes that several figures have.
PRESSURE = r"pressure $p/(E^*q_0h_\mathrm{rms})$"
GAP = r"gap $u/h_\mathrm{rms}$"
RANGE = r"range $\epsilon/h_\mathrm{rms}$"
ADHESION_LENGTH = r"adhesion length $l_a/\epsilon$"
MAGNIFICATION = r"magnification $\zeta$"
CONTACT_AREA = r"area $A_\mathrm{rep}/A_\mathrm{nom}$"

SYMBOLS = {
    "hurst": "$H$",
    "magnification": r"$\zeta$",
    "pressure": r"$\hat{p}$",
    "mean_gap": r"$\bar{u}/h_\mathrm{rms}$",
    "range": r"$\epsilon/h_\mathrm{rms}$",
    "adhesion_length": r"$l_a/\epsilon$",
    "q0_h_rms": r"$q_0h_\mathrm{rms}$",
    "a_v": "$a_V$",
}

logging.getLogger("fontTools").setLevel(logging.ERROR)  # else pages about fonts in the log

mpl.rc("font", size=8.5)
mpl.rc("axes", titlesize=8.5, labelsize=8.5, linewidth=0.7)
mpl.rc("lines", linewidth=1.2, markersize=4)
mpl.rc("xtick", direction="in", top=True, labelsize=8)
mpl.rc("ytick", direction="in", right=True, labelsize=8)
mpl.rc("legend", fontsize=8, title_fontsize=8, frameon=False, handlelength=1.7)
mpl.rc("legend", labelspacing=0.3, columnspacing=1.0, borderaxespad=0.4)
mpl.rc("savefig", dpi=200)
mpl.rc("pdf", fonttype=42)  # text stays text


@contextmanager
def open_figure(outputs, rows, height, **grid):
    """Panels to draw in, laid out as in ``subplot_mosaic("AB;CC")``; then write the files.

    Panels named by a letter show it. Files are whole or not there, and free of the time of writing.
    """
    look = {"figsize": (WIDTH, height), "layout": "constrained"} | grid
    figure, panels = plt.subplot_mosaic(rows, **look)
    yield panels
    for name, ax in panels.items():
        if name in string.ascii_uppercase:
            ax.set_title(name, loc="left", fontweight="bold", fontsize=10)
    for path in outputs:
        with datasets.whole_file(path) as temporary:
            undated = {"CreationDate": None} if temporary.suffix == ".pdf" else {}
            figure.savefig(temporary, metadata=undated)
        figure.set_layout_engine("none")  # further files keep what the first has laid out
    plt.close(figure)


def state(**values):
    """Equations like "H = 0.8, ζ = 64" for the quantities of `SYMBOLS`."""
    return ", ".join(f"{SYMBOLS[name]} = {number(value)}" for name, value in values.items())


def pick_look(index, **more):
    """Colour and marker of one of several sets of points."""
    colour = COLOURS[index % len(COLOURS)]
    marker = MARKERS[index % len(MARKERS)]
    return {"color": colour, "marker": marker} | more


def shade(values):
    """Every value of an ordered family with its colour, from dark to light."""
    colours = mpl.colormaps["cividis"](np.linspace(0, 0.9, len(values)))
    return zip(colours, values, strict=True)


def read_errors(data, name):
    """Sampling error of a variable, and all errors in quadrature; unknown ones are left out."""
    by_source = data[f"{name}_error"]
    return by_source.sel(source="sampling").fillna(0), np.sqrt((by_source**2).sum("source"))


def draw_points(ax, x, data, name, scale=1.0, **look):
    """A variable over `scale`: a thick bar for its sampling error, a thin one for all errors."""
    y = data[name] / scale
    (sampling, total) = read_errors(data, name)
    bars = {"linestyle": "none", "color": look["color"], "zorder": BARS}
    ax.errorbar(x, y, total / scale, elinewidth=0.7, **bars)
    ax.errorbar(x, y, sampling / scale, elinewidth=1.8, **bars)
    ax.plot(x, y, **{"linestyle": "none", "marker": "o", "zorder": FILLED} | look)


def find_rings(surface):
    """Which wave numbers of a measured spectrum are measured: it may go on, and have gaps."""
    q = surface.wave_number.values
    cutoff = float(surface.q_cutoff) * (1 + 1e-9)
    measured = (q <= cutoff) | (float(surface.q1) <= cutoff)
    for low, high in surface.gap.values if "gap" in surface else ():
        measured &= (q <= low) | (q >= high)
    if is_larger(surface):  # waves longer than those of the fit are assumed
        measured &= q >= q[surface.fitted.values == 1].min()
    return measured


def is_larger(surface):
    """Whether a measured surface is judged for a contact that is larger than its scan."""
    return "contact" in surface and bool(surface.contact > surface.scan * (1 + 1e-9))


def name_measurements(surface):
    """Names of the measurements of a surface: variables or channels, else files."""
    sources = surface.attrs["files"].split("; ")
    return [source.rpartition(": ")[2].rpartition("/")[2] for source in sources]


def draw_assumed(ax, surface, colour):
    """Band, which covers 90 %, of a measured spectrum where it is not measured."""
    q = surface.wave_number.values
    low, high = surface.psd.where(~find_rings(surface)).values  # one standard error off
    middle = np.sqrt(low * high)
    factor = np.sqrt(high / low) ** COVERS
    draw_band(ax, q, middle / factor, middle * factor, colour)


def draw_spectrum(ax, surface, colour, label=None):
    """Spectrum of a real surface: rings with bars that cover 90 %, or a band."""
    if "psd_standard_error" not in surface:
        q = surface.wave_number
        low, high = surface.psd.values
        draw_band(ax, q, low, high, colour)
        ax.plot(q, low, q, high, color=colour, linewidth=0.9)
        ax.plot([], [], color=colour, linewidth=4, alpha=0.6, label=label)
        return
    rings = surface.isel(wave_number=find_rings(surface))
    psd = rings.psd.isel(end=0)
    error = COVERS * rings.psd_standard_error
    below = np.minimum(error, 0.9 * psd)  # a bar down to zero has no end on a log axis
    look = {"marker": "o", "linestyle": "none", "markersize": 2.5, "elinewidth": 0.7}
    ax.errorbar(rings.wave_number, psd, [below, error], color=colour, label=label, **look)


def draw_hollow(ax, x, y, **look):
    """Open points, above the error bars and below the filled points that they are beside."""
    ax.plot(x, y, **{"linestyle": "none", "mfc": "white", "zorder": HOLLOW} | look)


def draw_band(ax, x, low, high, colour, alpha=0.3):
    """A pale band between two curves."""
    ax.fill_between(x, low, high, color=colour, alpha=alpha, linewidth=0)


def move_aside(x, steps, step=1.05):
    """Abscissae of a log axis moved by a few per cent, so that equal ones can be told apart."""
    return np.asarray(x) * step**steps


def draw_guide(ax, x, y, text, at):
    """Thin line that shows a power law or a formula, with its name."""
    ax.plot(x, y, color=GREY, linewidth=0.9, linestyle=":")
    ax.text(*at, text, color=GREY, fontsize=8)


def interpolate(data, name, value):
    """Values between those tabulated along a coordinate, by a power law from point to point."""
    logs = np.log(data).assign_coords({name: np.log(data[name])})
    return np.exp(logs.interp({name: np.log(value)}))


def write_ticks(axis, values):
    """Ticks of a log axis of few decades at these values, written out."""
    axis.set_major_locator(FixedLocator(list(values)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def make_key(label, **look):
    """Legend handle of a line that belongs to no curve in particular."""
    return Line2D([], [], label=label, **({"color": GREY} | look))


def make_dot(label, **look):
    """Legend handle of a point that belongs to no set in particular."""
    return make_key(label, **({"linestyle": "none", "marker": "o"} | look))


def add_legend(ax, *keys, **place):
    """Legend of what is labelled, and of these keys."""
    return ax.legend(handles=[*ax.get_legend_handles_labels()[0], *keys], **place)
