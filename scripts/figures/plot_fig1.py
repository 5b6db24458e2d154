"""Figure 1: distribution of gaps by Persson's theory and its convergence."""

import numpy as np

from common.conventions import VARIANT
from common.job import start
from common.theory_variants import between_corrections
from figures.theory_curves import DENSITY, VARIANT_KEYS, draw_variants, dress_density
from stickiness import datasets
from stickiness.pages import plotting
from stickiness.pages.plotting import COLOURS, GREY, interpolate, make_key, state

GAPS = [0.003, 0.01, 0.03, 0.1, 0.3, 1.0]  # over h_rms, of panel B


def main(job):
    density = datasets.read(job.input.density, ["gap_density"])
    convergence = datasets.read(job.input.convergence, ["gap_density"])
    with plotting.open_figure(job.output, "AB", 3.3) as panels:
        draw_magnifications(panels["A"], density)
        draw_convergence(panels["B"], convergence)


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
    dress_density(ax, (2e-2, 3), state(hurst=theory.hurst, mean_gap=theory.mean_gap.mean()))
    plotting.add_legend(ax, *VARIANT_KEYS, loc="lower left")


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


if __name__ == "__main__":
    main(start(globals()))
