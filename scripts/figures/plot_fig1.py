"""Figure 1: distribution of gaps by Persson's theory, its convergence, and simulation."""

import numpy as np
import xarray as xr

from pipeline.conventions import VARIANT
from pipeline.job import start
from pipeline.numbers import number
from pipeline.pages.style import (
    COLOURS,
    GREY,
    VARIANT_LABELS,
    VARIANT_LINES,
    apart,
    canvas,
    guide,
    key,
    letters,
    plain_ticks,
    save,
    shades,
    total_error,
    with_model,
)
from pipeline.theory import between_corrections
from stickiness.core import datasets

GAPS = [0.003, 0.01, 0.03, 0.1, 0.3, 1.0]  # over h_rms, of panel B
LOADS = [0.0065, 0.065, 0.26]  # over E* q0 h_rms, of panel C
REFERENCE_GAP = 0.03  # where the guide u^(-1/3) of panel B is anchored
GAP_LABEL = r"gap $u/h_\mathrm{rms}$"
DENSITY_LABEL = r"probability density $h_\mathrm{rms}P(u)$"


def main(job):
    density = datasets.read(job.input.density, ["gap_density"])
    convergence = datasets.read(job.input.convergence, ["gap_density"])
    ensemble = datasets.read(job.input.ensemble, ["gap_density_mean", "edge_gap_mean"])
    lattice = datasets.read(job.input.lattice, ["gap_density"])
    figure, panels = canvas("AB;CC", 5.9, height_ratios=[1, 1.05])
    panel_a(panels["A"], density)
    panel_b(panels["B"], convergence)
    panel_c(panels["C"], ensemble, lattice)
    letters(panels)
    save(figure, job.output)


def panel_a(ax, theory):
    """P(u) at a given mean gap for a few magnifications."""
    hurst, theory = float(theory.hurst[0]), theory.isel(hurst=0, load=0)
    for colour, magnification in zip(COLOURS, theory.magnification.values, strict=False):
        density = theory.gap_density.sel(magnification=magnification)
        banded(ax, density, colour)
        for variant, line in VARIANT_LINES.items():
            curve = density.sel(variant=variant)
            ax.loglog(curve.gap, curve, line, color=colour)
        ax.plot([], [], color=colour, label=rf"$\zeta$ = {number(magnification)}")
    u = np.array([1e-3, 1e-1])
    guide(ax, u, 0.9 * (u / u[0]) ** (-1 / 3), r"$u^{-1/3}$", (1.2e-2, 0.43))
    mean = float(theory.mean_gap.mean())
    ax.set(xlabel=GAP_LABEL, ylabel=DENSITY_LABEL, xlim=(1e-4, 10), ylim=(2e-2, 3))
    ax.set_title(rf"$H$ = {hurst:g}, $\bar{{u}}/h_\mathrm{{rms}}$ = {mean:.3g}")
    handles, _ = ax.get_legend_handles_labels()
    ax.legend(handles=handles + variant_keys(), loc="lower left")


def banded(ax, density, colour):
    """Band between the corrections of the theory."""
    low, high = between_corrections(density)
    ax.fill_between(low.gap, low, high, color=colour, alpha=0.3, linewidth=0)


def variant_keys():
    return [key(linestyle=VARIANT_LINES[name], label=text) for name, text in VARIANT_LABELS.items()]


