"""Text: a matrix of heights, a profile in one or two columns, or points x y z.

SurfaceTopography takes every line of text that it cannot read for a header, in silence, and knows
neither decimal commas nor separators other than blanks. So plain text is read here, with the
headers that Gwyddion, GIS, NanoScope and Keyence write and names of columns with their units.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from stickiness.measured.readers import grids
from stickiness.measured.readers.instruments import EXPORT
from stickiness.measured.readers.points import RESAMPLE, Gridded, map_points, read_columns
from stickiness.measured.readers.raw import Raw, fold, is_length, metres, sides

UTF16 = (b"\xff\xfe", b"\xfe\xff")  # first bytes
MOST_COLUMNS = 12  #: of a table of points; more are a matrix
MOST_MISSING = 2  #: different whole numbers that may stand for missing points in a column
ROWS_PER_COLUMN = 32  #: of such a table, at least

# What a comma or a point may mean: groups of three digits, beside smaller numbers without any.
_GROUPS = {mark: re.compile(rf"[-+]?[1-9]\d{{0,2}}(?:{re.escape(mark)}\d{{3}})+") for mark in ",."}
_SMALLER = re.compile(r"[-+]?\d{1,3}|[^\d]*")
# A number with groups of three digits that can mean nothing else, and the mark between them.
_GROUPED = re.compile(
    r"(?<![\d.,])[1-9]\d{0,2}([.,])(?:\d{3}\1)*\d{3}(?:(?!\1)[.,]\d|\1\d{3}(?![\d.,]))"
)
# A line that may be one number, with groups of digits or a decimal comma.
_ONE_NUMBER = re.compile(r"[-+]?(?:[1-9]\d{0,2}(?:[.,]\d{3})+|\d+)[.,]\d+")
_QUOTED = re.compile(r'"\s*[-+\u2212]?[\d.]*,[\d.,]*\s*"')  # a number with a comma
# Signs, groups of digits and powers of ten (of Fortran) as no keyboard or Python writes them.
_SIGNS = str.maketrans("\u2212\u2013", "--")
_APOSTROPHE = re.compile(r"(?<=\d)['\u2019](?=\d{3}(?!\d))")
_FORTRAN = re.compile(r"(?<=[\d.])[dD](?=[-+]?\d+(?![\d.]))")
# How a row begins: with a number, or with missing points before one.
_NUMERIC = re.compile(
    r'"?(?:(?:-{1,3}|\*{1,3})?"?[\s;,]+"?)*(?:[-+]?(?:nan|inf)\b|[-+]?\.?\d)', re.IGNORECASE
)
_MISSING = {"", "na", "n/a", "bad", "null", "none", "-nan", "-", "--", "---", "*", "***"}
_FIELD = re.compile(
    r"^\W*(width|height|value unit|lateral unit|breite|höhe|werteinheit|laterale einheit)(?:s|en)?"
    r"\s*[:=]\s*(.+?)\s*$",
    re.I,
)
# What stands before another field in one line, or before a number of points.
_NEXT_FIELD = re.compile(
    r"[\s,;]+(?=(?:width|height|value units?|lateral units?|\d+\s*[x×]\s*\d+)\b)", re.IGNORECASE
)
_GERMAN = {  # fields as Gwyddion writes them in German
    "breite": "width",
    "höhe": "height",
    "werteinheit": "value unit",
    "laterale einheit": "lateral unit",
}
# What SurfaceTopography takes from headers and this reader does not.
_OF_INSTRUMENTS = re.compile(
    r"pixel\s+size\s*=|height\s+conversion\s+factor|\b[xy]-length\b|\b[xyz]-unit\b|\bbit2nm\b"
    r"|wyko ascii|file format\s*=\s*ascii|^\W*unit (x|data)\s*=|^\W*scale [xy]\s*="
    r"|^\s*x;y;valid|^\s*scan data\b|^\W*lateral um",
    re.IGNORECASE | re.MULTILINE,
)
_FACTOR = re.compile(
    r"factor|scal(e|ing)\b|multiplier|conversion|(\bper|/)\s*(count|bit|digit|lsb)s?\b"
    r"|^wavelength(\s+[\d.]+){3}$",  # heights in waves
    re.I,
)
# Factors of pictures and axes, unless heights are named beside them.
_OF_NO_HEIGHTS = re.compile(
    r"^(?!.*(\bz\b|height|vertical|count|data)).*(zoom|colou?r|\bbar\b|\b[xy]\b)", re.IGNORECASE
)
# A number of points: at the start of a line or after another number, without a unit.
_COUNT = r"(?:^\W*|\d[\s,;]+)(?:{})\s*[:=,;]\s*(\d+)(?![\w./])|^\W*{}\s+(\d+)\s*$"
_COLUMNS = re.compile(
    _COUNT.format(r"nx|columns|cols|x[-_ ]?pixels?|samps/line|horizont(?:al|\.)", "ncols"),
    re.IGNORECASE,
)
_ROWS = re.compile(
    _COUNT.format(r"ny|rows|y[-_ ]?pixels?|number of lines|(?:vertical|vertik\.)", "nrows"),
    re.IGNORECASE,
)
# Columns and rows as of a picture, in a line that may begin with them.
_RESOLUTION = re.compile(
    r"(?:^|[\s,;:=])(\d+)\s*[x×]\s*(\d+)\s*(?:pixels?|points?|px|pts)?\W*$", re.I
)
# A number behind a key, without a unit: of the grids of geographic information systems.
_CELL = re.compile(r"^\W*(cellsize|dx|dy|nodata_value)\s+([-+.\deE]+)\s*$", re.IGNORECASE)
_KEYENCE = re.compile(r"^xy[ -](?:calibration|justierung)\W+([\d.]+)\W+(\w+)", re.IGNORECASE)
_KEYENCE_UNIT = re.compile(r"^(?:unit|einheit)\s*[,;:\t]\s*(\S+)\s*$", re.IGNORECASE)
_NANOSCOPE = re.compile(
    r"^\W*scan size\s*[:=]\s*([\d.]+)(?:\s+([\d.]+))?\s*(\w+)\s*$", re.IGNORECASE
)
_ASPECT = re.compile(r"^\W*aspect ratio\s*[:=]\s*([\d.]+)\s*:\s*([\d.]+)", re.IGNORECASE)
_NAME_AND_UNIT = re.compile(r"^(.*?)[\s_]*[\[(]\s*([^\])]+?)\s*[\])]$")
_NAMED_UNIT = re.compile(
    r"^\W*(?:heights?|topography|z)(?:[\s,;:=\t]+(?:in\b)?\s*|\s*[\[(]\s*)([a-zµμÅ]+)\W*$",
    re.IGNORECASE,
)
# Columns of positions: those of a matrix follow each other along x.
_AXES = {"x": "x", "y": "y", "column": "x", "col": "x", "row": "y"}
_HEIGHT_NAME = re.compile(r"^(?:z|heights?|topo\w*|h)\b", re.IGNORECASE)


def is_of_instrument(head: bytes) -> bool:
    """Whether SurfaceTopography reads the header of a text, and this module does not."""
    header, _ = split_header(head)
    return bool(_OF_INSTRUMENTS.search("\n".join(header)))


@dataclass(frozen=True)
class _Header:
    """What the lines before the numbers tell."""

    lines: list[str]
    fields: dict[str, str]  #: as Gwyddion names them
    cells: dict[str, float]  #: of geographic information systems
    names: tuple[str, ...] = ()  #: of columns
    units: tuple[str | None, ...] = ()  #: of columns, or of the heights of a matrix

    def count(self) -> list[int]:
        """Counts of columns and rows that lines tell, the first of each."""
        patterns = (_COLUMNS, _ROWS, _RESOLUTION)
        told = [next(filter(None, map(each.search, self.lines)), None) for each in patterns]
        if told[2] and not (told[0] and told[1]):
            return [int(told[2][1]), int(told[2][2])]
        return [int(match[1] or match[2]) for match in told[:2] if match]


def read_text(path: Path) -> Raw:
    """Read a matrix, one or two columns of a profile, or a list of points x y z."""
    lines = _decode(path.read_bytes()).splitlines()
    first = lines[0].strip() if lines else ""
    if first == "DSAA":
        return grids.read_surfer_text(path, " ".join(lines).split())
    if re.match(r"zygo (xyz|ascii) data file", first, re.IGNORECASE):
        return grids.read_zygo(path, lines)
    header_lines, rows = _split_lines(lines)
    if not rows:
        raise ValueError(
            "no line of numbers found; expected a matrix of heights, a profile or points x y z in "
            f"text; {EXPORT}, or give format: instrument if it is an instrument's file"
        )
    for line in header_lines:
        if _OF_INSTRUMENTS.search(line):
            raise ValueError(
                f"its header says {line!r}, which the text reader does not take; give format: "
                "instrument"
            )
    rows, counted = _drop_count(rows)
    is_german = any(field[1].lower() in _GERMAN for field in _find_fields(header_lines))
    matrix = _read_rows(rows, has_decimal_commas=is_german)
    header = _read_header(header_lines, matrix.shape[1])
    _refuse_factors(header)
    _refuse_blocks(rows, matrix.shape[1])
    matrix, header, remarks = _order_columns(matrix, header)
    return _make_raw(path, matrix.T, header, counted, remarks)


def _make_raw(
    path: Path, heights: NDArray, header: _Header, counted: list[int], remarks: tuple[str, ...]
) -> Raw:
    """Heights of a table (columns, rows) with its size and units."""
    columns, count = heights.shape
    unit = header.fields.get("value unit") or (header.units[-1] if header.units else None)
    place_unit = header.fields.get("lateral unit") or _unit_of_positions(header)
    folded = _fold(heights, header) if columns == 1 else None
    if columns > 3 and count > 3:
        _refuse_positions(heights)
    read = read_columns(heights) if folded is None else Gridded(folded, None)
    heights, places = read.heights, read.places
    remarks += read.remarks
    # Columns and rows that the header may mean: of a map, of the table, or points of a profile.
    shapes = [heights.shape, (columns, count)]
    if heights.ndim == 1:
        shapes = [(columns, count), (count, 1)]
    if places is None and heights.ndim == 2:
        places, place_unit = _find_steps(header, heights.shape)
    _check_counts(header.lines, shapes)
    points = int(np.prod(heights.shape))
    if counted and counted not in ([points], [count], [*heights.shape], [*heights.shape[::-1]]):
        raise ValueError(
            f"its first line counts {' x '.join(map(str, counted))} points, but {points} follow: "
            "is the file complete?"
        )
    remarks = tuple(f"{path}: {remark}" for remark in remarks)
    mark = header.cells.get("nodata_value", -9999 if "cellsize" in header.cells else None)
    return Raw(heights, str(path), unit, (), places, place_unit, False, mark, remarks)


def _decode(raw: bytes) -> str:
    try:
        return raw.decode("utf-16" if raw.startswith(UTF16) else "utf-8-sig")
    except UnicodeDecodeError:
        return raw.decode("latin-1")  # older instruments write µ as one byte


def split_header(raw: bytes) -> tuple[list[str], list[tuple[int, str]]]:
    """Comments and lines before the first row, and the rows with their line numbers."""
    return _split_lines(_decode(raw).splitlines())


def _split_lines(lines: list[str]) -> tuple[list[str], list[tuple[int, str]]]:
    header: list[str] = []
    rows: list[tuple[int, str]] = []
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
            header.append(stripped)
        elif stripped.strip():
            rows.append((number, row))
    return header, rows


def _write_plainly(row: str) -> str:
    """Write numbers as Python does, but for their commas."""
    if row.isascii() and not any(sign in row for sign in "'dD"):
        return row  # as nearly all are
    return _FORTRAN.sub("e", _APOSTROPHE.sub("", row.translate(_SIGNS)))


def _drop_count(rows: list[tuple[int, str]]) -> tuple[list[tuple[int, str]], list[int]]:
    """Rows without a first one that counts the others, and what it counts."""
    words = [re.split(r"[\s,;]+", line.strip(" ")) for _, line in rows[:2]]
    if len(rows) < 3 or len(words[0]) > 2 or len(words[1]) <= len(words[0]):
        return rows, []
    if not all(re.fullmatch(r"\d+", word) for word in words[0]):
        return rows, []
    return rows[1:], [int(word) for word in words[0]]


def _find_fields(lines: list[str]) -> list[re.Match]:
    """Fields that Gwyddion writes, in its language; others write several in one line."""
    told = [part for line in lines if _FIELD.match(line) for part in _NEXT_FIELD.split(line)]
    return [match for match in map(_FIELD.match, told) if match]


def _read_header(lines: list[str], columns: int) -> _Header:
    matches = _find_fields(lines)
    fields = {_GERMAN.get(match[1].lower(), match[1].lower()): match[2] for match in matches}
    if matches and matches[0][1].lower() in _GERMAN:
        fields = {name: text.replace(",", ".") for name, text in fields.items()}
    cells = {}
    for match in filter(None, map(_CELL.match, lines)):
        cells[match[1].lower()] = float(match[2])
    for match in filter(None, map(_KEYENCE.match, lines)):
        fields["pixel"] = f"{match[1]} {match[2]}"
        told = [each[1] for each in map(_KEYENCE_UNIT.match, lines) if each]
        fields |= {"value unit": told[-1]} if told else {}
    aspects = [float(each[2]) / float(each[1]) for each in map(_ASPECT.match, lines) if each]
    for match in filter(None, (_NANOSCOPE.match(line.replace("~", "u")) for line in lines)):
        fields["width"] = f"{match[1]} {match[3]}"
        height = float(match[2]) if match[2] else float(match[1]) * (aspects or [1.0])[-1]
        fields["height"] = f"{height:.6g} {match[3]}"
    names, units = _read_names(lines, columns)
    if not units:
        named = [match[1] for match in map(_NAMED_UNIT.match, lines) if match]
        units = tuple(unit for unit in named[-1:] if is_length(unit))
    return _Header(lines, fields, cells, names, units)


def _read_names(lines: list[str], columns: int) -> tuple[tuple[str, ...], tuple[str | None, ...]]:
    """Names of the columns of a table and their units, from the last lines of the header."""
    if not 1 <= columns <= MOST_COLUMNS:
        return (), ()
    below: tuple[str, ...] = ()  # units in a line of their own
    for line in reversed(lines[-3:]):
        text = line.strip("#%/ \t")
        words = _split_names(text, columns)
        if words is None:
            continue
        bare = tuple(word.strip("[]() ") for word in words)
        if all(map(is_length, bare)) and not below:
            below = bare
            continue
        pairs = [_NAME_AND_UNIT.match(word) for word in words]
        names = tuple(
            pair[1].strip() if pair else word for pair, word in zip(pairs, words, strict=True)
        )
        if columns == 1 and not _HEIGHT_NAME.match(names[0]):
            continue
        beside = tuple(pair[2].strip() if pair else None for pair in pairs)
        units: tuple[str | None, ...] = below or beside
        return names, units if any(units) else ()
    return (), below


def _split_names(text: str, columns: int) -> list[str] | None:
    """Words of a line that names so many columns; None of another line."""
    for separator in (r"\s*[\t;,]\s*", r"\s{2,}", r"(?<![\[(])\s+(?![\[(\])])"):
        words = [word for word in re.split(separator, text) if word]
        if len(words) == columns and not any(re.search(r"[:=]", word) for word in words):
            return words
    return None


def _unit_of_positions(header: _Header) -> str | None:
    units = {unit for unit in header.units[:-1] if unit}
    if len(units) > 1:
        raise ValueError(
            f"its columns of positions are in {' and '.join(sorted(units))}; write both in one unit"
        )
    return units.pop() if units else None


def _refuse_factors(header: _Header) -> None:
    """Refuse factors in a header, which nobody applies."""
    for line in header.lines:
        # Calibrations that NanoScope copies from its file of counts, though columns name a unit.
        is_applied = line.startswith("\\") and any(header.units)
        is_factor = _FACTOR.search(line) and re.search(r"\d", line)
        if is_factor and not is_applied and not _OF_NO_HEIGHTS.search(line):
            raise ValueError(
                f"its header says {line!r}, which is not read; apply it to the heights and remove "
                "the line, or try format: instrument"
            )


def _refuse_blocks(rows: list[tuple[int, str]], columns: int) -> None:
    """Refuse a text of several maps or profiles, which blank or other lines separate."""
    numbers = np.array([number for number, _ in rows])
    lengths = [len(block) for block in np.split(numbers, np.flatnonzero(np.diff(numbers) > 1) + 1)]
    if columns == 3 or len(lengths) == 1 or sorted(lengths)[-2] < 2:
        return  # points may have a blank line behind every line of a scan
    names = {2: "two", 3: "three"}
    equal = set(lengths) if len(set(lengths)) == 1 else lengths
    told = " and ".join(map(str, equal)) if len(lengths) < 4 else f"{min(lengths)} or more"
    raise ValueError(
        f"{names.get(len(lengths), len(lengths))} blocks of {told} rows; give one, in a file of "
        "its own (or remove the lines between them if they are one map)"
    )


def _order_columns(table: NDArray, header: _Header) -> tuple[NDArray, _Header, tuple[str, ...]]:
    """Columns of positions and heights of a table, in this order, and a remark on others."""
    rows, columns = table.shape
    names = [name.lower() for name in header.names]
    order = list(range(columns))
    heights = [i for i, name in enumerate(names) if _HEIGHT_NAME.match(name)]
    remarks: tuple[str, ...] = ()
    axes = {_AXES[name]: i for i, name in enumerate(names) if name in _AXES}
    if columns == 3 and len(axes) == 2:
        order = [axes["x"], axes["y"], *(i for i in order if i not in axes.values())]
    elif columns in (2, 3) and len(heights) == 1:
        order = [i for i in order if i not in heights] + heights
    elif 3 < columns <= MOST_COLUMNS and rows >= ROWS_PER_COLUMN * columns:
        order = [names.index(name) for name in "xyz"] if {*"xyz"} <= {*names} else [0, 1, 2]
        _try_points(table[:, order].T, columns)
        which = "columns x, y and z" if names else "first three columns"
        remarks = (f"of {columns} columns the {which} were taken for points x y z",)
    else:
        return table, header, ()
    names_in_order = tuple(header.names[i] for i in order) if header.names else ()
    units = header.units
    if len(units) == columns:
        units = tuple(units[i] for i in order)
    ordered = _Header(header.lines, header.fields, header.cells, names_in_order, units)
    return table[:, order], ordered, remarks


def _try_points(points: NDArray, columns: int) -> Gridded:
    try:
        return map_points(points)
    except ValueError as error:
        raise ValueError(
            f"a table of {points.shape[1]} rows in {columns} columns is no map, and its first "
            f"three columns are no points x y z on a grid ({error}); give a matrix, a profile in "
            f"two columns, or points x y z: {RESAMPLE}"
        ) from None


def _fold(column: NDArray, header: _Header) -> NDArray | None:
    """Map whose rows follow each other in one column, if the header tells its sides."""
    counts: Sequence[float] = header.count()
    if not counts and {"width", "height"} <= header.fields.keys():
        counts = _sides_in_header(header, (1, 1))
    elif np.prod(counts) != column.size:
        return None
    return fold(column, counts)


def _find_steps(header: _Header, shape: tuple[int, int]) -> tuple[NDArray | None, str | None]:
    """Steps of a map and their unit, as its header tells them."""
    if "pixel" in header.fields:
        return np.full(2, metres(header.fields["pixel"], "XY calibration in the header")), "m"
    if "width" in header.fields:
        return np.divide(_sides_in_header(header, shape), shape), "m"
    if "cellsize" in header.cells:
        return np.full(2, header.cells["cellsize"]), header.fields.get("lateral unit")
    if {"dx", "dy"} <= header.cells.keys():
        steps = np.array([header.cells["dx"], header.cells["dy"]])
        return steps, header.fields.get("lateral unit")
    return None, header.fields.get("lateral unit")


def _sides_in_header(header: _Header, shape: tuple[int, int]) -> tuple[float, ...]:
    size = [header.fields[name] for name in ("width", "height") if name in header.fields]
    # Without a height the pixels are square.
    return sides(size if len(size) == 2 else size[0], shape, "Width, Height in the header")


def _refuse_positions(heights: NDArray) -> None:
    """Refuse a matrix whose first column or row has even steps, unlike the next: positions."""
    for name, lines in (("column", heights), ("row", heights.T)):
        steps = np.diff(lines[:2, 1:], axis=1)
        if not np.all(np.isfinite(steps)):
            continue
        is_even = np.ptp(steps, axis=1) <= 1e-3 * np.abs(steps.mean(axis=1))
        if is_even[0] and not is_even[1]:
            raise ValueError(
                f"the first {name} rises in even steps of {steps[0].mean():g}, as positions do: "
                "remove it if it holds no heights"
            )


def _check_counts(header: list[str], shapes: list[tuple[int, ...]]) -> None:
    """Check the columns and rows that a header names against the shapes that they may mean."""
    for axis, (name, pattern) in enumerate((("columns", _COLUMNS), ("rows", _ROWS))):
        for line in header:
            match = pattern.search(line)
            if match and int(match[1] or match[2]) not in (shape[axis] for shape in shapes):
                raise ValueError(
                    f"{shapes[0][axis]} {name}, but its header says {line!r}; is the file "
                    "complete, and do decimal commas or separators split its numbers?"
                )


def _read_rows(rows: list[tuple[int, str]], has_decimal_commas: bool = False) -> NDArray:
    first = rows[0][1]
    separator = next((mark for mark in "\t;" if mark in first), None)  # None: any run of blanks
    # "1,5 2,5" has decimal commas, "1.5, 2.5" and "1,2,3" separating ones.
    if separator is None and not has_decimal_commas and re.search(r",\s|^[^ ]*,[^ ]*$", first):
        separator = ","
    mark = None if separator == "," else _find_mark_of_thousands(rows)
    if mark:
        rows = _join_groups(rows, mark)
    elif not has_decimal_commas:
        if separator != ",":
            _refuse_groups(rows, separator, ",")
        _refuse_groups(rows, separator, ".")
    values: list[list[float]] = []
    for number, line in rows:
        fields = (line if separator == "," else line.replace(",", ".")).split(separator)
        if separator and len(fields) > 1 and not fields[-1].strip():
            fields.pop()  # a separator after the last number
        try:
            row = [np.nan if f.strip().lower() in _MISSING else float(f) for f in fields]
        except ValueError as error:
            raise ValueError(
                f"line {number}: {str(error)[:80]}; mark missing points by NaN and comment lines "
                "by #"
            ) from None
        if values and len(row) != len(values[0]):
            raise ValueError(
                f"line {number}: {len(row)} numbers where the first row has {len(values[0])}; "
                "every row needs as many"
            )
        values.append(row)
    matrix = np.array(values)
    # Do columns by turns hold whole numbers and their decimals: close to the next but one?
    pairs = matrix.shape[1] >= 4 and matrix.shape[1] % 2 == 0 and not np.any(matrix[:, 1::2] < 0)
    if separator == "," and "." not in first and pairs:
        beside = np.nanmedian(np.abs(np.diff(matrix, axis=1)))
        whole = np.nanmedian(np.abs(np.diff(matrix[:, ::2], axis=1)))
        if beside > 5 * whole:
            raise ValueError(
                f"{matrix.shape[1]} columns without a decimal point that alternate: "
                "decimal commas, which its separating commas hide; separate by tabs or "
                "semicolons, or write decimal points"
            )
    is_repeated = len(np.unique(matrix[:, 0])) < len(matrix)
    may_be_one = separator == "," and (is_repeated or "." in first.partition(",")[0])
    if may_be_one and all(_ONE_NUMBER.fullmatch(line) for _, line in rows):
        raise ValueError(
            f"lines such as {first!r} may hold two numbers, or one with a comma: write decimal "
            "points and no thousands, or separate numbers by tabs or semicolons"
        )
    return matrix


def _find_mark_of_thousands(rows: list[tuple[int, str]]) -> str:
    """Mark between groups of three digits, if a number shows that it is one."""
    # Most lines have points alone, and no group of digits between two of them.
    odd = (line for _, line in rows if "," in line or re.search(r"\.\d{3}\.", line))
    return next((found[1] for line in odd if (found := _GROUPED.search(line))), "")


def _join_groups(rows: list[tuple[int, str]], mark: str) -> list[tuple[int, str]]:
    """Rows without a mark of thousands, which nowhere may be the decimal one."""
    groups = re.compile(rf"(?<=\d){re.escape(mark)}(?=\d{{3}}(?!\d))")
    joined = [(number, groups.sub("", line)) for number, line in rows]
    if mixed := [number for number, line in joined if mark in line]:
        raise ValueError(
            f"line {mixed[0]}: {mark!r} separates decimals, but thousands elsewhere: write "
            "decimal points, and no thousands"
        )
    return joined


def _refuse_groups(rows: list[tuple[int, str]], separator: str | None, mark: str) -> None:
    """Refuse numbers if all their commas, or points, may separate thousands or decimals.

    Points do only beside whole numbers in the same column: those that are decimal have them there.
    """
    example = ""
    whole: dict[int, set[str]] = {}  # numbers without the mark, of every column
    marked: set[int] = set()
    for _, line in rows:
        for column, field in enumerate(map(str.strip, line.split(separator))):
            if mark not in field:
                if not _SMALLER.fullmatch(field):
                    return
                whole.setdefault(column, set()).add(field)
            elif _GROUPS[mark].fullmatch(field):
                example = example or field
                marked.add(column)
            else:
                return
    # A few of them may stand for missing points.
    is_mixed = any(len(whole.get(column, ())) > MOST_MISSING for column in marked)
    if example and (mark == "," or is_mixed):
        advice = {
            ",": "commas or commas for thousands: write them with decimal points or without commas",
            ".": "points or points for thousands: write decimals in all numbers, or no points",
        }
        raise ValueError(f"numbers such as {example!r} may have decimal {advice[mark]}")
