"""Figure 2: area and load without adhesion, the threshold of stickiness, and maps of contact."""

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.patches import Rectangle
from scipy.ndimage import gaussian_filter

from pipeline.conventions import LINEAR_UP_TO
from pipeline.job import start
from pipeline.numbers import number
from pipeline.pages.style import (
    BLACK,
    BLUE,
    COLOURS,
    GREY,
    MARKERS,
    aside,
    canvas,
    key,
    letters,
    points,
    save,
    with_model,
)
from stickiness.core import datasets

DETAIL = 0.3  # side of the detail in panels G to I, in window sides
VARIANT = "afferrante2018"  # both variants of the theory have the same area
GAP_COLOUR, CONTACT_COLOUR, ATTRACTION_COLOUR = "white", BLACK, "#FF2A00"
PRESSURE_LABEL = r"pressure $p/(E^*q_0h_\mathrm{rms})$"
AREA_LABEL = r"area $A_\mathrm{rep}/A_\mathrm{nom}$"


def main(job):
    kappas = read_all(job.input.kappa, ["kappa", "area_fraction"])
    ensembles = read_all(job.input.ensembles, ["area_fraction_mean", "rms_slope"])
    lattices = read_all(job.input.lattices, ["area_fraction"])
    maps = datasets.read(job.input.maps, ["gap"])
    limit = datasets.read(job.input.adhesion, ["inverse_kappa", "q0_h_rms"])
    adhesive = datasets.read(job.input.adhesive, ["inverse_kappa", "q0_h_rms"])
    adhesive_maps = datasets.read(job.input.adhesive_maps, ["gap"])
    figure, panels = canvas("ABC;DEF;GHI", 7.9, height_ratios=[1.15, 1, 1])
    panel_a(panels["A"], kappas)
    panel_b(panels["B"], limit, adhesive)
    panel_c(panels["C"], list(zip(ensembles, lattices, strict=True)))
    draw_maps(panels, maps, adhesive_maps)
    letters(panels)
    save(figure, job.output)


def read_all(paths, variables):
    """Datasets of all cases in the order of their magnification."""
    return sorted((datasets.read(path, variables) for path in paths), key=magnification)


def magnification(dataset):
    return datasets.parameters(dataset)["magnification"]


def panel_a(ax, kappas):
    """kappa_rep load by load; open symbols beyond the area that is called linear."""
    for index, kappa in enumerate(kappas):
        colour, marker = COLOURS[index], MARKERS[index]
        theory = kappa.kappa_theory.sel(variant=VARIANT)
        ax.plot(kappa.pressure, theory, color=colour, linewidth=0.9)
        look = {"color": colour, "marker": marker, "markersize": 3.5}
        pressure = aside(kappa.pressure, index - 1)
        points(ax, pressure, kappa.kappa, *with_model(kappa, "kappa"), **look)
        beyond = kappa.where(kappa.area_fraction > LINEAR_UP_TO)
        ax.plot(pressure, beyond.kappa, linestyle="none", **look, mfc="white", zorder=5)
    ax.axhline(2, color=GREY, linestyle="--", linewidth=0.9)
    ax.text(1.1e-3, 1.98, r"$\kappa$ = 2", color=GREY, va="top", fontsize=8)
    ax.set(xscale="log", ylim=(1.4, 3.7), xlabel=PRESSURE_LABEL)
    ax.set(ylabel=r"$\kappa_\mathrm{rep}=A_\mathrm{rep}h'_\mathrm{rms}E^*/(A_\mathrm{nom}p)$")
    ax.set_title(f"open: area above {LINEAR_UP_TO:.0%}")
    ax.legend(handles=[*case_keys(kappas), key(label="theory")], loc="upper right")


def case_keys(kappas):
    """Symbols of the cases, shared by panels A and C."""
    return [
        key(
            color=colour,
            marker=marker,
            linestyle="none",
            label=rf"$\zeta$ = {number(magnification(kappa))}",
        )
        for colour, marker, kappa in zip(COLOURS, MARKERS, kappas, strict=False)
    ]


