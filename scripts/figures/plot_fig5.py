"""Figure 5: largest roughness that sticks, and the slope of the area-load line."""

import numpy as np

from pipeline.job import start
from pipeline.pages.style import BLACK, COLOURS, GREY, RED, canvas, key, letters, save, shades
from stickiness.core import datasets

LENGTHS = [0.001, 0.01, 0.1, 1.0, 10.0]  # l_a/range
EMPHASISED = 0.05  # a crystal on itself
CLAIMED = {1e-6: 1e3, 1e-9: 6.7e4, 1e-12: 1e6}  # range q0 and the paper's limit of h_rms/range
FORMS = {
    "h_rms_limit": {"color": BLACK, "linewidth": 1.0},
    "h_rms_limit_constant": {"color": RED, "linewidth": 1.2, "linestyle": "-."},
    "h_rms_limit_printed": {"color": RED, "linewidth": 1.2, "linestyle": "--"},
    "jtb_limit": {"color": BLACK, "linewidth": 1.0, "linestyle": "-."},
    "weak_limit": {"color": BLACK, "linewidth": 1.2, "linestyle": ":"},
}
ROUGHNESS_LABEL = r"roughness $h_\mathrm{rms}/\epsilon$"


LIMITS = ("h_rms_limit", "h_rms_limit_edges", "jtb_limit", "weak_limit")


def main(job):
    data = datasets.read(job.input.map, [*LIMITS, "slope_angle", "a_v"])
    figure, panels = canvas("AB", 4.2, width_ratios=[1.35, 1])
    panel_a(panels["A"], data)
    panel_b(panels["B"], data)
    letters(panels)
    save(figure, job.output)


def panel_a(ax, data):
    """Limit of stickiness for a few adhesion lengths, by the edges, and where its forms hold."""
    for length, colour in zip(LENGTHS, shades(len(LENGTHS)), strict=True):
        limit = at_length(data.h_rms_limit_edges, length)
        ax.plot(data.range_times_q0, limit, color=colour, label=f"{length:g}")
    emphasised(ax, data, EMPHASISED)
    ax.set(xscale="log", yscale="log", xlim=(4e-13, 1e-2), ylim=(1, 1e14))
    ax.set(xlabel=r"lowest wave number $\epsilon q_0$", ylabel=rf"largest sticky {ROUGHNESS_LABEL}")
    lines = ax.legend(title=r"$l_a/\epsilon$", title_fontsize=8, loc="lower left", ncols=2)
    ax.add_artist(lines)
    ax.legend(handles=emphasis_keys(data), loc="upper right")


def at_length(limit, length):
    """A limit between the adhesion lengths tabulated, nearly a power law of them."""
    name = "adhesion_length_over_range"
    logs = np.log(limit).assign_coords({name: np.log(limit[name])})
    return np.exp(logs.interp({name: np.log(length)}))


def emphasised(ax, data, length):
    """Error band, other forms of the criterion, their limits and the paper's numbers."""
    x = data.range_times_q0
    low, high = (at_length(data[f"h_rms_limit_edges_{end}"], length) for end in ("low", "high"))
    ax.fill_between(x, low, high, color=RED, alpha=0.25, linewidth=0)
    ax.plot(x, at_length(data.h_rms_limit_edges, length), color=RED, linewidth=2)
    for name, look in FORMS.items():
        ax.plot(x, at_length(data[name], length), **look)
    ax.plot(CLAIMED.keys(), CLAIMED.values(), "o", color=RED, mfc="white", zorder=5)


def emphasis_keys(data):
    def of(name, text):
        return key(label=text, **FORMS[name])

    return [
        key(color=RED, linewidth=2, label=rf"edges, $l_a/\epsilon$ = {EMPHASISED:g}, with error"),
        of("h_rms_limit", r"DMT limit, $a_V$ as tabulated"),
        of("h_rms_limit_constant", rf"DMT limit, constant $a_V$ = {float(data.a_v):.1f}"),
        of("h_rms_limit_printed", "DMT limit, 9/4 as printed"),
        key(color=RED, linestyle="none", marker="o", mfc="white", label="the paper's numbers"),
        of("jtb_limit", "JTB: DMT valid above"),
        of("weak_limit", r"edges weak above, stronger below"),
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
