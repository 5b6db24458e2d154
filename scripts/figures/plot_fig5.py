"""Figure 5: the plane of the criterion, and the slope of the area-load line."""

import numpy as np

from common.job import start
from common.paper import A_V, CRYSTAL, H_RMS_LIMITS
from stickiness import criteria, datasets
from stickiness.formatting import number
from stickiness.pages import plotting
from stickiness.pages.plotting import BLACK, BLUE, COLOURS, GREEN, GREY, RED, interpolate, state
from stickiness.verdicts.limits import LIMITS

LENGTH = "adhesion_length_over_range"
EDGES = "h_rms_threshold_edges"
PARAMETER = r"$\epsilon q_0/(l_a/\epsilon)$"
ROUGHNESS = r"roughness $h_\mathrm{rms}/\epsilon$"


def main(job):
    data = datasets.read(job.input.map, [EDGES, "slope_angle", "a_v", "a_v_total_error"])
    with plotting.open_figure(job.output, "AB", 4.0, width_ratios=[1.2, 1]) as panels:
        draw_plane(panels["A"], data)
        draw_angles(panels["B"], data)


def draw_plane(ax, data):
    """The plane in which the criterion is one line, with the validity of DMT and the edges."""
    h = np.geomspace(1, 1e8, 200)  # h_rms/range
    a_v = float(data.a_v)
    error = float(data.a_v_total_error)
    limit, low, high = (find_parameter(h, each) for each in (a_v, a_v - error, a_v + error))
    bottom = 1e-14
    top = 1e2
    plotting.draw_band(ax, h, bottom, limit, GREY, alpha=0.15)
    plotting.draw_band(ax, h, low, high, BLACK, alpha=0.35)
    ax.plot(h, limit, color=BLACK, label=f"measured {state(a_v=a_v)}, with error")
    correct = f"{state(a_v=A_V)}: coefficient {number(1.5 * A_V)}"
    ax.plot(h, find_parameter(h, A_V), "--", color=BLUE, label=correct)
    printed = f"as printed: coefficient {number(1.5 * criteria.PRINTED_A_V)}"
    ax.plot(h, find_parameter(h, criteria.PRINTED_A_V), "--", color=RED, label=printed)
    # The JTB limit of h_rms/range is inversely proportional to the parameter.
    jtb = criteria.jtb_limit(1.0, 1.0, 1.0) / h
    ax.plot(h, jtb, "-.", color=BLACK, linewidth=1.0, label="JTB: DMT valid above")
    look = {"color": RED, "mfc": "white", "linestyle": "none", "marker": "o", "zorder": 5}
    range_times_q0 = np.array([*H_RMS_LIMITS])
    parameters = range_times_q0 / CRYSTAL
    ax.plot([*H_RMS_LIMITS.values()], parameters, label="the paper's numbers", **look)
    recomputed = criteria.h_rms_threshold(range_times_q0, CRYSTAL, 1.0, criteria.PRINTED_A_V)
    look |= {"marker": "+", "mew": 1.4, "markersize": 6}
    ax.plot(recomputed, parameters, label="recomputed as printed", **look)
    draw_edges(ax, data)
    ax.text(2, 3e-12, "sticky", fontsize=9)
    ax.set(xscale="log", yscale="log", xlim=(h[0], h[-1]), ylim=(bottom, top))
    ax.set(xlabel=ROUGHNESS, ylabel=PARAMETER)
    ax.legend(loc="upper right")


def find_parameter(h_over_range, a_v):
    """Largest range q0/(l_a/range) that sticks by the criterion with a constant a_V."""
    # The limit of h_rms/range falls as the parameter to the power -3/5.
    at_one = criteria.h_rms_threshold(1.0, 1.0, 1.0, a_v)
    return (at_one / h_over_range) ** (5 / 3)


def draw_edges(ax, data):
    """Onset of stickiness at the edges of contact for the adhesion length of a crystal."""
    parameter = data.range_times_q0 / CRYSTAL
    low, limit, high = (
        interpolate(data[EDGES].sel(limit=name), LENGTH, CRYSTAL) for name in LIMITS
    )
    ax.fill_betweenx(parameter, low, high, color=GREEN, alpha=0.3, linewidth=0)
    label = f"edges, {state(adhesion_length=CRYSTAL)}, with error"
    ax.plot(limit, parameter, color=GREEN, label=label)


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
    ax.legend(title=PARAMETER, loc="center right")


if __name__ == "__main__":
    main(start(globals()))
