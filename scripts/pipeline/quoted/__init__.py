"""Numbers that README.md and docs quote from results, as texts by their names.

`docs/fill_numbers.py` writes them into the pages. Every function here takes `Sources` and returns
some of the texts. They come from the functions that claims and report use.
"""

from collections.abc import Iterator

from pipeline.quoted import (
    accuracy,
    adhesion,
    claims,
    contact,
    experiments,
    remaining,
    theory,
    times,
    verdicts,
)
from pipeline.quoted.sources import Sources

TOPICS = (claims, contact, theory, adhesion, remaining, verdicts, experiments, accuracy, times)


def quote_all(sources: Sources) -> dict[str, str]:
    """Texts of all numbers by their names; ValueError if two have one name."""
    texts: dict[str, str] = {}
    for name, text in list_numbers(sources):
        if name in texts:
            raise ValueError(f"two numbers are called {name}: give each its own name")
        texts[name] = text
    return texts


def list_numbers(sources: Sources) -> Iterator[tuple[str, str]]:
    """Names and texts of all topics."""
    for topic in TOPICS:
        for quote in topic.NUMBERS:
            yield from quote(sources).items()
