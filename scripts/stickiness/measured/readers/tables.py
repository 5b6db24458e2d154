"""Numbers of a table of text, whatever separates them, their decimals and their thousands.

A comma or a point may mean any of these. What can be read in two ways is refused.
"""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

MOST_MISSING = 2  #: different whole numbers that may stand for missing points in a column

Rows = dict[int, str]  # by the number of their line

# What a comma or a point may mean: groups of three digits, beside smaller numbers without any.
_GROUPS = {mark: re.compile(rf"[-+]?[1-9]\d{{0,2}}(?:{re.escape(mark)}\d{{3}})+") for mark in ",."}
_SMALLER = re.compile(r"[-+]?\d{1,3}|[^\d]*")
# A number with groups of three digits that can mean nothing else, and the mark between them.
_GROUPED = re.compile(
    r"(?<![\d.,])[1-9]\d{0,2}([.,])(?:\d{3}\1)*\d{3}(?:(?!\1)[.,]\d|\1\d{3}(?![\d.,]))"
)
_DECIMAL = re.compile(r"[-+]?\d+,\d+")
# A line that may be one number, with groups of digits or a decimal comma.
_ONE_NUMBER = re.compile(r"[-+]?(?:[1-9]\d{0,2}(?:[.,]\d{3})+|\d+)[.,]\d+")
_MISSING = {"", "na", "n/a", "bad", "null", "none", "-nan", "-", "--", "---", "*", "***"}


def read_rows(rows: Rows, has_decimal_commas: bool) -> NDArray:
    """Numbers of a table, NaN where they are missing."""
    first = next(iter(rows.values()))
    separator = next((mark for mark in "\t;" if mark in first), None)  # None: any run of blanks
    # "1,5 2,5" has decimal commas, "1.5, 2.5" and "1,2,3" separating ones.
    may_separate = not has_decimal_commas and not _is_column_of_decimals(rows)
    if separator is None and may_separate and re.search(r",\s|^[^ ]*,[^ ]*$", first):
        separator = ","

    # Marks of thousands go; those that may be decimal ones are refused.
    mark = None if separator == "," else _find_mark_of_thousands(rows)
    if mark:
        rows = _join_groups(rows, mark)
    elif not has_decimal_commas:
        if separator != ",":
            _refuse_groups(rows, separator, ",")
        _refuse_groups(rows, separator, ".")
    if separator != ",":
        rows = {number: row.replace(",", ".") for number, row in rows.items()}
    table = np.array(_split_rows(rows, separator))
    if separator == ",":
        _refuse_split_decimals(table, rows)
    return table


def _split_rows(rows: Rows, separator: str | None) -> list[list[float]]:
    """Numbers of every row, as many in each."""
    table: list[list[float]] = []
    # A separator behind the last number of every row is none; of some rows it is a missing point.
    has_ends = bool(separator) and all(row.endswith(str(separator)) for row in rows.values())
    for number, row in rows.items():
        words = row.split(separator)
        if has_ends:
            words.pop()
        try:
            table.append([np.nan if w.strip().lower() in _MISSING else float(w) for w in words])
        except ValueError as error:
            raise ValueError(
                f"line {number}: {str(error)[:80]}; mark missing points by NaN and comment lines "
                "by #"
            ) from None
        if len(words) != len(table[0]):
            raise ValueError(
                f"line {number}: {len(words)} numbers where the first row has {len(table[0])}; "
                "every row needs as many"
            )
    return table


def _is_column_of_decimals(rows: Rows) -> bool:
    """Whether every line is a number with a decimal comma.

    As two whole numbers, positions would repeat and heights begin with a zero; as one, commas for
    thousands would have three digits behind them.
    """
    lines = list(rows.values())
    if not all(map(_DECIMAL.fullmatch, lines)) or all(map(_GROUPS[","].fullmatch, lines)):
        return False
    whole, decimals = zip(*(line.split(",") for line in lines), strict=True)
    begins_with_zero = any(re.match("0[0-9]", digits) for digits in decimals)
    return begins_with_zero and len(set(whole)) < len(whole) / 2


def _refuse_split_decimals(table: NDArray, rows: Rows) -> None:
    """Refuse numbers that separating commas may have split into whole numbers and decimals."""
    first = next(iter(rows.values()))
    # Do columns by turns hold them: close to the next but one?
    columns = table.shape[1]
    are_pairs = columns >= 4 and columns % 2 == 0 and not np.any(table[:, 1::2] < 0)
    if "." not in first and are_pairs:
        beside = np.nanmedian(np.abs(np.diff(table, axis=1)))
        whole = np.nanmedian(np.abs(np.diff(table[:, ::2], axis=1)))
        if beside > 5 * whole:
            raise ValueError(
                f"{columns} columns without a decimal point that alternate: decimal commas, which "
                "its separating commas hide; separate by tabs or semicolons, or write decimal "
                "points"
            )
    is_repeated = len(np.unique(table[:, 0])) < len(table)
    may_be_one = is_repeated or "." in first.partition(",")[0]
    if may_be_one and all(map(_ONE_NUMBER.fullmatch, rows.values())):
        raise ValueError(
            f"lines such as {first!r} may hold two numbers, or one with a comma: write decimal "
            "points and no thousands, or separate numbers by tabs or semicolons"
        )


def _find_mark_of_thousands(rows: Rows) -> str:
    """Mark between groups of three digits, if a number shows that it is one."""
    # Most lines have points alone, and no group of digits between two of them.
    odd = (row for row in rows.values() if "," in row or re.search(r"\.\d{3}\.", row))
    return next((match[1] for match in map(_GROUPED.search, odd) if match), "")


def _join_groups(rows: Rows, mark: str) -> Rows:
    """Rows without a mark of thousands, which nowhere may be the decimal one."""
    groups = re.compile(rf"(?<=\d){re.escape(mark)}(?=\d{{3}}(?!\d))")
    joined = {number: groups.sub("", row) for number, row in rows.items()}
    if mixed := [number for number, row in joined.items() if mark in row]:
        raise ValueError(
            f"line {mixed[0]}: {mark!r} separates decimals, but thousands elsewhere: write "
            "decimal points, and no thousands"
        )
    return joined


def _refuse_groups(rows: Rows, separator: str | None, mark: str) -> None:
    """Refuse numbers if all their commas, or points, may separate thousands or decimals.

    Points do only beside whole numbers in the same column: those that are decimal have them there.
    """
    example = ""
    whole: dict[int, set[str]] = {}  # numbers without the mark, of every column
    marked: set[int] = set()
    for row in rows.values():
        for column, word in enumerate(map(str.strip, row.split(separator))):
            if mark not in word:
                if not _SMALLER.fullmatch(word):
                    return
                whole.setdefault(column, set()).add(word)
            elif _GROUPS[mark].fullmatch(word):
                example = example or word
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
