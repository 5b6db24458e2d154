"""Figure 10: attraction at the edges of contact, full simulation and its equivalent sphere."""

import numpy as np

from pipeline.job import start
from pipeline.numbers import number
from pipeline.pages.style import (
    BLACK,
    COLOURS,
    GREY,
    MARKERS,
    canvas,
    guide,
    letters,
    plain_ticks,
    save,
)
from stickiness.adhesion import equivalent_sphere
from stickiness.core import datasets

NEEDED = ("effect", "over_model", "over_model_total_error", "edge_strength")
LARGEST_ERROR = 0.25  # of a point that is drawn; covers 90 %
AREA_LABEL = r"attractive over contact area $A_\mathrm{ad}/A_\mathrm{rep}$"


def main(job):
    files = [datasets.read(path, NEEDED) for path in job.input.edges]
    figure, panels = canvas("AB", 3.4)
    panel_a(panels["A"], files)
    panel_b(panels["B"], files)
    letters(panels)
    save(figure, job.output)


def known(data):
    """Points with an error small enough to say something, as columns."""
    parts = (
        "attractive_over_contact",
        "edge_strength",
        "effect",
        "over_model",
        "over_model_total_error",
    )
    dims = data.effect.dims
    columns = np.array([data[name].transpose(*dims).values.ravel() for name in parts])
    return columns[:, columns[-1] < LARGEST_ERROR]


def panel_a(ax, files):
    """Weak edges: effect against the attractive area, with the closed form."""
    t = np.geomspace(0.05, 200, 200)
    ax.plot(t, equivalent_sphere.weak_effect(t), color=BLACK, label="equivalent sphere")
    small = t[t < 1.5]
    guide(ax, small, 4 / np.pi * small**-0.5, r"$(4/\pi)\,t^{-1/2}$", (0.06, 2.2))
    ax.axhline(1, color=GREY, linewidth=0.9, linestyle="--")
    ax.text(0.06, 1.04, "DMT limit", color=GREY, fontsize=8)
    for index, data in enumerate(files):
        area, strength, effect, ratio, error = known(data)
        weak = strength < equivalent_sphere.WEAK
        bars = (effect * error / ratio)[weak]
        ax.errorbar(area[weak], effect[weak], bars, label=name(data), **look(index))
    ax.set(xscale="log", yscale="log", xlabel=AREA_LABEL)
    ax.set_ylabel("attraction at equal area over DMT's")
    plain_ticks(ax.yaxis, [1, 1.5, 2, 3, 4, 5])
    ax.set_title(rf"weak edges, $\tau$ < {equivalent_sphere.WEAK:g}")
    ax.legend()


def panel_b(ax, files):
    """Simulation over model at every strength, with the error that verdicts take."""
    ends = 1e-4, equivalent_sphere.WEAK, equivalent_sphere.STRONGEST_SIMULATED
    errors = equivalent_sphere.ERROR_WEAK, equivalent_sphere.ERROR_STRONG
    for low, high, factor in zip(ends, ends[1:], errors, strict=False):
        ax.fill_between([low, high], 1 / factor, factor, color=GREY, alpha=0.2, linewidth=0)
    for index, data in enumerate(files):
        _, strength, _, ratio, error = known(data)
        ax.errorbar(strength, ratio, error, **look(index))
    ax.axhline(1, color=BLACK)
    ax.set(xscale="log", yscale="log", xlim=(ends[0], ends[-1]))
    plain_ticks(ax.yaxis, [0.6, 0.7, 0.8, 0.9, 1, 1.2, 1.4, 1.6])
    ax.set(xlabel=r"strength of the edges $\tau = l_ad/\epsilon^2$")
    ax.set_ylabel("simulation over equivalent sphere")


def look(index):
    chosen = {
        "color": COLOURS[index % len(COLOURS)],
        "marker": MARKERS[index % len(MARKERS)],
        "markersize": 3.5,
    }
    return chosen | {"linestyle": "none", "elinewidth": 0.7}


def name(data):
    made = datasets.parameters(data)
    return rf"$\zeta$ = {number(made['magnification'])}, $q_0h_\mathrm{{rms}}$ = " + number(
        made["q0_h_rms"], 2
    )


if __name__ == "__main__":
    main(start(globals(), "plot_fig10"))
