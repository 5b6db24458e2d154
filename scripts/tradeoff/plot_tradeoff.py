"""What accuracy costs: every knob by itself, and all settings together with the presets."""

import itertools

import numpy as np

from common import plotting
from common.job import start
from common.plotting import COLOURS, GREY, MARKERS, write_ticks
from stickiness.accuracy import plan
from stickiness.accuracy.choice import COARSE_SEEDS, PIXELS, SEEDS, TOLERANCES
from stickiness.accuracy.error_models import Settings, Surface, read_models
from stickiness.accuracy.prediction import Problem, predicted_cost, worst_error
from stickiness.accuracy.quantities import MODELLED, columns_of
from tradeoff import summary

LOADS = ("0.01", "0.065", "0.3")
SHOWN = {"area": "contact area", "a_v": r"$a_V$", "mean_gap": "mean gap"}
COST = r"cost [FFT pairs of $1024^2$]"
ERROR = "error, 90 %"
ERROR_TICKS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1)
ADHESIVE = {
    "inverse_kappa_ad_0.0075": r"$1/\kappa_\mathrm{ad}(0.0075)$",
    "inverse_kappa_ad_0.1": r"$1/\kappa_\mathrm{ad}(0.1)$",
    "threshold": "threshold",
    "pull_off": "pull-off",
}
SMALLEST = 1e-6  # error that is shown
PRESET_MARKS = {"draft": "v", "standard": "o", "fine": "^"}


def main(job):
    found = summary.read(job.input.summary)
    laws = read_models(job.input.laws)
    with plotting.open_figure(job.output, "ABC;DEF;GHI", 7.8) as panels:
        draw_grids(panels["A"], found[found.knob == "pixels"])
        draw_tolerances(panels["B"], found[found.knob == "tolerance"])
        draw_seeds(panels["C"], found[found.knob == "seeds"], found[found.knob == "model"])
        draw_cuts(panels["D"], found[found.knob == "band"])
        for name, quantities in {"E": ["a_v"], "F": list(MODELLED)}.items():
            draw_settings(panels[name], laws, quantities, job.params)
        panels["E"].set_title(r"all settings, $a_V$", loc="right")
        panels["F"].set_title("all settings, worst", loc="right")
        draw_adhesive_grids(panels["G"], found)
        draw_adhesive_tolerances(panels["H"], found)
        draw_adhesive_seeds(panels["I"], found)


def index_medians(found):
    """Error and cost by setting and quantity."""
    return found.set_index(["setting", "quantity"])[["error", "cost"]].sort_index()


def draw_grids(ax, found):
    """Error against cost from coarse to fine grids, for three ways to evaluate them."""
    by = index_medians(found)
    for colour, way in zip(COLOURS, ("counted", "sub-pixel", "extrapolated"), strict=False):
        for line, quantity in (("-", "area"), ("--", "attractive_area_0.01")):
            at = by.loc[[(f"{pixels} {way}", quantity) for pixels in (2, 4, 8, 16)]]
            label = way if quantity == "area" else None
            ax.plot(at.cost, at.error, line, marker="o", color=colour, label=label)
    ax.plot([], [], "--", color=GREY, label=r"$A_\mathrm{ad}(0.01)$")
    ax.set(xscale="log", yscale="log", xlabel=COST, ylabel=ERROR)
    write_ticks(ax.xaxis, [0.5, 1, 2, 5, 10, 20, 50])
    ax.set_ylim(bottom=2e-5)
    ax.set_title("grid: 2, 4, 8, 16 points", loc="right")
    ax.legend(loc="lower left")


def draw_tolerances(ax, found):
    """Error against the tolerance of the solver."""
    by = index_medians(found)
    values = sorted(set(found.setting), key=float)
    for colour, marker, (quantity, label) in zip(COLOURS, MARKERS, SHOWN.items(), strict=False):
        at = by.loc[[(value, quantity) for value in values]]
        shown = at.error.to_numpy() > 0
        x = np.array(values, float)[shown]
        ax.plot(x, at.error[shown], marker=marker, color=colour, label=label)
    ax.set(xscale="log", yscale="log", xlabel=r"tolerance over $h_\mathrm{rms}$", ylabel=ERROR)
    ax.set_title("solver", loc="right")
    ax.legend()


def draw_seeds(ax, found, model):
    """Error of means of a_V against cost, by kind of seeds, and of theory instead."""
    by = index_medians(found)
    kinds = {
        "plain": [s for s in dict.fromkeys(found.setting) if s.endswith("plain")],
        "multilevel": [s for s in dict.fromkeys(found.setting) if "+" in s],
        "fixed amplitudes": [s for s in dict.fromkeys(found.setting) if s.endswith("fixed")],
    }
    for colour, marker, (kind, chosen) in zip(COLOURS, MARKERS, kinds.items(), strict=False):
        at = by.loc[[(setting, "a_v") for setting in chosen]].sort_values("cost")
        ax.plot(at.cost, at.error, marker=marker, color=colour, label=kind, linewidth=0.7)
    theory = index_medians(model).loc[("theory", "a_v")]
    ax.plot(theory.cost, theory.error, "*", color="black", markersize=9, label="theory")
    ax.set(xscale="log", yscale="log", xlabel=COST, ylabel=ERROR)
    write_ticks(ax.xaxis, [20, 50, 100, 200, 500, 1000, 2000])
    write_ticks(ax.yaxis, ERROR_TICKS)
    ax.set_title(r"seeds, $a_V$", loc="right")
    ax.set_ylim(bottom=0.006)
    ax.legend(loc="lower left")


