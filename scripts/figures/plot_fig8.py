"""Figure 8: where Persson's theory fails, correction by correction, and gamma by simulation."""

from dataclasses import dataclass

import numpy as np
import xarray as xr

from pipeline.conventions import LOAD, VARIANT
from pipeline.job import start
from pipeline.numbers import number
from pipeline.pages.style import BLACK, COLOURS, GREY, MARKERS, canvas, key, letters, save
from stickiness.core import datasets

THEORIES = {
    VARIANT: "2018, Yang & Persson",
    f"{VARIANT}, wang2017": "2018, Wang & Müser",
    f"{VARIANT}, xu2024": "2018, Xu et al.",
    "almqvist2011": "2011, Yang & Persson",
}
RANGE = 0.1  # over h_rms, of the attractive area
QUANTITIES = {
    "area_fraction": r"$A$",
    "mean_gap": r"$\bar{u}$",
    "attractive_area": r"$A_\mathrm{ad}$",
    "all": "all",
}
ROWS = ("area_fraction", "mean_gap", "attractive_area", "gap_density", "distance")
LARGEST = 0.5  # relative difference shown
CORRECTIONS = {"yang2008": "Yang & Persson", "wang2017": "Wang & Müser", "xu2024": "Xu et al."}
PRESSURE_LABEL = r"pressure $p/(E^*q_0h_\mathrm{rms})$"


@dataclass(frozen=True)
class Case:
    """Differences of theory from simulation for one surface, with its look."""

    differences: xr.Dataset
    colour: str
    marker: str

    @property
    def made(self):
        """Parameters of the surface."""
        return datasets.parameters(self.differences)

    @property
    def holds(self):
        """Where the window holds summits enough."""
        return self.differences.window_holds.values == 1


def main(job):
    cases = looks([datasets.read(path, ["distance"]) for path in job.input.comparisons])
    gamma = datasets.read(job.input.gamma, ["gamma", "gamma_low", "gamma_high", "quantities_agree"])
    grid = [[f"{row}{column}" for column in range(len(THEORIES))] for row in ROWS]
    figure, panels = canvas(
        [*grid, ["A", "A", "B", "B"]], 10.2, height_ratios=[1] * len(ROWS) + [1.65]
    )
    for column, (theory, title) in enumerate(THEORIES.items()):
        for row in ROWS:
            ax = panels[f"{row}{column}"]
            draw_row(ax, row, theory, cases)
            dress(ax, row, column)
        panels[f"{ROWS[0]}{column}"].set_title(title)
    window_panel(panels["A"], cases)
    gamma_panel(panels["B"], gamma)
    letters(panels)
    figure.legend(handles=keys(cases), loc="outside upper center", ncols=6)
    save(figure, job.output)


def looks(comparisons):
    """Cases by Hurst exponent (colour), magnification (marker) and window, in order."""

    def order(comparison):
        made = datasets.parameters(comparison)
        return made["hurst"], made["magnification"], made.get("window", 1)

    comparisons = sorted(comparisons, key=order)
    hurst = sorted({order(comparison)[0] for comparison in comparisons})
    magnification = sorted({order(comparison)[1] for comparison in comparisons})
    return [
        Case(
            comparison,
            COLOURS[hurst.index(order(comparison)[0]) % len(COLOURS)],
            MARKERS[magnification.index(order(comparison)[1]) % len(MARKERS)],
        )
        for comparison in comparisons
    ]


def keys(cases):
    hurst = {case.made["hurst"]: case.colour for case in cases}
    magnification = {case.made["magnification"]: case.marker for case in cases}
    lines = [key(color=colour, label=f"$H$ = {value:g}") for value, colour in hurst.items()]
    dots = [
        key(linestyle="none", marker=marker, label=rf"$\zeta$ = {number(value)}")
        for value, marker in sorted(magnification.items())
    ]
    few = key(linestyle="none", marker="o", mfc="white", label="window too small for the load")
    return [*lines, *dots, few]


def draw_row(ax, row, theory, cases):
    """One quantity by one theory, for all cases."""
    deviations = []
    for case in cases:
        at = case.differences.sel(variant=theory)
        if row == "gap_density":
            deviations.append(draw_density(ax, case, at))
            continue
        if row == "attractive_area":
            at = at.interp({"range": RANGE})
        y, error = value(at, row)
        deviations.append(y[case.holds])
        draw_points(ax, case, y, error)
    deviations = np.concatenate(deviations)
    rms = np.sqrt(np.nanmean(deviations**2))
    text = f"mean {np.nanmean(deviations):.2f}" if row == "distance" else f"rms {rms:.0%}"
    ax.text(0.97, 0.93, text, ha="right", va="top", transform=ax.transAxes, fontsize=7.5)


def value(at, row):
    """What is drawn of a quantity and its error."""
    if row == "distance":
        return at.distance.values, np.nan_to_num(at.distance_total_error)
    return at[f"{row}_difference"].values, np.nan_to_num(at[f"{row}_difference_total_error"])


