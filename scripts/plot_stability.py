"""Map of validity: what becomes of every component as each parameter goes to extremes."""

from pathlib import Path

import numpy as np
from matplotlib.patches import Patch

from _job import start
from _stability import AXES, OUTCOMES
from _style import BLACK, BLUE, ORANGE, YELLOW, canvas, save
from stickiness import datasets

COLOURS = (BLUE, YELLOW, ORANGE, BLACK)  # dark, light, dark enough to tell in grey, darkest
HATCHES = ("", "", "///", "")


def main(job):
    every = {Path(path).stem: datasets.read(path, ["outcome"]) for path in job.input.components}
    names = list(every)
    mosaic = [[f"{name}/{axis}" for axis in AXES] for name in names]
    figure, panels = canvas(mosaic, 0.72 * len(names) + 1.3, gridspec_kw={"wspace": 0.08})
    for row, (name, data) in enumerate(every.items()):
        for column, axis in enumerate(AXES):
            ax = panels[f"{name}/{axis}"]
            strip(ax, data, axis)
            if row == 0:
                ax.set_title(AXES[axis].label.replace(" ", "\n", 1), fontsize=8)
            if column == 0:
                count = data.sizes["point"]
                ax.set_ylabel(f"{name}\n{count} points", fontsize=8, rotation=0, ha="right")
                ax.yaxis.set_label_coords(-0.1, 0.3)
    present = sorted({int(k) for data in every.values() for k in data.outcome.values})
    handles = [
        Patch(facecolor=COLOURS[k], hatch=HATCHES[k], edgecolor="white", label=OUTCOMES[k])
        for k in present
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
    save(figure, job.output)


def strip(ax, data, axis):
    """Shares of the outcomes at each value of an axis, over all points that have it."""
    ax.set(yticks=[], ylim=(0, 1))
    ax.tick_params(length=0)
    for side in ax.spines.values():
        side.set_visible(False)
    if axis not in data:
        ax.set_xticks([])
        return
    values = np.unique(data[axis].values)
    place = np.arange(len(values))
    bottom = np.zeros(len(values))
    for k, (colour, hatch) in enumerate(zip(COLOURS, HATCHES, strict=True)):
        share = [float(np.mean(data.outcome.values[data[axis].values == v] == k)) for v in values]
        look = {"color": colour, "hatch": hatch, "edgecolor": "white", "linewidth": 0}
        ax.bar(place, share, 0.9, bottom=bottom, **look)
        bottom += share
    ends = [0, len(values) - 1]
    ax.set_xticks(ends, [short(values[k]) for k in ends], fontsize=7)
    ax.set_xlim(-0.6, len(values) - 0.4)


def short(value):
    """A number in few characters."""
    exponent = round(np.log10(value))
    if (exponent > 2 or exponent < -2) and np.isclose(value, 10.0**exponent):
        return rf"$10^{{{exponent}}}$"
    return f"{value:g}"


if __name__ == "__main__":
    main(start(globals(), "plot_stability"))
