"""Figure 3: attractive area against range, and the prefactor a_V of its power law."""

from dataclasses import dataclass

import numpy as np
import xarray as xr

from pipeline.conventions import LOAD, VARIANT
from pipeline.job import start
from pipeline.numbers import number
from pipeline.pages.style import (
    BLACK,
    COLOURS,
    GREY,
    MARKERS,
    aside,
    canvas,
    key,
    letters,
    plain_ticks,
    points,
    save,
    shades,
    with_model,
)
from pipeline.theory import between_corrections
from stickiness import criteria
from stickiness.core import datasets

EXPONENT = 2 / 3
LARGEST_RANGE = 0.3  # over h_rms, in panels A and B
CONVERGED_A_V = 3.0  # of the paper, for the guides
WIDE_MARKER = MARKERS[3]  # of windows of several wavelengths, in panel C
RANGE_LABEL = r"$(\epsilon/h_\mathrm{rms})^{2/3}$"
AREA_LABEL = r"attractive area $A_\mathrm{ad}/A_\mathrm{nom}$"
PRESSURE_LABEL = r"pressure $p/(E^*q_0h_\mathrm{rms})$"


@dataclass(frozen=True)
class Case:
    """A simulated case: its areas, its fits of a_V and those of theory on its spectrum."""

    areas: xr.Dataset
    fit: xr.Dataset
    lattice: xr.Dataset

    @property
    def hurst(self):
        """Hurst exponent."""
        return datasets.parameters(self.areas)["hurst"]

    @property
    def magnification(self):
        """Magnification q1/q0."""
        return datasets.parameters(self.areas)["magnification"]

    @property
    def window(self):
        """Side of the window in longest wavelengths."""
        return datasets.parameters(self.areas).get("window", 1)

    @property
    def label(self):
        """Magnification and, if it holds several wavelengths, the window."""
        side = f", {number(self.window)}×{number(self.window)} waves" if self.window > 1 else ""
        return rf"$\zeta$ = {number(self.magnification)}{side}"


def main(job):
    sweeps = [datasets.read(path, ["attractive_area", "pressure"]) for path in job.input.sweeps]
    fits = [datasets.read(path, ["a_v", "window_low", "exponent"]) for path in job.input.fits]
    cases = read_cases(job.input)
    alike = [case for case in cases if case.hurst == float(sweeps[0].hurst[0])]
    figure, panels = canvas("AB;CD;EE", 8.6, height_ratios=[1, 1, 0.85])
    panel_a(panels["A"], sweeps[0], alike)
    panel_b(panels["B"], sweeps[1])
    panel_c(panels["C"], sweeps[2], fits[2], cases)
    panel_d(panels["D"], sweeps[3], fits[3], alike)
    panel_e(panels["E"], fits[0], alike)
    letters(panels)
    save(figure, job.output)


def read_cases(files):
    cases = [
        Case(
            datasets.read(areas, ["attractive_area_mean"]),
            datasets.read(fit, ["a_v_mean"]),
            datasets.read(lattice, ["a_v"]),
        )
        for areas, fit, lattice in zip(files.bem, files.bem_fits, files.lattice_fits, strict=True)
    ]
    return sorted(cases, key=lambda case: (case.hurst, case.window, case.magnification))


def panel_a(ax, theory, cases):
    """Areas at one pressure for a few magnifications, by theory and simulation."""
    hurst = float(theory.hurst[0])
    every = theory.attractive_area.isel(hurst=0, load=0)
    theory = theory.sel(variant=VARIANT).isel(hurst=0, load=0)
    pressure = float(theory.pressure[0])
    magnifications = theory.magnification.values
    for colour, magnification in zip(shades(len(magnifications)), magnifications, strict=True):
        curve = theory.attractive_area.sel(magnification=magnification)
        between(ax, curve["range"] ** EXPONENT, every.sel(magnification=magnification), colour)
        ax.plot(curve["range"] ** EXPONENT, curve, color=colour, label=number(magnification))
    for index, case in enumerate(cases):
        sideways = 0.004 * (index - 1)
        simulated_areas(ax, case, pressure, sideways, COLOURS[index], MARKERS[index])
    slope_guide(ax, pressure)
    limits(ax, 0.22)
    ax.set_title(rf"$H$ = {hurst:g}, $\hat{{p}}$ = {pressure:g}")
    lines = ax.legend(
        title=r"theory, $\zeta$ =", loc="upper left", ncols=2, alignment="left", title_fontsize=8
    )
    ax.add_artist(lines)
    law = key(linestyle=":", color=BLACK, label=rf"$a_V$ = {CONVERGED_A_V:g}")
    handles = [*case_keys(cases), law]
    ax.legend(handles=handles, loc="upper right", title="BEM", title_fontsize=8)


