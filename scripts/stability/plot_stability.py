"""Map of validity: the outcome of every component over its two parameters."""

from pathlib import Path

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

from common.job import start
from stickiness import datasets
from stickiness.formatting import number
from stickiness.pages.plotting import BLACK, BLUE, ORANGE, YELLOW, open_figure

COLOURS = (BLUE, YELLOW, ORANGE, BLACK)  # of the outcomes, in order


def main(job):
    every = {Path(path).stem: datasets.read(path, ["outcome"]) for path in job.input.components}
    columns_of_panels = 3  # panels beside each other
    names = [*every, *["."] * (-len(every) % columns_of_panels)]
    rows = [names[k : k + columns_of_panels] for k in range(0, len(names), columns_of_panels)]
    counts = sum(np.bincount(data.outcome.values.flat, minlength=4) for data in every.values())
    height = 2.1  # inches of a row
    with open_figure(job.output, rows, height * len(rows)) as panels:
        for name, data in every.items():
            draw_map(panels[name], data.outcome)
            panels[name].set_title(name, loc="left", fontweight="bold")
        words = datasets.parameters(data)["outcomes"]
        handles = [
            Patch(facecolor=colour, label=f"{word}: {count}")
            for colour, word, count in zip(COLOURS, words, counts, strict=True)
        ]
        place = {"loc": "outside lower center", "ncols": len(COLOURS)}
        panels[names[0]].figure.legend(handles=handles, **place)


def draw_map(ax, outcome):
    """Colour every point by its worst outcome over the variants."""
    down = outcome[outcome.dims[0]]
    across = outcome[outcome.dims[1]]
    worst = outcome.max(outcome.dims[2:])
    ax.imshow(worst, cmap=ListedColormap(COLOURS), vmin=0, vmax=3, origin="lower", aspect="auto")
    columns = [number(value, 6) for value in across.values]
    rows = [number(value, 6) for value in down.values]
    ax.set_xticks(range(across.size), columns, rotation=90, fontsize=6)
    ax.set_yticks(range(down.size), rows, fontsize=6)
    ax.tick_params(which="both", length=0)
    ax.minorticks_off()
    ax.set_xlabel(across.attrs["long_name"], fontsize=7)
    ax.set_ylabel(down.attrs["long_name"], fontsize=7)


if __name__ == "__main__":
    main(start(globals()))
