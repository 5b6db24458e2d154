"""Plot what each setting and each model costs, and how far it errs, for each quantity."""

from collections.abc import Callable
from dataclasses import dataclass

import pandas as pd

from common import plotting
from common import tradeoff_table as summary
from common.job import start
from common.plotting import make_key, pick_look, write_ticks
from stickiness.accuracy import plan
from stickiness.accuracy.error_models import Surface, read_models
from stickiness.accuracy.settings import Problem, predicted_cost, predicted_error
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
    with plotting.open_figure(job.output, "AB;CD;EF;GH", 9.5) as panels:
        for column in columns:
            draw_column(panels, column, medians, models, job.params)
        kinds = {"plain mean": "--", "with a control variate": "-"}
        keys = [make_key(text, linestyle=line) for text, line in kinds.items()]
        panels["F"].legend(handles=keys, loc="lower left")


def draw_column(panels, column, medians, models, params):
    """Draw what each setting costs and how far it errs, and below the models and presets."""
    styles = {quantity: pick_look(index) for index, quantity in enumerate(column.labels)}
    rows = medians[medians.quantity.isin(column.labels)]
    smallest = 2e-5  # error that is shown
    for name, (setting, text) in zip(column.panels, SETTINGS.items(), strict=False):
        panels[name].set_title(f"{column.title}: {text}", loc="right")
        chosen = rows[(rows.setting == setting) & (rows.error > smallest)]
        draw_setting(panels[name], chosen, styles, setting)
    keys = [make_key(column.labels[name], **style) for name, style in styles.items()]
    panels[column.panels[1]].legend(handles=keys, loc="upper left")

    last = panels[column.panels[-1]]
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
