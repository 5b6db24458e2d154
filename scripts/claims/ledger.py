"""The ledger of claims: what a claim states, which files it reads and what it finds in them.

A claim is a function from files to a `Finding`, decorated with `claim`. It knows no number that it
could have read from a file.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import ModuleType

import numpy as np
import xarray as xr

from stickiness.error_budget import SOURCES

REPRODUCED = "reproduced"
QUALIFIED = "reproduced with a qualification"
NOT = "not reproduced"
OPEN = "not decided"
VERDICTS = (REPRODUCED, QUALIFIED, NOT, OPEN)

# A name that stands for several files has a list of datasets; a table is a pandas.DataFrame.
Files = Mapping[str, xr.Dataset]


@dataclass(frozen=True, kw_only=True)
class Finding:
    """What the files say about a claim.

    `errors` of the value, by their source, cover 90 %; NaN: not known; a source that is left out
    does not apply.
    """

    quantity: str  # what `value` is, with its unit
    value: float
    claimed: float = np.nan  # the paper's value, if it gives one
    verdict: str  # one of those above
    remark: str  # the qualification or the reason, with its numbers
    errors: Mapping[str, float] = field(default_factory=dict)
    comment: str = "as in the file of the value"  # what the errors are, or why there are none

    def __post_init__(self):
        if unknown := {*self.errors} - {*SOURCES} or {self.verdict} - {*VERDICTS}:
            raise ValueError(f"{self.quantity}: {unknown} is neither an error source nor a verdict")

    @property
    def uncertainty(self) -> float:
        """All errors in quadrature; NaN where one of them is not known."""
        return float(np.linalg.norm([*self.errors.values()])) if self.errors else 0.0


@dataclass(frozen=True)
class Claim:
    """A statement of the paper, the files that it is tested by, and the test."""

    number: int
    statement: str
    files: tuple[str, ...]  # as the rule names them; that of the value comes first
    examine: Callable[[Files], Finding]

    def __call__(self, files: Files) -> Finding:
        """Examine the claim with its own files out of all."""
        return self.examine({name: files[name] for name in self.files})


def claim(
    number: int, statement: str, files: tuple[str, ...] = ()
) -> Callable[[Callable[[Files], Finding]], Claim]:
    """Make the decorated function the claim with this number."""
    return lambda examine: Claim(number, statement, files, examine)


def collect(*topics: ModuleType) -> tuple[Claim, ...]:
    """Claims of some modules in the order of their numbers, which must be 1, 2, 3 …, each once."""
    claims = [found for topic in topics for found in vars(topic).values() if type(found) is Claim]
    claims.sort(key=lambda found: found.number)
    for position, found in enumerate(claims, 1):
        if found.number < position:
            raise ValueError(f"two claims have the number {found.number}: give each its own")
        if found.number > position:
            raise ValueError(f"no claim has the number {position}: numbers run from 1 without gaps")
    return tuple(claims)


def grade(fully: bool, partly: bool) -> str:
    """Verdict from whether the claim holds outright or within limits that the remark states."""
    return REPRODUCED if fully else QUALIFIED if partly else NOT
