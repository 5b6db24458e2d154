"""Figure 8: Persson's theory against simulation, by surface and by theory, gamma, and kappa."""

from itertools import pairwise

import numpy as np

from common.conventions import LINEAR_UP_TO, VARIANT
from common.job import start
from common.paper import LOAD, at_load
from figures.theory_curves import name_cell
from stickiness import datasets
from stickiness.formatting import interval
from stickiness.pages import plotting
from stickiness.pages.plotting import BLACK, BLUE, GREY, RED, make_dot, make_key, pick_look, state

CORRECTIONS = {"yang2008": "Yang & Persson", "wang2017": "Wang & Müser", "xu2024": "Xu et al."}
SYMBOLS = {
    "area_fraction": r"$A$",
    "mean_gap": r"$\bar{u}$",
    "attractive_area": r"$A_\mathrm{ad}$",
    "gap_density": r"$P(u)$",
    "all": "all",
}
TITLES = {
    "area_fraction": "contact area",
    "mean_gap": "mean gap",
    "attractive_area": "attractive area",
}
LOADS = {0.01: (BLUE, "o"), LOAD: (BLACK, "s"), 0.4: (RED, "^")}  # the nearest of each case
GOOD_DIFFERENCE = 0.1  # relative, shaded
SHOWN = (0.55, 1.5)  # ratios


def main(job):
    files = (datasets.read(path, ["window_holds"]) for path in job.input.comparisons)
    shown_range = 0.1  # over h_rms, of the attractive area
    cases = sorted((file.interp({"range": shown_range}) for file in files), key=read_surface)
    gamma = datasets.read(job.input.gamma, ["gamma", "gamma_low", "gamma_high", "quantities_agree"])
    kappas = [datasets.read(path, ["kappa", "area_fraction"]) for path in job.input.kappa]
    lattices = [datasets.read(path, ["kappa"]) for path in job.input.lattices]
    rows = "AABBCC;DDDEEE;FFFGGG"
    ratios = [0.3 * len(cases) + 0.6, 2.2, 2.5]
    height = sum(ratios) + 0.9
    with plotting.open_figure(job.output, rows, height, height_ratios=ratios) as panels:
        for letter, name in zip("ABC", TITLES, strict=True):
            draw_ratios(panels[letter], name, cases)
        labels = [
            f"{state(hurst=hurst, magnification=magnification)}, {name_cell(window)}"
            for hurst, magnification, window in map(read_surface, cases)
        ]
        panels["A"].set_yticks(range(len(cases)), labels)
        panels["A"].tick_params(axis="y", length=0)
        draw_theories(panels["D"], cases)
        draw_gamma(panels["E"], gamma)
        draw_windows(panels["F"], cases)
        draw_slopes(panels["G"], kappas, lattices)
        keys = []
        for load, (colour, marker) in LOADS.items():
            near = [float(find_nearest(case, load).pressure) for case in cases]
            text = rf"$\hat{{p}}$ = {interval(min(near), max(near), 2)}"
            keys.append(make_dot(text, color=colour, marker=marker))
        keys.append(make_dot("cell too small for the load", mfc="white"))
        panels["A"].figure.legend(handles=keys, loc="outside upper center", ncols=len(keys))


def read_surface(case):
    """Hurst exponent, magnification, and longest waves a side of the cell."""
    parameters = datasets.parameters(case)
    return parameters["hurst"], parameters["magnification"], parameters["window"]


def find_nearest(case, load):
    """The case at the load that is nearest on a log axis."""
    return case.isel(pressure=int(np.argmin(np.abs(np.log(case.pressure.values / load)))))


