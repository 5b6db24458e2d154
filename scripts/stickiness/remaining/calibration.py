"""How far predictions of what remains have been off, and so how wide their limits are.

Simulations stand beside predictions in the tables of ``config/``, of which the rule
`calibrate_limits` makes the one beside this module; ``config/limits.csv`` is a link to it. Limits
cover 90 %. What the errors are proportional to is in `errors`.
"""

from __future__ import annotations

import csv
from functools import cache
from importlib import resources

from stickiness.limited import Limited


def find_spread(kind: str, quantity: str) -> Limited[float]:
    """Spread of simulations about predictions: where the middle of them lies, and 90 %.

    Parameters
    ----------
    kind, quantity : str
        Columns of the table, whose head describes them.

    Raises
    ------
    KeyError
        If the table has no such row.
    """
    return _read_spreads()[kind, quantity]


@cache
def _read_spreads() -> dict[tuple[str, str], Limited[float]]:
    """Rows of the table by kind and quantity."""
    with (resources.files("stickiness.remaining") / "calibration.csv").open(
        encoding="utf-8"
    ) as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return {
            (row["kind"], row["quantity"]): Limited(
                value=float(row["value"]), low=float(row["low"]), high=float(row["high"])
            )
            for row in rows
        }
