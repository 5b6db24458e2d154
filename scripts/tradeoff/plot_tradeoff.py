"""What accuracy costs: every knob by itself, and all settings together with the presets."""

import itertools

import numpy as np

from pipeline.job import start
from pipeline.pages.style import COLOURS, GREY, MARKERS, canvas, key, letters, plain_ticks, save
from pipeline.tradeoff import summary
from stickiness.accuracy import error_laws, plan

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
    table = summary.read(job.input.summary)
    figure, panels = canvas("ABC;DEF;GHI", 7.8)
    draw_grids(panels["A"], take_medians(table, "pixels"))
    draw_tolerances(panels["B"], take_medians(table, "tolerance"))
    draw_seeds(panels["C"], take_medians(table, "seeds"), take_medians(table, "model"))
    draw_bands(panels["D"], take_medians(table, "band"))
    laws = error_laws.read_laws(job.input.laws)
    draw_settings(panels["E"], r"all settings, $a_V$", laws, ["a_v"], job.params)
    draw_settings(panels["F"], "all settings, worst", laws, [*error_laws.QUANTITIES], job.params)
    draw_adhesive_grids(panels["G"], table)
    draw_adhesive_tolerances(panels["H"], table)
    draw_adhesive_seeds(panels["I"], table)
    letters(panels)
    save(figure, job.output)


def take_medians(table, knob):
    """Error and cost by setting and quantity, in the order of the table."""
    part = table[table.knob == knob]
    return part.set_index(["setting", "quantity"])[["error", "cost"]]


def settings_of(medians):
    return list(dict.fromkeys(medians.index.get_level_values("setting")))


def label_axes(ax, title, xlabel=COST, ylabel=ERROR):
    """Logarithmic axes with their labels, and the panel's title."""
    ax.set(xscale="log", yscale="log", xlabel=xlabel, ylabel=ylabel)
    ax.set_title(title, loc="right")


def draw_grids(ax, medians):
    """Error against cost from coarse to fine grids, for three ways to evaluate them."""
    for colour, way in zip(COLOURS, ("counted", "sub-pixel", "extrapolated"), strict=False):
        for line, quantity in (("-", "area"), ("--", "attractive_area_0.01")):
            at = medians.loc[[(f"{pixels} {way}", quantity) for pixels in (2, 4, 8, 16)]]
            label = way if quantity == "area" else None
            ax.plot(at.cost, at.error, line, marker="o", color=colour, label=label)
    ax.plot([], [], "--", color=GREY, label=r"$A_\mathrm{ad}(0.01)$")
    label_axes(ax, "grid: 2, 4, 8, 16 points")
    plain_ticks(ax.xaxis, [0.5, 1, 2, 5, 10, 20, 50])
    ax.set_ylim(bottom=2e-5)
    ax.legend(loc="lower left")


def draw_tolerances(ax, medians):
    """Error against the tolerance of the solver."""
    values = sorted(settings_of(medians), key=float)
    for colour, marker, (quantity, label) in zip(COLOURS, MARKERS, SHOWN.items(), strict=False):
        error = medians.loc[[(value, quantity) for value in values]].error.to_numpy()
        shown = error > 0
        tolerances = np.array(values, float)[shown]
        ax.plot(tolerances, error[shown], marker=marker, color=colour, label=label)
    label_axes(ax, "solver", r"tolerance over $h_\mathrm{rms}$")
    ax.legend()


def draw_seeds(ax, medians, model):
    """Error of means of a_V against cost, by kind of seeds, and of theory instead."""
    kinds = {"plain": "plain", "multilevel": "+", "fixed amplitudes": "fixed"}
    for colour, marker, (kind, text) in zip(COLOURS, MARKERS, kinds.items(), strict=False):
        chosen = [(setting, "a_v") for setting in settings_of(medians) if text in setting]
        at = medians.loc[chosen].sort_values("cost")
        ax.plot(at.cost, at.error, marker=marker, color=colour, label=kind, linewidth=0.7)
    theory = model.loc[("theory", "a_v")]
    ax.plot(theory.cost, theory.error, "*", color="black", markersize=9, label="theory")
    label_axes(ax, r"seeds, $a_V$")
    plain_ticks(ax.xaxis, [20, 50, 100, 200, 500, 1000, 2000])
    plain_ticks(ax.yaxis, ERROR_TICKS)
    ax.set_ylim(bottom=0.006)
    ax.legend(loc="lower left")


