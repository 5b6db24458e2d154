"""Figure 8: where Persson's theory fails, correction by correction, and gamma by simulation."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import xarray as xr

from pipeline import plotting
from pipeline.conventions import LOAD, VARIANT
from pipeline.plotting import BLACK, GREY, make_dot, make_key, pick_look, state
from stickiness.core import datasets

CORRECTIONS = {"yang2008": "Yang & Persson", "wang2017": "Wang & Müser", "xu2024": "Xu et al."}
THEORIES = {
    VARIANT: "2018, Yang & Persson",
    f"{VARIANT}, wang2017": "2018, Wang & Müser",
    f"{VARIANT}, xu2024": "2018, Xu et al.",
    "almqvist2011": "2011, Yang & Persson",
}
SYMBOLS = {
    "area_fraction": r"$A$",
    "mean_gap": r"$\bar{u}$",
    "attractive_area": r"$A_\mathrm{ad}$",
    "gap_density": r"$P(u)$",
    "all": "all",
}
ROWS = ("area_fraction", "mean_gap", "attractive_area", "gap_density", "distance")
RANGE = 0.1  # over h_rms, of the attractive area
LARGEST_DIFFERENCE = 0.6  # relative, shown
GOOD_DIFFERENCE = 0.1  # relative, shaded
LOAD_BANDS = (0, 0.02, 0.1, 1)  # over E* q0 h_rms, in which differences are averaged
KNOWN_TO = 0.2  # relative error of P(u) up to which it is drawn
LARGEST_GAP = 3  # over h_rms, up to which P(u) is drawn
SMALL = {"va": "center", "fontsize": 7}


@dataclass(frozen=True)
class Case:
    """Differences of theory from simulation for one surface, with its look."""

    differences: xr.Dataset
    look: dict

    @property
    def made(self):
        """Parameters of the surface."""
        return datasets.parameters(self.differences)

    @property
    def holds(self):
        """Where the window holds summits enough."""
        return self.differences.window_holds.values == 1


def main(job):
    cases = order_cases([datasets.read(path, ["distance"]) for path in job.input.comparisons])
    gamma = datasets.read(job.input.gamma, ["gamma", "gamma_low", "gamma_high", "quantities_agree"])
    grid = [[f"{row}{column}" for column in range(len(THEORIES))] for row in ROWS]
    rows, heights = [*grid, ["A", "A", "B", "B"]], [1] * len(ROWS) + [1.65]
    with plotting.open_figure(job.output, rows, 10.2, height_ratios=heights) as panels:
        for column, (theory, title) in enumerate(THEORIES.items()):
            for row in ROWS:
                ax = panels[f"{row}{column}"]
                draw_quantity(ax, row, theory, cases)
                dress(ax, row, column)
            panels[f"{ROWS[0]}{column}"].set_title(title)
        draw_windows(panels["A"], cases)
        draw_gamma(panels["B"], gamma)
        panels["A"].figure.legend(
            handles=make_case_keys(cases), loc="outside upper center", ncols=6
        )


def order_cases(comparisons):
    """Cases by Hurst exponent (colour), magnification (marker) and window, in order."""

    def order(comparison):
        made = datasets.parameters(comparison)
        return made["hurst"], made["magnification"], made.get("window", 1)

    comparisons = sorted(comparisons, key=order)
    hurst, magnification, _ = (
        sorted(set(values)) for values in zip(*map(order, comparisons), strict=True)
    )
    cases = []
    for comparison in comparisons:
        own_hurst, own_magnification, _ = order(comparison)
        colour = pick_look(hurst.index(own_hurst))["color"]
        marker = pick_look(magnification.index(own_magnification))["marker"]
        cases.append(Case(comparison, {"color": colour, "marker": marker}))
    return cases


def make_case_keys(cases):
    colours = {case.made["hurst"]: case.look["color"] for case in cases}
    markers = {case.made["magnification"]: case.look["marker"] for case in cases}
    return [
        *(make_key(state(hurst=h), color=colour) for h, colour in colours.items()),
        *(
            make_dot(state(magnification=zeta), marker=marker)
            for zeta, marker in sorted(markers.items())
        ),
        make_dot("window too small for the load", mfc="white"),
    ]


def draw_quantity(ax, row, theory, cases):
    """One quantity by one theory, for all cases, with the mean of what is drawn."""
    loads, deviations = [], []
    for case in cases:
        at = case.differences.sel(variant=theory)
        if row == "gap_density":
            deviations.append(draw_density(ax, case, at))
        else:
            name = row if row == "distance" else f"{row}_difference"
            at = at.interp({"range": RANGE}) if row == "attractive_area" else at
            error = np.nan_to_num(at[f"{name}_total_error"])
            draw_loads(ax, case, at[name].values, error)
            deviations.append(at[name].values[case.holds])
            loads.append(at.pressure.values[case.holds])
    deviations = np.concatenate(deviations)
    rms = np.sqrt(np.nanmean(deviations**2))
    text = f"mean {np.nanmean(deviations):.2f}" if row == "distance" else f"rms {rms:.0%}"
    if loads and row != "distance":
        text += describe_bands(np.concatenate(loads), deviations)
    height, place = (0.07, "bottom") if row == "gap_density" else (0.93, "top")
    ax.text(0.97, height, text, ha="right", va=place, transform=ax.transAxes, fontsize=7.5)


def describe_bands(loads, deviations):
    """Means of deviations at small, middle and large loads."""
    means = []
    for low, high in pairwise(LOAD_BANDS):
        inside = deviations[(loads > low) & (loads <= high)]
        means.append(f"{100 * inside.mean():+.0f}".replace("-", "−") if inside.size else "–")
    return f"\nmeans {', '.join(means)} %"


def draw_loads(ax, case, y, error):
    """Differences against pressure: a line where the window holds, open points elsewhere."""
    x = case.differences.pressure.values
    colour = case.look["color"]
    ax.errorbar(x, y, error, color=colour, elinewidth=0.6, linestyle="none", capsize=0, alpha=0.5)
    ax.plot(x, np.where(case.holds, y, np.nan), "-", color=colour, linewidth=0.7)
    look = case.look | {"linestyle": "none", "markersize": 2.6, "mew": 0.6}
    for chosen, face in ((case.holds, colour), (~case.holds, "white")):
        ax.plot(x[chosen], y[chosen], **look, mfc=face)


def draw_density(ax, case, at):
    """P(u) by theory over simulation against u, where simulation is certain enough.

    At one load, the values of which are returned, and dashed at the smallest that the window holds.
    """
    differences = []
    for load, line in ((LOAD, "-"), (at.pressure.values[case.holds].min(), "--")):
        one = at.sel(pressure=load, method="nearest")
        y, error = one.gap_density_difference, one.gap_density_difference_total_error
        known = (error < KNOWN_TO * (1 + y)) & (one.gap < LARGEST_GAP)
        look = {"color": case.look["color"], "linewidth": 0.8, "linestyle": line}
        ax.plot(one.gap.where(known), y.where(known), **look)
        differences.append(y.where(known).values)
    return differences[0]


def dress(ax, row, column):
    """Axes of one panel of the grid."""
    density = row == "gap_density"
    ax.set(xscale="log", xlim=(2e-3, 4) if density else (7e-4, 0.8))
    ax.set_xlabel(plotting.GAP if density else "")
    if row == "distance":
        ax.set(yscale="log", ylim=(4e-3, 2), xlabel=plotting.PRESSURE)
        label = r"$W_1/h_\mathrm{rms}$"
    else:
        ax.axhline(0, color=GREY, linewidth=0.7, zorder=0)
        shade = {"color": GREY, "alpha": 0.13, "linewidth": 0, "zorder": 0}
        ax.axhspan(-GOOD_DIFFERENCE, GOOD_DIFFERENCE, **shade)
        ax.set_ylim(-LARGEST_DIFFERENCE, LARGEST_DIFFERENCE)
        label = f"theory/BEM − 1\n{SYMBOLS[row]}"
    if column == 0:
        ax.set_ylabel(label)
    else:
        ax.tick_params(labelleft=False)


def draw_windows(ax, cases):
    """Attractive area at small loads against how far below the highest summit the mean gap is."""
    for case in cases:
        at = case.differences.sel(variant=VARIANT).interp({"range": RANGE})
        over = 1 / (1 + at.attractive_area_difference)
        error = over**2 * at.attractive_area_difference_total_error
        below = at.highest_summit - at.theory_mean_gap
        look = case.look | {"linestyle": "none", "markersize": 3, "elinewidth": 0.6, "mew": 0.7}
        face = "white" if case.made.get("window", 1) == 1 else case.look["color"]
        ax.errorbar(below, over, np.nan_to_num(error), **look, mfc=face)
    ax.axhline(1, color=GREY, linewidth=0.7, zorder=0)
    ax.axvline(float(cases[0].differences.margin), color=GREY, linestyle=":")
    ax.set(yscale="log", xlim=(-0.8, 3.2))
    plotting.write_ticks(ax.yaxis, [0.7, 1, 1.5, 2, 3])
    ax.set_xlabel(r"highest summit less theory's mean gap, over $h_\mathrm{rms}$")
    ax.set_ylabel(rf"BEM/theory, $A_\mathrm{{ad}}({RANGE:g}\,h_\mathrm{{rms}})$")
    keys = [make_dot("window of one wave", mfc="white"), make_dot("of several")]
    ax.legend(handles=keys, loc="upper right")


def draw_gamma(ax, gamma):
    """Gamma with its confidence interval for each correction and quantity.

    Of all quantities together only where they agree, for else it is nobody's gamma.
    """
    count = gamma.sizes["quantity"]
    for index, (correction, label) in enumerate(CORRECTIONS.items()):
        at = gamma.sel(correction=correction)
        aside = 0.26 * (1 - index)
        if not at.quantities_agree:
            at = at.sel(quantity=at["quantity"] != "all")
            ax.text(0.27, count - 1 + aside, f"{label}: none fits all", **SMALL)
        y = np.arange(at.sizes["quantity"]) + aside
        bars = np.abs([at.gamma - at.gamma_low, at.gamma_high - at.gamma])
        look = pick_look(index, linestyle="none")
        ax.errorbar(at.gamma, y, xerr=bars, elinewidth=1, capsize=2, **look, label=label)
        for height, end, misfit in zip(y, at.gamma_high.values, at.misfit.values, strict=True):
            ax.text(end + 0.015, height, f"{misfit:.0%}", **SMALL)
        ax.plot(float(at.own_gamma), count - 0.45, **look, mfc="white", clip_on=False)
    ax.plot([], [], linestyle="none", marker="o", color=BLACK, mfc="white", label="source's own")
    ax.set_yticks(np.arange(count), [SYMBOLS[str(name)] for name in gamma.quantity.values])
    ax.set(ylim=(count - 0.3, -0.5), xlim=(0.25, 1.15), xlabel=r"best $\gamma$, 95 %, and misfit")
    ax.legend(loc="lower right")


if __name__ == "__main__":
    main(plotting.start_figure(globals()))
