"""Figure 5: largest roughness that sticks, and the slope of the area-load line."""

import numpy as np

from _job import start
from _style import (
    BLACK,
    COLOURS,
    GREY,
    RED,
    canvas,
    key,
    letters,
    save,
    shades,
)
from stickiness import datasets

LENGTHS = [0.001, 0.01, 0.1, 1.0, 10.0]  # l_a/range
EMPHASISED = 0.05  # a crystal on itself
CLAIMED = {1e-6: 1e3, 1e-9: 6.7e4, 1e-12: 1e6}  # range q0 and the paper's limit of h_rms/range
ROUGHNESS_LABEL = r"roughness $h_\mathrm{rms}/\epsilon$"


def main(job):
    data = datasets.read(job.input.map, ["h_rms_limit", "jtb_limit", "slope_angle", "a_v_low"])
    figure, panels = canvas("AB", 3.9, width_ratios=[1.25, 1])
    panel_a(panels["A"], data)
    panel_b(panels["B"], data)
    letters(panels)
    save(figure, job.output)


def panel_a(ax, data):
    """Limit of stickiness for a few adhesion lengths, as measured and as printed."""
    for length, colour in zip(LENGTHS, shades(len(LENGTHS)), strict=True):
        limit = at_length(data.h_rms_limit, length)
        ax.plot(data.range_times_q0, limit, color=colour, label=f"{length:g}")
    emphasised(ax, data, EMPHASISED)
    unsafe(ax, data)
    ax.set(xscale="log", yscale="log", xlim=(4e-13, 1e-2), ylim=(1, 1e10))
    ax.set(xlabel=r"lowest wave number $\epsilon q_0$", ylabel=rf"largest sticky {ROUGHNESS_LABEL}")
    lines = ax.legend(title=r"$l_a/\epsilon$", title_fontsize=8, loc="upper right", ncols=2)
    ax.add_artist(lines)
    ax.legend(handles=emphasis_keys(data), loc="lower left")


def at_length(limit, length):
    """A limit between the adhesion lengths tabulated: a power law, so exact in logarithms."""
    name = "adhesion_length_over_range"
    logs = np.log(limit).assign_coords({name: np.log(limit[name])})
    return np.exp(logs.interp({name: np.log(length)}))


def emphasised(ax, data, length):
    """Error band, printed coefficient, DMT limit and the paper's numbers at one length."""
    x = data.range_times_q0
    low, high = at_length(data.h_rms_limit_low, length), at_length(data.h_rms_limit_high, length)
    ax.fill_between(x, low, high, color=RED, alpha=0.3, linewidth=0)
    ax.plot(x, at_length(data.h_rms_limit, length), color=RED, linewidth=2)
    ax.plot(x, at_length(data.h_rms_limit_printed, length), "--", color=RED, linewidth=1.2)
    ax.plot(x, at_length(data.jtb_limit, length), "-.", color=BLACK, linewidth=1.2)
    ax.plot(CLAIMED.keys(), CLAIMED.values(), "o", color=RED, mfc="white", zorder=5)


def unsafe(ax, data):
    """Shade roughness at which the threshold lies outside the DMT range.

    Threshold and DMT limit depend on (l_a/range)/(range q0) alone, and cross once.
    """
    ratio = np.log(data.h_rms_limit / data.jtb_limit).values.ravel()
    limit = np.log(data.h_rms_limit).values.ravel()
    order = np.argsort(ratio)
    crossing = np.exp(np.interp(0.0, ratio[order], limit[order]))
    ax.axhspan(crossing, 1e10, color=GREY, alpha=0.15, linewidth=0)
    ax.text(1e-12, 1.4 * crossing, "threshold outside\nthe DMT range", fontsize=8)


def emphasis_keys(data):
    a_v, low, high = (float(data[name]) for name in ("a_v", "a_v_low", "a_v_high"))
    text = rf"$l_a/\epsilon$ = {EMPHASISED:g}, $a_V$ = {a_v:.1f} ({low:.1f} to {high:.1f})"
    return [
        key(color=RED, linewidth=2, label=text),
        key(color=RED, linestyle="--", label="9/4 as printed"),
        key(color=RED, linestyle="none", marker="o", mfc="white", label="the paper's numbers"),
        key(color=BLACK, linestyle="-.", label="JTB: DMT valid above"),
    ]


def panel_b(ax, data):
    """Angle of the area-load line; beyond the vertical it leans to tension."""
    for colour, parameter in zip(COLOURS, data.slope_parameter.values, strict=False):
        curve = data.slope_angle.sel(slope_parameter=parameter)
        ax.plot(data.h_rms_over_range, curve, color=colour, label=f"{parameter:g}")
    ax.axhline(90, color=GREY, linewidth=0.9, linestyle="--")
    ax.axhspan(90, 180, color=GREY, alpha=0.15, linewidth=0)
    ax.text(0.97, 0.93, "sticky: above 90°", transform=ax.transAxes, ha="right")
    ax.set(xscale="log", ylim=(60, 180), yticks=range(60, 181, 30))
    ax.set(xlabel=ROUGHNESS_LABEL, ylabel=r"angle arctan $\kappa$ of the area–load line [°]")
    made = datasets.parameters(data)
    ax.set_title(rf"$a_V$ = {made['slope_a_v']:g}")
    ax.legend(title=r"$\epsilon q_0/(l_a/\epsilon)$", title_fontsize=8, loc="center right")


if __name__ == "__main__":
    main(start(globals(), "plot_fig5"))
