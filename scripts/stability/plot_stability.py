"""Map of validity: the outcome of every component over its two parameters."""

from pathlib import Path

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

from common.job import start
from common.plotting import BLACK, BLUE, ORANGE, YELLOW, open_figure
from stability.components import LABELS
from stickiness import datasets

COLOURS = (BLUE, YELLOW, ORANGE, BLACK)  # of the outcomes, in order
COLUMNS, HEIGHT = 3, 2.1  # panels beside each other, inches of a row


def main(job):
    every = {Path(path).stem: datasets.read(path, ["outcome"]) for path in job.input.components}
    names = [*every, *["."] * (-len(every) % COLUMNS)]
    rows = [names[k : k + COLUMNS] for k in range(0, len(names), COLUMNS)]
    with open_figure(job.output, rows, HEIGHT * len(rows)) as panels:
        for name, data in every.items():
            draw_map(panels[name], data)
            panels[name].set_title(name, loc="left", fontweight="bold")
        outcomes = datasets.parameters(next(iter(every.values())))["outcomes"]
        counts = sum(np.bincount(data.outcome.values, minlength=4) for data in every.values())
        panels[names[0]].figure.legend(
            handles=[
                Patch(facecolor=colour, label=f"{outcome}: {count}")
                for colour, outcome, count in zip(COLOURS, outcomes, counts, strict=True)
            ],
            loc="outside lower center",
            ncols=len(COLOURS),
        )


def draw_map(ax, data):
    """Colour every point by its worst outcome over the variants."""
    down, across = (axis for axis in data.data_vars if axis in LABELS)
    frame = data[[down, across, "outcome"]].to_dataframe()
    worst = frame.pivot_table(index=down, columns=across, values="outcome", aggfunc="max")
    ax.imshow(worst, cmap=ListedColormap(COLOURS), vmin=0, vmax=3, origin="lower", aspect="auto")
    ax.set_xticks(range(worst.shape[1]), map(shorten, worst.columns), rotation=90, fontsize=6)
    ax.set_yticks(range(worst.shape[0]), map(shorten, worst.index), fontsize=6)
    ax.tick_params(which="both", length=0)
    ax.minorticks_off()
    ax.set_xlabel(LABELS[across], fontsize=7)
    ax.set_ylabel(LABELS[down], fontsize=7)


def shorten(value):
    """Write a number in few characters."""
    exponent = round(np.log10(value)) if value else 0
    if abs(exponent) > 2 and np.isclose(value, 10.0**exponent):
        return rf"$10^{{{exponent}}}$"
    return f"{value:g}"


if __name__ == "__main__":
    main(start(globals(), "plot_stability"))
