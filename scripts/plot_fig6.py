"""Figure 6: power spectra of real surfaces under the lines of constant C0."""

import numpy as np
from _job import start
from _style import COLOURS, GREY, MARKERS, canvas, key, save
from stickiness import datasets

HURST = 0.8  # of the lines
LINES = {"1e-3": r"$C_0$ = 10$^{-3}$ m$^{0.4}$", "1e-5": r"$C_0$ = 10$^{-5}$ m$^{0.4}$"}
WAVE_NUMBERS = (1e-4, 1e10)  # 1/m
DENSITIES = (1e-38, 1e14)  # m^4


def main(job):
    surfaces = [datasets.read(path, ["psd", "wave_number"]) for path in job.input.surfaces]
    figure, panels = canvas("A", 5.0)
    ax = panels["A"]
    lines(ax)
    drawn = [surface for surface in surfaces if not is_line(surface)]
    for index, surface in enumerate(drawn):
        draw = measured if "psd_fit" in surface else parametric
        draw(ax, surface, COLOURS[index % len(COLOURS)], MARKERS[index % len(MARKERS)])
    ax.set(xscale="log", yscale="log", xlim=WAVE_NUMBERS)
    ax.set(xlabel=r"wave number $q$ [1/m]", ylabel=r"power spectral density $C(q)$ [m$^4$]")
    ax.legend(loc="lower left")
    save(figure, job.output)


def is_line(surface):
    """Whether a surface is one of the lines of constant C0, which are drawn without ends."""
    return label(surface).startswith("C0 =")


def label(surface):
    return datasets.parameters(surface)["label"]


def lines(ax):
    q = np.array(WAVE_NUMBERS)
    for c0, text in LINES.items():
        ax.plot(q, float(c0) * q ** (-2 * (HURST + 1)), "--", color=GREY, linewidth=0.9, label=text)


def parametric(ax, surface, colour, marker):
    smooth, rough = surface.psd.sel(end="smooth"), surface.psd.sel(end="rough")
    ax.fill_between(surface.wave_number, smooth, rough, color=colour, alpha=0.35, linewidth=0)
    for edge in (smooth, rough):
        ax.plot(surface.wave_number, edge, color=colour, linewidth=0.9)
    ax.plot([], [], color=colour, linewidth=4, alpha=0.6, label=label(surface))


def measured(ax, surface, colour, marker):
    """Radial averages with their sampling error, and the fit within its range."""
    psd = surface.psd.isel(end=0)
    error = np.minimum(surface.psd_standard_error, 0.99 * psd)  # a bar down to zero has no end
    look = {"color": colour, "marker": marker, "linestyle": "none", "markersize": 2.5}
    ax.errorbar(surface.wave_number, psd, [error, surface.psd_standard_error], elinewidth=0.7, **look)
    fit = surface.psd_fit.where(surface.fitted == 1)
    ax.plot(surface.wave_number, fit, color="black", linewidth=0.9, zorder=5)
    ax.plot([], [], label=label(surface), **look)


if __name__ == "__main__":
    main(start(globals(), "plot_fig6"))
