"""The shape of a claim: a value, its errors, and a verdict on it by a criterion.

A claim is a function from the files that its parameters name (datasets, lists of them or tables) to
a `Finding`. It takes every number from a file or a closed form. Its statement and remark are in
``report/claims.j2``.
"""

import inspect
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from stickiness import datasets, error_budget
from stickiness.error_budget import SOURCES

REPRODUCED = "reproduced"
QUALIFIED = "reproduced with a qualification"
NOT = "not reproduced"
OPEN = "not decided"
DIFFERS = "not checked: the configuration differs"  # in a parameter that the claim is about
VERDICTS = (REPRODUCED, QUALIFIED, NOT, OPEN, DIFFERS)


class Finding:
    """What the files say about a claim.

    `claimed` is the paper's value, NaN if it gives none. `errors`, by source, cover 90 % each; NaN
    if not known, left out if a source does not apply. `facts` are further numbers and names for the
    remark.
    """

    def __init__(self, value, verdict, claimed=np.nan, errors=None, **facts):
        self.value = float(value)
        self.verdict = verdict
        self.claimed = float(claimed)
        self.errors = errors or {}
        self.facts = facts

    @property
    def uncertainty(self):
        """All errors in quadrature; NaN if one of them is not known."""
        return float(np.linalg.norm([*self.errors.values()])) if self.errors else 0.0


@dataclass(frozen=True)
class Claim:
    """A claim of the paper by its number, and the function that tests it."""

    number: int
    examine: Callable

    @property
    def files(self):
        """Names of the files that it reads; the file of the value comes first."""
        return tuple(inspect.signature(self.examine).parameters)

    def __call__(self, files):
        """Examine the claim with its files out of all."""
        return self.examine(*(files[name] for name in self.files))


def claim(number):
    """Decorator that makes a claim of a function that examines it."""

    def register(examine):
        return Claim(number, examine)

    return register


def collect(*topics):
    """Claims of some modules by number."""
    claims = [
        member for topic in topics for member in vars(topic).values() if type(member) is Claim
    ]
    return sorted(claims, key=lambda member: member.number)


def grade(fully, partly):
    """Verdict on a claim that is true outright, or within limits that the remark states."""
    if fully:
        return REPRODUCED
    return QUALIFIED if partly else NOT


def errors_by_source(data, name):
    """Errors of a single number by source."""
    return {source: float(error_budget.part(data, name, source)) for source in SOURCES}


def value_and_error(data, name):
    """A single number of a dataset with its total error."""
    return float(data[name]), float(error_budget.total_error(data, name))


def describe_cell(data):
    """Hurst exponent, magnification and side of the cell, in longest wavelengths, of a case."""
    surface = datasets.parameters(data)
    return {
        "hurst": surface["hurst"],
        "zeta": surface["magnification"],
        "waves": surface["window"],
    }


def choose(data, **paper):
    """Points of a dataset nearest to those of the paper, by dimension.

    If the configuration lacks these, `common.paper` says so, and the claim has no grade.
    Texts therefore take the parameters from the coordinates of the chosen points.
    """
    for name, values in paper.items():
        ordered = data.sortby(name)
        nearest = ordered[name].sel({name: np.asarray(values)}, method="nearest")
        data = ordered.sel({name: np.unique(nearest) if np.ndim(values) else nearest})
    return data
