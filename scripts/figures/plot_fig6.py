"""Figure 6: power spectra of real surfaces under the lines of constant C0."""

import numpy as np

from common import plotting
from common.job import start
from common.plotting import BLACK, COLOURS, GREY
from stickiness import datasets

HURST = 0.8  # of the lines
EXPONENT = 2 * (HURST + 1)
WAVE_NUMBERS = (1e1, 1e10)  # 1/m


def main(job):
    read = [datasets.read(path, ["psd", "wave_number"]) for path in job.input.surfaces]
    surfaces = list(zip(job.params.labels.values(), read, strict=True))
    ratios = [1.25, 1]
    with plotting.open_figure(job.output, "A;B", 7.2, sharex=True, height_ratios=ratios) as panels:
        draw_spectra(panels["A"], surfaces, 0)
        draw_spectra(panels["B"], surfaces, EXPONENT)
        panels["A"].set_ylabel(r"power spectral density $C(q)$ [m$^4$]")
        panels["A"].legend(loc="upper right")
        unit = f"m$^{{{4 - EXPONENT:g}}}$"
        panels["B"].set_ylabel(rf"compensated, $C(q)\,q^{{{EXPONENT:g}}}$ [{unit}]")
        panels["B"].set_xlabel(r"wave number $q$ [1/m]")


def draw_spectra(ax, surfaces, power):
    """All spectra times q to a power, so that the lines are steep (0) or level (2 H + 2)."""
    for index, (label, surface) in enumerate(surfaces):
        colour = COLOURS[index % len(COLOURS)]
        plotting.draw_spectrum(ax, surface, colour, label, power)
        if "psd_measurement" in surface:
            draw_measurements(ax, surface, colour, power)
        if "psd_fit" in surface:
            plotting.draw_assumed(ax, surface, colour, power)
            fit = surface.psd_fit.where(surface.fitted == 1) * surface.wave_number**power
            ax.plot(surface.wave_number, fit, color=BLACK, linewidth=0.9, zorder=5)
    ax.set(xscale="log", yscale="log", xlim=WAVE_NUMBERS)
    q = np.array(WAVE_NUMBERS)
    grey = {"color": GREY, "fontsize": 8}
    lines = {1e-3: r"$C_0$ = 10$^{-3}$ m$^{0.4}$", 1e-5: r"$C_0$ = 10$^{-5}$ m$^{0.4}$"}
    for c0, text in lines.items():
        ax.plot(q, c0 * q ** (power - EXPONENT), "--", color=GREY, linewidth=0.9, zorder=1)
        if power:
            ax.text(1.3 * q[0], 0.8 * c0, text, va="top", **grey)
    if not power:
        upper, lower = lines
        ax.text(100, upper * 60**-EXPONENT, lines[upper], va="bottom", **grey)
        ax.text(12, lower * 200**-EXPONENT, lines[lower], va="top", **grey)


def draw_measurements(ax, surface, colour, power):
    """Open points of every measurement of a surface, with its name."""
    levels = surface.psd_measurement * surface.wave_number_measured**power
    names = plotting.name_measurements(surface)
    for name, used, level, marker in zip(names, surface.is_used, levels, "^sD", strict=False):
        text = f"   {name}" if used else f"   {name} (not used)"
        look = {"color": colour, "markersize": 3.5, "label": text}
        points = {"elinewidth": 0.0, "linestyle": "none", "marker": marker, "mfc": "white"}
        ax.errorbar(level.wave_number_measured, level, 0 * level, **points, **look)


if __name__ == "__main__":
    main(start(globals()))
