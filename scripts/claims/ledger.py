"""The ledger of claims: which files test a claim, and what they say about it.

A claim is a function from files by name (datasets, lists of them or tables) to a `Finding`,
decorated with `claim`. It takes every number from a file or a closed form. Its statement and remark
are in ``report/claims.j2``.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from stickiness import datasets, error_budget
from stickiness.error_budget import SOURCES

REPRODUCED = "reproduced"
QUALIFIED = "reproduced with a qualification"
NOT = "not reproduced"
OPEN = "not decided"
VERDICTS = (REPRODUCED, QUALIFIED, NOT, OPEN)


@dataclass(frozen=True, kw_only=True)
class Finding:
    """What the files say about a claim."""

    value: float
    verdict: str  # one of `VERDICTS`
    claimed: float = np.nan  # the paper's value, NaN if it gives none
    # By source, each covering 90 %; NaN if not known. A source that does not apply is left out.
    errors: dict = field(default_factory=dict)
    facts: dict = field(default_factory=dict)  # further numbers and names for the remark

    def __post_init__(self):
        if unknown := {*self.errors} - {*SOURCES} or {self.verdict} - {*VERDICTS}:
            raise ValueError(f"{unknown} is neither an error source nor a verdict")

    @property
    def uncertainty(self):
        """All errors in quadrature; NaN if one of them is not known."""
        return float(np.linalg.norm([*self.errors.values()])) if self.errors else 0.0


@dataclass(frozen=True)
class Claim:
    """A claim of the paper: its number, the files that test it, and the test."""

    number: int
    files: tuple[str, ...]  # as the rule names them; the file of the value comes first
    examine: Callable

    def __call__(self, files):
        """Examine the claim with its files out of all."""
        return self.examine({name: files[name] for name in self.files})


def claim(number, *files):
    return lambda examine: Claim(number, files, examine)


def collect(*topics):
    """Claims of some modules, sorted by number; ValueError unless they run from 1 on."""
    claims = [found for topic in topics for found in vars(topic).values() if type(found) is Claim]
    claims.sort(key=lambda found: found.number)
    for position, found in enumerate(claims, 1):
        if found.number < position:
            raise ValueError(f"two claims have the number {found.number}: give each its own")
        if found.number > position:
            raise ValueError(f"no claim has the number {position}: numbers run from 1 without gaps")
    return tuple(claims)


def grade(fully, partly):
    """Verdict on a claim that is true outright, or within limits that the remark states."""
    return REPRODUCED if fully else QUALIFIED if partly else NOT


def errors_by_source(data, name):
    """Errors of a single number by source."""
    return {source: float(error_budget.part(data, name, source)) for source in SOURCES}


def value_and_error(data, name):
    """A single number of a dataset with its total error."""
    return float(data[name]), float(error_budget.total_error(data, name))


def describe_cell(data):
    """Magnification of a simulated case, and the side of its cell in longest wavelengths."""
    made = datasets.parameters(data)
    return {"zeta": made["magnification"], "waves": made.get("window", 1)}
