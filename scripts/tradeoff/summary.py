"""Summary of the trade between accuracy and cost: a table that is committed, and how it is shown.

Rows are medians over surfaces and loads, one for every setting of every knob and every quantity.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pandas as pd

COLUMNS = ("knob", "setting", "quantity", "error", "cost", "memory")
COMMENT = """\
# What every setting errs by and costs, medians over surfaces and loads, from the target tradeoff.
# To take a new measurement over, copy it here. Errors are relative and cover 90 %; cost in pairs of
# Fourier transforms of 1024 x 1024 doubles; memory in MB.
"""


def write(path: Path, medians: pd.DataFrame) -> None:
    """Write the table with its comment."""
    text = medians[list(COLUMNS)].to_csv(index=False, float_format="%.6g", lineterminator="\n")
    path.write_text(COMMENT + text, encoding="utf-8")


def read(path: str | Path) -> pd.DataFrame:
    """Read the table.

    Raises
    ------
    ValueError
        Naming the file and what it lacks.
    """
    try:
        medians = pd.read_csv(path, comment="#", dtype={"setting": str})
    except FileNotFoundError:
        raise ValueError(f"{path}: no such file; the target tradeoff makes it") from None
    missing = [name for name in COLUMNS if name not in medians]
    if missing:
        raise ValueError(f"{path}: lacks the column {missing[0]!r}; the target tradeoff makes it")
    return medians


def tables(medians: pd.DataFrame) -> Iterator[tuple[list[str], list[list[str]]]]:
    """Head and lines of a table for every knob, with one line for every setting, as texts."""
    for knob in dict.fromkeys(medians.knob):
        part = medians[medians.knob == knob]
        quantities = list(dict.fromkeys(part.quantity))
        lines = []
        for setting in dict.fromkeys(part.setting):
            one = part[part.setting == setting]
            errors = [
                percent(one.error[one.quantity == quantity].median()) for quantity in quantities
            ]
            lines.append([setting, *errors, plain(one.cost.median()), plain(one.memory.median())])
        yield [knob, *quantities, "cost", "memory [MB]"], lines


def percent(value: float) -> str:
    return "–" if not np.isfinite(value) else f"{100 * value:.2g} %"


def plain(value: float) -> str:
    return "–" if not np.isfinite(value) else f"{value:.3g}"
