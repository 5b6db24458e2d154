"""Figure 13: what remains where contact edges are sharper than the finest waves."""

import numpy as np

from common import remaining_table
from common.job import start
from figures.theory_curves import draw_work_limits, name_cell
from stickiness.pages import plotting
from stickiness.pages.plotting import BLUE, GREY, RED, make_dot
from stickiness.remaining.roughness import FINEST_SIMULATED, Roughness
from stickiness.remaining.share import SHARP
from stickiness.spectrum import SelfAffine

COLOURS = {0.5: RED, 0.8: BLUE}  # by the Hurst exponent
CELLS = {4: "D", 2: "o", 1: "s"}  # markers by the longest waves along a cell
RATIOS = {"A": 0.5, "B": 0.8}  # works of adhesion over the energy of full contact, by panel
SHARPEST = 0.31  # zone over the finest waves of the works that are shown
WORKS = {"approach": "v", "separation": "^"}
ENERGY_RATIO = r"$w/U_\mathrm{full}$"
MAGNIFICATION = "magnification ζ"


def main(job):
    table = remaining_table.read(job.input.table)
    fine_zone = table.zone * table.magnification
    ladders = table[np.isclose(fine_zone, SHARP, rtol=1e-3)]
    with plotting.open_figure(job.output, "ABC", 3.0) as panels:
        for name, ratio in RATIOS.items():
            draw_ladder(panels[name], ladders, ratio)
        draw_works(panels["C"], table[(fine_zone < SHARPEST) & table.separation.notna()])


def draw_ladder(ax, table, ratio):
    """Share at zero load against the magnification, simulated and by theory with its limits."""
    magnifications = np.geomspace(2, 1e5, 60)
    last = FINEST_SIMULATED * 2 * SHARP  # as by `share.find_narrowest_wave`
    ax.axvspan(last, magnifications[-1], color=GREY, alpha=0.12, linewidth=0)
    for hurst, colour in COLOURS.items():
        value, low, high = predict(hurst, magnifications, ratio)
        plotting.draw_band(ax, magnifications, low, high, colour, alpha=0.18)
        ax.plot(magnifications, value, color=colour)
        rows = table[(table.hurst == hurst) & (table.energy_ratio == ratio)]
        rows = rows[rows["set"].str.contains("_rest")]
        for window, marker in CELLS.items():
            shares = average_ladder(rows[rows.window == window])
            look = {"color": colour, "mfc": colour if window > 1 else "white", "markersize": 4}
            ax.plot(shares.index, shares, marker, **look)
    ax.set(xscale="log", ylim=(0, 0.26), xlabel=MAGNIFICATION, title=f"{ENERGY_RATIO} = {ratio:g}")
    if ratio == min(RATIOS.values()):
        ax.set_ylabel("share of $w$ that remains")
        keys = [make_dot(f"H = {hurst:g}", color=colour) for hurst, colour in COLOURS.items()]
        for window, marker in CELLS.items():
            filled = {} if window > 1 else {"mfc": "white"}
            keys.append(make_dot(name_cell(window), marker=marker, color=GREY, **filled))
        ax.legend(handles=keys, loc="upper right")


def predict(hurst, magnifications, ratio):
    """Value and limits for a zone of `SHARP` times the finest waves."""
    spectra = [SelfAffine(hurst=hurst, q0=1.0, q1=zeta, h_rms=1.0) for zeta in magnifications]
    energy = np.array([spectrum.elastic_energy() for spectrum in spectra])
    rough = Roughness(
        h_rms=1.0,
        q0=1.0,
        elastic_energy=energy,
        q1=magnifications,
        rms_slope=np.array([spectrum.rms_slope for spectrum in spectra]),
    )
    length = ratio * energy
    range_ = np.sqrt(SHARP / magnifications * length)
    return rough.limit_share(length, range_)


def average_ladder(rows):
    """Mean share of the surfaces that were followed furthest, by magnification."""
    shares = rows.pivot_table(index="seed", columns="magnification", values="bound")
    return shares.loc[shares.count(axis=1) == shares.count(axis=1).max()].mean()


def draw_works(ax, table):
    """Works of approach and separation over the energy gained, with the limits of the theory."""
    for name, marker in WORKS.items():
        for row in table.itertuples():
            colour = COLOURS[min(COLOURS, key=lambda hurst: abs(hurst - row.hurst))]
            look = {"color": colour, "mfc": colour if row.window > 1 else "white", "markersize": 4}
            ax.plot(row.magnification, getattr(row, name) / row.bound, marker, **look)
    draw_work_limits(ax)
    ax.legend(handles=[make_dot(name, marker=marker, color=GREY) for name, marker in WORKS.items()])
    ax.set(xscale="log", xlim=(3.5, 12), ylim=(0.6, 2), xlabel=MAGNIFICATION)
    ax.set_ylabel("work over energy gained")
    plotting.write_ticks(ax.xaxis, [4, 5, 8, 10])


if __name__ == "__main__":
    main(start(globals()))
