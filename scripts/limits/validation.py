"""Write docs/validation.md: predictions of the library beside the committed simulations.

PYTHONPATH=scripts python -m limits.validation
"""

from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from common import heights_table, limits_table, remaining_table, tradeoff_table
from common.conventions import LOAD
from limits import calibrate_limits as calibrate
from stickiness.accuracy import error_models
from stickiness.formatting import number, percent, table
from stickiness.limited import Limited
from stickiness.pages.rendering import make_environment
from stickiness.remaining.calibration import find_spread
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.verdicts.longer_waves import find_larger_error, find_unlikeness

PROJECT = Path(__file__).parents[2]
PAGE = PROJECT / "docs/validation.md"
THEORY_QUANTITIES = {
    "area": "area in contact",
    "mean_gap": "mean gap",
    "attractive_area_0.01": "area within 0.01 h_rms",
    "attractive_area_0.1": "area within 0.1 h_rms",
    "a_v": "a_V",
}
THEORY_MAGNIFICATIONS = (16, 64)
THEORY_HURST = 0.8


class Compared(NamedTuple):
    """Predictions of one kind beside what was simulated, arrays of one length."""

    name: str
    by: str
    predicted: Limited
    simulated: np.ndarray


def page() -> str:
    """Return the page with its tables."""
    heights = calibrate.add_roles(heights_table.read(find_table("heights")))
    remaining = remaining_table.read(find_table("remaining"))
    simulated = {kind: limits_table.read(find_table(kind), kind) for kind in limits_table.COLUMNS}
    shares = [
        *compare_heights(heights),
        *compare_solids(simulated["solids"]),
        *compare_ranges(simulated["ranges"]),
    ]
    thresholds = [
        compare_patches(simulated["patches"]),
        compare_unresolved(simulated["unresolved"]),
        *compare_larger(simulated["larger"]),
    ]
    template = make_environment(PROJECT / "report").get_template("validation.md.j2")
    return template.render(
        shares=tabulate_shares(shares),
        thresholds=tabulate_factors("threshold of w", thresholds),
        paths=tabulate_factors("quantity", compare_paths(remaining)),
        pull_offs=calibrate.summarise_pull_offs(simulated["pull_offs"]),
        theory=tabulate_theory(error_models.read_models(find_table("accuracy"))),
        dmt_sum=tabulate_dmt_sum(pd.read_csv(find_table("dmt_error"), comment="#")),
        verdicts=tabulate_verdicts(tradeoff_table.read(find_table("tradeoff"))),
        load=number(LOAD),
        hurst=number(THEORY_HURST),
    )


def find_table(name):
    """Path of a committed table."""
    return PROJECT / f"config/{name}.csv"


def limit(quantity, rows):
    """Value and limits of rows by a method of `Roughness` that takes a deviation."""
    lengths = rows.adhesion_length.to_numpy()[:, None]
    ranges = rows.range.to_numpy()[:, None]
    return Limited(*(quantity(lengths, ranges, sign)[:, 0] for sign in (0, -1, 1)))


def compare_heights(heights):
    """Shares on heights of many shapes: by the spectrum, with the skewness, and by states."""
    for (kind, window), rows in heights.groupby(["kind", "window"]):
        name = f"{kind} heights, {window} × {window} waves"
        models = {"spectrum": calibrate.model_heights(rows)}
        if kind != heights_table.GAUSSIAN:
            shape = np.array([calibrate.find_height_shape(each).shape for each in rows.skewness])
            shape_error = find_spread("skewness", "ln_work").high * np.abs(shape)
            models["spectrum and skewness"] = replace(
                calibrate.model_heights(rows, shape), shape_error=shape_error[:, None]
            )
        simulated = rows.simulated.to_numpy()
        for by, rough in models.items():
            # A cell of few waves is one realisation.
            of_cell = replace(rough, waves=float(window))
            yield Compared(name, by, limit(of_cell.share, rows), simulated)
        states = Limited(*(rows[f"states{end}"].to_numpy() for end in ("", "_low", "_high")))
        yield Compared(name, "simulated states", states, simulated)


