"""Experiments in words: what was observed, what is predicted, and which criterion survives."""

import numpy as np

from pipeline.experiments.entries import GRADES
from pipeline.experiments.judgements import MISSED, OUTCOMES, SILENT, SOME, WITHIN
from pipeline.numbers import interval, number, percent, quantity
from stickiness.core import datasets
from stickiness.criteria.registry import CRITERIA
from stickiness.remaining.prediction import DEFAULT_SHARE

UNITS = {"roughness_at_a_tenth": "m", "work_of_approach": "J/m²", "work_of_separation": "J/m²"}
NAMES = {
    "roughness_at_a_tenth": "rms height at a tenth",
    "relative_pull_off": "relative pull-off",
    "work_of_approach": "work of approach",
    "work_of_separation": "work of separation",
    "sticks": "sticks",
}
INPUTS = {
    "radius": "radius of the sphere",
    "plane_strain_modulus": "modulus",
    "youngs_modulus": "modulus",
    "poisson_ratio": "Poisson's ratio",
    "work_of_adhesion": "work of adhesion",
    "range": "range of the attraction",
    "hurst": "Hurst exponent",
    "longest_wavelength": "longest wave",
    "rolloff_wavelength": "roll-off",
    "shortest_wavelength": "shortest wave",
    "h_rms": "rms height",
}
MARKS = {SILENT: "–", MISSED: "✗", SOME: "≈", WITHIN: "✓"}
TONES = {SILENT: "open", MISSED: "no", SOME: "partly", WITHIN: "yes"}
LEAST_EFFECT = 1.1  # factor by which an input must change a prediction to be named
WANTED = percent(DEFAULT_SHARE)
LEAST_SHARE = 1e-6  # of the work of adhesion; less is written as none


def describe(dataset):
    """All that a page says of the experiments."""
    experiments = datasets.parameters(dataset)["experiments"]
    return {
        "cases": [describe_case(dataset.sel(case=c), experiments) for c in dataset.case.values],
        "counts": count_outcomes(dataset),
        "missed": explain_misses(dataset, experiments),
        "sources": list(experiments.values()),
    }


def count_outcomes(dataset):
    """How many cases are within the limits, in a sentence."""
    codes = dataset.outcome.values
    within, some, missed = (int(np.sum(codes == code)) for code in (WITHIN, SOME, MISSED))
    return (
        f"Of {codes.size} cases, {within} lie within the limits whatever the unknown inputs, "
        f"{some} for some of them, and {missed} are missed."
    )


def predicted_name(case):
    """Variable that holds the prediction of what was observed."""
    observed = case["quantity"].item()
    return "remaining" if observed == "sticks" else observed


def describe_case(case, experiments):
    """One case in words; `case` is the dataset at one place along `case`."""
    experiment, name = case.case.item().split("/")
    entry = experiments[experiment]
    outcome = int(case.outcome)
    return {
        "experiment": entry["label"],
        "case": entry["cases"][name]["label"],
        "quantity": NAMES[case["quantity"].item()],
        "observed": describe_observed(case),
        "known": GRADES[int(case.observed_known)],
        "least_known": GRADES[int(case.known)],
        "predicted": describe_predicted(case),
        "outcome": OUTCOMES[outcome],
        "tone": TONES[outcome],
        "depends": describe_effect(case),
        "marks": {name: mark(case, name) for name in CRITERIA},
    }


def describe_observed(case):
    """What was observed, with its limits."""
    observed = case["quantity"].item()
    low, high = (float(case[f"observed_{observed}_{end}"]) for end in ("low", "high"))
    if observed == "sticks":
        return "sticks" if low else "does not stick"
    return write(observed, low, high)


def describe_predicted(case):
    """What is predicted, with the limits over the model and all that is plausible."""
    name = predicted_name(case)
    value, low, high = (float(case[f"{name}{end}"]) for end in ("", "_lowest", "_highest"))
    if name not in UNITS:
        return f"{percent(value)} ({percent(low)} to {percent(high)}) remains"
    whole = 1.0 if name == "roughness_at_a_tenth" else float(case.work_of_adhesion)
    low, value, high = (0.0 if x < LEAST_SHARE * whole else x for x in (low, value, high))
    if name == "roughness_at_a_tenth":
        low, value, high = (float(case[f"{name}{end}"]) for end in ("_lowest", "", "_highest"))
    return f"{write(name, value, value)} ({write(name, low, high)})"


def write(name, low, high):
    """Limits of a quantity with its unit."""
    if name not in UNITS:
        return interval(low, high, 2)
    if high <= 0:
        return f"0 {UNITS[name]}"
    return quantity(low, high, UNITS[name], 2)


def describe_effect(case):
    """The unknown input that matters most, and by how much."""
    effect = float(case.effect_of_input)
    if effect < LEAST_EFFECT:
        return "on none of the unknown inputs"
    return f"{INPUTS[case.most_effective_input.item()]} (factor {number(effect, 2)})"


def mark(case, criterion):
    """Mark and tone of one criterion."""
    code = int(case.criterion_outcome.sel(criterion=criterion))
    return {"mark": MARKS[code], "tone": TONES[code]}


def survivals(dataset):
    """Worst outcome of every criterion by experiment; `SILENT` where nothing was decided."""
    experiments = [name.split("/")[0] for name in dataset.case.values.tolist()]
    table = {}
    for name in dict.fromkeys(experiments):
        rows = dataset.criterion_outcome.values[[e == name for e in experiments]]
        decided = np.where(rows == SILENT, WITHIN + 1, rows).min(axis=0)
        table[name] = dict(
            zip(CRITERIA, np.where(decided > WITHIN, SILENT, decided).tolist(), strict=True)
        )
    return table


def compare_roughness(dataset, criterion):
    """Roughness limit of a criterion over that observed, geometric means; one for every case."""
    cases = dataset.where(dataset["quantity"] == "roughness_at_a_tenth", drop=True)
    observed = np.sqrt(
        cases.observed_roughness_at_a_tenth_low * cases.observed_roughness_at_a_tenth_high
    )
    return cases.criterion_roughness.sel(criterion=criterion) / observed


def explain_misses(dataset, experiments):
    """Reason looked for, by the label of every experiment with a case that was missed."""
    missed = {name.split("/")[0] for name in dataset.case.values[dataset.outcome.values == MISSED]}
    return {
        entry["label"]: entry.get("missed", "no reason was found")
        for name, entry in experiments.items()
        if name in missed
    }
