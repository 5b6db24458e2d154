"""Experiments as a page of Markdown."""

from common.formatting import number, percent, table
from experiments.judgements import FACTOR, FEWEST_WAVES
from experiments.texts import MARKS, count_outcomes, describe_case, explain_misses, survivals
from stickiness.criteria.registry import CRITERIA
from stickiness.remaining.prediction import DEFAULT_SHARE

HEAD = """\
# Published experiments

Predictions by the adhesion that remains, beside what was observed. {counts}

No constant of the theory was fitted to these data. The works of adhesion of two experiments were,
by their authors.

- **Known**: how the observation is known, and the least known of the inputs: read in a public text,
  recalled from the literature, or assumed.
- **Predicted**: with every input in the middle of what is plausible. In brackets: limits over the
  error of the model and over all ends and corners of what is plausible.
- **Outcome**: whether these limits overlap with those of the observation, for every, some or no
  combination of the inputs; *value too* where the value itself agrees. An observation that a pair
  does not stick is compatible if the low limit is below {wanted}.
- **Depends on**: the unknown input that changes the prediction most.
- **Waves**: longest waves across what holds a sphere. The model needs about {waves} or more.
- *(relation)*: a reported relation, evaluated with the inputs of the case. It moves with them, so
  that brackets may overlap where no combination does. It rests on Persson and Tosatti's balance of
  energy: agreement with it is consistent, not a test. Relations and everyday pairs are not counted
  above.

"""
CRITERIA_HEAD = """

# Which criterion survives

✓ right whatever the unknown inputs, ≈ right for some of them, ✗ wrong for all, – not tested.

A pair counts as sticking if at least {wanted} of its adhesion remains. That is the measure of the
verdicts; other criteria ask whether anything holds. Where a limiting roughness was observed, a
criterion is right if it asks there for a work of adhesion within a factor of {factor} of the actual
one. That is wider than the limits of the table above. Criteria in whose terms an observation was
stated are not tested by it.

"""
COLUMNS = (
    *("experiment", "case", "quantity", "observed", "known", "predicted", "outcome"),
    *("depends on", "waves"),
)


def write_markdown(dataset, experiments):
    """Text of the page."""
    wanted = percent(DEFAULT_SHARE)
    head = HEAD.format(counts=count_outcomes(dataset), wanted=wanted, waves=number(FEWEST_WAVES))
    cases = [describe_case(dataset.sel(case=name), experiments) for name in dataset.case.values]
    parts = [head, table(COLUMNS, map(list_case, cases))]
    parts.append(CRITERIA_HEAD.format(wanted=wanted, factor=number(FACTOR)))
    labels = [criterion.label for criterion in CRITERIA.values()]
    rows = [
        (experiments[name]["label"], *(MARKS[code] for code in outcomes.values()))
        for name, outcomes in survivals(dataset).items()
    ]
    parts.append(table(("experiment", *labels), rows))
    if misses := explain_misses(dataset, experiments):
        parts.append("\n# Missed\n\n")
        parts += [f"- {label}: {reason}\n" for label, reason in misses.items()]
    parts.append("\n# Not found\n\n")
    for entry in experiments.values():
        parts += [f"- {entry['label']}: {text}\n" for text in entry.get("not_found", [])]
    parts.append("\n# Sources\n\n")
    for entry in experiments.values():
        note = f". {entry['note']}" if "note" in entry else ""
        parts.append(f"- {entry['label']}: {entry['citation']}{note}\n")
    return "".join(parts)


def list_case(case):
    """Cells of one row."""
    known = f"{case['known']}; inputs {case['least_known']}"
    return (
        *(case[name] for name in ("experiment", "case", "quantity", "observed")),
        known,
        *(case[name] for name in ("predicted", "outcome", "depends", "waves")),
    )
