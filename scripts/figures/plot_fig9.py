"""Figure 9: criteria compared: adhesion that each asks for, and moduli on real surfaces."""

import textwrap
from dataclasses import dataclass

import numpy as np

from common.job import start
from stickiness import datasets
from stickiness.criteria.registry import CRITERIA, EDGES, FULL_CONTACT, REMAINING
from stickiness.formatting import number
from stickiness.pages import plotting
from stickiness.pages.plotting import GREY, RED, make_key


@dataclass(frozen=True)
class Line:
    """Line of a criterion, and its symbols."""

    colour: str = "GREY"  #: name in the palette
    style: str = "-"  #: as matplotlib has it
    width: float = 1.4  #: [pt]
    filled: bool = True  #: whether its symbols are


LINES = {
    REMAINING: Line("RED", "-", 2.2),
    EDGES: Line("RED", "--", 1.2, filled=False),
    "violano": Line("BLACK", "-", 1.2),
    "violano_constant": Line("BLACK", "-.", 1.2, filled=False),
    "violano_printed": Line("BLACK", ":", 1.2, filled=False),
    "pastewka_robbins": Line("BLUE", "--"),
    "fuller_tabor": Line("GREEN", "--"),
    "bearing_area": Line("ORANGE", "-"),
    FULL_CONTACT: Line("PURPLE", "-."),
}


def find_line(criterion):
    """Line of a criterion; grey of one that has no own."""
    return LINES.get(criterion.name, Line())


def main(job):
    compared = datasets.read(job.input.compared, ["against_roughness", "against_magnification"])
    verdicts = datasets.read(job.input.verdicts, ["threshold_by_criterion"])
    parameters = datasets.parameters(compared)
    zeta = rf"$\zeta$ = {number(parameters['quoted_magnification'])}"
    height = rf"$h_\mathrm{{rms}}/\epsilon$ = {number(parameters['quoted_h_rms_over_range'])}"
    with plotting.open_figure(job.output, "AB;CC", 6.8, height_ratios=[1, 1.15]) as panels:
        for panel, name, fixed in (("A", "roughness", zeta), ("B", "magnification", height)):
            limits = compared[f"remaining_against_{name}"]
            thresholds = compared[f"against_{name}"]
            draw_thresholds(panels[panel], thresholds, limits, parameters, fixed)
        panels["A"].set_xlabel(r"roughness $h_\mathrm{rms}/\epsilon$")
        panels["B"].set_xlabel(r"magnification $\zeta = q_1/q_0$")
        draw_surfaces(panels["C"], verdicts, job.params.labels)


def draw_thresholds(ax, thresholds, limits, parameters, fixed):
    """Threshold of every criterion, the verdict's with its limits; `fixed` is what is held."""
    (along,) = set(thresholds.dims) - {"criterion"}
    x = thresholds[along].values
    plotting.draw_band(ax, x, limits.sel(limit="low"), limits.sel(limit="high"), RED, alpha=0.2)
    for criterion in select_criteria(thresholds):
        ax.plot(x, thresholds.sel(criterion=criterion.name), **look_of(criterion))
    label = r"adhesion length at the threshold $l_a/\epsilon$"
    ax.set(xscale="log", yscale="log", ylim=(1e-4, 1e4), ylabel=label)
    ax.text(0.03, 0.93, "sticky above", transform=ax.transAxes, color=GREY)
    both = (
        rf"$H$ = {parameters['hurst']:g}, $\epsilon q_0$ = {number(parameters['range_times_q0'])}"
    )
    ax.text(0.97, 0.04, f"{both}\n{fixed}", transform=ax.transAxes, ha="right")


def select_criteria(thresholds):
    """Criteria with a line: those that know an adhesion length."""
    names = set(map(str, thresholds.criterion.values))
    return [c for c in CRITERIA.values() if c.has_length and c.name in names]


def look_of(criterion):
    """Colour, style, width and label of the line of a criterion."""
    line = find_line(criterion)
    label = criterion.label.replace("a_V", "$a_V$")
    look = {"color": getattr(plotting, line.colour), "label": label}
    return look | {"linestyle": line.style, "linewidth": line.width}


def draw_surfaces(ax, verdicts, labels):
    """Modulus below which a material sticks, over the one of the verdict, for every surface."""
    # Without surfaces that are not judged.
    by = verdicts.threshold_by_criterion.dropna("surface", how="all")
    ratio = np.log10(by / by.sel(criterion=REMAINING))
    others = [criterion for criterion in select_criteria(by) if criterion.name != REMAINING]
    places = np.arange(by.sizes["surface"])
    keys = [make_key(**look_of(CRITERIA[REMAINING]))]
    for index, criterion in enumerate(others):
        ratios = ratio.sel(criterion=criterion.name)
        middle = 10 ** ratios.mean(("material", "end"))
        low = 10 ** ratios.min(("material", "end"))
        high = 10 ** ratios.max(("material", "end"))
        x = places + 0.09 * (index - (len(others) - 1) / 2)
        look = look_of(criterion)
        marker = plotting.pick_look(index)["marker"]
        mark = {"marker": marker, "mfc": look["color"] if find_line(criterion).filled else "white"}
        ax.vlines(x, low, high, color=look["color"], linewidth=1.2)
        ax.plot(x, middle, color=look["color"], linestyle="none", markersize=4.5, **mark)
        keys.append(make_key(**look, **mark))
    ax.axhline(1, color=RED, linewidth=2)
    names = [labels[name] for name in by.surface.values]
    ax.set_xticks(places, [textwrap.fill(n, 12, break_long_words=False) for n in names])
    ax.set(yscale="log", ylim=(1e-5, 3e8), ylabel="threshold of E* over that of the verdict")
    ax.legend(handles=keys, loc="upper left", ncols=2, handlelength=2.6)


if __name__ == "__main__":
    main(start(globals()))
