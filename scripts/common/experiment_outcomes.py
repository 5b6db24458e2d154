"""Grades and outcomes of published experiments, and how pages and claims show them."""

import numpy as np

from common.config.conditions import CONDITIONS, OBSERVED, conditions_of
from stickiness import datasets
from stickiness.criteria.registry import CRITERIA
from stickiness.formatting import number, percent, quantity
from stickiness.remaining.sphere import FEWEST_WAVES

GRADES = ("measured", "read", "recalled", "assumed")
OUTCOMES = ("missed", "compatible for some inputs", "compatible")
MISSED, SOME, COMPATIBLE = range(3)
SILENT = -1  # of a criterion, on an observation that does not test it
MARKS = {SILENT: "–", MISSED: "✗", SOME: "≈", COMPATIBLE: "✓"}
TONES = {SILENT: "open", MISSED: "no", SOME: "partly", COMPATIBLE: "yes"}
LEAST_EFFECT = 1.1  # factor by which an input must change a prediction to be named
MOST_EFFECT = 1e3  # factor beyond which it goes from nothing to something
LEAST = 5e-8  # J/m²; less is written as none


def describe(dataset, experiments=None):
    """All that a page shows of the experiments; by default, those that the dataset was made of."""
    experiments = experiments or datasets.parameters(dataset)["experiments"]
    tested = dataset.isel(case=dataset.tests.values == 1)  # published, and no mere relations
    cases = [describe_case(dataset.sel(case=c), experiments) for c in dataset.case.values]
    return {
        "cases": cases,
        "counts": np.bincount(tested.outcome.values, minlength=len(OUTCOMES)).tolist(),
        "values_inside": int(tested.value_inside.sum()),
        "missed": {case["label"]: case["reason"] for case in cases if case["reason"]},
        "sources": list(experiments.values()),
    }


def describe_case(case, experiments):
    """One case in words; `case` is the dataset at one place along `case`."""
    experiment, name = case.case.item().split("/")
    entry = experiments[experiment]
    outcome = int(case.outcome)
    waves = float(case.waves_in_contact)
    few = ", too few" if waves < FEWEST_WAVES else ""
    unit, label = OBSERVED[case["quantity"].item()]
    unit = unit and unit.replace("^2", "²")
    low = float(case.observed_low)
    high = float(case.observed_high)
    predictions = [float(case[n]) for n in ("predicted", "predicted_lowest", "predicted_highest")]
    if unit == "J/m²":
        predictions = [0.0 if work < LEAST else work for work in predictions]
    value, lowest, highest = predictions
    observed = show_interval(low, high, unit) + (" (relation)" if case.by_relation else "")
    if label == "sticks":
        observed = "sticks" if low else "does not stick"
    predicted = percent(value) if unit is None else show_interval(value, value, unit, highest)
    short = entry["short"] or entry["label"]
    case_entry = entry["cases"][name]
    # An experiment says why it is missed, a case also why its value differs.
    reason = "" if case.value_inside else case_entry["missed"] or ""
    if outcome == MISSED:
        reason = reason or entry["missed"] or "no reason was found"
    return {
        "experiment": short,
        "case": case_entry["label"],
        "label": f"{short}: {case_entry['label']}" if case_entry["missed"] else short,
        "reason": reason,
        "of": experiment,
        "inputs": conditions_of(entry, case_entry),
        "quantity": label,
        "observed": observed,
        "known": GRADES[int(case.observed_known)],
        "least_known": GRADES[int(case.known)],
        "predicted": f"{predicted} ({show_interval(lowest, highest, unit)})",
        "outcome": OUTCOMES[outcome] + (", value too" if case.value_inside else ""),
        "tone": TONES[outcome],
        "depends": describe_effect(case.most_effective_input.item(), float(case.effect_of_input)),
        "waves": "flat" if np.isnan(waves) else number(waves, 2) + few,
        "marks": {
            name: {"mark": MARKS[code], "tone": TONES[code]}
            for name, code in zip(CRITERIA, case.criterion_outcome.values.tolist(), strict=True)
        },
    }


def show_interval(low, high, unit, beside=0.0):
    """Limits of a quantity with its unit, in the prefix that suits what stands beside."""
    if unit is None:
        return f"{percent(low).removesuffix(' %')} to {percent(high)}"
    if high <= 0 and beside <= 0:
        return f"0 {unit}"
    return quantity(low, high, unit, 2, beside)


def describe_effect(name, effect):
    """The unknown input that matters most, and by how much."""
    if np.isnan(effect):
        return "not resolved: nothing is predicted"
    if effect < LEAST_EFFECT:
        return "no unknown input"
    factor = "from none to some" if effect > MOST_EFFECT else f"factor {number(effect, 2)}"
    return f"{CONDITIONS[name][1]} ({factor})"
