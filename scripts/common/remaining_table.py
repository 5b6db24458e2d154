"""The committed table of the adhesion that remains: simulated values with predictions beside."""

import pandas as pd

COLUMNS = (
    *("set", "hurst", "magnification", "window", "points", "seed", "full_contact_energy"),
    *("rms_slope", "energy_ratio", "pressed", "zone", "range", "adhesion_length"),
    *("approach", "separation", "bound"),
    *("pull_off", "pixels_in_zone", "predicted", "predicted_low", "predicted_high"),
    "predicted_pull_off",
)


def read(path):
    """Read the table with kinds of rows; ValueError naming the file and what it lacks."""
    try:
        table = pd.read_csv(path, comment="#")
    except FileNotFoundError:
        raise ValueError(f"{path}: no such file; the target remaining_measured makes it") from None
    missing = [name for name in COLUMNS if name not in table]
    if missing:
        raise ValueError(f"{path}: lacks the columns {', '.join(missing)}")
    return table.assign(
        wide=table.window > 1,  # cells of two by two of the longest waves or more
        weak=table["set"].str.contains("weak"),  # from weak to tough adhesion
        held=table["set"].str.contains("_held"),  # nothing was fitted to these rows
    )
