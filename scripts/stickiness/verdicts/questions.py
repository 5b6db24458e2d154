"""Questions that a measurement leaves open, and on which a verdict may depend.

A surface is also read by the other answer to each question. Where the threshold by one answer lies
beyond the limits by the other, the question is told, and limits contain both answers, so that the
verdict holds whichever is right. Otherwise it is harmless, and so is an answer by which the data
are implausible. Of several questions, not all combinations of answers are read.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stickiness.criteria.pair import TOUCHES, WORDS, decide
from stickiness.measured.guess import Guess
from stickiness.verdicts.limits import HIGH, LOW, VALUE
from stickiness.verdicts.pair_variables import DIMENSIONS

_TOLD = ("remaining", "modulus_threshold")  #: of each answer


def ask(
    cell: Mapping[str, Any], others: Sequence[tuple[Guess, Mapping[str, Any]]], wanted_share: float
) -> dict[str, Any]:
    """Numbers and codes of a pair whatever the answers, and the questions that decide.

    Parameters
    ----------
    cell : mapping
        Numbers and codes by the guesses, with a question where the waves end if that decides.
    others : sequence of (Guess, mapping)
        The same by the other answer to each of them.
    wanted_share : float
        Share that must remain for the pair to stick.

    Returns
    -------
    dict
        The cell with limits that contain all answers. `questions` has, as JSON, each question that
        decides with its answers: what they are in words, the options that give them, and the
        verdict, the share and the threshold by each. Where waves end is asked if nothing else is.
    """
    united = dict(cell)
    asked = []
    for guess, other in others:
        if cell["not_judged"] or other["not_judged"] or _agree(cell, other):
            continue
        asked.append(_tell(guess, cell, other))
        united = _unite_limits(united, other)
    if asked:
        low, _, high = united["remaining"]
        grows = any(each["verdict"] == TOUCHES for each in (cell, *(other for _, other in others)))
        united["verdict"] = decide(low, high, grows, wanted_share)
        united["questions"] = json.dumps(asked)
    return united


def ask_about_end(
    cell: Mapping[str, Any], as_measured: Mapping[str, Any], guess: Guess
) -> dict[str, Any]:
    """Ask where the waves end if that decides; limits contain both answers."""
    if as_measured["verdict"] == cell["verdict"] or cell["not_judged"]:
        return dict(cell)
    asked = [_tell(guess, cell, as_measured)]
    return _unite_limits(cell, as_measured) | {"questions": json.dumps(asked)}


def _tell(guess: Guess, cell: Mapping[str, Any], other: Mapping[str, Any]) -> dict[str, Any]:
    """A question with what would be by either answer."""
    told = zip(guess.answers, guess.options, (cell, other), strict=True)
    return {
        "question": guess.question,
        "answers": [_describe(words, options, by_it) for words, options, by_it in told],
    }


def _unite_limits(cell: Mapping[str, Any], other: Mapping[str, Any]) -> dict[str, Any]:
    """The cell with limits that contain those of the other, where both have them."""
    united = dict(cell)
    for name, dimensions in DIMENSIONS.items():
        if "limit" in dimensions and name in cell and name in other:
            united[name] = _unite(np.asarray(cell[name]), np.asarray(other[name]))
    united["probability"] = np.fmax(cell["probability"], other["probability"])
    united["probability_low"] = np.fmin(cell["probability_low"], other["probability_low"])
    return united


def _agree(cell: Mapping[str, Any], other: Mapping[str, Any]) -> bool:
    """Whether the threshold of each lies within the limits of the other."""
    mine, theirs = (each["plane_strain_modulus_threshold"] for each in (cell, other))
    return bool(
        theirs[LOW] <= mine[VALUE] <= theirs[HIGH] and mine[LOW] <= theirs[VALUE] <= mine[HIGH]
    )


def _unite(mine: NDArray, theirs: NDArray) -> NDArray:
    """Limits that contain both, ``(..., limit)``, about the value of the first."""
    united = mine.copy()
    united[..., LOW] = np.fmin(mine[..., LOW], theirs[..., LOW])
    united[..., HIGH] = np.fmax(mine[..., HIGH], theirs[..., HIGH])
    return united


def _describe(words: str, options: Mapping[str, str], cell: Mapping[str, Any]) -> dict[str, Any]:
    """One answer, as JSON can hold it: numbers are low limit, value and high limit."""
    numbers = {name: [float(number) for number in cell[name]] for name in _TOLD}
    return {
        "answer": words,
        "give": dict(options),
        "verdict": WORDS[int(cell["verdict"])],
        **numbers,
    }