def between(ax, x, values, colour):
    """Band between the corrections of the theory."""
    ax.fill_between(x, *between_corrections(values), color=colour, alpha=0.3, linewidth=0)


def simulated_areas(ax, case, pressure, sideways, colour, marker):
    area = case.areas.sel(pressure=pressure, method="nearest").sel(range=slice(3e-3, LARGEST_RANGE))
    area = area.isel(range=slice(None, None, 4))
    errors = with_model(area, "attractive_area_mean")
    x = area["range"] ** EXPONENT + sideways
    points(ax, x, area.attractive_area_mean, *errors, color=colour, marker=marker)


def case_keys(cases):
    return [
        key(
            color=COLOURS[index],
            marker=MARKERS[index],
            linestyle="none",
            label=case.label,
        )
        for index, case in enumerate(cases)
    ]


def slope_guide(ax, pressure):
    """(3/2) a_V p (range/h_rms)^(2/3) for the paper's a_V."""
    x = np.array([0, LARGEST_RANGE**EXPONENT])
    ax.plot(x, 1.5 * CONVERGED_A_V * pressure * x, ":", color=BLACK, zorder=5)


def limits(ax, top):
    right = LARGEST_RANGE**EXPONENT
    ax.set(xlim=(0, right), ylim=(0, top), xlabel=RANGE_LABEL, ylabel=AREA_LABEL)


def panel_b(ax, theory):
    """Areas at one magnification for a few pressures."""
    hurst = float(theory.hurst[0])
    every = theory.attractive_area.isel(hurst=0, magnification=0)
    theory = theory.sel(variant=VARIANT).isel(hurst=0, magnification=0)
    for index, colour in enumerate(shades(theory.sizes["load"])):
        curve = theory.isel(load=index)
        x = curve["range"] ** EXPONENT
        between(ax, x, every.isel(load=index), colour)
        ax.plot(x, curve.attractive_area, color=colour, label=f"{float(curve.pressure):g}")
    limits(ax, 0.75)
    ax.set_title(rf"$H$ = {hurst:g}, $\zeta$ = {number(float(theory.magnification))}, theory")
    ax.legend(title=r"$\hat{p}$ =", loc="upper left", ncols=2, alignment="left", title_fontsize=8)


def panel_c(ax, sweep, fit, cases):
    """a_V against magnification with Pastewka and Robbins' and simulation."""
    every = fit.a_v.isel(load=0, window=0)
    fit = fit.sel(variant=VARIANT).isel(load=0)
    sweep = sweep.sel(variant=VARIANT).isel(load=0)
    for index, hurst in enumerate(fit.hurst.values):
        colour = COLOURS[index]
        curve, moments = fit.a_v.sel(hurst=hurst), sweep.sel(hurst=hurst)
        banded(ax, fit.magnification, curve, colour, "-")
        between(ax, fit.magnification, every.sel(hurst=hurst), colour)
        slope, curvature = moments.rms_slope.values, moments.rms_curvature.values
        robbins = criteria.pastewka_robbins_a_v(1.0, 1.0, slope, curvature)
        ax.plot(fit.magnification, robbins, "--", color=colour, linewidth=0.9)
        for case in cases:
            if case.hurst == hurst:
                x = aside(case.magnification, 2 * (index - 1))
                marker = WIDE_MARKER if case.window > 1 else MARKERS[index]
                case_points(ax, case, x, LOAD, colour, marker)
        ax.plot([], [], color=colour, marker=MARKERS[index], label=f"$H$ = {hurst:g}")
    ax.set(xscale="log", yscale="log", ylim=(0.6, 400))
    ax.set(xlabel=r"magnification $\zeta$", ylabel=r"$a_V$")
    ax.set_title(rf"$\hat{{p}}$ = {float(sweep.pressure[0, 0]):g}")
    handles, _ = ax.get_legend_handles_labels()
    pastewka = key(linestyle="--", label="Pastewka & Robbins")
    ax.legend(handles=[*handles, key(label="theory"), *point_keys(), pastewka], loc="upper left")


