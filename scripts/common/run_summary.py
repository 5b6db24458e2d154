"""What a finished run holds, in a few lines for the terminal."""

from collections import Counter
from pathlib import Path

from stickiness import datasets
from stickiness.criteria.pair import WORDS


def summary(results, since, answers=()):
    """Where the report is, how claims and pairs came out, and which cases missed their accuracy.

    `results` is the folder, `answers` those files of cases that ask for an accuracy. Files are left
    out that were written before `since` [s since the epoch], which are of an earlier run.
    """

    def find(pattern):
        paths = sorted(Path(results).glob(pattern))
        return [path for path in paths if path.stat().st_mtime >= since]

    lines = [("results", results)]
    lines += [("report", path) for path in find("report/report.html")]
    for path in find("claims/claims.nc"):
        lines.append(("claims", count(datasets.read(path, ["verdict"]).verdict.values)))
    for path in find("criteria/verdicts.nc"):
        codes = datasets.read(path, ["verdict"]).verdict.values.ravel()
        lines.append(("pairs", count(WORDS[code] for code in codes)))
    found = [datasets.read(path) for path in answers if Path(path).exists()]
    lines += [("missed", one.attrs["missed"]) for one in found if "missed" in one.attrs]
    if pages := find("report/surfaces/*.html"):
        lines.append(("pages", ", ".join(map(str, pages))))
    return "\n".join(f"  {what:<9} {text}" for what, text in lines)


def count(words):
    """The words by their number: ``23 does not stick; 12 sticks``."""
    return "; ".join(f"{n} {word}" for word, n in Counter(map(str, words)).most_common())
