"""How far predictions of what remains have been off, and so how wide their limits are.

Every error of the share that remains is taken as an error of the work of adhesion: a limit of the
share is its value at the work of adhesion times exp(error). The threshold of a modulus then has the
limits value times exp(-error), and shares and thresholds agree.

The errors are those of simulations beside predictions, in the tables of ``config/``, of which the
rule `calibrate_limits` makes ``config/limits.csv``. The package holds that file, too, beside this
module. Limits cover 90 %.
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
    kind : str
        What was predicted: by the spectrum on half-spaces ("spectrum"), in contacts of few of the
        longest waves along a side ("two waves", "one wave"), for the skewness of heights
        ("skewness"), on other solids ("layer", "film", "thin", "skin"), by states simulated on
        heights ("states"), on a surface by a map that was cut from it ("patch"), in a contact
        larger than a scan ("larger", "larger non-Gaussian"), or of a ball ("ball").
    quantity : str
        "ln_work" is the error of the logarithm of the work of adhesion; others are described in the
        table.

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