def draw_cuts(ax, found):
    """Error against the cut of the spectrum, alone and extrapolated by theory."""
    by = index_medians(found)
    cuts = sorted({int(setting.split()[0]) for setting in found.setting})
    for colour, marker, (quantity, label) in zip(COLOURS, MARKERS, SHOWN.items(), strict=False):
        for line, way in (("--", "cut"), ("-", "difference")):
            at = by.loc[[(f"{cut} {way}", quantity) for cut in cuts]]
            look = {"label": label} if way == "difference" else {"markerfacecolor": "white"}
            ax.plot(cuts, at.error, line, marker=marker, color=colour, **look)
    ax.set(xscale="log", yscale="log", xlabel=r"$\zeta$ simulated", ylabel="error of the mean")
    ax.set_title(f"cut, extrapolated to {2 * cuts[-1]}", loc="right")
    ax.set_xticks(cuts, [str(cut) for cut in cuts])
    ax.minorticks_off()
    ax.set_ylim(top=60)
    ax.legend(loc="upper right")


def medians_of_adhesion(found, knob):
    """For every quantity of full adhesion, medians over its cases by the value of a knob."""
    for colour, marker, (quantity, label) in zip(COLOURS, MARKERS, ADHESIVE.items(), strict=False):
        kind = "pull_off" if quantity == "pull_off" else "adhesive"
        one = found[(found.knob == f"{kind} {knob}") & (found.quantity == quantity)]
        one = one[~one.setting.str.contains("extrapolated")]
        by = one.groupby("setting")[["error", "cost"]].median()
        by = by.loc[sorted(by.index, key=float)] if knob != "seeds" else by
        yield by, {"marker": marker, "color": colour, "label": label}


def draw_adhesive_grids(ax, found):
    """Error of adhesive quantities against cost, from coarse to fine grids."""
    for by, look in medians_of_adhesion(found, "pixels"):
        ax.plot(by.cost, by.error, **look)
    ax.set(xscale="log", yscale="log", xlabel=COST, ylabel=ERROR)
    ax.set_title("full adhesion: grid", loc="right")


def draw_adhesive_tolerances(ax, found):
    """Error of adhesive quantities against the tolerance of their solver."""
    for by, look in medians_of_adhesion(found, "tolerance"):
        by = by[by.error > SMALLEST]
        ax.plot(by.index.astype(float), by.error, **look)
    ax.set(xscale="log", yscale="log", xlabel="tolerance", ylabel=ERROR)
    ax.set_title("full adhesion: solver", loc="right")
    ax.set_ylim(top=5)
    ax.legend(loc="upper left", title="in G to I")


def draw_adhesive_seeds(ax, found):
    """Error of adhesive means against cost, and of the DMT limit in their place."""
    for by, look in medians_of_adhesion(found[found.quantity != "pull_off"], "seeds"):
        for line, kind in (("--", "plain"), ("-", "controlled")):
            at = by[by.index.str.endswith(kind)].sort_values("cost")
            filled = {} if kind == "controlled" else {"markerfacecolor": "white"}
            ax.plot(at.cost, at.error, line, **(look | filled))
    model = found[found.knob == "adhesive model"]
    for colour, quantity in zip(COLOURS, ADHESIVE, strict=False):
        error = model.error[model.quantity == quantity].median()
        ax.axhline(error, color=colour, linestyle=":", linewidth=0.8)
    ax.set(xscale="log", yscale="log", xlabel=COST, ylabel=ERROR)
    ax.set_title("full adhesion: seeds", loc="right")
    kinds = {"plain": "--", "controlled": "-", "DMT limit": ":"}
    ax.legend(handles=[plotting.make_key(text, linestyle=line) for text, line in kinds.items()])


def draw_settings(ax, laws, quantities, params):
    """All settings as predicted, those that nothing cheaper beats, and the presets."""
    problem = Problem(
        laws,
        Surface.of(params.surface),
        params.presets["pressures"],
        columns_of(quantities),
        params.descriptor_seeds,
    )
    chosen = [
        Settings(*each)
        for each in itertools.product(
            PIXELS,
            TOLERANCES[1:4:2],
            SEEDS[:16:2],
            COARSE_SEEDS,
        )
    ]
    points = [predict(problem, each) for each in chosen]
    cost, error = np.array(points).T
    ax.plot(cost, error, ".", color="0.8", markersize=2, rasterized=True)
    front = find_front(cost, error)
    ax.plot(cost[front], error[front], ".-", color="black", markersize=4, linewidth=0.8)
    for colour, (name, mark) in zip(COLOURS, PRESET_MARKS.items(), strict=False):
        if name in params.fidelities:
            preset = plan.preset(params.fidelities[name])
            at = predict(problem, preset)
            ax.plot(*at, mark, color=colour, markersize=7, markeredgecolor="white", label=name)
    ax.set(xscale="log", yscale="log", xlabel=COST, ylabel="predicted error, 90 %")
    write_ticks(ax.yaxis, ERROR_TICKS)
    handles, _ = ax.get_legend_handles_labels()
    cheapest = plotting.make_key("cheapest", color="black", marker=".")
    ax.legend(handles=[*handles, cheapest], loc="lower left")


def predict(problem, chosen):
    """Predicted cost and error of settings."""
    return predicted_cost(problem, chosen), worst_error(problem, chosen)[0]


def find_front(cost, error):
    """Indices, by rising cost, of points that no cheaper one equals in error."""
    order = np.lexsort((error, cost))
    best = np.minimum.accumulate(error[order])
    return order[np.concatenate([[True], best[1:] < best[:-1]])]


if __name__ == "__main__":
    main(start(globals(), "plot_tradeoff"))
