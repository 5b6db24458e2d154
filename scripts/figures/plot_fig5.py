"""Figure 5: largest roughness that sticks, and the slope of the area-load line."""

from common import plotting
from common.job import start
from common.plotting import BLACK, COLOURS, GREY, RED, interpolate, state
from stickiness import datasets

LENGTH = "adhesion_length_over_range"
LENGTHS = [0.001, 0.01, 0.1, 1.0, 10.0]
EMPHASISED = 0.05  # l_a/range of a crystal on itself
EDGES = "h_rms_limit_edges"
LOOKS = {  # line, colour, width and label
    EDGES: ("-", RED, 2, f"edges, {state(adhesion_length=EMPHASISED)}, with error"),
    "h_rms_limit": ("-", BLACK, 1.0, "DMT sum, $a_V$ as tabulated"),
    "h_rms_limit_constant": ("-.", RED, 1.2, "DMT sum, constant $a_V$ = {a_v:.1f}"),
    "h_rms_limit_printed": ("--", RED, 1.2, "DMT sum, 9/4 as printed"),
    "jtb_limit": ("-.", BLACK, 1.0, "JTB: DMT valid above"),
    "weak_limit": (":", BLACK, 1.2, "edges weak above, stronger below"),
}
ROUGHNESS = r"roughness $h_\mathrm{rms}/\epsilon$"


def main(job):
    data = datasets.read(job.input.map, [*LOOKS, "slope_angle", "a_v"])
    with plotting.open_figure(job.output, "AB", 4.2, width_ratios=[1.35, 1]) as panels:
        draw_limits(panels["A"], data)
        draw_angles(panels["B"], data)


def draw_limits(ax, data):
    """Limit of stickiness for a few adhesion lengths, by the edges, and where its forms hold."""
    x = data.range_times_q0
    for colour, length in plotting.shade(LENGTHS):
        ax.plot(x, interpolate(data[EDGES], LENGTH, length), color=colour, label=f"{length:g}")
    low = interpolate(data[f"{EDGES}_low"], LENGTH, EMPHASISED)
    high = interpolate(data[f"{EDGES}_high"], LENGTH, EMPHASISED)
    plotting.draw_band(ax, x, low, high, RED, alpha=0.25)
    ax.add_artist(ax.legend(title=plotting.SYMBOLS["adhesion_length"], loc="lower left", ncols=2))
    drawn = []
    for name, (line, colour, width, text) in LOOKS.items():
        look = {"color": colour, "linewidth": width, "label": text.format(a_v=float(data.a_v))}
        drawn += ax.plot(x, interpolate(data[name], LENGTH, EMPHASISED), line, **look)
    look = {"color": RED, "mfc": "white", "zorder": 5, "label": "the paper's numbers"}
    claimed = {1e-6: 1e3, 1e-9: 6.7e4, 1e-12: 1e6}  # range q0 and the paper's limit of h_rms/range
    drawn[4:4] = ax.plot(claimed.keys(), claimed.values(), "o", **look)
    ax.legend(handles=drawn, loc="upper right")
    ax.set(xscale="log", yscale="log", xlim=(4e-13, 1e-2), ylim=(1, 1e14))
    ax.set(xlabel=r"lowest wave number $\epsilon q_0$", ylabel=f"largest sticky {ROUGHNESS}")


def draw_angles(ax, data):
    """Angle of the area-load line; beyond the vertical it leans to tension."""
    for colour, parameter in zip(COLOURS, data.slope_parameter.values, strict=False):
        curve = data.slope_angle.sel(slope_parameter=parameter)
        ax.plot(data.h_rms_over_range, curve, color=colour, label=f"{parameter:g}")
    ax.axhline(90, color=GREY, linewidth=0.9, linestyle="--")
    ax.axhspan(90, 180, color=GREY, alpha=0.15, linewidth=0)
    ax.text(0.97, 0.93, "sticky: above 90°", transform=ax.transAxes, ha="right")
    ax.set(xscale="log", ylim=(60, 180), yticks=range(60, 181, 30))
    ax.set(xlabel=ROUGHNESS, ylabel=r"angle arctan $\kappa$ of the area–load line [°]")
    ax.set_title(state(a_v=datasets.parameters(data)["slope_a_v"]))
    ax.legend(title=r"$\epsilon q_0/(l_a/\epsilon)$", loc="center right")


if __name__ == "__main__":
    main(start(globals()))
