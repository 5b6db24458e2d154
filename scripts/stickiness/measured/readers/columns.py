"""Named columns of a table of text, as rheometers and programs for spectra export them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path

from numpy.typing import NDArray

from stickiness.measured.readers.raw import split_unit
from stickiness.measured.readers.tables import read_rows
from stickiness.measured.readers.text import decode, split_lines, split_names

Column = tuple[str, str, NDArray]  #: name, unit (empty if none is told) and numbers


def read_columns(path: Path, patterns: Mapping[str, str]) -> dict[str, Column]:
    """Find the columns of a file whose names match, whatever their case, and their units.

    Parameters
    ----------
    path : Path
        Text with a line that names every column, with its unit in brackets or in the line below.
    patterns : dict of str
        Pattern of the whole name, by what messages call the column.

    Returns
    -------
    dict of Column
        Name, unit and numbers by the keys of `patterns`, as far as columns match; NaN where a
        number is missing.

    Raises
    ------
    ValueError
        If the file is no table with names, or if a pattern matches two columns.
    """
    if not path.is_file():
        raise ValueError("no such file; give a path from the working directory")
    header, rows = split_lines(decode(path.read_bytes()).splitlines())
    if not rows:
        raise ValueError("no line of numbers found; export the table as text (CSV)")
    table = read_rows(rows, has_decimal_commas=False)
    count = table.shape[1]

    # Any line of the header may name the columns; the next one may hold their units.
    columns: dict[str, Column] = {}
    for line, next_line in pairwise([*header, ""]):
        words = split_names(line.strip("#%/ "), count)
        if words is None:
            continue
        below = re.split(r"\s*[\t;,]\s*", next_line.strip("#%/ "))
        names, units = zip(*map(split_unit, words), strict=True)
        for key, pattern in patterns.items():
            matches = [i for i, name in enumerate(names) if re.fullmatch(f"(?i){pattern}", name)]
            if len(matches) > 1:
                told = " and ".join(repr(words[i]) for i in matches)
                raise ValueError(f"{told} may both be the {key}: leave one of these columns")
            for i in matches:
                unit_below = below[i].strip("[]() ") if len(below) == count else ""
                columns.setdefault(key, (names[i], units[i] or unit_below, table[:, i]))
    return columns
