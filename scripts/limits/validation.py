"""Write docs/validation.md: predictions of the library beside the committed simulations.

PYTHONPATH=scripts python -m limits.validation
"""

from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from common import heights_table, tradeoff_table
from common.paper import LOAD
from limits import comparisons
from limits.calibrate_limits import COVERAGE, MOST_RATIO, summarise_pull_offs
from stickiness.accuracy import error_models
from stickiness.formatting import number, percent, table
from stickiness.limited import Limited
from stickiness.pages.rendering import make_environment
from stickiness.remaining.errors import PATH, find_states_error
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.trial_states import DEFAULT_SHARE

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

    @classmethod
    def of(cls, name: str, by: str, comparison: comparisons.Comparison) -> "Compared":
        """A comparison whose error is calibrated, under a name for readers."""
        return cls(name, by, comparison.limits, comparison.simulated)


def page() -> str:
    """Return the page with its tables."""
    names = ("heights", "remaining", *comparisons.SIMULATED)
    tables = comparisons.read_tables(find_table(name) for name in names)
    shares = [
        *compare_shapes(tables["heights"]),
        *compare_solids(tables),
        *compare_short_ranges(tables["ranges"]),
    ]
    thresholds = list(compare_thresholds(tables))
    template = make_environment(PROJECT / "report").get_template("validation.md.j2")
    return template.render(
        shares=tabulate_shares(shares),
        thresholds=tabulate_factors("threshold of w", thresholds),
        paths=tabulate_factors("quantity", compare_works(tables["remaining"])),
        pull_offs=summarise_pull_offs(tables["pull_offs"]),
        theory=tabulate_theory(error_models.read_models(find_table("accuracy"))),
        dmt_sum=tabulate_dmt_sum(pd.read_csv(find_table("dmt_error"), comment="#")),
        verdicts=tabulate_verdicts(tradeoff_table.read(find_table("tradeoff"))),
        load=number(LOAD),
        hurst=number(THEORY_HURST),
    )


def find_table(name):
    """Path of a committed table."""
    return PROJECT / f"config/{name}.csv"


def compare_shapes(heights):
    """Shares on heights of many shapes: by the spectrum, with the skewness, and by states."""
    for (kind, window), rows in heights.groupby(["kind", "window"]):
        name = f"{kind} heights, {window} × {window} waves"
        yield Compared.of(name, "spectrum", comparisons.of_heights(rows))
        if kind != heights_table.GAUSSIAN:
            yield Compared.of(name, "spectrum and skewness", comparisons.of_skewed(rows))
        states = comparisons.of_states(rows)
        yield Compared(name, "simulated states", states.predicted, states.simulated)


def compare_solids(tables):
    """Shares on layers, thin incompressible layers, films and skins."""
    of_theory = comparisons.of_theory(tables)
    layers = of_theory.where(of_theory.groups == comparisons.LAYER)
    for comparison in (layers, *comparisons.of_solids(tables["solids"])):
        (name,) = set(comparison.groups)
        yield Compared.of(name, "spectrum", comparison)


def compare_short_ranges(ranges):
    """Shares at ranges below a tenth of that of the states and above, between both bounds."""
    is_short = ranges.range_ratio < MOST_RATIO
    for name, chosen in (("shorter", is_short), ("hardly shorter", ~is_short)):
        comparison = comparisons.of_ranges(ranges[chosen])
        most = np.maximum(comparison.rows.chord, comparison.rows.bound)
        between = Limited(*(np.minimum(share, most) for share in comparison.limits))
        predicted = Limited(
            value=between.value,
            low=between.low - find_states_error(between.low),
            high=between.high + find_states_error(between.high),
        )
        name = f"range {name} than that of the states"
        yield Compared(name, "simulated states", predicted, comparison.simulated)


def compare_thresholds(tables):
    """Thresholds of patches, of thinned grids, of coated maps, and of scans by family."""
    patches = comparisons.of_patches(tables["patches"])
    for share in comparisons.PATCH_SHARES.values():
        name = f"patch for its surface, share of {percent(share)}"
        yield Compared.of(name, "simulated states", patches.where(patches.rows.share == share))
    thinned = comparisons.of_unresolved(tables["unresolved"], {"10": DEFAULT_SHARE})
    yield Compared.of("thinned map for the whole", "simulated states", thinned)
    for name, by, is_skin in (
        ("skin on a map", "spectrum of the map", True),
        ("thin layer on a map", "simulated states", False),
    ):
        yield Compared.of(name, by, comparisons.of_coated(tables["coated"], is_skin))
    for family, rows in tables["larger"].groupby("family"):
        name = f"scan for a larger contact, {family.replace('_', ' ')}"
        yield Compared.of(name, "scan", comparisons.of_larger(rows))