def compare_solids(solids):
    """Shares on layers, films, skins and thin incompressible layers."""
    for kind, rows in calibrate.group_solids(solids):
        predicted = limit(calibrate.model_solids(rows).share, rows)
        yield Compared(kind, "spectrum", predicted, rows.simulated.to_numpy())


def compare_ranges(ranges):
    """Shares at ranges below a tenth of that of the states and above, between both bounds."""
    rows = ranges.dropna(subset="simulated")
    error = find_spread("states", "share").high
    rise = rows.energy_ratio * np.maximum(1 - rows.range_ratio, 0.0) ** 2
    room = np.maximum(rows.chord - rows.bound, 0.0)
    between = Limited(
        *(
            rows.bound + np.clip(place * rise, 0.0, 1.0) * room
            for place in find_spread("states", "place")
        )
    )
    predicted = Limited(
        value=between.value,
        low=between.low - error * between.low / (between.low + error),
        high=between.high + error * between.high / (between.high + error),
    )
    is_short = rows.range_ratio < calibrate.MOST_RATIO
    for name, chosen in (("shorter", is_short), ("hardly shorter", ~is_short)):
        yield Compared(
            name=f"range {name} than that of the states",
            by="simulated states",
            predicted=Limited(*(limits[chosen].to_numpy() for limits in predicted)),
            simulated=rows.simulated[chosen].to_numpy(),
        )


def compare_patches(patches):
    """Thresholds of patches for the surface that they were cut from."""
    rows = patches.dropna(subset=["threshold_10", "whole_threshold_10"])
    distance = calibrate.find_distance(rows)
    error = np.hypot(
        find_spread("patch", "least").high, find_spread("patch", "ln_work").high * distance
    )
    threshold = rows.threshold_10.to_numpy()
    predicted = Limited(value=threshold, low=threshold - error, high=threshold + error)
    return Compared(
        "patch for its surface", "simulated states", predicted, rows.whole_threshold_10.to_numpy()
    )


def compare_unresolved(unresolved):
    """Thresholds on thinned grids for the full ones."""
    rows = unresolved.dropna(subset=["thinned_10", "full_10"])
    rows = rows[rows.lacking > calibrate.LEAST_LACKING]
    beyond = np.sqrt(np.log1p(rows.lacking)) * (1 - DEFAULT_SHARE) ** 3
    spread = find_spread("states", "unresolved")
    # What remains on the full grid takes more work, by a negative spread.
    ends = (spread.value, spread.high, spread.low)
    predicted = Limited(*((rows.thinned_10 - end * beyond).to_numpy() for end in ends))
    return Compared(
        "thinned map for the whole", "simulated states", predicted, rows.full_10.to_numpy()
    )


def compare_larger(larger):
    """Thresholds of scans for contacts of two to eight times their side, by family."""
    rows = larger.dropna(subset=["value_10", "whole_threshold_10"])
    unlike = find_unlikeness(rows.unevenness, rows["shape"])
    error = find_larger_error(unlike, rows.parts)
    threshold = rows.value_10
    predicted = Limited(
        value=threshold,
        low=threshold - np.hypot(threshold - rows.low_10, error),
        high=threshold + np.hypot(rows.high_10 - threshold, error),
    )
    for family, chosen in rows.groupby("family").groups.items():
        yield Compared(
            name=f"scan for a larger contact, {family.replace('_', ' ')}",
            by="scan",
            predicted=Limited(*(limits[chosen].to_numpy() for limits in predicted)),
            simulated=rows.whole_threshold_10[chosen].to_numpy(),
        )


def compare_paths(remaining):
    """Energies, works and pull-offs of paths, by cells, in logarithms."""
    late = np.exp(find_spread("spectrum", "ln_approach").low)
    labels = {"bound": "share", "pull_off": "pull-off"}
    for window, rows in remaining[remaining.bound > calibrate.LEAST_SHARE].groupby("window"):
        for name in ("bound", "approach", "separation", "pull_off"):
            known = rows.dropna(subset=name)
            rough = replace(calibrate.model_heights(known), waves=float(window))
            pull = partial(rough.tension, pressed=known.pressed.to_numpy()[:, None])
            methods = {"separation": rough.separation, "pull_off": pull}
            predicted = limit(methods.get(name, rough.share), known)
            if name == "approach":
                predicted = predicted._replace(low=predicted.low * late)
            with np.errstate(divide="ignore"):
                logs = Limited(*map(np.log, predicted))
            label = f"{labels.get(name, f'work of {name}')}, {window} × {window} waves"
            yield Compared(label, "spectrum", logs, np.log(known[name].to_numpy()))


