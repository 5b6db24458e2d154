"""Figure of the published experiments: predicted against observed, and the criteria."""

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

from common.experiment_outcomes import COMPATIBLE, MARKS, SILENT
from stickiness.criteria.registry import CRITERIA, EDGES, REMAINING
from stickiness.pages import plotting
from stickiness.pages.plotting import BLUE, GREEN, GREY, ORANGE, RED, make_dot, make_key

FOLLOWED = "fuller_tabor"  # experiment whose pull-off is drawn against roughness
OBSERVED = ("observed_low", "observed_high")
LEAST_SHOWN = 0.005  # relative pull-off


def draw(dataset, experiments, files):
    """Write the figure of the predictions to files."""
    grid = {"left": 0.09, "right": 0.985, "top": 0.97, "bottom": 0.1, "wspace": 1.6, "hspace": 0.22}
    look = {"layout": "none", "gridspec_kw": grid | {"height_ratios": [1, 2]}}
    with plotting.open_figure(files, "AAABBB;..CCCC", 9.2, **look) as panels:
        draw_pull_off(panels["A"], dataset, experiments)
        draw_works(panels["B"], dataset, experiments)
        draw_criteria(panels["C"], dataset, experiments)


def draw_pull_off(ax, dataset, experiments):
    """Relative pull-off against roughness, with what was observed and other criteria's limits."""
    h = dataset.roughness.values * 1e6
    cases = [case for case in dataset.case.values if case.startswith(f"{FOLLOWED}/")]
    for colour, name in zip((BLUE, RED, GREEN, ORANGE), cases, strict=False):
        case = dataset.sel(case=name)
        lowest = case.pull_off_curve_lowest
        highest = case.pull_off_curve_highest
        plotting.draw_band(ax, h, lowest, np.minimum(highest, 2), colour, alpha=0.15)
        label = experiments[FOLLOWED]["cases"][name.split("/")[1]]["label"]
        ax.plot(h, case.pull_off_curve, color=colour, label=label)
        draw_observed(ax, case, colour)
        for criterion, marker in (("violano", "v"), (EDGES, "^")):
            onset = float(case.criterion_roughness.sel(criterion=criterion)) * 1e6
            ax.plot(onset, 2 * LEAST_SHOWN, marker, color=colour, mfc="white")
    handles, _ = ax.get_legend_handles_labels()
    handles += [make_key("observed", linewidth=5)]
    handles += [make_dot("limit by the paper", marker="v", mfc="white")]
    handles += [make_dot("onset, finest wave", marker="^", mfc="white")]
    ax.legend(handles=handles, loc="upper right", fontsize=7, bbox_to_anchor=(1, 0.95))
    ax.set(xscale="log", yscale="log", xlim=(0.07, 300), ylim=(LEAST_SHOWN, 3))
    ax.set(xlabel="rms height [µm]", ylabel="pull-off over that from a smooth surface")


def draw_observed(ax, case, colour):
    """What was observed: a range of roughness at its level, or of pull-off at its roughness."""
    limits = [case[name].item() for name in OBSERVED]
    if case["quantity"].item() == "limiting_roughness":
        roughness = float(case.predicted)
        curve = case.pull_off_curve.values
        x = np.multiply(limits, 1e6)
        y = [np.interp(roughness, case.roughness.values, curve)] * 2
    else:
        x = [float(case.h_rms) * 1e6] * 2
        y = np.maximum(limits, LEAST_SHOWN)
    ax.plot(x, y, color=colour, linewidth=5, solid_capstyle="butt")


def draw_works(ax, dataset, experiments):
    """Predicted against observed works of adhesion, with all limits."""
    nothing = 1e-4  # mJ/m^2, where what is predicted or observed to be none is drawn
    ax.plot([nothing, 300], [nothing, 300], color=GREY, linewidth=0.8)
    shown = {}
    works = ("work_of_approach", "work_of_separation")
    prediction_names = ("predicted_lowest", "predicted", "predicted_highest")
    for case in dataset.case.values[dataset["quantity"].isin(works)]:
        point = dataset.sel(case=case)
        experiment = case.split("/")[0]
        look = shown.setdefault(experiment, plotting.pick_look(len(shown)))
        # In mJ/m^2, none at the edge of the panel.
        observed = np.maximum([point[name].item() * 1e3 for name in OBSERVED], nothing)
        predicted = np.maximum([point[name].item() * 1e3 for name in prediction_names], nothing)
        low, value, high = predicted
        middle = np.sqrt(observed[0] * observed[1])
        bars = {"color": look["color"], "linewidth": 0.9}
        ax.plot(observed, [value] * 2, **bars)
        ax.plot([middle] * 2, [low, high], **bars)
        filled = {} if point["quantity"].item() == "work_of_approach" else {"mfc": "white"}
        ax.plot(middle, value, **look, **filled)
    labels = {e: experiments[e]["short"] or experiments[e]["label"] for e in shown}
    keys = [make_dot(labels[e], **look) for e, look in shown.items()]
    keys.append(make_dot("open: separation", mfc="white"))
    ax.legend(handles=keys, loc="lower right", fontsize=7)
    ax.set(xscale="log", yscale="log", xlim=(nothing, 300), ylim=(nothing / 2, 300))
    ax.set(xlabel="observed work of adhesion [mJ/m²]", ylabel="predicted [mJ/m²]")


def draw_criteria(ax, dataset, experiments):
    """Every case: outcome of the predicted value, and of every criterion's answer on sticking."""
    by_criterion = dataset.criterion_outcome.transpose("case", "criterion").values
    outcomes = np.column_stack([dataset.outcome.values, by_criterion])
    limits = {"vmin": SILENT - 0.5, "vmax": COMPATIBLE + 0.5}
    # From wrong to right, grey where nothing is decided; light enough for the marks.
    outcome_colours = ("#DDDDDD", "#F2B48C", "#F7E6A1", "#9CD1BE")
    ax.imshow(outcomes, cmap=ListedColormap(outcome_colours), aspect="auto", **limits)
    texts = "not tested", "none", "some", "all plausible inputs"
    keys = [
        Patch(color=colour, label=f"{MARKS[code]}  {text}")
        for code, (colour, text) in enumerate(zip(outcome_colours, texts, strict=True), SILENT)
    ]
    place = {"loc": "upper right", "bbox_to_anchor": (-0.3, -0.02)}
    ax.legend(handles=keys[::-1], title="right for", alignment="left", **place)
    for (row, column), code in np.ndenumerate(outcomes):
        ax.text(column, row, MARKS[int(code)], ha="center", va="center", fontsize=8)
    labels = [criterion.label.replace("a_V", "$a_V$") for criterion in CRITERIA.values()]
    labels.insert(0, "value predicted")
    ax.set_xticks(range(len(labels)), labels, rotation=35, ha="right", rotation_mode="anchor")
    ax.set_yticks(range(len(outcomes)), [name_case(c, experiments) for c in dataset.case.values])
    ax.axvline(0.5, color="white", linewidth=3)
    ax.get_xticklabels()[1 + list(CRITERIA).index(REMAINING)].set_fontweight("bold")
    ax.tick_params(length=0)
    starts = np.array([case.split("/")[0] for case in dataset.case.values])
    for row in np.flatnonzero(starts[1:] != starts[:-1]):
        ax.axhline(row + 0.5, color="white", linewidth=3)


def name_case(case, experiments):
    """Author and year of the experiment, if it has them, and the case."""
    experiment, name = case.split("/")
    entry = experiments[experiment]
    label = entry["cases"][name]["label"]
    return f"{entry['short']}: {label}" if entry["short"] else label
