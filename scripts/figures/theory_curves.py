"""Curves of theory that several figures draw, and names of the cases beside them."""

import numpy as np

from common.conventions import VARIANT
from common.theory_variants import between_corrections
from stickiness import datasets
from stickiness.formatting import number
from stickiness.pages import plotting
from stickiness.pages.plotting import GREY, make_key, state
from stickiness.remaining.errors import PATH

DENSITY = r"probability density $h_\mathrm{rms}P(u)$"
VARIANT_KEYS = [
    make_key("Afferrante et al. 2018"),
    make_key("Almqvist et al. 2011", linestyle="--"),
]


def draw_variants(ax, density, label, **look):
    """P(u) by both variants of the theory."""
    lines = {"afferrante2018": "-", "almqvist2011": "--"}
    for variant, line in lines.items():
        ax.plot(density.gap, density.sel(variant=variant), line, label=label, **look)
        label = None  # one entry of the legend


def dress_density(ax, limits, title):
    """Axes of P(u) against the gap."""
    ax.set(xscale="log", yscale="log", xlabel=plotting.GAP, ylabel=DENSITY)
    ax.set(xlim=(1e-4, 10), ylim=limits, title=title)


def draw_theory(ax, x, values, colour, **look):
    """Quoted variant of the theory, and a band between its corrections."""
    low, high = between_corrections(values)
    plotting.draw_band(ax, x, low, high, colour)
    ax.plot(x, values.sel(variant=VARIANT), color=colour, **look)


def draw_work_limits(ax):
    """Limits of the works of approach and separation over the energy gained."""
    for limit in np.exp([PATH.spread.low, PATH.spread.high]):
        ax.axhline(limit, color=GREY, linestyle=":")
    ax.axhline(1, color=GREY, linewidth=0.9)


def name_case(case):
    """Magnification of a simulated case, and its cell if that holds several longest waves."""
    parameters = datasets.parameters(case)
    window = parameters["window"]
    side = f", {name_cell(window)}" if window > 1 else ""
    return state(magnification=parameters["magnification"]) + side


def name_cell(window):
    """Cell by its sides over the longest wavelength."""
    return f"cell {number(window)} × {number(window)}"
