"""Figure 9: criteria compared: adhesion that each asks for, and moduli on real surfaces."""

import numpy as np

from pipeline.job import start
from pipeline.numbers import number
from pipeline.pages.style import BLACK, COLOURS, GREY, MARKERS, RED, canvas, letters, save
from stickiness.core import datasets

EDGES = "edge_adhesion"
LOOKS = {
    EDGES: ("edges of contact", RED, "-", 2.2),
    "violano": (r"derived (DMT), $a_V$ of the spectrum", BLACK, "-", 1.2),
    "violano_constant": (r"derived, constant $a_V$", BLACK, "-.", 1.2),
    "violano_printed": ("derived, 9/4 as printed", BLACK, ":", 1.2),
    "pastewka_robbins": ("Pastewka–Robbins", COLOURS[0], "--", 1.4),
    "fuller_tabor": ("Fuller–Tabor", COLOURS[2], "--", 1.4),
    "bearing_area": ("bearing area (BAM)", COLOURS[3], "-", 1.4),
    "persson_tosatti": ("Persson–Tosatti", COLOURS[4], "-.", 1.4),
    "dahlquist": ("Dahlquist", GREY, "-", 1.0),
}
LENGTH_LABEL = r"adhesion length at the threshold $l_a/\epsilon$"
LIMITS = 1e-4, 1e4


def main(job):
    compared = datasets.read(job.input.compared, ["against_roughness", "against_magnification"])
    verdicts = datasets.read(job.input.verdicts, ["threshold_by_criterion"])
    figure, panels = canvas("AB;CC", 6.8, height_ratios=[1, 1.15])
    curves(panels["A"], compared.against_roughness, r"roughness $h_\mathrm{rms}/\epsilon$")
    curves(panels["B"], compared.against_magnification, r"magnification $\zeta = q_1/q_0$")
    titled(panels, datasets.parameters(compared))
    handles, texts = panels["A"].get_legend_handles_labels()
    on_surfaces(panels["C"], verdicts)
    panels["C"].legend(handles, texts, loc="upper left", ncols=2)
    letters(panels)
    save(figure, job.output)


def curves(ax, thresholds, label):
    """Threshold of every criterion, that of the edges with its error."""
    (along,) = set(thresholds.dims) - {"criterion"}
    x = thresholds[along].values
    low, high = (thresholds.sel(criterion=f"{EDGES}_{end}") for end in ("low", "high"))
    ax.fill_between(x, low, high, color=RED, alpha=0.2, linewidth=0)
    for name, (text, colour, style, width) in LOOKS.items():
        if name in thresholds.criterion:
            y = thresholds.sel(criterion=name)
            ax.plot(x, y, color=colour, linestyle=style, linewidth=width, label=text)
    ax.set(xscale="log", yscale="log", ylim=LIMITS, xlabel=label, ylabel=LENGTH_LABEL)
    ax.text(0.03, 0.93, "sticky above", transform=ax.transAxes, color=GREY)


def titled(panels, made):
    """What is held in either panel."""
    both = rf"H = {made['hurst']:g}, $\epsilon q_0$ = {number(made['range_times_q0'])}"
    held = {
        "A": rf"$\zeta$ = {number(made['quoted_magnification'])}",
        "B": rf"$h_\mathrm{{rms}}/\epsilon$ = {number(made['quoted_h_rms_over_range'])}",
    }
    for name, text in held.items():
        place = {"transform": panels[name].transAxes, "ha": "right"}
        panels[name].text(0.97, 0.04, f"{both}\n{text}", **place)


def on_surfaces(ax, verdicts):
    """Modulus below which a material sticks, over the one by the edges, for every surface."""
    by = verdicts.threshold_by_criterion
    ratio = np.log10(by / by.sel(criterion=EDGES))
    names = [name for name in LOOKS if name in by.criterion and name not in (EDGES, "dahlquist")]
    places = np.arange(by.sizes["surface"])
    for index, name in enumerate(names):
        found = ratio.sel(criterion=name)
        middle = 10 ** found.mean(("material", "end"))
        low, high = (10 ** end(found) for end in (smallest, greatest))
        x = places + 0.09 * (index - (len(names) - 1) / 2)
        _, colour, _, _ = LOOKS[name]
        ax.vlines(x, low, high, color=colour, linewidth=1.2)
        full = name not in ("violano_constant", "violano_printed")
        look = {"markerfacecolor": colour if full else "white", "markersize": 4.5}
        ax.plot(x, middle, MARKERS[index % len(MARKERS)], color=colour, **look)
    ax.axhline(1, color=RED, linewidth=2)
    ax.set_xticks(places, [name.replace("_", "\n") for name in by.surface.values])
    ax.set(yscale="log", ylim=(1e-7, 3e7), ylabel="threshold of E* over that by the edges")


def smallest(values):
    return values.min(("material", "end"))


def greatest(values):
    return values.max(("material", "end"))


if __name__ == "__main__":
    main(start(globals(), "plot_fig9"))
