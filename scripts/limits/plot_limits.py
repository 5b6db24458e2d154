"""How far simulations lie from predictions, and the limits made of it."""

import numpy as np

from common.job import start
from stickiness import datasets
from stickiness.pages import plotting
from stickiness.pages.plotting import BLUE, GREY, RED
from stickiness.remaining.errors import SHOWN
from stickiness.remaining.trial_states import DEFAULT_SHARE

LEAST = 0.01  # error that is shown, of those that are smaller
HIGHEST = 8  # above all errors
SPREAD = 0.28  # half the width of a column of points
MOST = 200  # points of a kind that are drawn, chosen at random; numbers are those of all
ERROR = r"error of $\ln w$, or of S"


def main(job):
    names = ["kind", "required", "left_out", "needed", "limit", "distance", "share"]
    errors = datasets.read(job.input.errors, names).to_dataframe()
    errors["is_inside"] = errors.required <= errors.left_out
    of_default = np.isclose(errors.share, DEFAULT_SHARE)
    with plotting.open_figure(job.output, "AB", 3.2) as panels:
        draw_kinds(panels["A"], errors)
        draw_patches(panels["B"], errors[(errors.kind == "patch") & of_default])


def draw_kinds(ax, errors):
    """Errors of all kinds of predictions, above and below their limits."""
    rng = np.random.default_rng(1)
    for place, law in enumerate(SHOWN):
        rows = errors[errors.kind == law.kind]
        drawn = rows.sample(min(MOST, len(rows)), random_state=1)
        x = place + rng.uniform(-SPREAD, SPREAD, len(drawn))
        draw_errors(ax, x, drawn)
        low, middle, high = rows.limit.quantile([0.25, 0.5, 0.75])
        ax.bar(place, high - low, 0.8, bottom=low, color=GREY, alpha=0.35, linewidth=0)
        ax.plot([place - 0.4, place + 0.4], [middle, middle], color="black")
        ax.text(place, HIGHEST, f"{100 * rows.is_inside.mean():.0f}", ha="center", fontsize=7)
    ax.text(len(SHOWN) - 0.4, HIGHEST, " % inside", ha="left", fontsize=7)
    ax.set(yscale="log", ylim=(LEAST / 1.3, 2 * HIGHEST), ylabel=ERROR)
    ax.set_xlim(-0.7, len(SHOWN) + 2.1)
    look = {"fontsize": 7, "rotation": 40, "ha": "right", "rotation_mode": "anchor"}
    ax.set_xticks(range(len(SHOWN)), [law.label for law in SHOWN], **look)


def draw_patches(ax, rows):
    """Errors of maps against the distance of their quarters, with the limit."""
    draw_errors(ax, rows.distance, rows)
    ax.plot(rows.distance, rows.limit, ".", color="black", markersize=2, label="limit of 90 %")
    ax.set(xscale="log", yscale="log", ylim=(LEAST / 1.3, 2 * HIGHEST), ylabel=ERROR)
    ax.set_xlabel(r"rms distance of the quarters in $\ln w$")
    ax.legend(loc="upper left")


def draw_errors(ax, x, rows):
    """Errors as points; crosses where limits that other surfaces made do not hold them."""
    shown = np.maximum(rows.needed, LEAST)
    for chosen, colour, marker in ((rows.is_inside, BLUE, "o"), (~rows.is_inside, RED, "x")):
        ax.plot(x[chosen], shown[chosen], marker, color=colour, markersize=3, alpha=0.7)


if __name__ == "__main__":
    main(start(globals()))
