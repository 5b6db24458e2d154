"""Plot what each setting and each model costs, and how far it errs, for each quantity."""

from collections.abc import Callable
from dataclasses import dataclass

import pandas as pd

from common import tradeoff_table as summary
from common.job import start
from stickiness.accuracy import plan
from stickiness.accuracy.error_models import Surface, read_models
from stickiness.accuracy.settings import Problem, predicted_cost, predicted_error
from stickiness.pages import plotting
from stickiness.pages.plotting import make_key, pick_look, write_ticks
from tradeoff.presets import adhesive_cost, adhesive_error

CONTACT = {
    "area": "contact area",
    "mean_gap": "mean gap",
    "attractive_area_0.01": r"$A_\mathrm{ad}(0.01)$",
    "a_v": r"$a_V$",
    "gap_distribution": r"$P(u)$",
}
ADHESION = {
    "inverse_kappa_ad_0.0075": r"$1/\kappa_\mathrm{ad}(0.0075)$",
    "inverse_kappa_ad_0.1": r"$1/\kappa_\mathrm{ad}(0.1)$",
    "threshold": "threshold",
    "pull_off": "pull-off",
}
SETTINGS = {
    "points per wavelength": "points per shortest wavelength",
    "tolerance": "tolerance of the solver",
    "seeds": "number of random surfaces",
}
COST = r"cost [FFT pairs of $1024^2$]"
SECONDS = "processor time of a verdict [s]"
ABOVE = 4  # of texts beside markers, in points
BELOW = -10


@dataclass(frozen=True)
class Column:
    """A column of panels: its title, its quantities, and how their error and cost are predicted."""

    panels: str  # names, from above: one for each of `SETTINGS`, then one for models and presets
    title: str
    labels: dict
    error: Callable
    cost: Callable


def main(job):
    medians = summary.read(job.input.summary)
    # Along the abscissa stands the cost, or the tolerance where that is varied.
    tolerances = pd.to_numeric(medians.value, errors="coerce")
    medians["x"] = medians.cost.where(medians.setting != "tolerance", tolerances)
    models = read_models(job.input.laws)
    columns = (
        Column("ACEG", "contact", CONTACT, predicted_error, cost_of_load),
        Column("BDFH", "adhesion", ADHESION, adhesive_error, adhesive_cost),
    )
    with plotting.open_figure(job.output, "AB;CD;EF;GH;IJ", 11.9) as panels:
        for column in columns:
            draw_column(panels, column, medians, models, job.params)
        kinds = {"plain mean": "--", "with a control variate": "-"}
        keys = [make_key(text, linestyle=line) for text, line in kinds.items()]
        panels["E"].legend(handles=keys, loc="lower left", bbox_to_anchor=(0, 0.15))
        panels["F"].legend(handles=keys, loc="lower left")
        verdicts = pd.DataFrame(summary.list_verdicts(medians))
        draw_widths(panels["I"], verdicts)
        draw_pairs(panels["J"], verdicts)
        ways = [make_key(way, **pick_look(i)) for i, way in enumerate(verdicts.way.unique())]
        numbers = "verdicts (numbers: points a side; *: on fewer maps)"
        place = {"loc": "outside lower center", "title": numbers, "ncols": len(ways)}
        panels["I"].figure.legend(handles=ways, **place)


def draw_column(panels, column, medians, models, params):
    """Draw what each setting costs and how far it errs, and below the models and presets."""
    styles = {quantity: pick_look(index) for index, quantity in enumerate(column.labels)}
    rows = medians[medians.quantity.isin(column.labels)]
    smallest = 2e-5  # error that is shown
    for name, (setting, text) in zip(column.panels, SETTINGS.items(), strict=False):
        panels[name].set_title(f"{column.title}: {text}", loc="right")
        chosen = rows[(rows.setting == setting) & (rows.error > smallest)]
        draw_setting(panels[name], chosen, styles, setting)
    last = panels[column.panels[-1]]
    keys = [make_key(column.labels[name], **style) for name, style in styles.items()]
    side = "left" if column.panels[0] == "A" else "right"
    last.figure.legend(handles=keys, loc=f"outside upper {side}", title=column.title, ncols=3)

    last.set_title(f"{column.title}: model, presets", loc="right")
    keys = draw_models(last, rows[rows.setting == "model"], styles)
    problem = Problem(
        models,
        Surface.of(params.surface),
        params.presets["pressures"],
        list(column.labels),
        params.descriptor_seeds,
    )
    marks = {"draft": "v", "standard": "o", "fine": "^"}
    for name in [name for name in marks if name in params.fidelities]:
        settings = plan.preset(params.fidelities[name])
        look = {"linestyle": "", "marker": marks[name]}
        keys.append(make_key(f"simulation, {name}", **look))
        for quantity, style in styles.items():
            errors = [column.error(problem, settings, p, quantity) for p in problem.pressures]
            cost = column.cost(problem, settings)
            last.plot(cost, max(errors), color=style["color"], **look)
    finish(last, COST)
    last.legend(handles=keys, loc="lower left")


def cost_of_load(problem, settings):
    """Predicted cost of one load."""
    return predicted_cost(problem, settings) / len(problem.pressures)


