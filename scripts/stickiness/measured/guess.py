"""Questions about a measurement that its data leave open.

Some of what was done to heights rests on a guess, such as that a step along the rows of a scan is a
jump of the probe. Verdicts are found for both answers. Where these differ, the user is asked.
"""

from typing import Any, NamedTuple


class Guess(NamedTuple):
    """A question, and its answers; the first is the one that was taken."""

    question: str
    answers: Any  #: two of them, in words
    options: Any  #: keys and values of a measured surface by which a user gives either


def guess_fault(questions: list[str]) -> Guess:
    """Guess that what may be a fault of the scan, by these questions, is one."""
    return Guess(
        question=" ".join(questions),
        answers=("a fault of the scan", "the surface itself"),
        options=({"scan": "mend"}, {"scan": "keep"}),
    )


def guess_place(feature: str) -> Guess:
    """Guess that contacts with a feature of the map are meant."""
    return Guess(
        question=f"{feature}. Does the contact hold it, or is the surface elsewhere meant?",
        answers=("a contact with it", "the surface elsewhere"),
        options=({"features": "keep"}, {"features": "beside"}),
    )


def guess_pattern(question: str) -> Guess:
    """Guess that what may be hum, by this question, is a pattern of the surface."""
    return Guess(
        question=question,
        answers=("a pattern of the surface", "hum"),
        options=({"scan": "keep"}, {"scan": "mend"}),
    )


def guess_side(named: str, skewness: float) -> Guess:
    """Guess that heights are those of the surface, though they are named like a replica."""
    return Guess(
        question=f"Are these heights ({named!r}, skewness {skewness:.2g}) those of the surface, or "
        "of a replica, which is upside down?",
        answers=("the surface itself", "a replica"),
        options=({"invert": False}, {"invert": True}),
    )


def guess_end(shortest: str) -> Guess:
    """Guess that waves may go on below the shortest that was resolved."""
    return Guess(
        question=f"Do waves go on below {shortest}, the shortest that the measurement resolves?",
        answers=(
            "they may go on, which a finer map of a smaller part would tell",
            "they end there",
        ),
        options=({}, {"extend_to": shortest}),
    )
