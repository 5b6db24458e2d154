"""The table of errors and costs: one row for each setting and quantity, on each surface and load.

The committed table holds medians over surfaces and loads.
"""

import numpy as np
import pandas as pd

KEYS = ["problem", "quantity", "setting", "value"]
COLUMNS = [*KEYS, "surface", "pressure", "error", "cost"]
COMMENT = """\
# Error and cost of each setting and each model, from the target tradeoff: medians over surfaces and
# loads, one setting varied at a time. Errors are relative and cover 90 %. Cost: pairs of Fourier
# transforms of 1024 x 1024 doubles, per solution (seeds: per mean) at one load. A new measurement
# is taken over by copying it here.
"""


class Records:
    """Rows of the table, and the points that error models are fitted to."""

    def __init__(self):
        self.rows, self.points = [], []

    def start(self, problem, name, surface):
        """Name the problem and the surface of what is added from now on."""
        self.problem, self.name, self.surface = problem, name, surface

    def add(self, setting, value, errors, cost):
        """Add a row for every error, by quantity and load."""
        for (quantity, load), error in errors.items():
            if np.isfinite(error):
                where = self.problem, quantity, setting, value, self.name
                self.rows.append((*where, float(load), float(error), float(cost)))

    def add_point(
        self, part, quantity, value, noise=0.0, *, pressure=1.0, pixels=1.0, tolerance=1.0
    ):
        """Add a value of one part of the error models and its standard error, 0 if known well."""
        surface = self.surface.hurst, self.surface.magnification, self.surface.window
        at = pressure, pixels, tolerance
        self.points.append((part, quantity, *surface, *at, float(value), float(noise)))


def take_medians(rows):
    return rows.groupby(KEYS, sort=False)[["error", "cost"]].median().reset_index()


def write(path, medians):
    text = medians.to_csv(index=False, float_format="%.6g", lineterminator="\n")
    path.write_text(COMMENT + text, encoding="utf-8")


def read(path):
    """Read the table of medians; ValueError if it is not there or lacks a column."""
    try:
        medians = pd.read_csv(path, comment="#", dtype={"value": str})
    except FileNotFoundError:
        raise ValueError(f"{path}: no such file; the target tradeoff makes it") from None
    missing = [name for name in (*KEYS, "error", "cost") if name not in medians]
    if missing:
        raise ValueError(f"{path}: lacks the column {missing[0]!r}; the target tradeoff makes it")
    return medians


def tables(medians):
    """Head and lines of a table for every problem and setting, as texts."""
    for (problem, setting), part in medians.groupby(["problem", "setting"], sort=False):
        errors = part.pivot_table("error", "value", "quantity", sort=False)
        cost = part.groupby("value", sort=False).cost.median()
        lines = [
            [value, *map(percent, row), f"{cost[value]:.3g}"] for value, row in errors.iterrows()
        ]
        yield [f"{problem}: {setting}", *errors.columns, "cost"], lines


def percent(value):
    return f"{100 * value:.2g} %" if np.isfinite(value) else "–"
