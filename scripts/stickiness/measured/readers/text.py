"""Text: a matrix of heights, a profile in one or two columns, or points x y z.

SurfaceTopography takes every line of text that it cannot read for a header, in silence, and knows
neither decimal commas nor separators other than blanks. So plain text is read here, with the
headers that Gwyddion, GIS, NanoScope and Keyence write and names of columns with their units.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import islice
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from stickiness.measured.readers.dialects import (
    DIALECTS,
    INSTRUMENTS,
    Fields,
    find_counts,
    read_fields,
)
from stickiness.measured.readers.instruments import EXPORT
from stickiness.measured.readers.points import RESAMPLE, Gridded, map_points, read_columns
from stickiness.measured.readers.raw import Raw, fold, is_length, metres, sides, split_unit
from stickiness.measured.readers.tables import Rows, read_rows

UTF16 = (b"\xff\xfe", b"\xfe\xff")  # first bytes
MOST_COLUMNS = 12  #: of a table of points; more are a matrix
ROWS_PER_COLUMN = 32  #: of such a table, at least

Units = tuple[str | None, ...]  # of columns, or one of heights

_QUOTED = re.compile(r'"\s*[-+\u2212]?[\d.]*,[\d.,]*\s*"')  # a number with a comma
# Signs, groups of digits and powers of ten (of Fortran) as no keyboard or Python writes them.
_SIGNS = str.maketrans("\u2212\u2013", "--")
_APOSTROPHE = re.compile(r"(?<=\d)['\u2019](?=\d{3}(?!\d))")
_FORTRAN = re.compile(r"(?<=[\d.])[dD](?=[-+]?\d+(?![\d.]))")
# How a row begins: with a number, or with missing points before one.
_NUMERIC = re.compile(r'(?i)"?(?:(?:-{1,3}|\*{1,3})?"?[\s;,]+"?)*(?:[-+]?(?:nan|inf)\b|[-+]?\.?\d)')

_FACTOR = re.compile(  # the last one of heights in waves
    r"(?i)factor|scal(e|ing)\b|multiplier|conversion|(\bper|/)\s*(count|bit|digit|lsb)s?\b"
    r"|^wavelength(\s+[\d.]+){3}$"
)
# Factors of pictures and axes, unless heights are named beside them.
_OF_NO_HEIGHTS = re.compile(
    r"(?i)^(?!.*(\bz\b|height|vertical|count|data)).*(zoom|colou?r|\bbar\b|\b[xy]\b)"
)
# Columns and rows as of a picture, in a line that may begin with them.
_RESOLUTION = re.compile(
    r"(?i)(?:^|[\s,;:=])(\d+)\s*[x×]\s*(\d+)\s*(?:pixels?|points?|px|pts)?\W*$"
)
_NAMED_UNIT = re.compile(
    r"(?i)^\W*(?:heights?|höhe|topography|z)(?:[\s,;:=\t]+(?:in\b)?\s*|\s*[\[(]\s*)([a-zµμÅ]+)\W*$"
)
# Columns of positions: those of a matrix follow each other along x.
_AXES = {"x": "x", "y": "y", "column": "x", "col": "x", "row": "y"}
_HEIGHT_NAME = re.compile(r"(?i)^(?:z|heights?|höhe|topo\w*|h)\b")


def is_of_instrument(head: bytes) -> bool:
    """Whether SurfaceTopography reads the header of a text, and this module does not."""
    header, _ = split_lines(decode(head[: len(head) // 2 * 2]).splitlines())
    return INSTRUMENTS.find(header) is not None


def read_text(path: Path) -> Raw:
    """Read a matrix, one or two columns of a profile, or a list of points x y z."""
    lines = decode(path.read_bytes()).splitlines()
    for dialect in DIALECTS:
        if dialect.heights is not None and dialect.find(lines[:1]) is not None:
            return dialect.heights(path, lines)

    # The table of numbers, and what the lines before it tell.
    header, rows = split_lines(lines)
    if not rows:
        raise ValueError(
            "no line of numbers found; expected a matrix of heights, a profile or points x y z in "
            f"text; {EXPORT}, or give format: instrument if it is an instrument's file"
        )
    if (line := INSTRUMENTS.find(header)) is not None:
        raise ValueError(
            f"its header says {line!r}, which the text reader does not take; give format: "
            "instrument"
        )
    rows, counted = _drop_count(rows)
    fields = read_fields(header)
    table = read_rows(rows, has_decimal_commas=fields.get("decimal") == ",")
    names, units = _read_names(header, table.shape[1])
    _refuse_factors(header, has_units=any(units))
    _refuse_blocks(rows, table.shape[1])
    table, units, remarks = _order_columns(table, names, units)

    # Its heights, with their size and units.
    unit = fields.get("value unit") or (units[-1] if units else None)
    place_unit = fields.get("lateral unit") or _find_unit_of_positions(units)
    folded = _fold(table, header, fields) if table.shape[1] == 1 else None
    _refuse_positions(table)
    heights, places, more = read_columns(table.T) if folded is None else Gridded(folded, None)
    if places is None and heights.ndim == 2:
        places, place_unit = _find_steps(fields, heights.shape)
    _check_counts(header, counted, table.shape[::-1], heights.shape)
    return Raw(
        heights=heights,
        source=str(path),
        unit=unit,
        places=places,
        place_unit=place_unit,
        missing_value=float(fields["missing"]) if "missing" in fields else None,
        remarks=(*remarks, *more),
    )


# Lines.


def decode(content: bytes) -> str:
    """Text of a file, in the encoding that its bytes show."""
    try:
        return content.decode("utf-16" if content.startswith(UTF16) else "utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")  # older instruments write µ as one byte


def split_lines(lines: list[str]) -> tuple[list[str], Rows]:
    """Comments and lines before the first row, and the rows."""
    header_lines: list[str] = []
    rows: Rows = {}
    has_commas = any('"' in line and _QUOTED.search(line) for line in lines)
    for number, line in enumerate(lines, start=1):
        stripped = line.strip(" \r\n")
        if has_commas:  # a comma in quotes separates no numbers
            stripped = re.sub(r'("[^"]*")|,', lambda match: match[1] or "\t", stripped)
        stripped = stripped.replace('"', "").strip(" ")
        row = _write_plainly(stripped)
        is_comment = stripped.startswith(("#", "%", "//"))
        is_numeric = _NUMERIC.match(row) and not _RESOLUTION.match(row)
        if is_comment or not (rows or is_numeric):
            header_lines.append(stripped)
        elif stripped.strip():
            rows[number] = row
    return header_lines, rows


def _write_plainly(row: str) -> str:
    """Write numbers as Python does, but for their commas."""
    if row.isascii() and not any(sign in row for sign in "'dD"):
        return row  # as nearly all are
    return _FORTRAN.sub("e", _APOSTROPHE.sub("", row.translate(_SIGNS)))


def _drop_count(rows: Rows) -> tuple[Rows, list[int]]:
    """Rows without a first one that counts the others, and what it counts."""
    if len(rows) < 3:
        return rows, []
    first, second = (re.split(r"[\s,;]+", row.strip(" ")) for row in islice(rows.values(), 2))
    are_whole = all(re.fullmatch(r"\d+", word) for word in first)
    if len(first) > 2 or len(second) <= len(first) or not are_whole:
        return rows, []
    return dict(islice(rows.items(), 1, None)), [int(word) for word in first]


def _refuse_blocks(rows: Rows, columns: int) -> None:
    """Refuse a text of several maps or profiles, which blank or other lines separate."""
    numbers = np.array(list(rows))
    blocks = np.split(numbers, np.flatnonzero(np.diff(numbers) > 1) + 1)
    lengths = [len(block) for block in blocks]
    if columns == 3 or len(lengths) == 1 or sorted(lengths)[-2] < 2:
        return  # points may have a blank line behind every line of a scan
    count = {2: "two", 3: "three"}.get(len(lengths), len(lengths))
    equal = set(lengths) if len(set(lengths)) == 1 else lengths
    told = " and ".join(map(str, equal)) if len(lengths) < 4 else f"{min(lengths)} or more"
    raise ValueError(
        f"{count} blocks of {told} rows; give one, in a file of its own (or remove the lines "
        "between them if they are one map)"
    )


# What the header tells.


def _read_names(lines: list[str], columns: int) -> tuple[tuple[str, ...], Units]:
    """Names of the columns of a table and their units, from the last lines of the header.

    Without them there may be one unit, that of the heights.
    """
    named = next(filter(None, map(_NAMED_UNIT.match, reversed(lines))), None)
    of_heights: Units = (named[1],) if named and is_length(named[1]) else ()
    if not 1 <= columns <= MOST_COLUMNS:
        return (), of_heights
    below: tuple[str, ...] = ()  # units in a line of their own
    for line in reversed(lines[-3:]):
        words = split_names(line.strip("#%/ \t"), columns)
        if words is None:
            continue
        bare = tuple(word.strip("[]() ") for word in words)
        if all(map(is_length, bare)) and not below:
            below = bare
            continue
        names, units = zip(*map(split_unit, words), strict=True)
        if columns == 1 and not _HEIGHT_NAME.match(names[0]):
            continue
        units = below or units
        return names, units if any(units) else of_heights
    return (), below or of_heights


def split_names(line: str, columns: int) -> list[str] | None:
    """Words of a line that names so many columns; None of another line."""
    for separator in (r"\s*[\t;,]\s*", r"\s{2,}", r"(?<![\[(])\s+(?![\[(\])])"):
        words = [word for word in re.split(separator, line) if word]
        if len(words) == columns and not any(re.search(r"[:=]", word) for word in words):
            return words
    return None


def _find_unit_of_positions(units: Units) -> str | None:
    different = sorted({unit for unit in units[:-1] if unit})
    if len(different) > 1:
        raise ValueError(
            f"its columns of positions are in {' and '.join(different)}; write both in one unit"
        )
    return different[0] if different else None


def _refuse_factors(lines: list[str], has_units: bool) -> None:
    """Refuse factors in a header, which nobody applies."""
    for line in lines:
        # Calibrations that NanoScope copies from its file of counts, though columns name a unit.
        is_applied = line.startswith("\\") and has_units
        is_factor = _FACTOR.search(line) and re.search(r"\d", line)
        if is_factor and not is_applied and not _OF_NO_HEIGHTS.search(line):
            raise ValueError(
                f"its header says {line!r}, which is not read; apply it to the heights and remove "
                "the line, or try format: instrument"
            )


def _find_steps(fields: Fields, shape: tuple[int, ...]) -> tuple[NDArray | None, str | None]:
    """Steps of a map and their unit, as its header tells them."""
    if "pixel" in fields:
        return np.full(2, metres(fields["pixel"], "XY calibration in the header")), "m"
    if "width" in fields:
        return np.divide(_find_sides(fields, shape), shape), "m"
    steps = [fields.get(axis) for axis in ("dx", "dy")]
    return None if None in steps else np.array(steps, dtype=float), fields.get("lateral unit")


def _find_sides(fields: Fields, shape: tuple[int, ...]) -> tuple[float, ...]:
    size = [fields[name] for name in ("width", "height") if name in fields]
    # Without a height the pixels are square.
    return sides(size if len(size) == 2 else size[0], shape, "Width, Height in the header")


def _check_counts(
    lines: list[str], counted: list[int], table: tuple[int, ...], shape: tuple[int, ...]
) -> None:
    """Check counts in the header and in the first row against the shape of the heights."""
    columns, rows = table
    # Columns and rows may be those of a map, of the table, or the points of a profile.
    shapes = [shape, table] if len(shape) == 2 else [table, (rows, 1)]
    for axis, name in enumerate(("columns", "rows")):
        for count, line in find_counts(lines, axis):
            if count not in (each[axis] for each in shapes):
                raise ValueError(
                    f"{shapes[0][axis]} {name}, but its header says {line!r}; is the file "
                    "complete, and do decimal commas or separators split its numbers?"
                )
    points = int(np.prod(shape))
    if counted and counted not in ([points], [rows], [*shape], [*shape[::-1]]):
        raise ValueError(
            f"its first line counts {' x '.join(map(str, counted))} points, but {points} follow: "
            "is the file complete?"
        )


# What the columns are.


def _order_columns(
    table: NDArray, names: tuple[str, ...], units: Units
) -> tuple[NDArray, Units, tuple[str, ...]]:
    """Columns of positions and heights, in this order, with their units, and a remark on others."""
    rows, columns = table.shape
    names = tuple(map(str.lower, names))
    heights = [i for i, name in enumerate(names) if _HEIGHT_NAME.match(name)]
    axes = {_AXES[name]: i for i, name in enumerate(names) if name in _AXES}
    remarks: tuple[str, ...] = ()
    if columns == 3 and len(axes) == 2:
        order = [axes["x"], axes["y"], *({0, 1, 2} - {*axes.values()})]
    elif columns in (2, 3) and len(heights) == 1:
        order = [*(i for i in range(columns) if i not in heights), *heights]
    elif 3 < columns <= MOST_COLUMNS and rows >= ROWS_PER_COLUMN * columns:
        order = [names.index(name) for name in "xyz"] if {*"xyz"} <= {*names} else [0, 1, 2]
        try:
            map_points(table[:, order].T)
        except ValueError as error:
            raise ValueError(
                f"a table of {rows} rows in {columns} columns is no map, and its first three "
                f"columns are no points x y z on a grid ({error}); give a matrix, a profile in two "
                f"columns, or points x y z: {RESAMPLE}"
            ) from None
        which = "columns x, y and z" if names else "first three columns"
        remarks = (f"of {columns} columns the {which} were taken for points x y z",)
    else:
        return table, units, ()
    if len(units) == columns:
        units = tuple(units[i] for i in order)
    return table[:, order], units, remarks


def _fold(column: NDArray, lines: list[str], fields: Fields) -> NDArray | None:
    """Map whose rows follow each other in one column, if the header tells its sides."""
    counts: Sequence[float] = [
        count for axis in (0, 1) for count, _ in find_counts(lines, axis)[:1]
    ]
    resolution = next(filter(None, map(_RESOLUTION.search, lines)), None)
    if resolution and len(counts) < 2:
        counts = [int(resolution[1]), int(resolution[2])]
    if not counts and {"width", "height"} <= fields.keys():
        counts = _find_sides(fields, (1, 1))
    elif np.prod(counts) != column.size:
        return None
    return fold(column, counts)


def _refuse_positions(table: NDArray) -> None:
    """Refuse a matrix whose first column or row has even steps, unlike the next: positions."""
    if min(table.shape) < 4:
        return
    for name, lines in (("column", table.T), ("row", table)):
        steps = np.diff(lines[:2, 1:], axis=1)
        if not np.all(np.isfinite(steps)):
            continue
        is_even = np.ptp(steps, axis=1) <= 1e-3 * np.abs(steps.mean(axis=1))
        if is_even[0] and not is_even[1]:
            raise ValueError(
                f"the first {name} rises in even steps of {steps[0].mean():g}, as positions do: "
                "remove it if it holds no heights"
            )
