"""Figure 7: how far the DMT limit is from the full solution, over range and adhesion length."""

import matplotlib as mpl
import numpy as np

from pipeline.job import start
from pipeline.numbers import number
from pipeline.pages.style import (
    COLOURS,
    GREY,
    MARKERS,
    canvas,
    guide,
    key,
    letters,
    points,
    save,
    with_model,
)
from stickiness import criteria
from stickiness.core import budget, datasets

RANGE_LABEL = r"range $\epsilon/h_\mathrm{rms}$"
RATIO_LABEL = r"$1/\kappa_\mathrm{ad}$, full over DMT"
ACCURACY = 0.15  # of the DMT limit, as Figure 4B asks
SPAN = 4.0  # largest ratio, up or down, that the colours tell apart


def main(job):
    data = datasets.read(job.input.adhesive, ["dmt_ratio", "zone_strength", "q0_h_rms"])
    figure, panels = canvas("AB", 3.3, width_ratios=[1.1, 1])
    panel_a(figure, panels["A"], data.sel(pressure=job.params.pressure, method="nearest"))
    panel_b(panels["B"], data)
    letters(panels)
    save(figure, job.output)


def panel_a(figure, ax, data):
    """Ratio in colour and in figures, with the conditions under which DMT is taken to hold."""
    ranges, lengths = data.range_over_h_rms.values, data.adhesion_length_over_range.values
    dims = "adhesion_length_over_range", "range_over_h_rms"
    ratio = data.dmt_ratio.transpose(*dims).values
    good = (error_of_dmt(data) <= ACCURACY).transpose(*dims).values
    norm = mpl.colors.LogNorm(1 / SPAN, SPAN)
    mesh = ax.pcolormesh(edges(ranges), edges(lengths), ratio, norm=norm, cmap="RdYlBu_r")
    for row, length in enumerate(lengths):
        for column, reach in enumerate(ranges):
            value = ratio[row, column]
            text = f"{value:.2f}" if np.isfinite(value) else "·"
            dark = np.isfinite(value) and abs(np.log(value)) > np.log(2.2)
            colour = "white" if dark else "black"
            weight = "bold" if good[row, column] else "normal"
            look = {"ha": "center", "va": "center", "fontsize": 7}
            ax.text(reach, length, text, color=colour, weight=weight, **look)
    ax.set(xscale="log", yscale="log", xlabel=RANGE_LABEL)
    ax.set_ylabel(r"adhesion length $l_a/\epsilon$")
    limits = ax.get_xlim(), ax.get_ylim()
    strength = data.zone_strength.transpose(*dims)
    ax.contour(ranges, lengths, strength.values, levels=[1], colors="black")
    ax.legend(handles=[key(color="black", label=r"$l_ad/\epsilon^2$ = 1")], loc="upper left")
    jtb = 1 / criteria.jtb_limit(float(data.q0_h_rms), 1.0, 1.0)
    if limits[1][0] < jtb < limits[1][1]:
        ax.axhline(jtb, color="black", linestyle="--", linewidth=0.9)
    ax.set(xlim=limits[0], ylim=limits[1])
    ticks = [0.25, 0.5, 1, 2, 4]
    bar = figure.colorbar(mesh, ax=ax, ticks=ticks, label=RATIO_LABEL)
    bar.ax.set_yticklabels([f"{tick:g}" for tick in ticks])
    bar.ax.minorticks_off()
    made = datasets.parameters(data)
    ax.set_title(
        rf"$\zeta$ = {number(made['magnification'])}, $q_0h_\mathrm{{rms}}$ = "
        rf"{float(data.q0_h_rms):g}, $\hat{{p}}$ = {float(data.pressure):g}"
    )


def error_of_dmt(data):
    """Relative error of the DMT limit, as far as its measurement allows."""
    log_error = budget.total_error(data, "dmt_ratio") / data.dmt_ratio
    return abs(np.expm1(abs(np.log(data.dmt_ratio)) + log_error))


def edges(values):
    """Edges of the cells around values on a log axis."""
    middle = np.sqrt(values[1:] * values[:-1])
    return np.concatenate([[values[0] ** 2 / middle[0]], middle, [values[-1] ** 2 / middle[-1]]])


def panel_b(ax, data):
    """Weak adhesion, by the area at zero gap and by its compressed part (open)."""
    weak = data.isel(adhesion_length_over_range=0)
    for index, load in enumerate(weak.pressure.values):
        one = weak.sel(pressure=load)
        look = {"color": COLOURS[index], "marker": MARKERS[index], "markersize": 3.5}
        errors = with_model(one, "dmt_ratio")
        x = one.range_over_h_rms * 1.06 ** (index - 1)
        ax.plot(x, one.dmt_ratio_net, linestyle="none", **look, mfc="white", zorder=3)
        points(ax, x, one.dmt_ratio, *errors, **look)
        ax.plot([], [], linestyle="none", label=rf"$\hat{{p}}$ = {load:g}", **look)
    x = np.array([0.01, 0.2])
    guide(ax, x, 3.2 * (x / 0.01) ** (-1 / 3), r"$\epsilon^{-1/3}$", (0.04, 2.3))
    ax.axhline(1, color=GREY, linewidth=0.9)
    ax.set(xscale="log", yscale="log", xlabel=RANGE_LABEL)
    ticks = [0.5, 1, 2, 4, 8]
    ax.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
    ax.minorticks_off()
    ax.plot([], [], "o", color=GREY, mfc="white", markersize=3.5, label="compressed area")
    ax.set_title(rf"weak adhesion, $l_a/\epsilon$ = {float(weak.adhesion_length_over_range):g}")
    ax.legend(loc="upper right")


if __name__ == "__main__":
    main(start(globals(), "plot_fig7"))