def draw_setting(ax, rows, styles, setting):
    """Error against cost or tolerance; plain means are dashed beside those with a control."""
    for quantity, style in styles.items():
        curve = rows[rows.quantity == quantity].sort_values("x")
        plain = curve.value.str.endswith("plain")
        for part, line, fill in (
            (curve[plain], "--", "white"),
            (curve[~plain], "-", style["color"]),
        ):
            ax.plot(part.x, part.error, line, markerfacecolor=fill, **style)
    finish(ax, "tolerance" if setting == "tolerance" else COST)
    if setting == "points per wavelength":
        for value, part in rows.groupby("value"):
            top = part.loc[part.error.idxmax()]
            place = {"xytext": (0, 4), "textcoords": "offset points", "ha": "center", "fontsize": 7}
            ax.annotate(value, (top.cost, top.error), **place)
        ax.margins(y=0.12)


def draw_models(ax, rows, styles):
    """Error and cost of the approximate models; a line where one is free once contact is solved."""
    for row in rows.itertuples():
        colour = styles[row.quantity]["color"]
        if row.cost > 0:
            ax.plot(row.cost, row.error, "*", color=colour, markersize=8)
        else:
            ax.axhline(row.error, color=colour, linestyle=":", linewidth=1)
    if (rows.cost > 0).any():
        return [make_key("theory", linestyle="", marker="*")]
    return [make_key("DMT sum", linestyle=":")]


def draw_widths(ax, verdicts):
    """Width of the limits of verdicts, and the error of the share, against processor time."""
    draw_ways(ax, verdicts, verdicts.width, verdicts.share, (ABOVE, BELOW))
    add_keys(ax, "width of the limits", "error of the share", loc="upper left", ncols=2)
    ax.set_title("verdict: share that remains", loc="right")
    ax.set(yscale="log", ylabel=r"share of $w$, median", ylim=(2e-4, 9))
    write_ticks(ax.yaxis, (1e-3, 0.01, 0.1, 1))
    finish_seconds(ax)


def draw_pairs(ax, verdicts):
    """Pairs rightly decided, and pairs within limits, against processor time."""
    rightly = 1 - verdicts.undecided - verdicts.wrong
    draw_ways(ax, verdicts, 100 * rightly, 100 * (1 - verdicts.outside), (BELOW, BELOW))
    add_keys(ax, "rightly decided at 10 %", "within limits", loc="lower right")
    ax.set_title("verdict: pairs", loc="right")
    ax.set(ylabel="pairs [%]", ylim=(0, 110), yticks=range(0, 101, 20))
    finish_seconds(ax)


def draw_ways(ax, verdicts, full, dotted, places):
    """Two quantities of every way, with the points a side at `places` beside the first, by turns.

    Grids on fewer pairs are not comparable, and stand alone.
    """
    is_alone = verdicts.pairs < verdicts.pairs.max()
    for index, way in enumerate(verdicts.way.unique()):
        style = pick_look(index)
        is_way = verdicts.way == way
        for values, line, fill in ((full, "-", style["color"]), (dotted, ":", "white")):
            look = style | {"markerfacecolor": fill}
            curve = is_way & ~is_alone
            ax.plot(verdicts.seconds[curve], values[curve], line, **look)
            alone = is_way & is_alone
            if alone.any():
                ax.plot(verdicts.seconds[alone], values[alone], linestyle="none", **look)
        for number, row in enumerate(verdicts[is_way].itertuples()):
            text = f"{row.points}*" if is_alone[row.Index] else str(row.points)
            place = {"xytext": (0, places[number % 2]), "textcoords": "offset points"}
            at = (row.seconds, full[row.Index])
            ax.annotate(text, at, **place, ha="center", fontsize=7)


def add_keys(ax, full, dotted, **place):
    """Legend of the two quantities of every way."""
    keys = [
        make_key(full, marker="o"),
        make_key(dotted, linestyle=":", marker="o", markerfacecolor="white"),
    ]
    ax.legend(handles=keys, **place)


def finish_seconds(ax):
    """Axis of processor time."""
    ax.set(xscale="log", xlabel=SECONDS)
    ax.margins(x=0.1)
    low, high = ax.get_xlim()
    ticks = (0.1, 0.3, 1, 3, 10, 30, 100, 300)
    write_ticks(ax.xaxis, [tick for tick in ticks if low <= tick <= high] or [low, high])


def finish(ax, label):
    """Axes of error against cost or tolerance."""
    ax.set(xscale="log", yscale="log", xlabel=label, ylabel="error, covers 90 %")
    low, high = ax.get_ylim()
    error_ticks = (1e-4, 1e-3, 0.01, 0.1, 1)
    write_ticks(ax.yaxis, [tick for tick in error_ticks if low <= tick <= high])
    low, high = ax.get_xlim()
    cost_ticks = (1, 3, 10, 30, 100, 300, 1000, 3000, 10000)
    if label == COST:
        write_ticks(ax.xaxis, [tick for tick in cost_ticks if low <= tick <= high] or [low, high])


if __name__ == "__main__":
    main(start(globals()))
