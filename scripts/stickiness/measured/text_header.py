"""Header of a text file of heights: what it says of size, unit, factor and number of points.

The header that Gwyddion writes in English (Width, Height, Value units) is read here. Headers of
instruments (Wyko, SPIP, Nova, Attocube, Gwyddion in other languages) are SurfaceTopography's. A
factor that neither knows is refused, because heights without it are wrong in silence.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

_OWN = re.compile(
    r"^\W*(width|height|value units?|lateral units?)\s*[:=]\s*(.+?)\s*$", re.IGNORECASE
)
# What SurfaceTopography takes from headers and this reader does not.
_OF_INSTRUMENTS = re.compile(
    r"pixel\s+size\s*=|height\s+conversion\s+factor|\b[xy]-length\b|\b[xyz]-unit\b|\bbit2nm\b"
    r"|wyko ascii|file format\s*=\s*ascii|^\W*unit (x|data)\s*=|^\W*scale [xy]\s*="
    r"|^\W*(Šířka|Breite|Anchura|Largeur|Larghezza|幅|폭|Largura|Ширина)\s*[:：]"
    r"|^\s*x;y;valid|^\s*scan data\b|^\W*lateral um",
    re.IGNORECASE,
)
_FACTORS = r"z?(?:factor|scal(?:e|ing)|multiplier|conversion)"
_PER_COUNT = r"(?:(?:\bper|/)\s*(?:counts?|bits?|digits?|lsb)|\bbits?\s*to)(?![a-z])"
_OF_HEIGHTS = r"(?:z|heights?|data|values?|elevations?|counts?|vertical)"
_BESIDE = r"[\s_()\[\]-]+(?:[a-z]+[\s_()\[\]-]+)?"  # at most one word between
# A factor of the heights says so, has a unit per count, or no other word before its number:
# zoom, colours and axes have factors and scales of their own.
_FACTOR = re.compile(
    rf"(?<![a-z]){_OF_HEIGHTS}{_BESIDE}{_FACTORS}(?![a-z])"
    rf"|(?<![a-z]){_FACTORS}{_BESIDE}{_OF_HEIGHTS}(?![a-z])|(?<![a-z])z{_FACTORS}(?![a-z])"
    rf"|{_PER_COUNT}|^\W*(?:{_FACTORS}[\s_-]*)+(?:[:=]|$|[-+\d.])",
    re.IGNORECASE,
)
_NUMBER = re.compile(r"[-+]?\d*\.?\d+(?:[eE][-+]?\d+)?")
# A number of points: whole, and not that of a length or of points per length.
_UNITS = r"(?:[pnuµμmckf]?m|microns?|[a-z]*met(?:er|re)s?|å|a|mil|inch|in|dpi|ppi|deg|%|°)"
_COUNT = rf"(\d+)(?!\d|[.,]\d|e[-+]?\d|\s*(?:{_UNITS}(?![a-z])|/))"
_START = r"(?:^\W*|\d[\s,;]+)(?:(?:number|no\.?)\s+of\s+)?"  # of a line, or after another number
_COLUMNS = re.compile(
    r"(?:\b(?:x[-_ ]?pixels?|nx|x[-_ ]?res(?:olution)?|points per line)"
    rf"|{_START}(?:columns|cols))\s*[:=]\s*{_COUNT}",
    re.IGNORECASE,
)
_ROWS = re.compile(
    rf"(?:\b(?:y[-_ ]?pixels?|ny|y[-_ ]?res(?:olution)?)|{_START}(?:rows|lines))\s*[:=]\s*{_COUNT}",
    re.IGNORECASE,
)
_BOTH = re.compile(
    rf"\b(?:resolution|pixels|points|grid|shape)\s*[:=]\s*(\d+)\s*[x×*,]\s*{_COUNT}", re.IGNORECASE
)


def is_of_instrument(lines: Iterable[str]) -> bool:
    """Whether a header has what SurfaceTopography reads and this package does not."""
    return any(_OF_INSTRUMENTS.search(line) for line in lines)


def fields_of(lines: Iterable[str]) -> dict[str, str]:
    """Width, height, value_unit and lateral_unit, as far as a header has them."""
    found = {}
    for line in lines:
        if match := _OWN.match(line):
            key = match[1].lower().removesuffix("s")
            found[key.replace(" ", "_")] = match[2]
    return found


def check_factor(path: Path, lines: Iterable[str]) -> None:
    """Refuse a header with a size, unit or factor that is not read."""
    for line in lines:
        if _OF_INSTRUMENTS.search(line):
            raise ValueError(
                f"{path}: its header says {line.strip()!r}, which the text reader does not take; "
                "give format: instrument"
            )
        if _FACTOR.search(line) and _NUMBER.search(line):
            raise ValueError(
                f"{path}: its header says {line.strip()!r}, which is not read; apply it to the "
                "heights and remove the line, or try format: instrument"
            )


def check_counts(path: Path, lines: Iterable[str], *shapes: tuple[int, int]) -> None:
    """Refuse a file whose header states numbers of columns and rows that it does not have.

    `shapes` are (columns, rows) that the header may mean. Messages name those of the first.
    """
    for line in lines:
        both = _BOTH.search(line)
        stated = both.groups() if both else (_COLUMNS.search(line), _ROWS.search(line))
        for said, found, what in zip(
            stated, zip(*shapes, strict=True), ("columns", "rows"), strict=True
        ):
            count = said if said is None or isinstance(said, str) else said[1]
            if count is not None and int(count) not in found:
                raise ValueError(
                    f"{path}: {found[0]} {what}, but its header says {line.strip()!r}; is the file "
                    "complete, and do decimal commas or separators split its numbers?"
                )
