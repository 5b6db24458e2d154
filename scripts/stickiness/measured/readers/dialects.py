"""How programs write maps as text: a declaration for each of them.

Tables of numbers are alike (`text` and `tables` read them); what their headers tell is not. To read
another program's text, add a `Dialect` to `DIALECTS`, and a small file of it with a row in
`tests/data/instruments/files.yaml`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from stickiness.measured.readers import grids
from stickiness.measured.readers.raw import Raw

#: What a header tells, in its words: the sides "width" and "height", "pixel" (a side of it), all
#: with units; the steps "dx" and "dy" in the "lateral unit"; the "value unit" of the heights; the
#: "missing" value; and "decimal", the mark before decimals.
Fields = dict[str, str]


def _tell_nothing(lines: list[str]) -> Fields:
    return {}


@dataclass(frozen=True)
class Dialect:
    """Text as one program writes it."""

    name: str
    recognise: re.Pattern[str]  #: found in a line of the header, or in the first line of the file
    fields: Callable[[list[str]], Fields] = _tell_nothing  #: what the lines of a header tell
    #: Reader of the whole file, which the first line names; None if a table of numbers follows.
    heights: Callable[[Path, list[str]], Raw] | None = None
    counts: tuple[str, str] | None = None  #: patterns of the numbers of columns and of rows

    def find(self, lines: list[str]) -> str | None:
        """First line by which the dialect is recognised."""
        return next(filter(self.recognise.search, lines), None)


def read_fields(lines: list[str]) -> Fields:
    """What a header tells in any dialect; a later one of `DIALECTS` overrides an earlier one."""
    fields: Fields = {}
    for dialect in DIALECTS:
        if dialect.find(lines) is not None:
            fields |= dialect.fields(lines)
    return fields


def find_counts(lines: list[str], axis: int) -> list[tuple[int, str]]:
    """Numbers of columns (axis 0) or rows (axis 1), and the lines that tell them."""
    matches = filter(None, map(_COUNTS[axis].search, lines))
    return [(int(match[match.lastindex or 0]), match.string) for match in matches]


def _match(pattern: re.Pattern[str], lines: list[str]) -> Iterator[re.Match[str]]:
    return filter(None, map(pattern.match, lines))


def _match_last(pattern: re.Pattern[str], lines: list[str]) -> re.Match[str] | None:
    return next(_match(pattern, lines[::-1]), None)


def _count(names: str) -> str:
    """Pattern of a number of points: at the start of a line or after another, without a unit."""
    return rf"(?:^\W*|\d[\s,;]+)(?:{names})\s*[:=,;]\s*(\d+)(?![\w./])"


# Gwyddion writes its fields in the language of its user, and other programs several in a line.

_GERMAN = {
    "breite": "width",
    "höhe": "height",
    "werteinheit": "value unit",
    "laterale einheit": "lateral unit",
}
_NAMES = "|".join([*_GERMAN, *_GERMAN.values()])
_FIELD = re.compile(rf"(?i)^\W*({_NAMES})(?:s|en)?\s*[:=]\s*(.+?)\s*$")
# What stands before another field in one line, or before a number of points.
_NEXT_FIELD = re.compile(rf"(?i)[\s,;]+(?=(?:(?:{_NAMES})(?:s|en)?|\d+\s*[x×]\s*\d+)\b)")


def _read_gwyddion(lines: list[str]) -> Fields:
    apart = [field for line in lines if _FIELD.match(line) for field in _NEXT_FIELD.split(line)]
    told = {match[1].lower(): match[2] for match in _match(_FIELD, apart)}
    fields = {_GERMAN.get(name, name): value for name, value in told.items()}
    if _GERMAN.keys().isdisjoint(told):
        return fields
    return {name: value.replace(",", ".") for name, value in fields.items()} | {"decimal": ","}


# Grids of geographic information systems: a number behind a key, without a unit.

_CELL = re.compile(r"(?i)^\W*(cellsize|dx|dy|nodata_value)\s+([-+.\deE]+)\s*$")


def _read_grid(lines: list[str]) -> Fields:
    told = {match[1].lower(): match[2] for match in _match(_CELL, lines)}
    fields = {axis: told[axis] for axis in ("dx", "dy") if axis in told}
    if "cellsize" in told:
        fields = {"dx": told["cellsize"], "dy": told["cellsize"], "missing": "-9999"}
    return fields | ({"missing": told["nodata_value"]} if "nodata_value" in told else {})


# Keyence's microscopes.

_CALIBRATION = re.compile(r"(?i)^xy[ -](?:calibration|justierung)\W+([\d.]+)\W+(\w+)")
_UNIT = re.compile(r"(?i)^(?:unit|einheit)\s*[,;:\t]\s*(\S+)\s*$")


def _read_keyence(lines: list[str]) -> Fields:
    fields = {}
    if pixel := _match_last(_CALIBRATION, lines):
        fields["pixel"] = f"{pixel[1]} {pixel[2]}"
    if unit := _match_last(_UNIT, lines):
        fields["value unit"] = unit[1]
    return fields


# NanoScope.

_SCAN = re.compile(r"(?i)^\W*scan size\s*[:=]\s*([\d.]+)(?:\s+([\d.]+))?\s*([\w~]+)\s*$")
_ASPECT = re.compile(r"(?i)^\W*aspect ratio\s*[:=]\s*([\d.]+)\s*:\s*([\d.]+)")


def _read_nanoscope(lines: list[str]) -> Fields:
    scan = _match_last(_SCAN, lines)
    if scan is None:
        return {}
    unit = scan[3].replace("~", "u")
    aspect = _match_last(_ASPECT, lines)
    ratio = float(aspect[2]) / float(aspect[1]) if aspect else 1.0
    height = float(scan[2]) if scan[2] else float(scan[1]) * ratio
    return {"width": f"{scan[1]} {unit}", "height": f"{height:.6g} {unit}"}


#: Text of instruments that SurfaceTopography reads and `text` does not.
INSTRUMENTS = Dialect(
    name="instruments",
    recognise=re.compile(
        r"(?i)pixel\s+size\s*=|height\s+conversion\s+factor|\b[xy]-length\b|\b[xyz]-unit\b"
        r"|\bbit2nm\b|wyko ascii|file format\s*=\s*ascii|^\W*unit (x|data)\s*=|^\W*scale [xy]\s*="
        r"|^\s*x;y;valid|^\s*scan data\b|^\W*lateral um"
    ),
)

DIALECTS = (
    Dialect(
        name="any program",
        recognise=re.compile(""),
        counts=(
            _count(r"nx|columns|cols|x[-_ ]?pixels?"),
            _count(r"ny|rows|y[-_ ]?pixels?"),
        ),
    ),
    Dialect(name="Gwyddion", recognise=_FIELD, fields=_read_gwyddion),
    Dialect(
        name="ESRI",
        recognise=_CELL,
        fields=_read_grid,
        counts=(r"^\W*ncols\s+(\d+)\s*$", r"^\W*nrows\s+(\d+)\s*$"),
    ),
    Dialect(
        name="Keyence",
        recognise=_CALIBRATION,
        fields=_read_keyence,
        counts=(
            r"^horizont(?:al|\.)\s*[,;:\t]\s*(\d+)\s*$",
            r"^(?:vertical|vertik\.)\s*[,;:\t]\s*(\d+)\s*$",
        ),
    ),
    Dialect(
        name="NanoScope",
        recognise=_SCAN,
        fields=_read_nanoscope,
        counts=(_count("samps/line"), _count("number of lines")),
    ),
    Dialect(
        name="Surfer",
        recognise=re.compile(r"^\s*DSAA\s*$"),
        heights=grids.read_surfer_text,
    ),
    Dialect(
        name="Zygo",
        recognise=re.compile(r"(?i)^\s*zygo (xyz|ascii) data file"),
        heights=grids.read_zygo,
    ),
)
_COUNTS = [
    re.compile("|".join(patterns), re.IGNORECASE)
    for patterns in zip(*(dialect.counts for dialect in DIALECTS if dialect.counts), strict=True)
]
