"""The paper's criterion, held against published experiments."""

from __future__ import annotations

import numpy as np

from claims.ledger import NOT, OPEN, QUALIFIED, REPRODUCED, Files, Finding, claim
from common.formatting import percent, quantity
from experiments.entries import GRADES
from experiments.judgements import COMPATIBLE, MISSED, SILENT, SOME
from experiments.texts import INPUTS
from stickiness import datasets
from stickiness.remaining.prediction import DEFAULT_SHARE

PAPER = "violano"
RUBBER = "fuller_tabor/one_MPa"


@claim(
    22,
    "the criterion says what sticks among soft solids (held against experiments)",
    files=("experiments",),
)
def stickiness_of_experiments(files: Files) -> Finding:
    dataset = files["experiments"]
    experiments = datasets.parameters(dataset)["experiments"]
    rubber = dataset.sel(case=RUBBER)
    limit = float(rubber.criterion_roughness.sel(criterion=PAPER))
    read = (dataset.tests == 1) & (dataset.observed_known == GRADES.index("read"))
    codes = dataset.criterion_outcome.sel(criterion=PAPER).where(read, SILENT)
    named = {
        code: [name_case(str(c), experiments) for c in codes.case.values[codes.values == code]]
        for code in (COMPATIBLE, SOME, MISSED)
    }
    at = quantity(float(rubber.h_rms), float(rubber.h_rms), "m", 2)
    return Finding(
        quantity="rms height up to which the criterion says that rubber of 1 MPa sticks [um]",
        value=limit * 1e6,
        verdict=decide(named),
        remark=(
            f"At an rms height of {at} such rubber was seen to lose its adhesion, or almost. The "
            f"adhesion that remains there is {percent(float(rubber.relative_pull_off))} of the "
            f"smooth pull-off ({percent(float(rubber.relative_pull_off_lowest))} to "
            f"{percent(float(rubber.relative_pull_off_highest))}). Of the observations that could "
            f"be read, the criterion contradicts {join(named[MISSED])} whatever the unknown "
            f"inputs, agrees with {join(named[SOME])} for some of them, and with "
            f"{join(named[COMPATIBLE])} for all. What is unknown is most often the "
            f"{INPUTS['longest_wavelength']}. To stick is to keep {percent(DEFAULT_SHARE)} of the "
            "adhesion. Observations that are only recalled or assumed do not count here."
        ),
        errors={"model": np.nan},
        comment="model: not known, for the spectrum of the roughened surface is not",
    )


def decide(named: dict[int, list[str]]) -> str:
    """Verdict from the observations that were read."""
    if named[MISSED]:
        return NOT
    if named[SOME]:
        return QUALIFIED
    return REPRODUCED if named[COMPATIBLE] else OPEN


def name_case(case: str, experiments: dict) -> str:
    """Author and label of a case."""
    experiment, name = case.split("/")
    entry = experiments[experiment]
    return f"{entry.get('short', entry['label'])} ({entry['cases'][name]['label']})"


def join(names: list[str]) -> str:
    """Names in a row, or none."""
    return "; ".join(names) or "none"