def draw_ratios(ax, name, cases):
    """Theory over simulation: a row for every case, a point for every load, open as in the key."""
    for row, case in enumerate(cases):
        for place, (load, (colour, marker)) in enumerate(LOADS.items()):
            point = find_nearest(case, load).sel(variant=VARIANT)
            height = row + 0.25 * (place - 1)
            ratio = 1 + float(point[f"{name}_difference"])
            error = float(np.nan_to_num(point[f"{name}_difference_total_error"]))
            ax.errorbar(ratio, height, xerr=error, color=colour, elinewidth=0.8, alpha=0.6)
            inside = np.clip(ratio, SHOWN[0], SHOWN[1])  # an arrow if it lies outside
            marker = marker if inside == ratio else ("<" if ratio < inside else ">")
            face = colour if point.window_holds == 1 else "white"
            look = {"color": colour, "mfc": face, "markersize": 4, "mew": 0.8, "clip_on": False}
            ax.plot(inside, height, marker, **look)
    # A line between Hurst exponents.
    for row, (case, next_case) in enumerate(pairwise(cases)):
        if read_surface(case)[0] != read_surface(next_case)[0]:
            ax.axhline(row + 0.5, color=GREY, linewidth=0.5)
    ax.axvspan(1 - GOOD_DIFFERENCE, 1 + GOOD_DIFFERENCE, color=GREY, alpha=0.15, linewidth=0)
    ax.axvline(1, color=GREY, linewidth=0.7, zorder=0)
    ax.set(xlim=SHOWN, ylim=(len(cases) - 0.4, -0.6), title=TITLES[name], yticks=[])
    ax.set_xlabel(f"theory/simulation, {SYMBOLS[name]}")


def draw_theories(ax, cases):
    """Root mean square of what each theory is off, by quantity, in cells that are large enough."""
    names = [*TITLES, "gap_density"]
    theories = {
        VARIANT: "2018, Yang & Persson",
        f"{VARIANT}, wang2017": "2018, Wang & Müser",
        f"{VARIANT}, xu2024": "2018, Xu et al.",
        "almqvist2011": "2011, Yang & Persson",
    }
    for index, (theory, label) in enumerate(theories.items()):
        errors = [root_mean_square(name, theory, cases) for name in names]
        y = np.arange(len(names)) + 0.2 * (index - 1.5)
        ax.plot(errors, y, **pick_look(index, linestyle="none"), label=label)
    ax.axvline(100 * GOOD_DIFFERENCE, color=GREY, linestyle=":", linewidth=0.9)
    ax.set_yticks(range(len(names)), [SYMBOLS[name] for name in names])
    ax.set(ylim=(len(names) - 0.5, -0.5), xlabel="theory less simulation, rms [%]")
    ax.set_xlim(0, 2.2 * ax.get_xlim()[1])  # room for the legend
    for row in range(1, len(names)):
        ax.axhline(row - 0.5, color=GREY, linewidth=0.5)
    ax.tick_params(axis="y", length=0)
    ax.legend(loc="right", frameon=True, framealpha=1, edgecolor="none")


def root_mean_square(name, theory, cases):
    """In per cent, over every case and load whose cell is large enough."""
    differences = []
    known_to = 0.2  # relative error of P(u) up to which it counts
    largest_gap = 3  # over h_rms, up to which P(u) counts
    for case in cases:
        of_theory = case.sel(variant=theory)
        if name == "gap_density":  # at the load of the paper's figures, where simulation knows it
            loaded = at_load(of_theory)
            difference = loaded.gap_density_difference
            error = loaded.gap_density_difference_total_error
            certain = (error < known_to * (1 + difference)) & (loaded.gap < largest_gap)
            differences.append(difference.where(certain).values)
            continue
        differences.append(of_theory[f"{name}_difference"].values[case.window_holds.values == 1])
    return 100 * np.sqrt(np.nanmean(np.concatenate(differences) ** 2))


