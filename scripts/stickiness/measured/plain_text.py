"""Plain text: matrices of heights and lists of points x y z, and what their headers say.

SurfaceTopography takes every line that it cannot read for a header, in silence, and knows neither
decimal commas nor other separators than blanks. So plain text is read here, with the header that
Gwyddion writes in English (Width, Height, Value units). Headers of instruments (Wyko, SPIP, Nova,
Attocube, Gwyddion in other languages) are SurfaceTopography's. A factor that neither knows is
refused, because heights without it would be wrong without notice.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

UTF16 = (b"\xff\xfe", b"\xfe\xff")  #: first bytes of text in UTF-16
FEWEST_POINTS = 16  #: rows of three numbers, from which they are a list of points and no matrix
_SLACK = 0.01  # of a step, by which positions may be off the grid
_ONE_STEP = 1.5  # times the shortest distance of positions, below which they are one step apart
_MOST_EMPTY = 0.5  # share of the grid that may have no point; more are scattered points
_COMMENT = ("#", "%", "//")
_MISSING = {"nan", "-nan", "na", "n/a", "bad", "null", "none", "---", "--", "-", "***", "*", ""}
# Begins with a number.
_NUMERIC = re.compile(r"\s*(?:-?nan(?=[\t;, ]|$)|[-+]?\.?\d)", re.IGNORECASE)
_ALTERNATE = 5.0  # step to the next column over that to the next but one, if commas split numbers
_FIELD = re.compile(
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
# zoom, colours and axes have factors and scales, too.
_FACTOR = re.compile(
    rf"(?<![a-z]){_OF_HEIGHTS}{_BESIDE}{_FACTORS}(?![a-z])"
    rf"|(?<![a-z]){_FACTORS}{_BESIDE}{_OF_HEIGHTS}(?![a-z])|(?<![a-z])z{_FACTORS}(?![a-z])"
    rf"|{_PER_COUNT}|^\W*(?:{_FACTORS}[\s_-]*)+(?:[:=]|$|[-+\d.])",
    re.IGNORECASE,
)
_NUMBER = re.compile(r"[-+]?\d*\.?\d+(?:[eE][-+]?\d+)?")
# A number of points: a whole number without a unit of length, and not per length.
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


@dataclass(frozen=True)
class PlainText:
    """Content of a text file."""

    values: NDArray  #: (rows, columns), as written, NaN where a point is marked as missing
    header: tuple[str, ...]  #: lines of comments, and those before the first row
    #: `width` (along the rows), `height`, `value_unit` and `lateral_unit`, as far as it has them
    fields: dict[str, str]


def parse(path: Path) -> PlainText:
    """Read a matrix separated by tabs, semicolons, commas or spaces.

    Lines that begin with #, % or // are comments, and so are lines before the first row that do
    not begin with a number. Decimal commas are allowed if the separator is another. Missing points
    may be written as NaN, ---, *** or left empty between tabs, semicolons or commas.

    A ValueError names file, line and field if there are no numbers, rows differ in length, a
    field is no number, commas split the numbers, or the header says what is not read.
    """
    header, rows = split_header(decode(path.read_bytes()))
    if not rows:
        raise ValueError(
            f"{path}: no line of numbers found; expected a matrix of heights, or give format: "
            "instrument if it is an instrument's file"
        )
    fields = {}
    for line in header:
        if _OF_INSTRUMENTS.search(line):
            raise ValueError(
                f"{path}: its header says {line!r}, which the text reader does not take; "
                "give format: instrument"
            )
        if _FACTOR.search(line) and _NUMBER.search(line):
            raise ValueError(
                f"{path}: its header says {line!r}, which is not read; apply it to the "
                "heights and remove the line, or try format: instrument"
            )
        if match := _FIELD.match(line):
            fields[match[1].lower().removesuffix("s").replace(" ", "_")] = match[2]
    return PlainText(_matrix(path, rows), tuple(header), fields)


def split_header(text: str) -> tuple[list[str], list[tuple[int, str]]]:
    """Comments and lines before the first row, and the rows with their line numbers."""
    header: list[str] = []
    rows: list[tuple[int, str]] = []
    for number, line in enumerate(text.splitlines(), start=1):
        stripped = line.strip(" \r\n")
        if stripped.startswith(_COMMENT) or (not rows and not _NUMERIC.match(stripped)):
            header.append(stripped)
        elif stripped.strip():
            rows.append((number, stripped))
    return header, rows


def is_of_instrument(header: Iterable[str]) -> bool:
    """Whether a header has what SurfaceTopography reads and `parse` does not."""
    return any(_OF_INSTRUMENTS.search(line) for line in header)


def decode(raw: bytes) -> str:
    """Text of a file, whatever of three encodings it has."""
    if raw.startswith(UTF16):
        return raw.decode("utf-16")
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        return raw.decode("latin-1")  # older instruments write µ as one byte


def check_counts(path: Path, header: Iterable[str], *shapes: tuple[int, int]) -> None:
    """Refuse a file whose header states numbers of columns and rows that it does not have.

    `shapes` are (columns, rows) that the header may mean. Messages name the first.
    """
    for line in header:
        both = _BOTH.search(line)
        stated = both.groups() if both else (_COLUMNS.search(line), _ROWS.search(line))
        for axis, said in enumerate(stated):
            count = said if said is None or isinstance(said, str) else said[1]
            if count is not None and int(count) not in (shape[axis] for shape in shapes):
                raise ValueError(
                    f"{path}: {shapes[0][axis]} {('columns', 'rows')[axis]}, but its header says "
                    f"{line!r}; is the file complete, and do decimal commas or separators split "
                    "its numbers?"
                )


def _matrix(path: Path, rows: list[tuple[int, str]]) -> NDArray:
    separator = _separator(rows[0][1])
    values: list[NDArray] = []
    for number, line in rows:
        fields = (line if separator == "," else line.replace(",", ".")).split(separator)
        if separator and len(fields) > 1 and not fields[-1].strip():
            fields.pop()  # a separator after the last number
        try:
            row = np.array(fields, dtype=float)
        except ValueError:
            row = np.array([_number(path, number, field.strip()) for field in fields])
        if values and len(row) != len(values[0]):
            raise ValueError(
                f"{path}, line {number}: {len(row)} numbers where the first row has "
                f"{len(values[0])}; every row needs as many"
            )
        values.append(row)
    matrix = np.array(values)
    if separator == "," and "." not in rows[0][1] and _commas_split(matrix):
        raise ValueError(
            f"{path}: {matrix.shape[1]} columns without a decimal point that alternate: decimal "
            "commas, which its separating commas hide; separate by tabs or semicolons, or write "
            "decimal points"
        )
    return matrix


def _separator(line: str) -> str | None:
    """Return the separator of a row; None stands for any run of blanks."""
    for separator in ("\t", ";"):
        if separator in line:
            return separator
    # "1,5 2,5" has decimal commas, "1.5, 2.5" and "1,2,3" separating ones.
    if "," in line and (" " not in line or re.search(r",\s", line)):
        return ","
    return None


def _commas_split(matrix: NDArray) -> bool:
    """Whether columns are by turns whole numbers and their decimals: close to the next but one."""
    if matrix.shape[1] % 2 or matrix.shape[1] < 4 or np.any(matrix[:, 1::2] < 0):
        return False
    beside = np.nanmedian(np.abs(np.diff(matrix, axis=1)))
    whole = np.nanmedian(np.abs(np.diff(matrix[:, ::2], axis=1)))
    return bool(beside > _ALTERNATE * whole)


def _number(path: Path, number: int, field: str) -> float:
    if field.lower() in _MISSING:
        return np.nan
    try:
        return float(field)
    except ValueError:
        raise ValueError(
            f"{path}, line {number}: {field!r} is not a number; mark missing points by NaN and "
            "comment lines by #"
        ) from None


def is_list(values: NDArray) -> bool:
    """Whether a matrix (rows, columns) is a list of points."""
    return values.shape[1] == 3 and len(values) >= FEWEST_POINTS


def map_points(path: Path, points: NDArray) -> tuple[NDArray, tuple[float, float]]:
    """Heights (nx, ny), NaN where there is no point, and grid steps in the unit of the positions.

    `points` (n, 3) may be in any order. A ValueError names `path` if they are on no even grid,
    or two are at one place.
    """
    points = points[np.isfinite(points[:, :2]).all(axis=1)]
    (i, dx), (j, dy) = (_index(path, points[:, axis], "xy"[axis]) for axis in (0, 1))
    shape = int(i.max()) + 1, int(j.max()) + 1
    if len(points) < (1 - _MOST_EMPTY) * shape[0] * shape[1]:
        raise ValueError(
            f"{path}: three columns, which as x y z leave most of a grid of {shape[0]} x "
            f"{shape[1]} points empty; resample them on a grid, or export a matrix"
        )
    if len(np.unique(i * shape[1] + j)) < len(points):
        raise ValueError(f"{path}: as x y z it has two points at one place; remove one")
    heights = np.full(shape, np.nan)
    heights[i, j] = points[:, 2]
    return heights, (dx, dy)


def _index(path: Path, positions: NDArray, name: str) -> tuple[NDArray, float]:
    """Index of every position on an even grid, and its step."""
    levels = np.unique(positions)
    gaps = np.diff(levels)
    if gaps.size == 0:
        raise ValueError(f"{path}: three columns, which as x y z all have one {name}")
    gaps = gaps[gaps > _SLACK * gaps.max()]  # positions that differ by rounding only
    # Gaps of rounded positions differ: one step is the mean of the short ones, and then what
    # fits the whole side.
    step = gaps[gaps < _ONE_STEP * gaps.min()].mean()
    step = float((levels[-1] - levels[0]) / np.rint(gaps / step).sum())
    index = (positions - levels[0]) / step
    if np.abs(index - np.rint(index)).max() > 10 * _SLACK:
        raise ValueError(
            f"{path}: three columns, which as x y z are on no even grid along {name}; resample "
            "them on a grid, or export a matrix"
        )
    return np.rint(index).astype(int), step
