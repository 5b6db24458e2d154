"""Text exports of topographies: a matrix of numbers under an optional header."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from stickiness.measured import text_header

_COMMENT = ("#", "%", "//")
_MISSING = {"nan", "-nan", "na", "n/a", "bad", "null", "none", "---", "--", "-", "***", "*", ""}
_ALTERNATE = 5.0  # step to the next column over that to the next but one, if commas split numbers


@dataclass(frozen=True)
class TextMatrix:
    """Content of a text matrix."""

    values: NDArray  #: (rows, columns), as written, NaN where a point is marked as missing
    header: tuple[str, ...]  #: lines of comments, and those before the first row
    width: str | None = None  #: along the rows, with unit, from the header
    height: str | None = None  #: down the columns
    value_unit: str | None = None  #: of the numbers
    lateral_unit: str | None = None  #: of positions x y, if the columns are x y z


def parse(path: Path) -> TextMatrix:
    """Read a matrix separated by tabs, semicolons, commas or spaces.

    Lines that begin with #, % or // are comments, and so are lines before the first row that do
    not begin with a number. Among them "Width: 10 µm", "Height: 10 µm" and "Value units: m", as
    Gwyddion exports them, are read. Decimal commas are allowed if the separator is another.
    Missing points may be written as NaN, ---, *** or left empty between tabs, semicolons or commas.

    A ValueError names file, line and field if there are no numbers, rows differ in length, a
    field is no number, commas split the numbers, or the header says what is not read.
    """
    header, rows = split_header(decode(path.read_bytes()))
    if not rows:
        raise ValueError(
            f"{path}: no line of numbers found; expected a matrix of heights, or give format: "
            "instrument if it is an instrument's file"
        )
    text_header.check_factor(path, header)
    values = _matrix(path, rows)
    return TextMatrix(values, tuple(header), **text_header.fields_of(header))


def split_header(text: str) -> tuple[list[str], list[tuple[int, str]]]:
    """Comments and lines before the first row, and the rows with their line numbers."""
    header: list[str] = []
    rows: list[tuple[int, str]] = []
    for number, line in enumerate(text.splitlines(), start=1):
        stripped = line.strip(" \r\n")
        if stripped.startswith(_COMMENT) or (not rows and not _starts_with_number(stripped)):
            header.append(stripped)
        elif stripped.strip():
            rows.append((number, stripped))
    return header, rows


def decode(raw: bytes) -> str:
    """Text of a file, whatever of three encodings it has."""
    if raw.startswith((b"\xff\xfe", b"\xfe\xff")):
        return raw.decode("utf-16")
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        return raw.decode("latin-1")  # older instruments write µ as one byte


def _starts_with_number(line: str) -> bool:
    first = re.split(r"[\t;, ]", line.strip(), maxsplit=1)[0]
    return first.lower() in {"nan", "-nan"} or bool(re.match(r"[-+]?\.?\d", first))


def _separator(line: str) -> str | None:
    """Return the separator of a row; None stands for any run of blanks."""
    for separator in ("\t", ";"):
        if separator in line:
            return separator
    # "1,5 2,5" has decimal commas, "1.5, 2.5" and "1,2,3" separating ones.
    if "," in line and (" " not in line or re.search(r",\s", line)):
        return ","
    return None


def _matrix(path: Path, rows: list[tuple[int, str]]) -> NDArray:
    separator = _separator(rows[0][1])
    decimal_comma = separator != ","
    values: list[NDArray] = []
    for number, line in rows:
        fields = (line.replace(",", ".") if decimal_comma else line).split(separator)
        if separator and len(fields) > 1 and not fields[-1].strip():
            fields.pop()  # a separator after the last number
        try:
            row = np.array(fields, dtype=float)
        except ValueError:
            row = np.array([_number(path, number, field) for field in fields])
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


def _commas_split(matrix: NDArray) -> bool:
    """Whether columns are by turns whole numbers and their decimals: close to the next but one."""
    if matrix.shape[1] % 2 or matrix.shape[1] < 4 or np.any(matrix[:, 1::2] < 0):
        return False
    beside = np.nanmedian(np.abs(np.diff(matrix, axis=1)))
    whole = np.nanmedian(np.abs(np.diff(matrix[:, ::2], axis=1)))
    return bool(beside > _ALTERNATE * whole)


def _number(path: Path, number: int, field: str) -> float:
    field = field.strip()
    if field.lower() in _MISSING:
        return np.nan
    try:
        return float(field)
    except ValueError:
        raise ValueError(
            f"{path}, line {number}: {field!r} is not a number; mark missing points by NaN and "
            "comment lines by #"
        ) from None
