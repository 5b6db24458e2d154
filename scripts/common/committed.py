"""Tables that are committed: how they are read."""

import pandas as pd


def read(path, columns, target, **options):
    """Read a committed table; ValueError naming the file, what it lacks and what makes it."""
    try:
        # Only an empty cell is none.
        words = {"keep_default_na": False, "na_values": [""]}
        table = pd.read_csv(path, comment="#", **words, **options)
    except FileNotFoundError:
        raise ValueError(f"{path}: no such file; the target {target} makes it") from None
    missing = [name for name in columns if name not in table]
    if missing:
        names = ", ".join(missing)
        raise ValueError(f"{path}: lacks the columns {names}; the target {target} makes it")
    return table