def panel_b(ax, limit, adhesive):
    """1/kappa at one load, fitted over all, by the net area, and in the DMT limit (dotted)."""
    load = float(adhesive.pressure[-1])
    for index, reach in enumerate(adhesive.range_over_h_rms.values):
        full = adhesive.sel(pressure=load, range_over_h_rms=reach)
        dmt = limit.sel(pressure=load, range_over_h_rms=reach, method="nearest")
        look = {"color": COLOURS[index], "marker": MARKERS[index], "markersize": 3.5}
        ax.plot(dmt.adhesion_length_over_range, dmt.inverse_kappa, ":", color=COLOURS[index])
        lengths = full.adhesion_length_over_range
        ax.plot(lengths, full.inverse_kappa_fit, "-", color=COLOURS[index], linewidth=0.9)
        ax.plot(lengths, full.inverse_kappa_net, linestyle="none", **look, mfc="white", zorder=3)
        label = rf"$\epsilon/h_\mathrm{{rms}}$ = {reach:g}"
        points(ax, lengths, full.inverse_kappa, *with_model(full, "inverse_kappa"), **look)
        ax.plot([], [], linestyle="none", label=label, **look)
    kinds = [
        key(linewidth=0.9, label="fit over loads"),
        key(marker="o", markersize=3.5, mfc="white", linestyle="none", label="compressed"),
        key(linestyle=":", label="DMT limit"),
    ]
    ax.add_artist(ax.legend(loc="upper right", borderaxespad=0.2))
    low, high = -0.35, 0.68
    ax.axhspan(low, 0, color=GREY, alpha=0.15, linewidth=0)
    ax.text(0.03, 0.03, "sticky", transform=ax.transAxes, fontsize=8)
    ax.set(xlabel=r"adhesion length $l_a/\epsilon$", ylabel=r"$1/\kappa$ with adhesion")
    ax.set(ylim=(low, high), xscale="log")
    ax.set_title(rf"$q_0h_\mathrm{{rms}}$ = {float(adhesive.q0_h_rms):g}, $\hat{{p}}$ = {load:g}")
    ax.legend(handles=kinds, loc="lower left", bbox_to_anchor=(0, 0.08))


def panel_c(ax, cases):
    """Area against load, with the straight line of kappa = 2 and theory."""
    for index, (ensemble, lattice) in enumerate(cases):
        look = {"color": COLOURS[index], "marker": MARKERS[index], "markersize": 3.5}
        errors = with_model(ensemble, "area_fraction_mean")
        points(ax, ensemble.pressure, ensemble.area_fraction_mean, *errors, **look)
        theory = lattice.area_fraction.sel(variant=VARIANT)
        ax.plot(theory.pressure, theory, color=COLOURS[index], linewidth=0.9)
        line = 2 * ensemble.pressure * float((1 / ensemble.rms_slope).mean())
        ax.plot(ensemble.pressure, line, ":", color=COLOURS[index], linewidth=0.9)
    ax.set(xlabel=PRESSURE_LABEL, ylabel=AREA_LABEL, xlim=(0, 0.55), ylim=(0, 0.48))
    straight = key(linestyle=":", label=r"$\kappa$ = 2, $\langle 1/h'_\mathrm{rms}\rangle$")
    ax.legend(handles=[straight, key(label="theory")], loc="upper left")


def draw_maps(panels, maps, adhesive):
    """Up to three loads: the window without, and its densest detail with adhesion."""
    made = datasets.parameters(adhesive)
    reach = made["range_over_h_rms"]
    loads = maps.pressure.values
    middle = maps.gap.sel(pressure=loads[len(loads) // 2]).transpose("y", "x").values
    x, y = densest(middle == 0)
    for name, load in zip("DEF", loads, strict=False):
        contact_map(panels[name], maps.sel(pressure=load), None)
        panels[name].add_patch(Rectangle((x, y), DETAIL, DETAIL, fill=False, color=BLUE))
        panels[name].set(xticks=[0, 0.5, 1], yticks=[0, 0.5, 1])
    for name, load in zip("GHI", loads, strict=False):
        contact_map(panels[name], adhesive.sel(pressure=load, method="nearest"), reach)
        panels[name].set(xlim=(x, x + DETAIL), ylim=(y, y + DETAIL))
    panels["D"].set_ylabel("repulsive contact\n$y/L$")
    panels["G"].set_ylabel("blue frame, with adhesion\n$y/L$")


def densest(contact):
    """Lower left corner (x, y) of the detail around the densest contact, in window sides."""
    density = gaussian_filter(contact.astype(float), DETAIL * len(contact) / 4, mode="wrap")
    row, column = np.unravel_index(np.argmax(density), density.shape)
    centre = np.array([column, row]) / len(contact)
    return tuple(np.clip(centre - DETAIL / 2, 0, 1 - DETAIL))


def contact_map(ax, state, reach):
    """Repulsive contact black and, if `reach` is given, gaps up to it red."""
    gap = state.gap.transpose("y", "x").values
    picture = np.empty((*gap.shape, 3))
    picture[:] = to_rgb(GAP_COLOUR)
    if reach is not None:
        picture[gap <= reach] = to_rgb(ATTRACTION_COLOUR)
    picture[gap == 0] = to_rgb(CONTACT_COLOUR)
    extent = (0, 1, 0, 1)  # the window, as unit of length
    ax.imshow(picture, origin="lower", extent=extent, aspect="equal", interpolation="none")
    ax.set_xlabel("$x/L$")
    ax.set_title(rf"$\hat{{p}}$ = {float(state.pressure):g}")


if __name__ == "__main__":
    main(start(globals(), "plot_fig2"))
