"""Plot what each setting and each model costs, and how far it errs, for each quantity."""

import numpy as np

from common import plotting
from common.job import start
from common.plotting import COLOURS, MARKERS, write_ticks
from stickiness.accuracy import plan
from stickiness.accuracy.error_models import Surface, read_models
from stickiness.accuracy.prediction import Problem, predicted_cost, predicted_error
from stickiness.accuracy.settings import adhesive_cost, adhesive_error
from tradeoff import summary

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
COST = r"cost [FFT pairs of $1024^2$]"
ERROR = "error, covers 90 %"
ERROR_TICKS = (1e-4, 1e-3, 0.01, 0.1, 1)
COST_TICKS = (1, 3, 10, 30, 100, 300, 1000, 3000, 10000)
SMALLEST = 2e-5  # error that is shown
PRESET_MARKS = {"draft": "v", "standard": "o", "fine": "^"}


def main(job):
    medians, models = summary.read(job.input.summary), read_models(job.input.laws)
    is_contact = medians.problem == "contact"
    where = models, Surface.of(job.params.surface), job.params.presets["pressures"]
    presets = {
        name: plan.preset(job.params.fidelities[name])
        for name in PRESET_MARKS
        if name in job.params.fidelities
    }
    with plotting.open_figure(job.output, "AB;CD;EF;GH", 9.5) as panels:
        for names, title, found, shown, error, cost in (
            ("ACEG", "contact", medians[is_contact], CONTACT, predicted_error, cost_of_one_load),
            ("BDFH", "adhesion", medians[~is_contact], ADHESION, adhesive_error, adhesive_cost),
        ):
            grids, tolerances, seeds, choices = (panels[name] for name in names)
            draw_grids(grids, found, shown)
            draw_tolerances(tolerances, found, shown)
            draw_seeds(seeds, found, shown)
            problem = Problem(*where, list(shown), job.params.descriptor_seeds)
            draw_models(choices, found, problem, presets, error, cost)
            for ax, setting in (
                (grids, "points per shortest wavelength"),
                (tolerances, "tolerance of the solver"),
                (seeds, "number of random surfaces"),
                (choices, "model, presets"),
            ):
                ax.set_title(f"{title}: {setting}", loc="right")


def cost_of_one_load(problem, settings):
    return predicted_cost(problem, settings) / len(problem.pressures)


def draw_grids(ax, found, shown):
    """Error against cost, the points per wavelength written beside the largest error."""
    chosen = found[(found.setting == "points per wavelength") & (found.error > SMALLEST)]
    for colour, marker, (quantity, label) in zip(COLOURS, MARKERS, shown.items(), strict=False):
        one = chosen[chosen.quantity == quantity].sort_values("cost")
        ax.plot(one.cost, one.error, marker=marker, color=colour, label=label)
    for value, part in chosen[chosen.quantity.isin(shown)].groupby("value"):
        top = part.loc[part.error.idxmax()]
        at = {"xytext": (0, 4), "textcoords": "offset points", "ha": "center", "fontsize": 7}
        ax.annotate(value, (top.cost, top.error), **at)
    finish(ax)
    ax.margins(y=0.12)
    ax.legend(loc="lower left" if "area" in shown else "lower right")


def draw_tolerances(ax, found, shown):
    """Error against the tolerance, which hardly changes the cost."""
    chosen = found[(found.setting == "tolerance") & (found.error > SMALLEST)]
    for colour, marker, quantity in zip(COLOURS, MARKERS, shown, strict=False):
        one = chosen[chosen.quantity == quantity]
        one = one.iloc[np.argsort(one.value.astype(float))]
        ax.plot(one.value.astype(float), one.error, marker=marker, color=colour)
    ax.set(xscale="log", yscale="log", xlabel="tolerance", ylabel=ERROR)


def draw_seeds(ax, found, shown):
    """Error of means against cost, plain (dashed) and with a control variate."""
    chosen = found[found.setting == "seeds"]
    for colour, marker, quantity in zip(COLOURS, MARKERS, shown, strict=False):
        one = chosen[chosen.quantity == quantity].sort_values("cost")
        plain = one.value.str.endswith("plain")
        for line, part, fill in (("--", one[plain], "white"), ("-", one[~plain], colour)):
            look = {"marker": marker, "color": colour, "markerfacecolor": fill}
            ax.plot(part.cost, part.error, line, **look)
    finish(ax)
    kinds = {"plain mean": "--", "with a control variate": "-"}
    ax.legend(
        handles=[plotting.make_key(text, linestyle=line) for text, line in kinds.items()],
        loc="lower left",
    )


def draw_models(ax, found, problem, presets, error, cost):
    """Error and cost of the approximate model, and of simulations with each preset."""
    approximate = found[found.setting == "model"].set_index("quantity")
    for colour, quantity in zip(COLOURS, problem.columns, strict=False):
        if quantity in approximate.index:
            one = approximate.loc[quantity]
            if one.cost > 0:
                ax.plot(one.cost, one.error, "*", color=colour, markersize=8)
            else:  # free once the contact without adhesion is solved
                ax.axhline(one.error, color=colour, linestyle=":", linewidth=1)
        for name, mark in PRESET_MARKS.items():
            if name in presets:
                settings = presets[name]
                worst = max(error(problem, settings, p, quantity) for p in problem.pressures)
                ax.plot(cost(problem, settings), worst, mark, color=colour)
    finish(ax)
    label = approximate.value.iloc[0]
    free = {"linestyle": ":"} if label == "DMT" else {"linestyle": "", "marker": "*"}
    handles = [plotting.make_key("DMT limit" if label == "DMT" else label, **free)]
    handles += [
        plotting.make_key(f"simulation, {name}", linestyle="", marker=PRESET_MARKS[name])
        for name in presets
    ]
    ax.legend(handles=handles, loc="lower left")


def finish(ax):
    ax.set(xscale="log", yscale="log", xlabel=COST, ylabel=ERROR)
    low, high = ax.get_ylim()
    write_ticks(ax.yaxis, [tick for tick in ERROR_TICKS if low <= tick <= high])
    low, high = ax.get_xlim()
    write_ticks(ax.xaxis, [tick for tick in COST_TICKS if low <= tick <= high] or [low, high])


if __name__ == "__main__":
    main(start(globals(), "plot_tradeoff"))
