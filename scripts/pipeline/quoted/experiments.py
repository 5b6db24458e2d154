"""Predictions held against published experiments."""

from pipeline.experiments.judgements import COMPATIBLE, MISSED, SOME
from pipeline.experiments.texts import describe_observed, describe_predicted, tally_outcomes
from pipeline.numbers import number, table
from pipeline.quoted.sources import Sources, say_count
from stickiness.core import datasets
from stickiness.criteria.registry import CRITERIA, EDGES, FULL_CONTACT, REMAINING

RUBBERS = ("fuller_tabor/soft", "fuller_tabor/one_MPa", "fuller_tabor/stiff")
SHOWN = (
    *(REMAINING, FULL_CONTACT, "bearing_area", "fuller_tabor"),
    *("pastewka_robbins", EDGES, "violano"),
)
OTHERS = {
    "dalvi": "dalvi/stiffest",
    "smooth_ruby": "thimons/smoothest",
    "rough_ruby": "thimons/roughest",
    "tape": "dahlquist/below",
    "stiff_tape": "dahlquist/above",
    "canas": "canas/micro_rough",
    "wafers": "wafers/limit",
}


def quote_outcomes(sources: Sources) -> dict[str, str]:
    by, tested, inside = tally_outcomes(sources.read("experiments/experiments"))
    return {
        "experiments.tested": say_count(tested),
        "experiments.compatible": say_count(by[COMPATIBLE]),
        "experiments.some": say_count(by[SOME]),
        "experiments.missed": say_count(by[MISSED]),
        "experiments.value": say_count(inside),
    }


def quote_rubbers(sources: Sources) -> dict[str, str]:
    """Fuller & Tabor's rubbers: observed, predicted, and up to which rms height criteria stick."""
    data = sources.read("experiments/experiments")
    cases = datasets.parameters(data)["experiments"]["fuller_tabor"]["cases"]
    rows = []
    for name in RUBBERS:
        case = data.sel(case=name)
        heights = 1e6 * case.criterion_roughness.sel(criterion=list(SHOWN)).values
        label = cases[name.split("/")[1]]["label"]
        limits = (number(float(height), 2) for height in heights)
        rows.append((label, describe_observed(case), describe_predicted(case), *limits))
    heads = ("rubber", "observed", "predicted", *(CRITERIA[name].label for name in SHOWN))
    return {"experiments.rubbers": table(heads, rows)}


def quote_cases(sources: Sources) -> dict[str, str]:
    """Predictions with their limits, of cases that findings name."""
    data = sources.read("experiments/experiments")
    return {
        f"experiments.{name}": describe_predicted(data.sel(case=case))
        for name, case in OTHERS.items()
    }


NUMBERS = (quote_outcomes, quote_rubbers, quote_cases)
