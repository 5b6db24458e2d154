"""Figure 11: how much adhesion remains, simulated and by theories."""

import numpy as np

from common import remaining_table
from common.job import start
from figures.theory_curves import draw_work_limits
from stickiness.pages import plotting
from stickiness.pages.plotting import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PURPLE,
    RED,
    make_dot,
    make_key,
)
from stickiness.remaining.measurement import RESOLVED
from stickiness.remaining.roughness import SHORT_RANGE, Roughness

LEAST = 0.05
WORKS = {"approach": "v", "separation": "^"}
ENERGY_RATIO = r"$w/U_\mathrm{full}$"
TOUCH = 0.2  # pressure over E* q0 h_rms, below which the surfaces were hardly pressed


def main(job):
    table = remaining_table.read(job.input.table)
    with plotting.open_figure(job.output, "AB;CD", 5.6) as panels:
        draw_shares(panels["A"], table)
        draw_errors(panels["B"], table)
        draw_hysteresis(panels["C"], table)
        draw_weak(panels["D"], table)


def draw_shares(ax, table):
    """Share that remains against w/U_full: simulations at short ranges, and the theories."""
    tough = table[table.wide & ~table.weak & (table.pressed < TOUCH)]
    narrowest = tough.groupby(["set", "seed", "energy_ratio"]).zone.transform("min")
    tough = tough[tough.zone == narrowest]
    # Amid those simulated.
    rough = Roughness(h_rms=1.0, q0=1.0, elastic_energy=0.55, rms_slope=2.5)
    ratios = np.geomspace(0.2, 3, 200)  # w/U_full
    length = ratios * rough.elastic_energy
    zone = 0.1  # q0 range^2/l_a, of the lines of panel A
    range_ = np.sqrt(zone * length)
    share, low, high = rough.limit_share(length, range_)
    plotting.draw_band(ax, ratios, low, high, GREY, alpha=0.25)
    ax.plot(ratios, share, color=BLACK, linewidth=1.8, label="this theory")
    ax.plot(ratios, rough.share(length, SHORT_RANGE), "--", color=BLACK, label="range → 0")
    ax.plot(ratios, np.maximum(1 - 1 / ratios, 0), ":", color=RED, label="full contact")
    hurst_colours = {0.3: PURPLE, 0.5: RED, 0.6: ORANGE, 0.7: GREEN, 0.8: BLUE, 0.9: BLACK}
    markers = {4: "o", 8: "P", 16: "s", 32: "^", 64: "D"}
    for (hurst, magnification), group in tough.groupby(["hurst", "magnification"]):
        colour = hurst_colours[min(hurst_colours, key=lambda value: abs(value - hurst))]
        marker = markers[min(markers, key=lambda value: abs(np.log(value / magnification)))]
        ax.plot(group.energy_ratio, group.bound, marker, color=colour, markersize=3.5)
    limits = make_key("its limits, 90 %", linewidth=6, alpha=0.25)
    ax.add_artist(plotting.add_legend(ax, limits, loc="upper left"))
    keys = [make_dot(f"H = {h:g}", color=c, marker="s") for h, c in hurst_colours.items()]
    keys += [make_dot(f"ζ = {zeta}", marker=marker) for zeta, marker in markers.items()]
    look = {"title": "simulation, nearest H, ζ", "ncols": 2, "fontsize": 7, "title_fontsize": 7}
    ax.legend(handles=keys, loc="lower right", handletextpad=0, markerscale=0.9, **look)
    ax.set(xlabel=ENERGY_RATIO, ylabel="share of $w$ that remains", xlim=(0.2, 2.5), ylim=(0, 0.7))


