"""Grades and outcomes of published experiments, and how pages and claims show them."""

from collections import Counter

import numpy as np

from common.formatting import number, percent, quantity
from stickiness import datasets
from stickiness.criteria.registry import CRITERIA

GRADES = ("measured", "read", "recalled", "assumed")
OUTCOMES = ("missed", "compatible for some inputs", "compatible")
MISSED, SOME, COMPATIBLE = range(3)
SILENT = -1  # of a criterion, on an observation that does not test it
MARKS = {SILENT: "–", MISSED: "✗", SOME: "≈", COMPATIBLE: "✓"}
TONES = {SILENT: "open", MISSED: "no", SOME: "partly", COMPATIBLE: "yes"}
FEWEST_WAVES = 5.0  # across what holds a sphere, from which the model of a sphere applies
UNITS = {"limiting_roughness": "m", "work_of_approach": "J/m²", "work_of_separation": "J/m²"}
NAMES = {
    "limiting_roughness": "limiting rms height",
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
LEAST_EFFECT = 1.1  # factor by which an input must change a prediction to be named
MOST_EFFECT = 1e3  # factor beyond which it goes from nothing to something
LEAST_SHARE = 1e-6  # of the work of adhesion; less is written as none


def describe(dataset, experiments=None):
    """All that a page shows of the experiments; by default, those that the dataset was made of."""
    experiments = experiments or datasets.parameters(dataset)["experiments"]
    return {
        "cases": [describe_case(dataset.sel(case=c), experiments) for c in dataset.case.values],
        "counts": count_outcomes(dataset),
        "missed": explain_misses(dataset, experiments),
        "sources": list(experiments.values()),
    }


def count_outcomes(dataset):
    """How the cases came out, in two sentences; of published ones, without mere relations."""
    tested = dataset.isel(case=dataset.tests.values == 1)
    by = Counter(tested.outcome.values.tolist())
    return (
        f"The limits of the prediction overlap with {by[COMPATIBLE]} of {tested.sizes['case']} "
        f"published observations whatever the unknown inputs, with {by[SOME]} for some of them, "
        f"and with {by[MISSED]} for none. The value itself agrees with "
        f"{int(tested.value_inside.sum())}. None is a sharp test, because no spectrum is known."
    )


def describe_case(case, experiments):
    """One case in words; `case` is the dataset at one place along `case`."""
    experiment, name = case.case.item().split("/")
    entry = experiments[experiment]
    outcome, waves = int(case.outcome), float(case.waves_in_contact)
    few = ", too few" if waves < FEWEST_WAVES else ""
    return {
        "experiment": entry.get("short", entry["label"]),
        "case": entry["cases"][name]["label"],
        "quantity": NAMES[case["quantity"].item()],
        "observed": describe_observed(case),
        "known": GRADES[int(case.observed_known)],
        "least_known": GRADES[int(case.known)],
        "predicted": describe_predicted(case),
        "outcome": OUTCOMES[outcome] + (", value too" if case.value_inside else ""),
        "tone": TONES[outcome],
        "depends": describe_effect(case),
        "waves": "flat" if np.isnan(waves) else number(waves, 2) + few,
        "marks": {
            name: {"mark": MARKS[code], "tone": TONES[code]}
            for name, code in zip(CRITERIA, case.criterion_outcome.values.tolist(), strict=True)
        },
    }


def describe_observed(case):
    observed = case["quantity"].item()
    low, high = (float(case[f"observed_{observed}_{end}"]) for end in ("low", "high"))
    if observed == "sticks":
        return "sticks" if low else "does not stick"
    text = show_interval(observed, low, high)
    return f"{text} (relation)" if case.by_relation else text


def describe_predicted(case):
    """What is predicted, with the limits over the model and all that is plausible."""
    observed = case["quantity"].item()
    name = "remaining" if observed == "sticks" else observed
    value, low, high = (float(case[f"{name}{end}"]) for end in ("", "_lowest", "_highest"))
    if name in ("remaining", "relative_pull_off"):
        return f"{percent(value)} ({show_interval(name, low, high)})"
    if name != "limiting_roughness":
        least = LEAST_SHARE * float(case.work_of_adhesion)
        value, low, high = (0.0 if x < least else x for x in (value, low, high))
    return f"{show_interval(name, value, value, high)} ({show_interval(name, low, high)})"


def show_interval(name, low, high, beside=0.0):
    """Limits of a quantity with its unit, in the prefix that suits what stands beside."""
    if name not in UNITS:
        return f"{percent(low).removesuffix(' %')} to {percent(high)}"
    if high <= 0 and beside <= 0:
        return f"0 {UNITS[name]}"
    return quantity(low, high, UNITS[name], 2, beside)


def describe_effect(case):
    """The unknown input that matters most, and by how much."""
    effect = float(case.effect_of_input)
    if np.isnan(effect):
        return "not resolved: nothing is predicted"
    if effect < LEAST_EFFECT:
        return "no unknown input"
    factor = "from none to some" if effect > MOST_EFFECT else f"factor {number(effect, 2)}"
    return f"{INPUTS[case.most_effective_input.item()]} ({factor})"


def find_survivals(dataset):
    """Worst outcome of every criterion by experiment; `SILENT` where nothing is tested."""
    experiments = np.array([name.split("/")[0] for name in dataset.case.values])
    table = {}
    for name in dict.fromkeys(experiments.tolist()):
        rows = dataset.criterion_outcome.values[experiments == name]
        worst = np.where(rows == SILENT, COMPATIBLE + 1, rows).min(axis=0)
        table[name] = np.where(worst > COMPATIBLE, SILENT, worst).tolist()
    return table


def explain_misses(dataset, experiments):
    """Reason looked for, by the label of every experiment with a case that was missed."""
    missed = {name.split("/")[0] for name in dataset.case.values[dataset.outcome.values == MISSED]}
    return {
        entry.get("short", entry["label"]): entry.get("missed", "no reason was found")
        for name, entry in experiments.items()
        if name in missed
    }
