"""Plain text: a matrix of heights, one or two columns of a profile, or a list of points x y z.

SurfaceTopography takes every line that it cannot read for a header, in silence, and knows neither
decimal commas nor separators other than blanks. So plain text is read here, with the header that
Gwyddion writes (Width, Height, Value units). Other headers of instruments are
SurfaceTopography's. What neither reads is refused: heights would be wrong without notice.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

UTF16 = (b"\xff\xfe", b"\xfe\xff")  #: first bytes of text in UTF-16
FEWEST_POINTS = 16  #: rows of three numbers, from which they are a list of points and no matrix
_SLACK = 0.01  # of a step, by which positions may be off the grid
_ONE_STEP = 1.5  # times the shortest distance of positions, below which they are one step apart
_MOST_EMPTY = 0.5  # share of the grid that may have no point; more are scattered points
_ALTERNATE = 5.0  # step to the next column over that to the next but one, if commas split numbers
_COMMENT = ("#", "%", "//")
_MISSING = {"", "na", "n/a", "bad", "null", "none", "-nan", "-", "--", "---", "*", "***"}
# How a row begins: with a number, or with missing points before one.
_NUMERIC = re.compile(r"(?:(?:-{1,3}|\*{1,3})?[\s;,]+)*(?:-?nan\b|[-+]?\.?\d)", re.IGNORECASE)
_FIELD = re.compile(r"^\W*(width|height|value unit|lateral unit)s?\s*[:=]\s*(.+?)\s*$", re.I)
#: What SurfaceTopography takes from headers and this reader does not.
OF_INSTRUMENTS = re.compile(
    r"pixel\s+size\s*=|height\s+conversion\s+factor|\b[xy]-length\b|\b[xyz]-unit\b|\bbit2nm\b"
    r"|wyko ascii|file format\s*=\s*ascii|^\W*unit (x|data)\s*=|^\W*scale [xy]\s*="
    r"|^\s*x;y;valid|^\s*scan data\b|^\W*lateral um",
    re.IGNORECASE | re.MULTILINE,
)
_FACTOR = re.compile(
    r"factor|scal(e|ing)\b|multiplier|conversion|(\bper|/)\s*(count|bit|digit|lsb)s?\b", re.I
)
# Factors of pictures and axes, unless heights are named beside them.
_OF_NO_HEIGHTS = re.compile(
    r"^(?!.*(\bz\b|height|vertical|count|data)).*(zoom|colou?r|\bbar\b|\b[xy]\b)", re.IGNORECASE
)
# A number of points: at the start of a line or after another number, without a unit.
_COUNT = r"(?:^\W*|\d[\s,;]+)(?:{})\s*[:=]\s*(\d+)(?![\w./])"
_COLUMNS = re.compile(_COUNT.format("nx|columns|cols|x[-_ ]?pixels?"), re.IGNORECASE)
_ROWS = re.compile(_COUNT.format("ny|rows|y[-_ ]?pixels?"), re.IGNORECASE)


def decode(raw: bytes) -> str:
    """Text of a file, whatever of three encodings it has."""
    if raw.startswith(UTF16):
        return raw.decode("utf-16")
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        return raw.decode("latin-1")  # older instruments write µ as one byte


def split_header(text: str) -> tuple[list[str], list[tuple[int, str]]]:
    """Comments and lines before the first row, and the rows with their line numbers."""
    header: list[str] = []
    rows: list[tuple[int, str]] = []
    for number, line in enumerate(text.splitlines(), start=1):
        stripped = line.strip(" \r\n")
        if stripped.startswith(_COMMENT) or not (rows or _NUMERIC.match(stripped)):
            header.append(stripped)
        elif stripped.strip():
            rows.append((number, stripped))
    return header, rows


def parse(path: Path) -> tuple[NDArray, list[str], dict[str, str]]:
    """Read a matrix separated by tabs, semicolons, commas or spaces.

    Lines that begin with #, % or // are comments, and so are lines before the first row that do
    not begin with a number. Decimal commas are allowed if the separator is another. Missing points
    may be written as NaN, ---, *** or left empty between tabs, semicolons or commas.

    Returns the numbers as written (rows, columns), NaN where a point is marked as missing; comments
    and lines before the first row; and the `width` (along the rows), `height`, `value unit` and
    `lateral unit` that these give. A ValueError names the file, and the line that cannot be read.
    """
    header, rows = split_header(decode(path.read_bytes()))
    if not rows:
        raise ValueError(
            f"{path}: no line of numbers found; expected a matrix of heights, or give format: "
            "instrument if it is an instrument's file"
        )
    for line in header:
        if OF_INSTRUMENTS.search(line):
            raise ValueError(
                f"{path}: its header says {line!r}, which the text reader does not take; "
                "give format: instrument"
            )
        if _FACTOR.search(line) and re.search(r"\d", line) and not _OF_NO_HEIGHTS.search(line):
            raise ValueError(
                f"{path}: its header says {line!r}, which is not read; apply it to the "
                "heights and remove the line, or try format: instrument"
            )
    matches = filter(None, map(_FIELD.match, header))
    return _matrix(path, rows), header, {match[1].lower(): match[2] for match in matches}


def _matrix(path: Path, rows: list[tuple[int, str]]) -> NDArray:
    first = rows[0][1]
    separator = next((mark for mark in "\t;" if mark in first), None)  # None: any run of blanks
    # "1,5 2,5" has decimal commas, "1.5, 2.5" and "1,2,3" separating ones.
    if separator is None and re.search(r",\s|^[^ ]*,[^ ]*$", first):
        separator = ","
    values: list[list[float]] = []
    for number, line in rows:
        fields = (line if separator == "," else line.replace(",", ".")).split(separator)
        if separator and len(fields) > 1 and not fields[-1].strip():
            fields.pop()  # a separator after the last number
        try:
            row = [np.nan if f.strip().lower() in _MISSING else float(f) for f in fields]
        except ValueError as error:
            raise ValueError(
                f"{path}, line {number}: {error}; mark missing points by NaN and comment lines by #"
            ) from None
        if values and len(row) != len(values[0]):
            raise ValueError(
                f"{path}, line {number}: {len(row)} numbers where the first row has "
                f"{len(values[0])}; every row needs as many"
            )
        values.append(row)
    matrix = np.array(values)
    if separator == "," and "." not in first and _commas_split(matrix):
        raise ValueError(
            f"{path}: {matrix.shape[1]} columns without a decimal point that alternate: decimal "
            "commas, which its separating commas hide; separate by tabs or semicolons, or write "
            "decimal points"
        )
    return matrix


def _commas_split(matrix: NDArray) -> bool:
    """Whether columns are by turns whole numbers and their decimals: close to the next but one."""
    if matrix.shape[1] % 2 or matrix.shape[1] < 4 or np.any(matrix[:, 1::2] < 0):
        return False
    beside = np.nanmedian(np.abs(np.diff(matrix, axis=1)))
    whole = np.nanmedian(np.abs(np.diff(matrix[:, ::2], axis=1)))
    return bool(beside > _ALTERNATE * whole)


def check_counts(path: Path, header: Iterable[str], *shapes: tuple[int, int]) -> None:
    """Refuse a file whose header states numbers of columns and rows that it does not have.

    `shapes` are (columns, rows) that the header may mean. Messages name the first.
    """
    for axis, (name, pattern) in enumerate((("columns", _COLUMNS), ("rows", _ROWS))):
        for line, match in ((line, pattern.search(line)) for line in header):
            if match and int(match[1]) not in (shape[axis] for shape in shapes):
                raise ValueError(
                    f"{path}: {shapes[0][axis]} {name}, but its header says {line!r}; is the file "
                    "complete, and do decimal commas or separators split its numbers?"
                )


def map_points(path: Path, points: NDArray) -> tuple[NDArray, tuple[float, float]]:
    """Heights (nx, ny), NaN where there is no point, and grid steps in the unit of the positions.

    `points` (n, 3) may be in any order. A ValueError names `path` if they are on no even grid,
    or two are at one place.
    """
    points = points[np.isfinite(points[:, :2]).all(axis=1)]
    (i, dx), (j, dy) = (_index(path, points[:, axis], "xy"[axis]) for axis in (0, 1))
    heights = np.full((int(i.max()) + 1, int(j.max()) + 1), np.nan)
    if len(points) < (1 - _MOST_EMPTY) * heights.size:
        raise ValueError(
            f"{path}: three columns, which as x y z leave most of a grid of {heights.shape[0]} x "
            f"{heights.shape[1]} points empty; resample them on a grid, or export a matrix"
        )
    if len(np.unique(i * heights.shape[1] + j)) < len(points):
        raise ValueError(f"{path}: as x y z it has two points at one place; remove one")
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
