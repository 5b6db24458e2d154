"""Text exports of topographies: a matrix of numbers under an optional header."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

_COMMENT = ("#", "%", "//")
_MISSING = {"nan", "-nan", "na", "n/a", "bad", "null", "none", "---", "--", "-", "***", "*", ""}
_HEADER = re.compile(r"^\W*(width|height|value units?)\s*[:=]\s*(.+?)\s*$", re.IGNORECASE)


@dataclass(frozen=True)
class TextMatrix:
    """Content of a text matrix."""

    values: NDArray  # (rows, columns), as written, NaN where a point is marked as missing
    width: str | None = None  # along the rows, with unit, from the header
    height: str | None = None  # down the columns
    value_unit: str | None = None  # of the numbers


def parse(path: Path) -> TextMatrix:
    """Read a matrix separated by tabs, semicolons, commas or spaces.

    Lines that begin with #, % or // are comments, and so are lines before the first row that do
    not begin with a number. Among them "Width: 10 µm", "Height: 10 µm" and "Value units: m", as
    Gwyddion exports them, are read. Decimal commas are allowed if the separator is another.
    Missing points may be written as NaN, ---, *** or left empty between tabs, semicolons or commas.

    A ValueError names file, line and field if there are no numbers, rows differ in length or a
    field is no number.
    """
    header: dict[str, str] = {}
    rows: list[tuple[int, str]] = []
    for number, line in enumerate(_decode(path).splitlines(), start=1):
        stripped = line.strip(" \r\n")
        if stripped.startswith(_COMMENT) or (not rows and not _starts_with_number(stripped)):
            match = _HEADER.match(stripped)
            if match:
                key = match[1].lower()
                header["value_unit" if key.startswith("value") else key] = match[2]
        elif stripped.strip():
            rows.append((number, stripped))
    if not rows:
        raise ValueError(f"{path}: no line of numbers found; expected a matrix of heights")
    return TextMatrix(_matrix(path, rows), **header)


def _decode(path: Path) -> str:
    raw = path.read_bytes()
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
    return np.array(values)


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