def draw_gamma(ax, gamma):
    """Gamma with its confidence interval for each correction and quantity, of all if they agree."""
    count = gamma.sizes["quantity"]
    small = {"va": "center", "fontsize": 7}
    for index, (correction, label) in enumerate(CORRECTIONS.items()):
        fits = gamma.sel(correction=correction)
        aside = 0.26 * (index - 1)
        if not fits.quantities_agree:
            fits = fits.sel(quantity=fits["quantity"] != "all")
            ax.text(0.27, count - 1 + aside, f"{label}: none fits all", **small)
        y = np.arange(fits.sizes["quantity"]) + aside
        bars = np.abs([fits.gamma - fits.gamma_low, fits.gamma_high - fits.gamma])
        look = pick_look(index, linestyle="none")
        ax.errorbar(fits.gamma, y, xerr=bars, elinewidth=1, capsize=2, **look, label=label)
        for height, end, misfit in zip(y, fits.gamma_high.values, fits.misfit.values, strict=True):
            ax.text(end + 0.015, height, f"{100 * misfit:.0f} %", **small)
        ax.plot(float(fits.own_gamma), count - 0.45, **look, mfc="white", clip_on=False)
    ax.plot([], [], linestyle="none", marker="o", color=BLACK, mfc="white", label="published")
    ax.set_yticks(np.arange(count), [SYMBOLS[str(name)] for name in gamma.quantity.values])
    ax.set(ylim=(count - 0.3, -0.5), xlim=(0.25, 1.6), xlabel=r"best $\gamma$, 95 %, and misfit")
    ax.legend(loc="center right")


def draw_windows(ax, cases):
    """Attractive area, simulation over theory, against what of the highest summit is in reach."""
    for case in cases:
        quoted = case.sel(variant=VARIANT)
        ratio = 1 / (1 + quoted.attractive_area_difference)
        error = np.nan_to_num(ratio**2 * quoted.attractive_area_difference_total_error)
        below = quoted.highest_summit - quoted.theory_mean_gap
        colour, marker = (RED, "o") if read_surface(case)[2] == 1 else (BLUE, "s")
        look = {"linestyle": "none", "markersize": 3, "elinewidth": 0.6, "mew": 0.7}
        ax.errorbar(below, ratio, error, **look, color=colour, marker=marker)
    ax.axhline(1, color=GREY, linewidth=0.7, zorder=0)
    margin = float(cases[0].margin)
    ax.axvline(margin, color=GREY, linestyle=":")
    look = {"rotation": 90, "ha": "right", "va": "top", "fontsize": 8}
    ax.text(margin, 0.97, "too few summits", transform=ax.get_xaxis_transform(), **look)
    label = f"simulation/theory, {SYMBOLS['attractive_area']}"
    ax.set(yscale="log", xlim=(-0.8, 3.2), ylabel=label)
    plotting.write_ticks(ax.yaxis, [0.7, 1, 1.5, 2, 3])
    ax.set_xlabel(r"highest summit less theory's mean gap, over $h_\mathrm{rms}$")
    larger = make_dot("larger cells", color=BLUE, marker="s")
    ax.legend(handles=[make_dot(name_cell(1), color=RED), larger], loc="upper right")


def draw_slopes(ax, kappas, lattices):
    """kappa_rep load by load; open symbols beyond the area that is called linear."""
    for index, (kappa, lattice) in enumerate(zip(kappas, lattices, strict=True)):
        look = pick_look(index, markersize=3.5)
        # Both variants of the theory have the same area.
        theory = lattice.kappa.sel(variant=VARIANT)
        ax.plot(theory.pressure, theory, color=look["color"], linewidth=0.9)
        pressure = plotting.move_aside(kappa.pressure, index - 1)
        label = state(magnification=datasets.parameters(kappa)["magnification"])
        plotting.draw_points(ax, pressure, kappa, "kappa", **look, label=label)
        beyond = kappa.kappa.where(kappa.area_fraction > LINEAR_UP_TO)
        plotting.draw_hollow(ax, pressure, beyond, **look | {"zorder": plotting.FILLED + 1})
    ax.axhline(2, color=GREY, linestyle="--", linewidth=0.9)
    ax.set(xscale="log", ylim=(1.4, 3.7), xlabel=plotting.PRESSURE)
    ax.set_ylabel(r"slope $\kappa_\mathrm{rep}$")
    ax.set_title(f"open: area above {100 * LINEAR_UP_TO:.0f} %")
    straight = make_key(r"$\kappa$ = 2", linestyle="--", linewidth=0.9)
    plotting.add_legend(ax, make_key("theory"), straight, loc="upper right")


if __name__ == "__main__":
    main(start(globals()))
