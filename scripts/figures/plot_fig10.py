"""Figure 10: the edges of contact: attraction there against a sphere, gaps and attractive area."""

from itertools import pairwise

import numpy as np
import pandas as pd

from common.edge_points import COLUMNS, select_certain
from common.job import start
from common.paper import LOAD, at_load
from figures.theory_curves import (
    draw_theory,
    draw_variants,
    dress_density,
    name_case,
)
from stickiness import datasets
from stickiness.criteria import equivalent_sphere
from stickiness.formatting import number
from stickiness.pages import plotting
from stickiness.pages.plotting import BLACK, COLOURS, GREY, make_dot, make_key, pick_look, state

LOADS = [0.0065, 0.065, 0.26]  # over E* q0 h_rms, of panel C
EXPONENT = 2 / 3
LOOK = {"markersize": 3.5, "linestyle": "none", "elinewidth": 0.7}


def main(job):
    points = select_certain(datasets.read(path, COLUMNS) for path in job.input.edges)
    ensemble = datasets.read(job.input.ensemble, ["gap_density_mean", "edge_gap_mean"])
    lattice = datasets.read(job.input.lattice, ["gap_density"])
    sweep = datasets.read(job.input.sweep, ["exponent"])
    fits = [datasets.read(path, ["exponent"]).isel(window=0) for path in job.input.fits]
    with plotting.open_figure(job.output, "AB;CD", 7.2, height_ratios=[1, 1.15]) as panels:
        draw_weak(panels["A"], points)
        draw_ratios(panels["B"], points)
        draw_simulation(panels["C"], ensemble, lattice)
        draw_exponents(panels["D"], sweep, fits)


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


def draw_simulation(ax, ensemble, lattice):
    """Simulated P(u) with its errors against theory on the spectrum of the cell."""
    for colour, load in zip(COLOURS, LOADS, strict=False):
        measured = ensemble.sel(pressure=load, method="nearest")
        draw_measured(ax, measured, colour)
        theory = lattice.gap_density.sel(pressure=load, method="nearest")
        label = state(pressure=measured.pressure)
        draw_variants(ax, theory, label, color=colour, linewidth=0.9)
    case = datasets.parameters(ensemble)
    fine = ensemble.sizes["seed"]
    coarse = ensemble.sizes.get("coarse_seed")
    count = f"{fine} + {coarse}" if coarse else f"{fine}"
    surface = state(hurst=case["hurst"], magnification=case["magnification"])
    title = f"{surface}, {count} realisations"
    dress_density(ax, (1e-2, 300), title)
    mean = make_dot("BEM", marker=".")
    below = make_dot("by the edge law", mfc="white", markersize=3)
    variants = [make_key("theory, 2018"), make_key("theory, 2011", linestyle="--")]
    plotting.add_legend(ax, mean, below, *variants, loc="upper right", ncols=2)


def draw_measured(ax, measured, colour):
    """Mean with a dark band for the sampling error and a light one for all errors."""
    mean = measured.gap_density_mean.where(measured.gap_density_mean > 0)
    sampling, total = plotting.read_errors(measured, "gap_density_mean")
    lowest_density = 1e-6  # a band down to zero has no lower end on a log axis
    for error, strength in ((total, 0.15), (sampling, 0.3)):
        low = np.maximum(mean - error, lowest_density)
        plotting.draw_band(ax, mean.gap, low, mean + error, colour, strength)
    # Below the gap next to the edge of contact the edge law replaces the grid: hollow points.
    resolved = mean.gap >= measured.edge_gap_mean
    small = {"color": colour, "linestyle": "none"}
    ax.plot(mean.gap, mean.where(resolved), marker=".", markersize=3.5, **small)
    below = {"marker": "o", "markersize": 2.2, "mfc": "white", "mew": 0.5}
    ax.plot(mean.gap, mean.where(~resolved), **below, **small)


def draw_exponents(ax, fit, cases):
    """Local exponents of the attractive area at one load, by theory and simulation."""
    hurst = float(fit.hurst[0])
    exponents = fit.exponent.isel(hurst=0, load=0)
    for colour, magnification in plotting.shade(fit.magnification.values):
        curve = exponents.sel(magnification=magnification)
        label = number(magnification) if magnification in fit.magnification[[0, -1]] else None
        draw_theory(ax, curve["range"], curve, colour, label=label)
    for index, case in enumerate(cases):
        exponent = at_load(case.exponent)
        exponent = exponent.isel(range=slice(None, None, 2))
        look = pick_look(index, linestyle="none", markersize=3, label=f"BEM, {name_case(case)}")
        ax.plot(exponent["range"], exponent, **look)
    for x, level, text, side in (
        (9, EXPONENT, "2/3: edges", "right"),
        (0.05, (1 - hurst) / hurst, r"$(1-H)/H$: fractal", "center"),
    ):
        ax.axhline(level, color=BLACK, linestyle=":", linewidth=0.9)
        ax.text(x, level + 0.015, text, ha=side, fontsize=8)
    ax.set(xscale="log", xlim=(1e-4, 10), ylim=(0, 1.7), xlabel=plotting.RANGE)
    ax.set_ylabel(r"$\mathrm{d}\,\ln A_\mathrm{ad}\,/\,\mathrm{d}\,\ln\epsilon$")
    ax.legend(loc="upper left", title=r"theory, $\zeta$ =", ncols=2, alignment="left")
    ax.set_title(state(hurst=hurst, pressure=LOAD))


if __name__ == "__main__":
    main(start(globals()))
