"""Figure 9: criteria compared: adhesion that each asks for, and moduli on real surfaces."""

import numpy as np

from pipeline.job import start
from pipeline.numbers import number
from pipeline.pages import style
from pipeline.pages.style import GREY, MARKERS, RED, canvas, letters, save
from stickiness.core import datasets
from stickiness.criteria.registry import CRITERIA, EDGES

LENGTH_LABEL = r"adhesion length at the threshold $l_a/\epsilon$"
LIMITS = 1e-4, 1e4


def main(job):
    compared = datasets.read(job.input.compared, ["against_roughness", "against_magnification"])
    verdicts = datasets.read(job.input.verdicts, ["threshold_by_criterion"])
    figure, panels = canvas("AB;CC", 6.8, height_ratios=[1, 1.15])
    curves(panels["A"], compared.against_roughness, r"roughness $h_\mathrm{rms}/\epsilon$")
    curves(panels["B"], compared.against_magnification, r"magnification $\zeta = q_1/q_0$")
    add_titles(panels, datasets.parameters(compared))
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
    for criterion in drawn(thresholds):
        line, label = criterion.line, criterion.label.replace("a_V", "$a_V$")
        look = {"color": colour_of(criterion), "linestyle": line.style, "linewidth": line.width}
        ax.plot(x, thresholds.sel(criterion=criterion.name), label=label, **look)
    ax.set(xscale="log", yscale="log", ylim=LIMITS, xlabel=label, ylabel=LENGTH_LABEL)
    ax.text(0.03, 0.93, "sticky above", transform=ax.transAxes, color=GREY)


def drawn(thresholds):
    """Criteria with a line: those that know an adhesion length."""
    names = set(map(str, thresholds.criterion.values))
    return [c for c in CRITERIA.values() if c.has_length and c.name in names]


def colour_of(criterion):
    return getattr(style, criterion.line.colour.upper())


def add_titles(panels, made):
    """State what is held fixed in either panel."""
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
    others = [criterion for criterion in drawn(by) if criterion.name != EDGES]
    places = np.arange(by.sizes["surface"])
    for index, criterion in enumerate(others):
        found = ratio.sel(criterion=criterion.name)
        middle = 10 ** found.mean(("material", "end"))
        low, high = (10 ** end(("material", "end")) for end in (found.min, found.max))
        x = places + 0.09 * (index - (len(others) - 1) / 2)
        colour = colour_of(criterion)
        ax.vlines(x, low, high, color=colour, linewidth=1.2)
        face = colour if criterion.line.filled else "white"
        look = {"markerfacecolor": face, "markersize": 4.5}
        ax.plot(x, middle, MARKERS[index % len(MARKERS)], color=colour, **look)
    ax.axhline(1, color=RED, linewidth=2)
    ax.set_xticks(places, [name.replace("_", "\n") for name in by.surface.values])
    ax.set(yscale="log", ylim=(1e-7, 3e7), ylabel="threshold of E* over that by the edges")


if __name__ == "__main__":
    main(start(globals(), "plot_fig9"))
