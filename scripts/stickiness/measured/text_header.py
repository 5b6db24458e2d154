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
_FACTOR = re.compile(
    r"\b(factor|scal(e|ing)|multiplier|conversion|bits?\s*to|per\s+(count|bit|digit|lsb))\b",
    re.IGNORECASE,
)
_NUMBER = re.compile(r"[-+]?\d*\.?\d+(?:[eE][-+]?\d+)?")
_COLUMNS = re.compile(
    r"\b(?:x[-_ ]?pixels?|columns|cols|nx|x[-_ ]?res(?:olution)?|points per line|w)\s*[:=]\s*(\d+)",
    re.IGNORECASE,
)
_ROWS = re.compile(
    r"\b(?:y[-_ ]?pixels?|rows|lines|ny|y[-_ ]?res(?:olution)?|h)\s*[:=]\s*(\d+)", re.IGNORECASE
)
_BOTH = re.compile(
    r"\b(?:resolution|pixels|points|grid|shape)\s*[:=]\s*(\d+)\s*[x×*,]\s*(\d+)", re.IGNORECASE
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


def check_counts(path: Path, lines: Iterable[str], shape: tuple[int, int]) -> None:
    """Refuse a matrix (rows, columns) whose header states other numbers of them."""
    for line in lines:
        both = _BOTH.search(line)
        stated = both.groups() if both else (_COLUMNS.search(line), _ROWS.search(line))
        for said, found, what in zip(stated, shape[::-1], ("columns", "rows"), strict=True):
            count = said if said is None or isinstance(said, str) else said[1]
            if count is not None and int(count) != found:
                raise ValueError(
                    f"{path}: {found} {what}, but its header says {line.strip()!r}; is the file "
                    "complete, and do decimal commas or separators split its numbers?"
                )
