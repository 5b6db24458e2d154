"""Figure 2: a surface, area and load with growing adhesion, and maps of contact."""

import numpy as np
import xarray as xr
from matplotlib.colors import to_rgb
from matplotlib.patches import Rectangle
from scipy.ndimage import gaussian_filter

from common.job import start
from stickiness import datasets
from stickiness.pages import plotting
from stickiness.pages.plotting import BLACK, BLUE, GREY, make_dot, make_key, pick_look, state

DETAIL = 0.13  # side of the detail in panels G to I, in window sides
ZONES = {1: "#FF2A00", 2: plotting.ORANGE, 3: BLACK}  # colours by the codes of `zone`
SIZE = 3.5  # of markers


def main(job):
    read = datasets.read
    surface = read(job.input.surface, ["height", "window_length", "rms_slope"]).isel(seed=0)
    maps = xr.concat([read(path, ["gap"]) for path in job.input.maps], "pressure")
    limit = read(job.input.adhesion, ["inverse_kappa", "q0_h_rms"])
    adhesive = read(job.input.adhesive, ["inverse_kappa", "q0_h_rms"])
    adhesive_maps = read(job.input.adhesive_maps, ["zone", "repulsive_area", "pixels_in_zone"])
    rms_slope = float(surface.rms_slope.sel(source="heights"))
    rows = "ABC;DEF;GHI"
    with plotting.open_figure(job.output, rows, 7.9, height_ratios=[1.1, 1, 1]) as panels:
        draw_surface(panels["A"], surface)
        draw_areas(panels["B"], adhesive_maps, rms_slope)
        draw_threshold(panels["C"], limit, adhesive, adhesive_maps, rms_slope)
        draw_maps(panels, maps, adhesive_maps)


def draw_surface(ax, surface):
    """Heights of the realisation whose contact the other panels show."""
    heights = surface.height.transpose("y", "x").values
    look = {"origin": "lower", "extent": (0, 1, 0, 1), "aspect": "equal"}
    picture = ax.imshow(heights, cmap="cividis", interpolation="none", **look)
    bar = ax.figure.colorbar(picture, cax=ax.inset_axes([1.04, 0, 0.06, 1]))
    bar.ax.set_title(r"$h/h_\mathrm{rms}$", fontsize=8)
    ax.set(xlabel="$x/L$", ylabel="$y/L$", xticks=[0, 0.5, 1], yticks=[0, 0.5, 1])
    parameters = datasets.parameters(surface)
    ax.set_title(state(hurst=parameters["hurst"], magnification=parameters["magnification"]))


def draw_areas(ax, maps, rms_slope):
    """Area against load of one realisation on loading, without adhesion and with more of it."""
    load = maps.pressure
    origin_and_loads = np.concatenate([[0], load])
    ax.plot(
        origin_and_loads, 2 * origin_and_loads / rms_slope, ":", color=GREY, label=r"$\kappa$ = 2"
    )
    look = pick_look(0, color=BLACK, markersize=SIZE)
    ax.plot(load, maps.area_alone, **look, label="0")
    for index, length in enumerate(maps.adhesion_length_over_range.values):
        area = maps.repulsive_area.sel(adhesion_length_over_range=length)
        look = pick_look(index + 1, color=plotting.COLOURS[index], markersize=SIZE)
        ax.plot(load, area, **look, label=f"{length:g}")
    ax.set(xlabel=plotting.PRESSURE, ylabel=plotting.CONTACT_AREA)
    ax.set_xlim(left=0)
    ax.set_ylim(bottom=0)
    ax.set_title(state(range=float(maps.range_over_h_rms)))
    roughness = state(q0_h_rms=datasets.parameters(maps)["q0_h_rms"])
    ax.text(0.96, 0.04, roughness, transform=ax.transAxes, ha="right")
    ax.legend(title=plotting.SYMBOLS["adhesion_length"], loc="upper left", alignment="left")


