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

REPRODUCED = "reproduced"
QUALIFIED = "reproduced with a qualification"
NOT = "not reproduced"
OPEN = "not decided at this resolution"

Files = Mapping[str, xr.Dataset]  # a name that stands for several files has a list of datasets


@dataclass(frozen=True, kw_only=True)
class Finding:
    """What the files say about a claim.

    Attributes
    ----------
    quantity : str
        What `value` is, with its unit.
    value, claimed : float
        Value measured here, and the paper's (NaN where it gives none).
    verdict : str
        One of the verdicts above.
    remark : str
        The qualification or the reason, with its numbers.
    errors : mapping of str to float
        Errors of the value by their source, covering 90 %. NaN: not known; a source that is left
        out does not apply.
    comment : str
        What the errors are, or why they are not known or do not apply.
    """

    quantity: str
    value: float
    claimed: float = np.nan
    verdict: str
    remark: str
    errors: Mapping[str, float] = field(default_factory=dict)
    comment: str = "as in the file of the value"

    @property
    def uncertainty(self) -> float:
        """All errors in quadrature; NaN where one of them is not known."""
        return float(np.linalg.norm([*self.errors.values()])) if self.errors else 0.0


@dataclass(frozen=True)
class Claim:
    """A statement of the paper, the files that it is tested by, and the test.

    Attributes
    ----------
    number : int
        Position in the ledger.
    statement : str
        What the paper claims.
    files : tuple of str
        Names of the files it reads, as the rule gives them; that of the value comes first.
    examine : callable
        Finds in these files, and no others, whether the claim holds.
    """

    number: int
    statement: str
    files: tuple[str, ...]
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
    """Claims of some modules in the order of their numbers.

    Raises
    ------
    ValueError
        If the numbers are not 1, 2, 3 … with each there once.
    """
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