def compare_works(remaining):
    """Energies, works and pull-offs of paths, by cells, in logarithms."""
    late = np.exp(PATH.spread.low)
    labels = {"bound": "share", "pull_off": "pull-off"}
    for window, rows in remaining[remaining.bound > comparisons.LEAST_SHARE].groupby("window"):
        for name in ("bound", "approach", "separation", "pull_off"):
            known = rows.dropna(subset=name)
            pull = partial(Roughness.tension, pressed=known.pressed.to_numpy()[:, None])
            methods = {"separation": Roughness.separation, "pull_off": pull}
            method = methods.get(name, Roughness.share)
            predicted = comparisons.find_limits(method, comparisons.add_waves(known))
            if name == "approach":
                predicted = predicted._replace(low=predicted.low * late)
            with np.errstate(divide="ignore"):
                logs = Limited(*map(np.log, predicted))
            label = f"{labels.get(name, f'work of {name}')}, {window} × {window} waves"
            yield Compared(label, "spectrum", logs, np.log(known[name].to_numpy()))


def tabulate(lines):
    """Table of texts by the heads of their columns."""
    return table(lines[0], [line.values() for line in lines])


def tabulate_shares(compared):
    """Table of shares, whose deviations and widths are in shares of w."""
    lines = []
    for name, by, predicted, simulated in compared:
        error = predicted.value - simulated
        width, decided, false = comparisons.judge_shares(predicted, simulated)
        lines.append(
            {
                "share of w on": name,
                "predicted by": by,
                "rows": str(simulated.size),
                "mean error": number(np.mean(error), 2),
                "90 % of errors below": number(np.quantile(abs(error), COVERAGE), 2),
                "inside limits": percent(np.mean(find_inside(predicted, simulated))),
                "width of limits": number(width, 2),
                "decided": percent(decided),
                "false": str(false),
            }
        )
    return tabulate(lines)


def tabulate_factors(quantity, compared):
    """Table of quantities whose logarithms are compared."""
    lines = []
    for name, by, predicted, simulated in compared:
        error = predicted.value - simulated
        width = np.median(predicted.high - predicted.low)
        lines.append(
            {
                quantity: name,
                "predicted by": by,
                "rows": str(simulated.size),
                "predicted over simulated": number(np.exp(np.median(error)), 3),
                "90 % within a factor": number(np.exp(np.quantile(abs(error), COVERAGE)), 3),
                "inside limits": percent(np.mean(find_inside(predicted, simulated))),
                "high over low limit": number(np.exp(width), 3),
            }
        )
    return tabulate(lines)


def find_inside(predicted, simulated):
    """Whether limits hold what was simulated, to the rounding of tables."""
    above = predicted.low - comparisons.ROUNDING <= simulated
    return above & (simulated <= predicted.high + comparisons.ROUNDING)


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
    lines = [
        {
            "range over h_rms": number(ratio),
            "rows": str(len(rows)),
            "median": number(rows.ratio.median(), 3),
            "extremes": f"{number(rows.ratio.min(), 3)} to {number(rows.ratio.max(), 3)}",
        }
        for ratio, rows in weakest.groupby("range_over_h_rms")
    ]
    return tabulate(lines)


def tabulate_verdicts(medians):
    """Table of what verdicts gain from time."""
    lines = [
        {
            "verdict by": row["way"],
            "points a side": str(row["points"]),
            "pairs": number(row["pairs"]),
            "processor time": f"{number(row['seconds'], 2)} s",
            "median error of the share": number(row["share"], 2),
            "inside limits": percent(1 - row["outside"]),
            "width of limits": number(row["width"], 2),
            "decided": percent(1 - row["undecided"]),
            "wrongly": percent(row["wrong"]),
        }
        for row in tradeoff_table.list_verdicts(medians)
    ]
    return tabulate(lines)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