def draw_threshold(ax, limit, adhesive, maps, rms_slope):
    """1/kappa at one load, fitted over all, by the net area, and by the DMT sum (dotted).

    At the range of the maps, which the ensemble does not resolve, crosses show one realisation.
    """
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
    loaded = maps.sel(pressure=load, method="nearest")
    inverse = loaded.pressure / (loaded.repulsive_area * rms_slope)
    ax.plot(loaded.adhesion_length_over_range, inverse, "x", color=BLACK, markersize=5, mew=1.4)
    single = make_dot("panel B", marker="x", color=BLACK, markersize=5)
    compressed = make_dot("compressed", markersize=SIZE, mfc="white")
    fit = make_key("fit over loads", linewidth=0.9)
    dmt = make_key("DMT sum", linestyle=":")
    ax.add_artist(ax.legend(loc="upper right", borderaxespad=0.2))
    ax.axhspan(-0.65, 0, color=GREY, alpha=0.15, linewidth=0)
    ax.text(0.03, 0.03, "sticky", transform=ax.transAxes, fontsize=8)
    ax.set(xlabel=plotting.ADHESION_LENGTH, ylabel=r"load over area, $1/\kappa$ (sticky below 0)")
    ax.set(ylim=(-0.65, 0.78), xscale="log")
    ax.set_title(state(pressure=load))
    place = {"loc": "lower left", "bbox_to_anchor": (0, 0.07), "fontsize": 7, "handlelength": 1.2}
    ax.legend(handles=[fit, compressed, single, dmt], **place)


def draw_maps(panels, maps, adhesive):
    """Up to three loads: the window without, and its densest detail with adhesion."""
    loads = maps.pressure.values
    middle = maps.gap.sel(pressure=loads[len(loads) // 2]).transpose("y", "x").values
    x, y = find_densest(middle == 0)
    for whole, detail, load in zip("DEF", "GHI", loads, strict=False):
        contact = maps.gap.sel(pressure=load) == 0
        draw_zones(panels[whole], np.where(contact, 3, 0).T)
        panels[whole].add_patch(Rectangle((x, y), DETAIL, DETAIL, fill=False, color=BLUE))
        panels[whole].set(xticks=[0, 0.5, 1], yticks=[0, 0.5, 1])
        panels[whole].set_title(state(pressure=load))
        loaded = adhesive.sel(pressure=load, method="nearest")
        draw_zones(panels[detail], loaded.zone.transpose("y", "x").values)
        panels[detail].set(xlim=(x, x + DETAIL), ylim=(y, y + DETAIL))
        panels[detail].set_title(state(pressure=float(loaded.pressure)))
    panels["D"].set_ylabel("without adhesion\n$y/L$")
    panels["G"].set_ylabel("blue frame, with adhesion\n$y/L$")
    label_zones(panels["H"], adhesive.isel(adhesion_length_over_range=-1))


def label_zones(ax, strongest):
    """Name the colours of the maps with adhesion below them, and what the grid resolves."""
    names = {3: "compressed", 2: "contact in tension", 1: r"gap up to $\epsilon$"}
    keys = [make_dot(name, color=ZONES[zone], marker="s") for zone, name in names.items()]
    length = float(strongest.adhesion_length_over_range)
    label = state(range=float(strongest.range_over_h_rms), adhesion_length=length)
    pixels = float(strongest.pixels_in_zone)
    title = rf"{label}; zone of attraction $\epsilon^2/l_a$: {pixels:.2g} pixels"
    place = {"loc": "outside lower center", "ncols": len(keys)}
    ax.figure.legend(handles=keys, title=title, **place)


def find_densest(contact):
    """Lower left corner (x, y) of the detail around the densest contact, in window sides."""
    density = gaussian_filter(contact.astype(float), DETAIL * len(contact) / 4, mode="wrap")
    row, column = np.unravel_index(np.argmax(density), density.shape)
    centre = np.array([column, row]) / len(contact)
    return tuple(np.clip(centre - DETAIL / 2, 0, 1 - DETAIL))


def draw_zones(ax, zone):
    """Contact black, in tension orange, and gaps up to the range red; `zone[y, x]` in codes."""
    picture = np.ones((*zone.shape, 3))
    for code, colour in ZONES.items():
        picture[zone == code] = to_rgb(colour)
    # The window is the unit of length.
    ax.imshow(picture, origin="lower", extent=(0, 1, 0, 1), aspect="equal", interpolation="none")
    ax.set_xlabel("$x/L$")


if __name__ == "__main__":
    main(start(globals()))