def draw_bands(ax, medians):
    """Error against the cut of the spectrum, alone and extrapolated by theory."""
    cuts = sorted({int(setting.split()[0]) for setting in settings_of(medians)})
    for colour, marker, (quantity, label) in zip(COLOURS, MARKERS, SHOWN.items(), strict=False):
        for line, way in (("--", "cut"), ("-", "difference")):
            at = medians.loc[[(f"{cut} {way}", quantity) for cut in cuts]]
            look = {"label": label} if way == "difference" else {"markerfacecolor": "white"}
            ax.plot(cuts, at.error, line, marker=marker, color=colour, **look)
    label_axes(ax, f"cut, carried to {2 * cuts[-1]}", r"$\zeta$ simulated", "error of the mean")
    ax.set_xticks(cuts, [str(cut) for cut in cuts])
    ax.minorticks_off()
    ax.set_ylim(top=60)
    ax.legend(loc="upper right")


def list_adhesive(table, knob):
    """For every quantity of full adhesion, medians over its cases by the value of a knob."""
    for colour, marker, (quantity, label) in zip(COLOURS, MARKERS, ADHESIVE.items(), strict=False):
        kind = "pull_off" if quantity == "pull_off" else "adhesive"
        one = table[(table.knob == f"{kind} {knob}") & (table.quantity == quantity)]
        one = one[~one.setting.str.contains("extrapolated")]
        by = one.groupby("setting")[["error", "cost"]].median()
        by = by.loc[sorted(by.index, key=float)] if knob != "seeds" else by
        yield by, {"marker": marker, "color": colour, "label": label}


def draw_adhesive_grids(ax, table):
    """Error of adhesive quantities against cost, from coarse to fine grids."""
    for by, look in list_adhesive(table, "pixels"):
        ax.plot(by.cost, by.error, **look)
    label_axes(ax, "full adhesion: grid")


def draw_adhesive_tolerances(ax, table):
    """Error of adhesive quantities against the tolerance of their solver."""
    for by, look in list_adhesive(table, "tolerance"):
        by = by[by.error > SMALLEST]
        ax.plot(by.index.astype(float), by.error, **look)
    label_axes(ax, "full adhesion: solver", "tolerance")
    ax.set_ylim(top=5)
    ax.legend(loc="upper left", title="in G to I")


def draw_adhesive_seeds(ax, table):
    """Error of adhesive means against cost, and of the DMT limit in their place."""
    for by, look in list_adhesive(table[table.quantity != "pull_off"], "seeds"):
        for line, kind in (("--", "plain"), ("-", "controlled")):
            at = by[by.index.str.endswith(kind)].sort_values("cost")
            filled = {} if kind == "controlled" else {"markerfacecolor": "white"}
            ax.plot(at.cost, at.error, line, **(look | filled))
    model = table[table.knob == "adhesive model"]
    for colour, quantity in zip(COLOURS, ADHESIVE, strict=False):
        error = model.error[model.quantity == quantity].median()
        ax.axhline(error, color=colour, linestyle=":", linewidth=0.8)
    label_axes(ax, "full adhesion: seeds")
    handles = [key(color=GREY, linestyle=line) for line in ("--", "-", ":")]
    ax.legend(handles, ["plain", "controlled", "DMT limit"])


def draw_settings(ax, title, laws, quantities, params):
    """All settings as predicted, those that nothing cheaper beats, and the presets."""
    given = error_laws.Surface.of(params.surface), params.presets["pressures"]

    def predict(settings):
        cost = error_laws.predicted_cost(laws, settings, *given, params.descriptor_seeds)
        worst = error_laws.worst_error(laws, settings, *given, quantities, params.descriptor_seeds)
        return cost, worst[0]

    every = itertools.product(
        error_laws.PIXELS,
        error_laws.TOLERANCES[1:4:2],
        error_laws.SEEDS[:16:2],
        error_laws.COARSE_SEEDS,
    )
    cost, error = np.array([predict(error_laws.Settings(*each)) for each in every]).T
    ax.plot(cost, error, ".", color="0.8", markersize=2, rasterized=True)
    front = find_non_dominated(cost, error)
    ax.plot(cost[front], error[front], ".-", color="black", markersize=4, linewidth=0.8)
    for colour, (name, mark) in zip(COLOURS, PRESET_MARKS.items(), strict=False):
        if name in params.fidelities:
            at = predict(plan.preset(params.fidelities[name]))
            ax.plot(*at, mark, color=colour, markersize=7, markeredgecolor="white", label=name)
    label_axes(ax, title, ylabel="predicted error, 90 %")
    plain_ticks(ax.yaxis, ERROR_TICKS)
    handles, _ = ax.get_legend_handles_labels()
    ax.legend(handles=[*handles, key(color="black", marker=".", label="cheapest")])


def find_non_dominated(cost, error):
    """Find indices, by rising cost, of points that no cheaper one equals in error."""
    order = np.lexsort((error, cost))
    best = np.minimum.accumulate(error[order])
    return order[np.concatenate([[True], best[1:] < best[:-1]])]


if __name__ == "__main__":
    main(start(globals(), "plot_tradeoff"))
