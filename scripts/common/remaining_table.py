"""The committed table of the adhesion that remains: simulated values with predictions beside."""

import pandas as pd

COLUMNS = (
    *("set", "hurst", "magnification", "window", "points", "seed", "full_contact_energy"),
    *("energy_ratio", "zone", "range", "adhesion_length", "approach", "separation", "bound"),
    *("pull_off", "pixels_in_zone", "predicted", "predicted_low", "predicted_high"),
    "predicted_pull_off",
)


def read(path):
    """Read the table; ValueError naming the file and what it lacks."""
    try:
        table = pd.read_csv(path, comment="#")
    except FileNotFoundError:
        raise ValueError(f"{path}: no such file; the target remaining_measured makes it") from None
    missing = [name for name in COLUMNS if name not in table]
    if missing:
        raise ValueError(f"{path}: lacks the columns {', '.join(missing)}")
    return table


def is_wide(table):
    """Whether cells hold two by two of the longest waves or more."""
    return table.window > 1


def is_weak(table):
    """Whether rows belong to the set from weak to tough adhesion."""
    return table["set"].str.endswith("_weak")


def is_held(table):
    """Whether nothing was fitted to rows."""
    return table["set"].str.endswith("_held")
