"""Figure 1: distribution of gaps by Persson's theory, its convergence, and simulation."""

import numpy as np

from common import plotting
from common.conventions import VARIANT
from common.job import start
from common.plotting import COLOURS, GREY, interpolate, make_dot, make_key, state
from common.theory_variants import between_corrections
from stickiness import datasets

GAPS = [0.003, 0.01, 0.03, 0.1, 0.3, 1.0]  # over h_rms, of panel B
LOADS = [0.0065, 0.065, 0.26]  # over E* q0 h_rms, of panel C
VARIANT_KEYS = [
    make_key("Afferrante et al. 2018"),
    make_key("Almqvist et al. 2011", linestyle="--"),
]
DENSITY = r"probability density $h_\mathrm{rms}P(u)$"


def main(job):
    density = datasets.read(job.input.density, ["gap_density"])
    convergence = datasets.read(job.input.convergence, ["gap_density"])
    ensemble = datasets.read(job.input.ensemble, ["gap_density_mean", "edge_gap_mean"])
    lattice = datasets.read(job.input.lattice, ["gap_density"])
    with plotting.open_figure(job.output, "AB;CC", 5.9, height_ratios=[1, 1.05]) as panels:
        draw_magnifications(panels["A"], density)
        draw_convergence(panels["B"], convergence)
        draw_simulation(panels["C"], ensemble, lattice)


def draw_magnifications(ax, theory):
    """P(u) at a given mean gap for a few magnifications, with the power law -1/3."""
    theory = theory.isel(hurst=0, load=0)
    for colour, magnification in zip(COLOURS, theory.magnification.values, strict=False):
        density = theory.gap_density.sel(magnification=magnification)
        low, high = between_corrections(density)
        plotting.draw_band(ax, theory.gap, low, high, colour)
        draw_variants(ax, density, state(magnification=magnification), color=colour)
    u = np.array([1e-3, 1e-1])
    plotting.draw_guide(ax, u, 0.9 * (u / u[0]) ** (-1 / 3), r"$u^{-1/3}$", (1.2e-2, 0.43))
    finish(ax, (2e-2, 3), state(hurst=theory.hurst, mean_gap=theory.mean_gap.mean()))
    plotting.add_legend(ax, *VARIANT_KEYS, loc="lower left")


def draw_variants(ax, density, label, **look):
    """P(u) by both variants of the theory."""
    lines = {"afferrante2018": "-", "almqvist2011": "--"}
    for variant, line in lines.items():
        ax.plot(density.gap, density.sel(variant=variant), line, label=label, **look)
        label = None  # one entry of the legend


def finish(ax, limits, title):
    """Axes of P(u) against the gap."""
    ax.set(xscale="log", yscale="log", xlabel=plotting.GAP, ylabel=DENSITY)
    ax.set(xlim=(1e-4, 10), ylim=limits, title=title)


def draw_convergence(ax, theory):
    """P at fixed gaps against magnification, and where u^(-1/3) would put the limits."""
    theory = theory.isel(hurst=0, load=0)
    zeta = theory.magnification
    density = theory.gap_density
    low, high = between_corrections(density)
    curves = interpolate_gaps(density.sel(variant=VARIANT))
    lows = interpolate_gaps(low)
    highs = interpolate_gaps(high)
    last = float(zeta[-1])
    # Labels stand at the ends of their curves, pushed up until neighbours differ by 15 %.
    ends = np.array(curves)[:, -1]
    steps = 1.15 ** np.arange(len(GAPS))
    heights = ends.copy()
    order = ends.argsort()
    heights[order] = np.maximum.accumulate(ends[order] / steps) * steps
    largest_power_law_gap = 0.1  # over h_rms, beyond which that power law does not hold
    reference_gap = 0.03  # over h_rms, where the power law u^(-1/3) of panel B is anchored
    for index, (colour, gap) in enumerate(plotting.shade(GAPS)):
        ax.plot(zeta, curves[index], ".-", color=colour)
        plotting.draw_band(ax, zeta, lows[index], highs[index], colour)
        ax.text(1.7 * last, heights[index], f"{gap:g}", color=colour, va="center", fontsize=8)
        if gap <= largest_power_law_gap:
            level = ends[GAPS.index(reference_gap)] * (gap / reference_gap) ** (-1 / 3)
            ax.plot([last / 30, last], [level, level], ":", color=GREY, linewidth=1.1)
    ax.set_title(state(hurst=theory.hurst, mean_gap=theory.mean_gap.mean()))
    ax.set(xscale="log", yscale="log", xlabel=plotting.MAGNIFICATION, ylabel=DENSITY)
    ax.set(xlim=(2, 3e7), ylim=(0.2, 4))
    plotting.write_ticks(ax.yaxis, [0.2, 0.3, 0.5, 1, 2, 3])
    ax.text(1.7 * last, 2.95, r"$u/h_\mathrm{rms}$", ha="center", fontsize=8)
    law = rf"$u^{{-1/3}}$ through $u/h_\mathrm{{rms}}$ = {reference_gap:g}"
    ax.legend(handles=[make_key(law, linestyle=":")], loc="upper left")


def interpolate_gaps(density):
    """Densities at every gap of panel B, along the magnification."""
    return [interpolate(density, "gap", gap).values for gap in GAPS]


def draw_simulation(ax, ensemble, lattice):
    """Simulated P(u) with its errors against theory on the spectrum of the window."""
    for colour, load in zip(COLOURS, LOADS, strict=False):
        measured = ensemble.sel(pressure=load, method="nearest")
        draw_measured(ax, measured, colour)
        theory = lattice.gap_density.sel(pressure=load, method="nearest")
        label = state(pressure=measured.pressure)
        draw_variants(ax, theory, label, color=colour, linewidth=0.9)
    case = datasets.parameters(ensemble)
    surface = state(hurst=case["hurst"], magnification=case["magnification"])
    fine = ensemble.sizes["seed"]
    coarse = ensemble.sizes.get("coarse_seed")
    count = f"{fine} fine and {coarse} coarse" if coarse else f"{fine}"
    title = f"simulation against theory on the window's spectrum, {surface}, {count} realisations"
    finish(ax, (1e-2, 20), title)
    mean = make_dot("BEM, ensemble mean", marker=".")
    below = make_dot("by the edge law", mfc="white", markersize=3)
    plotting.add_legend(ax, mean, below, *VARIANT_KEYS, loc="upper right", ncols=2)


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


if __name__ == "__main__":
    main(start(globals()))
