"""Figure 7: how far the DMT sum is from the full solution, over range and adhesion length."""

import matplotlib as mpl
import numpy as np

from common.conventions import middles
from common.job import start
from stickiness import criteria, datasets
from stickiness import error_budget as budget
from stickiness.pages import plotting
from stickiness.pages.plotting import BLACK, GREY, make_dot, make_key, pick_look, state


def main(job):
    data = datasets.read(job.input.adhesive, ["dmt_ratio", "zone_strength", "q0_h_rms"])
    with plotting.open_figure(job.output, "AB", 3.3, width_ratios=[1.1, 1]) as panels:
        draw_plane(panels["A"], data.sel(pressure=job.params.pressure, method="nearest"))
        draw_weak(panels["B"], data)


def draw_plane(ax, data):
    """Ratio in colour and in figures, bold where DMT is good enough, and where it should hold."""
    data = data.transpose("adhesion_length_over_range", "range_over_h_rms", ...)
    ranges = data.range_over_h_rms.values
    lengths = data.adhesion_length_over_range.values
    ratio = data.dmt_ratio.values
    accuracy = 0.15  # of the DMT sum, as Figure 4B asks
    good = error_of_dmt(data).values <= accuracy
    largest_ratio = 4.0  # up or down, that the colours tell apart
    norm = mpl.colors.LogNorm(1 / largest_ratio, largest_ratio)
    mesh = ax.pcolormesh(find_cells(ranges), find_cells(lengths), ratio, norm=norm, cmap="RdYlBu_r")
    dark_ratio = 2.2  # up or down, beyond which a cell's colour asks for white text
    small = {"ha": "center", "va": "center", "fontsize": 7}
    for (row, column), value in np.ndenumerate(ratio):
        ax.text(
            ranges[column],
            lengths[row],
            f"{value:.2f}" if np.isfinite(value) else "·",
            color="white" if abs(np.log(value)) > np.log(dark_ratio) else BLACK,
            weight="bold" if good[row, column] else "normal",
            bbox={"facecolor": mesh.to_rgba(value), "linewidth": 0, "pad": 0.7},
            **small,
        )
    ax.set(xscale="log", yscale="log", xlabel=plotting.RANGE, ylabel=plotting.ADHESION_LENGTH)
    ax.autoscale(False)
    ax.contour(ranges, lengths, data.zone_strength, levels=[1], colors=BLACK)
    jtb = 1 / criteria.jtb_limit(float(data.q0_h_rms), 1.0, 1.0)
    ax.axhline(jtb, color=BLACK, linestyle="--", linewidth=0.9, label="Joe, Thouless & Barber")
    ax.set_ylim(top=max(2.2 * jtb, ax.get_ylim()[1]))
    contour = make_key(r"$l_ad/\epsilon^2$ = 1, $d$: width of the edge", color=BLACK)
    below = {"bbox_to_anchor": (0, jtb), "bbox_transform": ax.get_yaxis_transform()}
    plotting.add_legend(ax, contour, loc="upper left", **below, borderaxespad=0.2)
    bar = ax.figure.colorbar(mesh, ax=ax, label=r"$1/\kappa_\mathrm{ad}$, full over DMT sum")
    plotting.write_ticks(bar.ax.yaxis, [0.25, 0.5, 1, 2, 4])
    bar.ax.minorticks_off()
    zeta = datasets.parameters(data)["magnification"]
    ax.set_title(state(magnification=zeta, q0_h_rms=data.q0_h_rms, pressure=data.pressure))


def error_of_dmt(data):
    """Relative error of the DMT sum, as far as its measurement allows."""
    log_error = budget.total_error(data, "dmt_ratio") / data.dmt_ratio
    return abs(np.expm1(abs(np.log(data.dmt_ratio)) + log_error))


def find_cells(values):
    """Edges of the cells around values on a log axis."""
    inner = middles(values)
    return np.concatenate([[values[0] ** 2 / inner[0]], inner, [values[-1] ** 2 / inner[-1]]])


def draw_weak(ax, data):
    """Weak adhesion at equal area, and at equal mean gap (open) with its limit (line)."""
    weak = data.isel(adhesion_length_over_range=0)
    for index, load in enumerate(weak.pressure.values):
        loaded = weak.sel(pressure=load)
        look = pick_look(index, markersize=3.5)
        x = plotting.move_aside(loaded.range_over_h_rms, index - 1, 1.06)
        ax.plot(x, loaded.dmt_ratio_at_gap / loaded.weak_ratio, linewidth=0.9, color=look["color"])
        plotting.draw_hollow(ax, x, loaded.dmt_ratio_at_gap, **look)
        plotting.draw_points(ax, x, loaded, "dmt_ratio", **look, label=state(pressure=load))
    x = np.array([0.01, 0.2])
    plotting.draw_guide(ax, x, 3.2 * (x / 0.01) ** (-1 / 3), r"$\epsilon^{-1/3}$", (0.042, 1.25))
    ax.axhline(1, color=BLACK, linewidth=0.9, linestyle="--", label="DMT sum")
    ax.set(xscale="log", yscale="log", xlabel=plotting.RANGE)
    ax.set_ylabel("attraction, full over DMT sum")
    plotting.write_ticks(ax.yaxis, [0.125, 0.25, 0.5, 1, 2, 4])
    at_gap = make_dot("equal mean gap", color=GREY, markersize=3.5, mfc="white")
    ax.set_title(f"weak adhesion, {state(adhesion_length=weak.adhesion_length_over_range)}")
    limit = make_key("its weak limit", color=GREY, linewidth=0.9)
    plotting.add_legend(ax, at_gap, limit, loc="upper right")


if __name__ == "__main__":
    main(start(globals()))
