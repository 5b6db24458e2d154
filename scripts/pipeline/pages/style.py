"""Look of the figures: colours that the colour-blind can tell apart, letters, error bars, files."""

from __future__ import annotations

import logging
import string
from collections.abc import Iterable
from typing import Any

import matplotlib as mpl

mpl.use("Agg")  # no display on a cluster

import matplotlib.pyplot as plt
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter
from numpy.typing import ArrayLike, NDArray

from stickiness.core import budget, datasets

# Okabe & Ito, Color Universal Design (2008).
BLACK, ORANGE, SKY, GREEN, YELLOW, BLUE, RED, PURPLE = (
    "#000000",
    "#E69F00",
    "#56B4E9",
    "#009E73",
    "#F0E442",
    "#0072B2",
    "#D55E00",
    "#CC79A7",
)
COLOURS = (BLUE, RED, GREEN, ORANGE, PURPLE, SKY, BLACK)
MARKERS = ("o", "s", "^", "D", "v", "P", "X")
GREY = "0.45"
WIDTH = 7.1  # inches, two columns of a journal
VARIANT_LINES = {"afferrante2018": "-", "almqvist2011": "--"}
VARIANT_LABELS = {
    "afferrante2018": "Afferrante et al. 2018",
    "almqvist2011": "Almqvist et al. 2011",
}

logging.getLogger("fontTools").setLevel(logging.ERROR)  # else pages about fonts in the log

_SETTINGS = {
    "font.size": 8.5,
    "axes.titlesize": 8.5,
    "axes.labelsize": 8.5,
    "legend.fontsize": 8,
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "figure.titlesize": 9,
    "axes.linewidth": 0.7,
    "lines.linewidth": 1.2,
    "lines.markersize": 4,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.top": True,
    "ytick.right": True,
    "legend.frameon": False,
    "legend.handlelength": 1.7,
    "legend.labelspacing": 0.3,
    "legend.columnspacing": 1.0,
    "legend.borderaxespad": 0.4,
    "figure.constrained_layout.use": True,
    "savefig.dpi": 200,
    "pdf.fonttype": 42,  # text stays text
}


def canvas(rows: str, height: float, **grid: Any) -> tuple[Figure, dict[str, Axes]]:
    """Figure of `height` inches with lettered panels laid out as in ``subplot_mosaic("AB;CC")``."""
    mpl.rcParams.update(_SETTINGS)
    return plt.subplot_mosaic(rows, figsize=(WIDTH, height), **grid)


def letters(panels: dict[str, Axes]) -> None:
    """Bold letter above the upper left corner of every panel named by a letter."""
    for name, ax in panels.items():
        if name in string.ascii_uppercase:
            ax.set_title(name, loc="left", fontweight="bold", fontsize=10)


def save(figure: Figure, outputs: Iterable[str]) -> None:
    """Write the figure to every path, whole or not at all, free of the time of writing."""
    for path in outputs:
        with datasets.whole_file(path) as temporary:
            undated = {"CreationDate": None} if temporary.suffix == ".pdf" else {}
            figure.savefig(temporary, metadata=undated)
    plt.close(figure)


def shades(count: int) -> NDArray:
    """Colours from dark to light for an ordered family of curves."""
    return mpl.colormaps["cividis"](np.linspace(0, 0.9, count))


def total_error(sampling: ArrayLike, discretisation: ArrayLike) -> NDArray:
    """Both errors in quadrature; the sampling error of a single seed is unknown and left out."""
    return np.sqrt(np.nansum(np.square([sampling, discretisation]), axis=0))


def with_model(data: xr.Dataset, name: str) -> tuple[NDArray, NDArray]:
    """Sampling error of a variable, and all its others, for `points`."""
    error = data[f"{name}_error"]
    others = error.sel(source=[s for s in budget.SOURCES if s != "sampling"])
    return error.sel(source="sampling").values, np.sqrt((others**2).sum("source")).values


def points(
    ax: Axes,
    x: ArrayLike,
    y: ArrayLike,
    sampling: ArrayLike,
    discretisation: ArrayLike,
    **look: Any,
) -> None:
    """Points with a thick bar for the sampling error and a thin one that adds discretisation."""
    look = {"linestyle": "none", "marker": "o", "color": BLACK, "zorder": 4} | look
    bare = {key: value for key, value in look.items() if key not in ("marker", "label")}
    bare |= {"linestyle": "none", "capsize": 0, "marker": "none"}
    ax.errorbar(x, y, total_error(sampling, discretisation), elinewidth=0.7, **bare)
    ax.errorbar(x, y, np.nan_to_num(sampling), elinewidth=1.8, **bare)
    ax.plot(x, y, **look)


def aside(x: ArrayLike, steps: float) -> NDArray:
    """Abscissae of a log axis moved by a few per cent, so that equal ones can be told apart."""
    return np.asarray(x) * 1.05**steps


def guide(ax: Axes, x: ArrayLike, y: ArrayLike, text: str, at: tuple[float, float]) -> None:
    """Thin line that shows a power law or a formula, with its name."""
    ax.plot(x, y, color=GREY, linewidth=0.9, linestyle=":")
    ax.text(*at, text, color=GREY, fontsize=8)


def apart(positions: Iterable[float], factor: float) -> list[float]:
    """Heights of labels on a log axis, pushed up until neighbours differ by `factor`."""
    positions = list(positions)
    below = 0.0
    for index in np.argsort(positions):
        below = positions[index] = max(positions[index], below * factor)
    return positions


def plain_ticks(axis: Axis, values: Iterable[float]) -> None:
    """Ticks of a log axis of few decades at these values, written out."""
    axis.set_major_locator(FixedLocator(list(values)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def key(**look: Any) -> Line2D:
    """Legend handle that belongs to no curve in particular."""
    return Line2D([], [], **({"color": GREY} | look))