def point_keys():
    return [
        key(linestyle="none", marker="o", label="BEM"),
        key(linestyle="none", marker=WIDE_MARKER, label="BEM, wide window"),
        key(linestyle="none", marker="o", mfc="white", label="theory, window's spectrum"),
    ]


def banded(ax, x, a_v, colour, line):
    """a_V in the window quoted, and a band over all windows of the fit."""
    ax.fill_between(x, a_v.min("window"), a_v.max("window"), color=colour, alpha=0.2, linewidth=0)
    ax.plot(x, a_v.isel(window=0), line, color=colour)


def case_points(ax, case, x, pressure, colour, marker):
    """a_V of a case at a pressure, or at all if it is None, with theory on its spectrum."""
    fit, lattice = case.fit.isel(window=0), case.lattice.isel(window=0).sel(variant=VARIANT)
    if pressure is not None:
        fit = fit.sel(pressure=[pressure], method="nearest")
        lattice = lattice.sel(pressure=[pressure], method="nearest")
    x = np.broadcast_to(x, fit.pressure.shape)
    look = {"color": colour, "marker": marker}
    ax.plot(x, lattice.a_v, linestyle="none", **look, mfc="white", zorder=3.5)
    points(ax, x, fit.a_v_mean, *with_model(fit, "a_v_mean"), **look)


def panel_d(ax, sweep, fit, cases):
    """a_V against pressure."""
    hurst = float(sweep.hurst[0])
    sweep = sweep.sel(variant=VARIANT).isel(hurst=0, magnification=0)
    every = fit.a_v.isel(hurst=0, magnification=0)
    banded(ax, sweep.pressure, every.sel(variant=VARIANT), GREY, "-")
    between(ax, sweep.pressure, every.isel(window=0), GREY)
    for index, case in enumerate(cases):
        case_points(
            ax, case, aside(case.fit.pressure, index - 1), None, COLOURS[index], MARKERS[index]
        )
    ax.set(xscale="log", yscale="log", ylim=(0.8, 25), xlabel=PRESSURE_LABEL, ylabel=r"$a_V$")
    plain_ticks(ax.yaxis, [1, 2, 3, 5, 10, 20])
    ax.set_title(rf"$H$ = {hurst:g}")
    theory = key(label=rf"theory, $\zeta$ = {number(float(sweep.magnification))}")
    ax.legend(handles=[theory, *case_keys(cases), point_keys()[-1]], loc="upper right")


def panel_e(ax, fit, cases):
    """Local exponent of the attractive area against the range."""
    every = fit.exponent.isel(hurst=0, load=0)
    hurst, magnifications = float(fit.hurst[0]), fit.magnification.values
    for colour, magnification in zip(shades(len(magnifications)), magnifications, strict=True):
        curve = every.sel(magnification=magnification)
        between(ax, curve["range"], curve, colour)
        ax.semilogx(curve["range"], curve.sel(variant=VARIANT), color=colour)
    for index, case in enumerate(cases):
        exponent = case.fit.exponent.sel(pressure=LOAD, method="nearest")
        exponent = exponent.isel(range=slice(None, None, 2))
        look = {"color": COLOURS[index], "marker": MARKERS[index], "linestyle": "none"}
        ax.plot(exponent["range"], exponent, **look, markersize=3)
    for x, level, text in (
        (6, EXPONENT, "2/3: edges"),
        (0.05, (1 - hurst) / hurst, r"$(1-H)/H$: fractal"),
    ):
        ax.axhline(level, color=BLACK, linestyle=":", linewidth=0.9)
        ax.text(x, level + 0.015, text, ha="center", fontsize=8)
    ax.set(xlim=(1e-4, 10), ylim=(0, 1.3), xlabel=r"range $\epsilon/h_\mathrm{rms}$")
    ax.set_ylabel(r"$\mathrm{d}\ln A_\mathrm{ad}/\mathrm{d}\ln\epsilon$")
    ax.legend(handles=case_keys(cases), loc="upper left", title="BEM", title_fontsize=8)
    ax.set_title(rf"$H$ = {hurst:g}, $\hat{{p}}$ = {LOAD:g}, theory as in A")


if __name__ == "__main__":
    main(start(globals(), "plot_fig3"))
