"""What a finished run holds, in a few lines for the terminal."""

from collections import Counter
from collections.abc import Iterable
from pathlib import Path

from stickiness import datasets
from stickiness.criteria.pair import WORDS


def summary(results: str, since: float, answers: Iterable[str] = ()) -> str:
    """Where the report is, how claims and pairs came out, and which cases missed their accuracy.

    `results` is the folder, `answers` those files of cases that ask for an accuracy. Files are left
    out that were written before `since` [s since the epoch], which are of an earlier run.
    """
    lines = [("results", results), *grades(Path(results), since), *misses(answers)]
    report = Path(results, "report/report.html")
    if is_new(report, since):
        lines.insert(1, ("report", str(report)))
    pages = [
        page for page in Path(results, "report/surfaces").glob("*.html") if is_new(page, since)
    ]
    if pages:
        lines.append(("pages", ", ".join(map(str, sorted(pages)))))
    return "\n".join(f"  {what:<9} {text}" for what, text in lines)


def is_new(path: Path, since: float) -> bool:
    """Whether a file was written after a time."""
    return path.exists() and path.stat().st_mtime >= since


def grades(results: Path, since: float) -> list[tuple[str, str]]:
    """Which claims hold and which pairs stick, as far as this run has found it out."""
    lines = []
    claims, verdicts = results / "claims/claims.nc", results / "criteria/verdicts.nc"
    if is_new(claims, since):
        lines.append(("claims", count(datasets.read(claims, ["verdict"]).verdict.values)))
    if is_new(verdicts, since):
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