def tabulate_shares(compared):
    """Table of shares, whose deviations and widths are in shares of w."""
    lines = []
    for name, by, predicted, simulated in compared:
        inside = find_inside(predicted, simulated)
        decided_low = predicted.low >= DEFAULT_SHARE
        decided_high = predicted.high < DEFAULT_SHARE
        sticks = simulated >= DEFAULT_SHARE
        false = np.sum((decided_low & ~sticks) | (decided_high & sticks))
        lines.append(
            (
                name,
                by,
                str(simulated.size),
                number(np.mean(predicted.value - simulated), 2),
                number(np.quantile(abs(predicted.value - simulated), calibrate.COVERAGE), 2),
                percent(np.mean(inside)),
                number(np.mean(predicted.high - predicted.low), 2),
                percent(np.mean(decided_low | decided_high)),
                str(false),
            )
        )
    columns = ("share of w on", "predicted by", "rows", "mean error", "90 % of errors below")
    return table((*columns, "inside limits", "width of limits", "decided", "false"), lines)


def tabulate_factors(quantity, compared):
    """Table of quantities whose logarithms are compared."""
    lines = []
    for name, by, predicted, simulated in compared:
        error = predicted.value - simulated
        width = np.median(predicted.high - predicted.low)
        lines.append(
            (
                name,
                by,
                str(simulated.size),
                number(np.exp(np.median(error)), 3),
                number(np.exp(np.quantile(abs(error), calibrate.COVERAGE)), 3),
                percent(np.mean(find_inside(predicted, simulated))),
                number(np.exp(width), 3),
            )
        )
    columns = (quantity, "predicted by", "rows", "predicted over simulated", "90 % within a factor")
    return table((*columns, "inside limits", "high over low limit"), lines)


def find_inside(predicted, simulated):
    """Whether limits hold what was simulated, to the rounding of tables."""
    above = predicted.low - calibrate.ROUNDING <= simulated
    return above & (simulated <= predicted.high + calibrate.ROUNDING)


def tabulate_theory(models):
    """Table of errors of Persson's theory beside simulations on the same discrete spectra."""
    lines = []
    for column, label in THEORY_QUANTITIES.items():
        surfaces = [
            error_models.Surface(hurst=THEORY_HURST, magnification=magnification)
            for magnification in THEORY_MAGNIFICATIONS
        ]
        errors = [error_models.single_error(models, "theory", column, s, LOAD) for s in surfaces]
        points = number(models["theory", column].points)
        lines.append((label, points, *map(percent, errors)))
    heads = [f"error at ζ = {magnification}" for magnification in THEORY_MAGNIFICATIONS]
    return table(("quantity", "rows", *heads), lines)


def tabulate_dmt_sum(dmt_error):
    """Table of full simulation with the weakest adhesion over the DMT sum, by the range."""
    weakest = dmt_error[dmt_error.strength == dmt_error.strength.min()]
    lines = []
    for ratio, rows in weakest.groupby("range_over_h_rms"):
        median = number(rows.ratio.median(), 3)
        extremes = f"{number(rows.ratio.min(), 3)} to {number(rows.ratio.max(), 3)}"
        lines.append((number(ratio), str(len(rows)), median, extremes))
    return table(("range over h_rms", "rows", "median", "extremes"), lines)


def tabulate_verdicts(medians):
    """Table of what verdicts gain from time."""
    lines = [
        (
            row["way"],
            str(row["points"]),
            number(row["pairs"]),
            f"{number(row['seconds'], 2)} s",
            number(row["share"], 2),
            percent(1 - row["outside"]),
            number(row["width"], 2),
            percent(1 - row["undecided"]),
            percent(row["wrong"]),
        )
        for row in tradeoff_table.list_verdicts(medians)
    ]
    columns = (
        "verdict by",
        "points a side",
        "pairs",
        "processor time",
        "median error of the share",
    )
    return table((*columns, "inside limits", "width of limits", "decided", "wrongly"), lines)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
