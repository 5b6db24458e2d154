"""Experiments as a page of Markdown."""

from pipeline.experiments.judgements import FACTOR
from pipeline.experiments.texts import (
    MARKS,
    WANTED,
    describe_case,
    explain_misses,
    survivals,
)
from pipeline.numbers import number, table
from stickiness.criteria.registry import CRITERIA

HEAD = """\
# Published experiments

Predictions by the adhesion that remains, beside what was observed. **Known**: how the observation
is known, and the least known of the inputs (read in a public text, recalled from the literature, or
assumed). **Predicted**: with every input in the middle of what is plausible; in brackets the limits
over the model's error and over all that is plausible. **Outcome**: whether the prediction's limits
reach those of the observation, for every, some or no combination of the inputs. **Depends on**: the
unknown input that changes the prediction most. Nothing was fitted to these experiments.

"""
CRITERIA_HEAD = """

# Which criterion survives

✓ right whatever the unknown inputs, ≈ right for some of them, ✗ wrong for all, – nothing to decide.
A pair sticks if at least {wanted} of the adhesion remains. Where the roughness was observed at
which adhesion falls to a tenth, a criterion is right if its own limit lies within a factor of
{factor}.

"""
COLUMNS = (
    *("experiment", "case", "quantity", "observed", "known", "predicted", "outcome", "depends on"),
)


def write_markdown(dataset, experiments):
    """Text of the page."""
    cases = [describe_case(dataset.sel(case=name), experiments) for name in dataset.case.values]
    parts = [HEAD, table(COLUMNS, map(list_case, cases))]
    parts.append(CRITERIA_HEAD.format(wanted=WANTED, factor=number(FACTOR)))
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
    parts += [f"- {entry['label']}: {entry['citation']}\n" for entry in experiments.values()]
    return "".join(parts)


def list_case(case):
    """Cells of one row."""
    known = f"{case['known']}; inputs {case['least_known']}"
    return (
        *(case[name] for name in ("experiment", "case", "quantity", "observed")),
        known,
        *(case[name] for name in ("predicted", "outcome", "depends")),
    )
