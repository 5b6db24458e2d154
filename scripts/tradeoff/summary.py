"""The table of errors and costs: one row for each setting and quantity, on each surface and load.

The committed table holds medians over surfaces and loads.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
import pandas as pd

KEYS = ["problem", "quantity", "setting", "value"]
COLUMNS = [*KEYS, "surface", "pressure", "error", "cost", "seconds"]
COMMENT = """\
# Error and cost of each setting and each model, from the target tradeoff: medians over surfaces and
# loads, one setting varied at a time. Errors are relative and cover 90 %. Cost: pairs of Fourier
# transforms of 1024 x 1024 doubles, per solution (seeds: per mean) at one load. A new measurement
# is taken over by copying it here.
"""


def list_rows(
    where: tuple[str, str, str, str],
    errors: Mapping[tuple[str, float], float],
    seconds: float,
    unit: float,
) -> list[tuple]:
    """List a row for every quantity and load.

    Parameters
    ----------
    where
        Problem, setting, value and surface.
    errors
        Relative errors by quantity and load.
    seconds, unit
        Processor time [s], and that of the pair of transforms that costs are counted in.
    """
    problem, setting, value, surface = where
    return [
        (problem, quantity, setting, value, surface, load, float(error), seconds / unit, seconds)
        for (quantity, load), error in errors.items()
    ]


def take_medians(rows: pd.DataFrame) -> pd.DataFrame:
    """Take medians over surfaces and loads."""
    return rows.groupby(KEYS, sort=False)[["error", "cost"]].median().reset_index()


def write(path: Path, medians: pd.DataFrame) -> None:
    """Write the table of medians with its comment."""
    text = medians.to_csv(index=False, float_format="%.6g", lineterminator="\n")
    path.write_text(COMMENT + text, encoding="utf-8")


def read(path: str | Path) -> pd.DataFrame:
    """Read the table of medians; ValueError if it is not there or lacks a column."""
    try:
        medians = pd.read_csv(path, comment="#", dtype={"value": str})
    except FileNotFoundError:
        raise ValueError(f"{path}: no such file; the target tradeoff makes it") from None
    missing = [name for name in (*KEYS, "error", "cost") if name not in medians]
    if missing:
        raise ValueError(f"{path}: lacks the column {missing[0]!r}; the target tradeoff makes it")
    return medians


def tables(medians: pd.DataFrame) -> Iterator[tuple[list[str], list[list[str]]]]:
    """Head and lines of a table for every problem and setting, as texts."""
    for (problem, setting), part in medians.groupby(["problem", "setting"], sort=False):
        quantities = list(dict.fromkeys(part.quantity))
        lines = []
        for value, one in part.groupby("value", sort=False):
            errors = one.set_index("quantity").error.reindex(quantities)
            lines.append([value, *map(percent, errors), number(one.cost.median())])
        yield [f"{problem}: {setting}", *quantities, "cost"], lines


def percent(value: float) -> str:
    return "–" if not np.isfinite(value) else f"{100 * value:.2g} %"


def number(value: float) -> str:
    return "–" if not np.isfinite(value) else f"{value:.3g}"