def draw_points(ax, case, y, error):
    x = case.differences.pressure.values
    look = {"color": case.colour, "elinewidth": 0.6, "linestyle": "none", "capsize": 0}
    ax.errorbar(x, y, error, **look, alpha=0.5)
    ax.plot(x, np.where(case.holds, y, np.nan), "-", color=case.colour, linewidth=0.7)
    for chosen, face in ((case.holds, case.colour), (~case.holds, "white")):
        ax.plot(
            x[chosen], y[chosen], linestyle="none", marker=case.marker, markersize=2.6,
            color=case.colour, mfc=face, mew=0.6,
        )  # fmt: skip


def draw_density(ax, case, at):
    """P(u) by theory over simulation against u at one load, where simulation is certain enough."""
    at = at.sel(pressure=LOAD, method="nearest")
    y, error = at.gap_density_difference, at.gap_density_difference_total_error
    known = (error < 0.2 * (1 + y)) & (at.gap < 3)
    ax.plot(at.gap.where(known), y.where(known), color=case.colour, linewidth=0.8)
    return y.where(known).values


def dress(ax, row, column):
    """Axes of one panel of the grid."""
    density = row == "gap_density"
    ax.set(xscale="log", xlim=(2e-3, 4) if density else (7e-4, 0.8))
    ax.set_xlabel(r"gap $u/h_\mathrm{rms}$" if density else "")
    if row == "distance":
        ax.set(yscale="log", ylim=(4e-3, 2), xlabel=PRESSURE_LABEL)
        label = r"$W_1/h_\mathrm{rms}$"
    else:
        ax.axhline(0, color=GREY, linewidth=0.7, zorder=0)
        ax.axhspan(-0.1, 0.1, color=GREY, alpha=0.13, linewidth=0, zorder=0)
        ax.set_ylim(-LARGEST, LARGEST)
        name = r"$P(u)$" if density else QUANTITIES[row]
        label = f"theory/BEM − 1\n{name}"
    if column == 0:
        ax.set_ylabel(label)
    else:
        ax.tick_params(labelleft=False)


def window_panel(ax, cases):
    """Attractive area at small loads against how far below the highest summit the mean gap is."""
    for case in cases:
        at = case.differences.sel(variant=VARIANT).interp({"range": RANGE})
        over = 1 / (1 + at.attractive_area_difference)
        error = over**2 * at.attractive_area_difference_total_error
        below = at.highest_summit - at.theory_mean_gap
        look = {"color": case.colour, "marker": case.marker, "markersize": 3}
        ax.errorbar(
            below, over, np.nan_to_num(error), linestyle="none", elinewidth=0.6, **look,
            mfc="white" if case.made.get("window", 1) == 1 else case.colour, mew=0.7,
        )  # fmt: skip
    ax.axhline(1, color=GREY, linewidth=0.7, zorder=0)
    ax.axvline(float(cases[0].differences.margin), color=GREY, linestyle=":")
    ax.set(yscale="log", xlim=(-0.8, 3.2))
    ax.set_yticks([0.7, 1, 1.5, 2, 3], ["0.7", "1", "1.5", "2", "3"])
    ax.set_xlabel(r"highest summit less theory's mean gap, over $h_\mathrm{rms}$")
    ax.set_ylabel(rf"BEM/theory, $A_\mathrm{{ad}}({RANGE:g}\,h_\mathrm{{rms}})$")
    ax.legend(
        handles=[
            key(linestyle="none", marker="o", mfc="white", label="window of one wave"),
            key(linestyle="none", marker="o", label="of several"),
        ],
        loc="upper right",
    )


def gamma_panel(ax, gamma):
    """Gamma with its confidence interval for each correction and quantity.

    Of all quantities together only where they agree, for else it is nobody's gamma.
    """
    small = {"va": "center", "fontsize": 7}
    for index, (correction, label) in enumerate(CORRECTIONS.items()):
        at = gamma.sel(correction=correction)
        if not at.quantities_agree:
            at = at.sel(quantity=at["quantity"] != "all")
        y = np.arange(at.sizes["quantity"]) + 0.26 * (1 - index)
        bars = np.abs([at.gamma - at.gamma_low, at.gamma_high - at.gamma])
        look = {"color": COLOURS[index], "marker": MARKERS[index], "linestyle": "none"}
        ax.errorbar(at.gamma, y, xerr=bars, elinewidth=1, capsize=2, **look, label=label)
        for height, best, misfit in zip(y, at.gamma_high.values, at.misfit.values, strict=True):
            ax.text(best + 0.015, height, f"{misfit:.0%}", **small)
        own = float(at.own_gamma)
        if not at.quantities_agree:
            ax.text(0.27, 3 + 0.26 * (1 - index), f"{label}: none fits all", **small)
        ax.plot(own, 3.55, marker=MARKERS[index], color=COLOURS[index], mfc="white", clip_on=False)
    ax.plot([], [], linestyle="none", marker="o", color=BLACK, mfc="white", label="source's own")
    names = [QUANTITIES[str(name)] for name in gamma.quantity.values]
    ax.set_yticks(np.arange(len(names)), names)
    ax.set(ylim=(3.7, -0.5), xlim=(0.25, 1.0), xlabel=r"best $\gamma$, 95 %, and misfit")
    ax.legend(loc="center right")


if __name__ == "__main__":
    main(start(globals(), "plot_fig8"))
