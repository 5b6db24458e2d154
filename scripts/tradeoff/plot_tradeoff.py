"""Plot what each setting and each model costs, and how far it errs, for each quantity."""

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
ERROR_TICKS = (1e-4, 1e-3, 0.01, 0.1, 1)
COST_TICKS = (1, 3, 10, 30, 100, 300, 1000, 3000, 10000)
SMALLEST = 2e-5  # error that is shown
PRESET_MARKS = {"draft": "v", "standard": "o", "fine": "^"}


def main(job):
    medians, params = summary.read(job.input.summary), job.params
    tolerances = pd.to_numeric(medians.value, errors="coerce")
    medians["x"] = medians.cost.where(medians.setting != "tolerance", tolerances)
    given = read_models(job.input.laws), Surface.of(params.surface), params.presets["pressures"]
    with plotting.open_figure(job.output, "AB;CD;EF;GH", 9.5) as panels:
        for names, title, labels, error, cost in (
            ("ACEG", "contact", CONTACT, predicted_error, cost_of_load),
            ("BDFH", "adhesion", ADHESION, adhesive_error, adhesive_cost),
        ):
            styles = {quantity: pick_look(index) for index, quantity in enumerate(labels)}
            found = medians[medians.quantity.isin(labels)]
            for name, (setting, text) in zip(names, SETTINGS.items(), strict=False):
                panels[name].set_title(f"{title}: {text}", loc="right")
                chosen = found[(found.setting == setting) & (found.error > SMALLEST)]
                draw_setting(panels[name], chosen, styles, setting)
            keys = [make_key(labels[name], **style) for name, style in styles.items()]
            panels[names[1]].legend(handles=keys, loc="upper left")
            last = panels[names[-1]]
            last.set_title(f"{title}: model, presets", loc="right")
            keys = draw_models(last, found[found.setting == "model"], styles)
            problem = Problem(*given, list(labels), params.descriptor_seeds)
            for name in [name for name in PRESET_MARKS if name in params.fidelities]:
                settings = plan.preset(params.fidelities[name])
                look = {"linestyle": "", "marker": PRESET_MARKS[name]}
                keys.append(make_key(f"simulation, {name}", **look))
                for column, style in styles.items():
                    largest = max(error(problem, settings, p, column) for p in problem.pressures)
                    last.plot(cost(problem, settings), largest, color=style["color"], **look)
            finish(last, COST)
            last.legend(handles=keys, loc="lower left")
        kinds = {"plain mean": "--", "with a control variate": "-"}
        keys = [make_key(text, linestyle=line) for text, line in kinds.items()]
        panels["F"].legend(handles=keys, loc="lower left")


def cost_of_load(problem, settings):
    return predicted_cost(problem, settings) / len(problem.pressures)


def draw_setting(ax, found, styles, setting):
    """Error against cost or tolerance; plain means are dashed beside those with a control."""
    for quantity, style in styles.items():
        one = found[found.quantity == quantity].sort_values("x")
        plain = one.value.str.endswith("plain")
        for part, line, fill in ((one[plain], "--", "white"), (one[~plain], "-", style["color"])):
            ax.plot(part.x, part.error, line, markerfacecolor=fill, **style)
    finish(ax, "tolerance" if setting == "tolerance" else COST)
    if setting == "points per wavelength":
        for value, part in found.groupby("value"):
            top = part.loc[part.error.idxmax()]
            at = {"xytext": (0, 4), "textcoords": "offset points", "ha": "center", "fontsize": 7}
            ax.annotate(value, (top.cost, top.error), **at)
        ax.margins(y=0.12)


def draw_models(ax, found, styles):
    """Error and cost of the approximate models; a line where one is free once contact is solved."""
    for one in found.itertuples():
        colour = styles[one.quantity]["color"]
        if one.cost > 0:
            ax.plot(one.cost, one.error, "*", color=colour, markersize=8)
        else:
            ax.axhline(one.error, color=colour, linestyle=":", linewidth=1)
    if (found.cost > 0).any():
        return [make_key("theory", linestyle="", marker="*")]
    return [make_key("DMT sum", linestyle=":")]


def finish(ax, label):
    ax.set(xscale="log", yscale="log", xlabel=label, ylabel="error, covers 90 %")
    low, high = ax.get_ylim()
    write_ticks(ax.yaxis, [tick for tick in ERROR_TICKS if low <= tick <= high])
    low, high = ax.get_xlim()
    if label == COST:
        write_ticks(ax.xaxis, [tick for tick in COST_TICKS if low <= tick <= high] or [low, high])


if __name__ == "__main__":
    main(start(globals(), "plot_tradeoff"))
