"""Figure 10: attraction at the edges of contact, full simulation and its equivalent sphere."""

from itertools import pairwise

import numpy as np
import pandas as pd

from common import plotting
from common.edge_points import COLUMNS, select_certain
from common.job import start
from common.plotting import BLACK, GREY, pick_look, state
from stickiness import datasets
from stickiness.criteria import equivalent_sphere

LOOK = {"markersize": 3.5, "linestyle": "none", "elinewidth": 0.7}


def main(job):
    points = select_certain(datasets.read(path, COLUMNS) for path in job.input.edges)
    with plotting.open_figure(job.output, "AB", 3.4) as panels:
        draw_weak(panels["A"], points)
        draw_ratios(panels["B"], points)


def draw_weak(ax, points):
    """Weak edges: effect against the attractive area, with the closed form."""
    area_ratio = np.geomspace(0.05, 200, 200)
    ax.plot(
        area_ratio,
        equivalent_sphere.weak_effect(area_ratio),
        color=BLACK,
        label="equivalent sphere",
    )
    small = area_ratio[area_ratio < 1.5]
    wide = area_ratio[area_ratio > 0.7]
    formula = r"$(4/\pi)\,t^{-1/2}$"
    plotting.draw_guide(ax, small, 4 / np.pi * small**-0.5, formula, (0.05, 1.95))
    at_approach = equivalent_sphere.weak_effect_at_approach(wide)
    plotting.draw_guide(ax, wide, at_approach, "at equal approach", (3, 0.4))
    ax.axhline(1, color=GREY, linewidth=0.9, linestyle="--")
    ax.text(0.06, 1.04, "DMT sum", color=GREY, fontsize=8)
    surfaces = points.groupby(["magnification", "roughness"], sort=False)
    for index, ((magnification, roughness), edges) in enumerate(surfaces):
        weak = edges[edges.edge_strength < equivalent_sphere.WEAK]
        bars = weak.effect * weak.over_model_total_error / weak.over_model
        label = state(magnification=magnification, q0_h_rms=roughness)
        look = LOOK | pick_look(index, label=label)
        ax.errorbar(weak.attractive_over_contact, weak.effect, bars, **look)
    ax.set(xscale="log", yscale="log")
    ax.set_xlabel(r"attractive over contact area $A_\mathrm{ad}/A_\mathrm{rep}$")
    ax.set_ylabel("attraction at equal area over DMT sum")
    plotting.write_ticks(ax.yaxis, [0.4, 0.6, 1, 1.5, 2, 3, 4, 5])
    ax.set_title(rf"weak edges, $\tau$ < {equivalent_sphere.WEAK:g}")
    ax.legend()


def draw_ratios(ax, points):
    """Simulation over model at every strength, with the error that verdicts take."""
    weakest_edge = 1e-3  # left end of panel B
    ends = weakest_edge, equivalent_sphere.WEAK, equivalent_sphere.STRONGEST_SIMULATED
    factors = equivalent_sphere.ERROR_WEAK, equivalent_sphere.ERROR_STRONG
    for (low, high), factor in zip(pairwise(ends), factors, strict=True):
        plotting.draw_band(ax, [low, high], 1 / factor, factor, GREY, alpha=0.2)
    surfaces = points.groupby(["magnification", "roughness"], sort=False)
    for index, (_, edges) in enumerate(surfaces):
        look = LOOK | pick_look(index, alpha=0.5)
        ax.errorbar(edges.edge_strength, edges.over_model, edges.over_model_total_error, **look)
    ax.axhline(1, color=GREY, linewidth=0.9)
    # Means between the strengths of `edges_of_bins`, as steps with their standard errors.
    look = {"color": BLACK, "linewidth": 2}
    # Tabor parameters between which ratios are averaged: from about 0.2 on they have a trend.
    edges_of_bins = (1e-3, 0.01, 0.05, 0.2, 0.5, 1.0, 1.5, 2.5, 4.0)
    bins = pd.cut(points.edge_strength, edges_of_bins, right=False)
    for strengths, ratio in points.over_model.groupby(bins, observed=True):
        if ratio.size > 1:  # else there is no error of the mean
            ax.plot([strengths.left, strengths.right], [ratio.mean()] * 2, **look)
            ax.errorbar(
                np.sqrt(strengths.left * strengths.right), ratio.mean(), ratio.sem(), **look
            )
    ax.plot([], [], **look, label="means, with standard errors")
    ax.legend(loc="upper left")
    ax.set(xscale="log", yscale="log", xlim=(ends[0], ends[-1]))
    plotting.write_ticks(ax.yaxis, [0.6, 0.7, 0.8, 0.9, 1, 1.2, 1.4, 1.6])
    ax.set(xlabel=r"Tabor parameter of the edges $\tau = l_ad/\epsilon^2$")
    ax.set_ylabel("simulation over equivalent sphere")


if __name__ == "__main__":
    main(start(globals()))
