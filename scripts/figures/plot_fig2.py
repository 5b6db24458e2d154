"""Figure 2: area and load without adhesion, the threshold of stickiness, and maps of contact."""

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.patches import Rectangle
from scipy.ndimage import gaussian_filter

from common import plotting
from common.conventions import LINEAR_UP_TO, VARIANT
from common.job import start
from common.plotting import BLACK, BLUE, GREY, make_dot, make_key, pick_look, state
from stickiness import datasets

DETAIL = 0.3  # side of the detail in panels G to I, in window sides
ATTRACTION_COLOUR = "#FF2A00"
SIZE = 3.5  # of markers


def main(job):
    read = datasets.read
    kappas = [read(path, ["kappa", "area_fraction"]) for path in job.input.kappa]
    ensembles = [read(path, ["area_fraction_mean", "rms_slope"]) for path in job.input.ensembles]
    lattices = [read(path, ["area_fraction", "kappa"]) for path in job.input.lattices]
    maps = read(job.input.maps, ["gap"])
    limit = read(job.input.adhesion, ["inverse_kappa", "q0_h_rms"])
    adhesive = read(job.input.adhesive, ["inverse_kappa", "q0_h_rms"])
    adhesive_maps = read(job.input.adhesive_maps, ["gap"])
    rows = "ABC;DEF;GHI"
    with plotting.open_figure(job.output, rows, 7.9, height_ratios=[1.15, 1, 1]) as panels:
        draw_slopes(panels["A"], kappas, lattices)
        draw_threshold(panels["B"], limit, adhesive)
        draw_areas(panels["C"], ensembles, lattices)
        draw_maps(panels, maps, adhesive_maps)


def draw_slopes(ax, kappas, lattices):
    """kappa_rep load by load; open symbols beyond the area that is called linear."""
    for index, (kappa, lattice) in enumerate(zip(kappas, lattices, strict=True)):
        look = pick_look(index, markersize=SIZE)
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
    ax.set(ylabel=r"$\kappa_\mathrm{rep}=A_\mathrm{rep}h'_\mathrm{rms}E^*/(A_\mathrm{nom}p)$")
    ax.set_title(f"open: area above {100 * LINEAR_UP_TO:.0f} %")
    straight = make_key(r"$\kappa$ = 2", linestyle="--", linewidth=0.9)
    plotting.add_legend(ax, make_key("theory"), straight, loc="upper right")


def draw_threshold(ax, limit, adhesive):
    """1/kappa at one load, fitted over all, by the net area, and by the DMT sum (dotted)."""
    load = float(adhesive.pressure[-1])
    for index, range_ in enumerate(adhesive.range_over_h_rms.values):
        full = adhesive.sel(pressure=load, range_over_h_rms=range_)
        dmt = limit.sel(pressure=load, range_over_h_rms=range_, method="nearest")
        look = pick_look(index, markersize=SIZE)
        colour = look["color"]
        lengths = full.adhesion_length_over_range
        ax.plot(dmt.adhesion_length_over_range, dmt.inverse_kappa, ":", color=colour)
        ax.plot(lengths, full.inverse_kappa_fit, "-", color=colour, linewidth=0.9)
        plotting.draw_hollow(ax, lengths, full.inverse_kappa_net, **look)
        plotting.draw_points(ax, lengths, full, "inverse_kappa", **look, label=state(range=range_))
    compressed = make_dot("compressed", markersize=SIZE, mfc="white")
    fit = make_key("fit over loads", linewidth=0.9)
    dmt = make_key("DMT sum", linestyle=":")
    ax.add_artist(ax.legend(loc="upper right", borderaxespad=0.2))
    ax.axhspan(-0.35, 0, color=GREY, alpha=0.15, linewidth=0)
    ax.text(0.03, 0.03, "sticky", transform=ax.transAxes, fontsize=8)
    ax.set(xlabel=plotting.ADHESION_LENGTH, ylabel=r"$1/\kappa$ with adhesion")
    ax.set(ylim=(-0.35, 0.68), xscale="log")
    ax.set_title(state(q0_h_rms=float(adhesive.q0_h_rms), pressure=load))
    ax.legend(handles=[fit, compressed, dmt], loc="lower left", bbox_to_anchor=(0, 0.08))


def draw_areas(ax, ensembles, lattices):
    """Area against load, with the straight line of kappa = 2 and theory."""
    for index, (ensemble, lattice) in enumerate(zip(ensembles, lattices, strict=True)):
        look = pick_look(index, markersize=SIZE)
        plotting.draw_points(ax, ensemble.pressure, ensemble, "area_fraction_mean", **look)
        theory = lattice.area_fraction.sel(variant=VARIANT)
        ax.plot(theory.pressure, theory, color=look["color"], linewidth=0.9)
        line = 2 * ensemble.pressure * float((1 / ensemble.rms_slope).mean())
        ax.plot(ensemble.pressure, line, ":", color=look["color"], linewidth=0.9)
    ax.set(xlabel=plotting.PRESSURE, ylabel=plotting.CONTACT_AREA, xlim=(0, 0.55), ylim=(0, 0.48))
    straight = make_key(r"$\kappa$ = 2, $\langle 1/h'_\mathrm{rms}\rangle$", linestyle=":")
    ax.legend(handles=[straight, make_key("theory")], loc="upper left")


def draw_maps(panels, maps, adhesive):
    """Up to three loads: the window without, and its densest detail with adhesion."""
    range_ = datasets.parameters(adhesive)["range_over_h_rms"]
    loads = maps.pressure.values
    middle = maps.gap.sel(pressure=loads[len(loads) // 2]).transpose("y", "x").values
    x, y = find_densest(middle == 0)
    for whole, detail, load in zip("DEF", "GHI", loads, strict=False):
        draw_contact(panels[whole], maps.sel(pressure=load), 0)
        panels[whole].add_patch(Rectangle((x, y), DETAIL, DETAIL, fill=False, color=BLUE))
        panels[whole].set(xticks=[0, 0.5, 1], yticks=[0, 0.5, 1])
        draw_contact(panels[detail], adhesive.sel(pressure=load, method="nearest"), range_)
        panels[detail].set(xlim=(x, x + DETAIL), ylim=(y, y + DETAIL))
    panels["D"].set_ylabel("repulsive contact\n$y/L$")
    panels["G"].set_ylabel("blue frame, with adhesion\n$y/L$")


def find_densest(contact):
    """Lower left corner (x, y) of the detail around the densest contact, in window sides."""
    density = gaussian_filter(contact.astype(float), DETAIL * len(contact) / 4, mode="wrap")
    row, column = np.unravel_index(np.argmax(density), density.shape)
    centre = np.array([column, row]) / len(contact)
    return tuple(np.clip(centre - DETAIL / 2, 0, 1 - DETAIL))


def draw_contact(ax, solution, range_):
    """Repulsive contact black and gaps up to the range of attraction red."""
    gap = solution.gap.transpose("y", "x").values
    picture = np.ones((*gap.shape, 3))
    picture[gap <= range_] = to_rgb(ATTRACTION_COLOUR)
    picture[gap == 0] = to_rgb(BLACK)
    # The window is the unit of length.
    ax.imshow(picture, origin="lower", extent=(0, 1, 0, 1), aspect="equal", interpolation="none")
    ax.set_xlabel("$x/L$")
    ax.set_title(state(pressure=float(solution.pressure)))


if __name__ == "__main__":
    main(start(globals()))
