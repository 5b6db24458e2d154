"""How far simulations lie from predictions, and the limits made of it."""

import numpy as np

from common.job import start
from stickiness import datasets
from stickiness.pages import plotting
from stickiness.pages.plotting import BLUE, GREY, RED
from stickiness.remaining.errors import SHOWN

LEAST = 0.01  # error of ln w that is shown, of those that are smaller
HIGHEST = 8  # above all errors
SPREAD = 0.28  # half the width of a column of points
MOST = 200  # points of a kind that are drawn, chosen at random; numbers are those of all
ERROR = r"error of $\ln w$"


def main(job):
    errors = datasets.read(job.input.errors, ["kind", "role", "needed", "limit", "weight"])
    unseen = errors.to_dataframe().query("role == 'unseen'")
    with plotting.open_figure(job.output, "AB", 3.2) as panels:
        draw_kinds(panels["A"], unseen)
        draw_patches(panels["B"], unseen[unseen.kind == "patch"])


def draw_kinds(ax, unseen):
    """Errors of all kinds of predictions, above and below their limits."""
    rng = np.random.default_rng(1)
    for place, law in enumerate(SHOWN):
        rows = unseen[unseen.kind == law.kind]
        is_inside = rows.needed <= rows.limit
        drawn = rows.sample(min(MOST, len(rows)), random_state=1)
        x = place + rng.uniform(-SPREAD, SPREAD, len(drawn))
        draw_errors(ax, x, drawn.needed, drawn.needed <= drawn.limit)
        low, middle, high = np.quantile(rows.limit, (0.25, 0.5, 0.75))
        ax.bar(place, high - low, 0.8, bottom=low, color=GREY, alpha=0.35, linewidth=0)
        ax.plot([place - 0.4, place + 0.4], [middle, middle], color="black")
        ax.text(place, HIGHEST, f"{100 * is_inside.mean():.0f}", ha="center", fontsize=7)
    ax.text(len(SHOWN) - 0.4, HIGHEST, " % inside", ha="left", fontsize=7)
    ax.set(yscale="log", ylim=(LEAST / 1.3, 2 * HIGHEST), ylabel=ERROR)
    ax.set_xlim(-0.7, len(SHOWN) + 2.1)
    look = {"fontsize": 7, "rotation": 40, "ha": "right", "rotation_mode": "anchor"}
    ax.set_xticks(range(len(SHOWN)), [law.label for law in SHOWN], **look)


def draw_patches(ax, rows):
    """Errors of maps against the distance of their quarters, with the limit."""
    draw_errors(ax, rows.weight, rows.needed, rows.needed <= rows.limit)
    order = np.argsort(rows.weight)
    ax.plot(rows.weight.iloc[order], rows.limit.iloc[order], color="black", label="limit of 90 %")
    ax.set(xscale="log", yscale="log", ylim=(LEAST / 1.3, 2 * HIGHEST), ylabel=ERROR)
    ax.set_xlabel(r"rms distance of the quarters in $\ln w$")
    ax.legend(loc="upper left")


def draw_errors(ax, x, errors, is_inside):
    """Errors as points, filled where the limits hold them."""
    shown = np.maximum(errors, LEAST)
    for chosen, colour, marker in ((is_inside, BLUE, "o"), (~is_inside, RED, "x")):
        ax.plot(x[chosen], shown[chosen], marker, color=colour, markersize=3, alpha=0.7)


if __name__ == "__main__":
    main(start(globals()))