def draw_errors(ax, table):
    """Theory over simulation in the works, where more than a little remains."""
    table = table[table.wide & (table.separation > LEAST)]
    goal = 0.25  # error that a theory may have where more than LEAST remains
    within = f"within {100 * goal:.0f} %"
    ax.axhspan(1 - goal, 1 + goal, color=GREY, alpha=0.2, linewidth=0, label=within)
    ax.axhline(1, color=GREY, linewidth=0.9)
    for name, marker in WORKS.items():
        for independent, colour in ((False, BLUE), (True, RED)):
            rows = table[(table.held == independent) & (table[name] > LEAST)]
            look = {"marker": marker, "color": colour, "mfc": colour if independent else "white"}
            ratio = rows.predicted / rows[name]
            draw_works(ax, rows.energy_ratio, ratio, rows, **look, markersize=3.5)
    keys = [make_dot(name, marker=marker) for name, marker in WORKS.items()]
    keys.append(make_dot("not used in the fit", color=RED))
    plotting.add_legend(ax, *keys, loc="upper left")
    ax.set(xlabel=ENERGY_RATIO, ylabel="theory over simulation", xscale="log", ylim=(0.4, 2.2))


def draw_works(ax, x, y, rows, **look):
    """Points of these rows, pale where the grid does not resolve the cohesive zone."""
    resolved_from = 3.9  # pixels in the cohesive zone that resolve it
    fine = rows.pixels_in_zone >= resolved_from
    pale = 0.3  # opacity of points with fewer
    for which, alpha in ((fine, 1), (~fine, pale)):
        ax.plot(x[which], y[which], linestyle="none", alpha=alpha, **look)


def draw_hysteresis(ax, table):
    """Works over the energy gained, against the width of the cohesive zone."""
    table = table[(table.zone < 0.21) & (table.bound > LEAST) & ~table.weak]
    table = table[table.pixels_in_zone >= RESOLVED]
    magnifications = (4, 8), (12, 24), (32, 64)  # from and to, of the colours of panel C
    colours = dict(zip(magnifications, (BLUE, ORANGE, PURPLE), strict=True))
    for i, ((least, most), colour) in enumerate(colours.items()):
        rows = table[table.magnification.between(least, most)]
        for pressed in (False, True):
            here = rows[(rows.pressed > TOUCH) == pressed]
            look = {"color": colour, "mfc": colour if pressed else "white", "markersize": 3.5}
            for name, marker in WORKS.items():
                ax.plot(here.zone * (0.94 + 0.06 * i), here[name] / here.bound, marker, **look)
    draw_work_limits(ax)
    keys = [make_key("limits, 90 %", linestyle=":")]
    keys += [make_dot(f"ζ = {a} to {b}", color=c, marker="s") for (a, b), c in colours.items()]
    keys += [make_dot(name, marker=marker, mfc="white") for name, marker in WORKS.items()]
    ax.legend(handles=[*keys, make_dot("pressed", marker="^")], loc="upper right", ncols=2)
    ax.set(xscale="log", ylim=(0.6, 1.9), xlim=(0.02, 0.3), ylabel="work over energy gained")
    plotting.write_ticks(ax.xaxis, [0.025, 0.05, 0.1, 0.2])
    ax.set_xlabel(r"width of the cohesive zone $q_0\epsilon^2/l_a$")


def draw_weak(ax, table):
    """Share against the range of attraction, from weak to tough adhesion."""
    rows = table[table.weak]
    rows = rows[rows["set"] == rows["set"].iloc[0]]
    energy, slope = rows[["full_contact_energy", "rms_slope"]].iloc[0]
    rough = Roughness(h_rms=1.0, q0=1.0, elastic_energy=energy, rms_slope=slope)
    ranges = np.geomspace(0.05, 5, 100)  # over h_rms
    for colour, ratio in plotting.shade(sorted(rows.energy_ratio.unique())):
        ax.plot(ranges, rough.share(ratio * energy, ranges), color=colour, label=f"{ratio:g}")
        here = rows[rows.energy_ratio == ratio]
        ax.plot(here.range, here.bound, "o", color=colour)
    ax.set(xscale="log", yscale="log", ylim=(3e-3, 1), xlabel=plotting.RANGE)
    ax.set_ylabel("share of $w$ that remains")
    ax.legend(title=ENERGY_RATIO, loc="lower right")


if __name__ == "__main__":
    main(start(globals()))
