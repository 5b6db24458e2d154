"""Map of validity: what becomes of every component as each parameter goes to extremes."""

from pathlib import Path

import numpy as np
from matplotlib.patches import Patch

from common.job import start
from common.plotting import BLACK, BLUE, ORANGE, YELLOW, open_figure
from stickiness import datasets

LABELS = {
    "magnification": "magnification",
    "hurst": "Hurst",
    "pressure": "load",
    "range_over_h_rms": "range",
    "adhesion_length_over_range": "adhesion",
    "q0_h_rms": "roughness",
    "thickness": "thickness",
    "poisson": "Poisson",
    "modulus_ratio": "backing",
    "anisotropy": "anisotropy",
    "unit": "unit",
    "grid": "grid",
    "frequency": "rate",
}
OUTCOMES = ((BLUE, ""), (YELLOW, ""), (ORANGE, "///"), (BLACK, ""))  # colour and hatch, in order
ROW_HEIGHT = 0.5  # inches
SMALL = 6.5  # points, of labels in rows that are full


def main(job):
    every = {Path(path).stem: datasets.read(path, ["outcome"]) for path in job.input.components}
    axes = {name: [axis for axis in LABELS if axis in data] for name, data in every.items()}
    most = max(map(len, axes.values()))
    mosaic = [
        [f"{name}/{axis}" for axis in own] + ["."] * (most - len(own)) for name, own in axes.items()
    ]
    with open_figure(job.output, mosaic, ROW_HEIGHT * len(every) + 0.4) as panels:
        for name, data in every.items():
            for axis in axes[name]:
                draw_strip(panels[f"{name}/{axis}"], data, axis)
            first = panels[f"{name}/{axes[name][0]}"]
            look = {"rotation": 0, "ha": "right", "va": "center"}
            first.set_ylabel(f"{name}\n{data.sizes['point']} points", **look)
        place = {"loc": "outside lower center", "ncols": len(OUTCOMES)}
        first.figure.legend(handles=outcome_keys(every.values()), **place)


def draw_strip(ax, data, axis):
    """Shares of the outcomes at each value of an axis, over all points that have it."""
    ax.set(yticks=[], ylim=(0, 1))
    ax.set_title(LABELS[axis], fontsize=SMALL, pad=2.5)
    ax.tick_params(length=0, labelsize=SMALL, pad=1)
    for side in ax.spines.values():
        side.set_visible(False)
    values = np.unique(data[axis].values)
    place, bottom = np.arange(len(values)), np.zeros(len(values))
    here = data[axis].values == values[:, None]
    for outcome, (colour, hatch) in enumerate(OUTCOMES):
        share = (here & (data.outcome.values == outcome)).sum(1) / here.sum(1)
        look = {"facecolor": colour, "hatch": hatch, "edgecolor": "white", "linewidth": 0}
        ax.bar(place, share, 0.9, bottom=bottom, **look)
        bottom += share
    ends = [0, len(values) - 1]
    ax.set_xticks(ends, [shorten(values[end]) for end in ends])
    ax.set_xlim(-0.6, len(values) - 0.4)


def outcome_keys(every):
    """Legend of all outcomes with how many points have each."""
    every = list(every)
    names = datasets.parameters(every[0])["outcomes"]
    counts = [sum(int((data.outcome == k).sum()) for data in every) for k in range(len(names))]
    return [
        Patch(facecolor=colour, hatch=hatch, edgecolor="white", label=f"{name}: {count}")
        for (colour, hatch), name, count in zip(OUTCOMES, names, counts, strict=True)
    ]


def shorten(value):
    """A number in few characters."""
    exponent = round(np.log10(value)) if value else 0
    if abs(exponent) > 2 and np.isclose(value, 10.0**exponent):
        return rf"$10^{{{exponent}}}$"
    return f"{value:g}"


if __name__ == "__main__":
    main(start(globals(), "plot_stability"))
