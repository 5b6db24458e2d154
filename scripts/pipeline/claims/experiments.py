"""The paper's criterion, held against published experiments."""

from __future__ import annotations

import numpy as np

from pipeline.claims.ledger import NOT, QUALIFIED, REPRODUCED, Files, Finding, claim
from pipeline.experiments.judgements import MISSED, SOME
from pipeline.experiments.texts import compare_roughness, survivals
from pipeline.numbers import interval, number
from stickiness.core import datasets
from stickiness.core.statistics import students_t
from stickiness.criteria.registry import REMAINING

PAPER = "violano"


@claim(
    22,
    "the criterion says up to which roughness soft solids stick (held against experiments)",
    files=("experiments",),
)
def stickiness_of_experiments(files: Files) -> Finding:
    dataset = files["experiments"]
    labels = {
        name: entry["label"] for name, entry in datasets.parameters(dataset)["experiments"].items()
    }
    ratios, ours = (compare_roughness(dataset, name).values for name in (PAPER, REMAINING))
    outcomes = {name: found[PAPER] for name, found in survivals(dataset).items()}
    missed = [labels[name] for name, code in outcomes.items() if code == MISSED]
    partly = [labels[name] for name, code in outcomes.items() if code == SOME]
    verdict = NOT if missed else QUALIFIED if partly else REPRODUCED
    logs = np.log(ratios)
    value = float(np.exp(logs.mean()))
    scatter = float(students_t(logs.size) * logs.std(ddof=1) / np.sqrt(logs.size))
    return Finding(
        quantity="roughness up to which the criterion says sticky over that observed, geometric "
        "mean",
        value=value,
        claimed=1.0,
        verdict=verdict,
        remark=(
            f"Over the {logs.size} observations of a limiting roughness the ratio is "
            f"{interval(ratios.min(), ratios.max(), 2)}; that of the adhesion that remains is "
            f"{interval(ours.min(), ours.max(), 2)}. Whatever is plausible of the unknown inputs, "
            f"the criterion contradicts {number(len(missed))} of {number(len(outcomes))} "
            f"experiments: {'; '.join(missed) or 'none'}. Most values of these experiments are "
            "recalled or assumed; the table of experiments says which."
        ),
        errors={"sampling": value * float(np.expm1(scatter))},
        comment="sampling: Student's t of the logarithms of a few observations",
    )
