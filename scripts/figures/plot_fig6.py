"""Figure 6: power spectra of real surfaces under the lines of constant C0."""

import numpy as np

from common.job import start
from common.paper import C0_LINES, HURST
from stickiness import datasets
from stickiness.pages import plotting
from stickiness.pages.plotting import BLACK, COLOURS, GREY, state

WAVE_NUMBERS = (1e2, 1e10)  # 1/m


def main(job):
    read = [datasets.read(path, ["psd", "wave_number"]) for path in job.input.surfaces]
    surfaces = zip(COLOURS, job.params.labels.values(), read, strict=False)
    with plotting.open_figure(job.output, [["spectra"]], 4.4) as panels:
        for colour, label, surface in surfaces:
            draw_surface(panels["spectra"], surface, colour, label)
        draw_lines(panels["spectra"])


def draw_surface(ax, surface, colour, label):
    """Spectrum of a surface: a band from its smooth to its rough end, or points and their fit."""
    plotting.draw_spectrum(ax, surface, colour, label)
    if "psd_fit" in surface:
        plotting.draw_assumed(ax, surface, colour)
        fit = surface.psd_fit.where(surface.fitted == 1)
        ax.plot(surface.wave_number, fit, color=BLACK, linewidth=0.9, zorder=5)


def draw_lines(ax):
    """The paper's two lines of constant C0, and the axes."""
    q = np.array(WAVE_NUMBERS)
    for c0, place, beside in zip(C0_LINES, (3e3, 1.2e2), (8, 5e-6), strict=True):
        text = rf"$C_0$ = 10$^{{{np.log10(c0):.0f}}}$ m$^{{0.4}}$"
        level = c0 * q ** (-2 * (HURST + 1))
        ax.plot(q, level, "--", color=GREY, linewidth=1.1, zorder=1)
        ax.text(place, beside * c0 * place ** (-2 * (HURST + 1)), text, color=GREY, fontsize=8)
    ax.set(xscale="log", yscale="log", xlim=WAVE_NUMBERS, title=f"lines: {state(hurst=HURST)}")
    ax.set(xlabel=r"wave number $q$ [1/m]", ylabel=r"power spectral density $C(q)$ [m$^4$]")
    ax.legend(loc="upper right")


if __name__ == "__main__":
    main(start(globals()))
