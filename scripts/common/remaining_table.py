"""The committed table of the adhesion that remains: simulated values with the theories beside."""

from __future__ import annotations

from pathlib import Path

import pandas as pd

from common.formatting import number, table

COLUMNS = (
    *("set", "hurst", "magnification", "window", "points", "seed", "full_contact_energy"),
    *("energy_ratio", "zone", "range", "adhesion_length", "approach", "separation", "bound"),
    *("pull_off", "pixels_in_zone", "predicted", "predicted_low", "predicted_high"),
    *("predicted_pull_off", "full_contact", "dmt", "local_margin", "finest_margin"),
)
HELD = "_held"  # end of the name of a set that nothing was fitted to
WEAK = "_weak"  # of a set from weak to tough adhesion
BINS = (0.3, 0.4, 0.6, 0.8, 1.1, 1.5, 2.5)  # of w/U_full, of the table of means


def read(path: str | Path) -> pd.DataFrame:
    """Read the table.

    Raises
    ------
    ValueError
        Naming the file and what it lacks.
    """
    try:
        table = pd.read_csv(path, comment="#")
    except FileNotFoundError:
        raise ValueError(f"{path}: no such file; the target remaining_measured makes it") from None
    missing = [name for name in COLUMNS if name not in table]
    if missing:
        raise ValueError(f"{path}: lacks the columns {', '.join(missing)}")
    return table


def is_wide(table: pd.DataFrame) -> pd.Series:
    """Whether cells hold two by two of the longest waves or more."""
    return table.window > 1


def is_weak(table: pd.DataFrame) -> pd.Series:
    """Whether rows belong to the set from weak to tough adhesion."""
    return table["set"].str.endswith(WEAK)


def is_held(table: pd.DataFrame) -> pd.Series:
    """Whether nothing was fitted to rows."""
    return table["set"].str.endswith(HELD)


def summarise(frame: pd.DataFrame) -> str:
    """Means of simulation and theories by w/U_full, as a table in Markdown."""
    names = ("approach", "separation", "bound", "predicted", "full_contact", "dmt")
    tough = frame[(frame.zone < 0.11) & (frame.window > 1)]
    groups = tough.groupby(pd.cut(tough.energy_ratio, BINS), observed=True)
    rows = [
        (
            number(group.energy_ratio.mean(), 2),
            len(group),
            *(f"{group[n].mean():.3f}" for n in names),
        )
        for _, group in groups
    ]
    return table(("w/U_full", "points", *(name.replace("_", " ") for name in names)), rows)
