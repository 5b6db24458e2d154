"""What a finished run holds, in a few lines for the terminal."""

from collections import Counter
from pathlib import Path

from stickiness import datasets
from stickiness.criteria.pair import WORDS


def summary(results, since, answers=()):
    """Where the report is, how claims and pairs came out, and which cases missed their accuracy.

    `answers` are the files of cases with an accuracy. Files that were written before `since` [s
    since the epoch] are left out.
    """

    def find(pattern):
        return [path for path in Path(results).glob(pattern) if path.stat().st_mtime >= since]

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
        lines.append(("pages", ", ".join(sorted(map(str, pages)))))
    return "\n".join(f"  {what:<9} {text}" for what, text in lines)


def count(words):
    """The words by their number: ``23 does not stick; 12 sticks``."""
    return "; ".join(f"{n} {word}" for word, n in Counter(map(str, words)).most_common())
