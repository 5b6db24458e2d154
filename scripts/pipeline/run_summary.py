"""What a finished run holds, in a few lines for the terminal."""

from collections import Counter
from collections.abc import Iterable
from pathlib import Path

from stickiness.core import datasets
from stickiness.criteria.pair import WORDS


def summary(results: str, answers: Iterable[str] = ()) -> str:
    """Where the report is, how claims and pairs came out, and which cases missed their accuracy.

    `results` is the folder, `answers` those files of cases that ask for an accuracy.
    """
    lines = [("results", results), *grades(Path(results)), *misses(answers)]
    report = Path(results, "report/report.html")
    if report.exists():
        lines.insert(1, ("report", str(report)))
    return "\n".join(f"  {what:<9} {text}" for what, text in lines)


def grades(results: Path) -> list[tuple[str, str]]:
    """Which claims hold and which pairs stick, as far as there are files of them."""
    lines = []
    claims, verdicts = results / "claims/claims.nc", results / "criteria/verdicts.nc"
    if claims.exists():
        lines.append(("claims", count(datasets.read(claims, ["verdict"]).verdict.values)))
    if verdicts.exists():
        codes = datasets.read(verdicts, ["verdict"]).verdict.values.ravel()
        lines.append(("pairs", count(WORDS[code] for code in codes)))
    return lines


def misses(answers: Iterable[str]) -> list[tuple[str, str]]:
    """Cases that are less accurate than they ask for, of those that are answered."""
    read = (datasets.read(path) for path in answers if Path(path).exists())
    return [("missed", answer.attrs["missed"]) for answer in read if "missed" in answer.attrs]


def count(words: Iterable[str]) -> str:
    """The words by their number: ``23 does not stick, 12 sticks``."""
    return ", ".join(f"{n} {word}" for word, n in Counter(map(str, words)).most_common())