def panel_b(ax, theory):
    """P at fixed gaps against magnification, and where u^(-1/3) would put the limits."""
    hurst = float(theory.hurst[0])
    every = theory.isel(hurst=0, load=0)
    theory = every.sel(variant=VARIANT)
    limit = float(at_gap(theory, REFERENCE_GAP)[-1])
    last = float(theory.magnification[-1])
    curves = [at_gap(theory, gap) for gap in GAPS]
    labels = apart([curve[-1] for curve in curves], 1.15)
    for colour, gap, curve, label in zip(shades(len(GAPS)), GAPS, curves, labels, strict=True):
        ax.loglog(theory.magnification, curve, ".-", color=colour)
        low, high = (
            at_gap(xr.Dataset({"gap_density": end}), gap)
            for end in between_corrections(every.gap_density)
        )
        ax.fill_between(theory.magnification, low, high, color=colour, alpha=0.3, linewidth=0)
        ax.text(1.7 * last, label, f"{gap:g}", color=colour, va="center", fontsize=8)
        if gap <= 0.1:  # beyond, the power law does not hold
            level = limit * (gap / REFERENCE_GAP) ** (-1 / 3)
            ax.plot([last / 30, last], [level, level], ":", color=GREY, linewidth=1.1)
    mean = float(theory.mean_gap.mean())
    ax.set_title(rf"$H$ = {hurst:g}, $\bar{{u}}/h_\mathrm{{rms}}$ = {mean:.3g}")
    ax.set(xlabel=r"magnification $\zeta$", ylabel=DENSITY_LABEL, xlim=(2, 3e7), ylim=(0.2, 4))
    plain_ticks(ax.yaxis, [0.2, 0.3, 0.5, 1, 2, 3])
    ax.text(1.7 * last, 2.95, r"$u/h_\mathrm{rms}$", ha="center", fontsize=8)
    law = rf"$u^{{-1/3}}$ through $u/h_\mathrm{{rms}}$ = {REFERENCE_GAP:g}"
    ax.legend(handles=[key(linestyle=":", label=law)], loc="upper left")


def at_gap(theory, gap):
    """Density at a gap between those tabulated, along a power law from point to point."""
    logs = np.log(theory.gap_density).assign_coords(gap=np.log(theory.gap))
    return np.exp(logs.interp(gap=np.log(gap))).values


def panel_c(ax, ensemble, lattice):
    """Simulated P(u) with its errors against theory on the spectrum of the window."""
    for colour, load in zip(COLOURS, LOADS, strict=False):
        measured = ensemble.sel(pressure=load, method="nearest")
        simulated(ax, measured, colour)
        for variant, line in VARIANT_LINES.items():
            curve = lattice.gap_density.sel(variant=variant).sel(pressure=load, method="nearest")
            ax.plot(curve.gap, curve, line, color=colour, linewidth=0.9)
        ax.plot([], [], color=colour, label=rf"$\hat{{p}}$ = {float(measured.pressure):g}")
    made = datasets.parameters(ensemble)
    ax.set(xscale="log", yscale="log", xlabel=GAP_LABEL, ylabel=DENSITY_LABEL)
    ax.set(xlim=(1e-4, 10), ylim=(1e-2, 20))
    ax.set_title(
        rf"simulation against theory on the window's spectrum, $H$ = {made['hurst']:g}, "
        rf"$\zeta$ = {number(made['magnification'])}, {counted(ensemble)} realisations"
    )
    handles, _ = ax.get_legend_handles_labels()
    dots = key(linestyle="none", marker=".", label="BEM, ensemble mean")
    hollow = key(linestyle="none", marker="o", mfc="white", markersize=3, label="by the edge law")
    ax.legend(handles=handles + [dots, hollow, *variant_keys()], loc="upper right", ncols=2)


def counted(ensemble):
    """Number of realisations, coarse ones apart."""
    fine, coarse = ensemble.sizes["seed"], ensemble.sizes.get("coarse_seed")
    return f"{fine} fine and {coarse} coarse" if coarse else f"{fine}"


def simulated(ax, measured, colour):
    """Mean with the sampling error as a dark band and the discretisation error as a light one.

    Hollow below the gap next to the edge of contact, where the law of edges stands in for the grid.
    """
    mean = measured.gap_density_mean.where(measured.gap_density_mean > 0)
    sampling, others = with_model(measured, "gap_density_mean")
    sampling, total = np.nan_to_num(sampling), total_error(sampling, others)
    for error, strength in ((total, 0.15), (sampling, 0.3)):
        low = np.maximum(mean - error, 1e-6)  # a band down to zero has no lower end on a log axis
        ax.fill_between(mean.gap, low, mean + error, color=colour, alpha=strength, linewidth=0)
    resolved = mean.gap >= measured.edge_gap_mean
    ax.plot(mean.gap, mean.where(resolved), ".", color=colour, markersize=3.5)
    ax.plot(
        mean.gap, mean.where(~resolved), "o", color=colour, markersize=2.2, mfc="white", mew=0.5
    )


if __name__ == "__main__":
    main(start(globals(), "plot_fig1"))
