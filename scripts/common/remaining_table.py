"""The committed table of the adhesion that remains: simulated values with predictions beside."""

from common import committed

COLUMNS = (
    *("set", "role", "hurst", "magnification", "window", "points", "seed", "full_contact_energy"),
    *("rms_slope", "energy_ratio", "pressed", "zone", "range", "adhesion_length"),
    *("approach", "separation", "bound"),
    *("pull_off", "pixels_in_zone", "predicted", "predicted_pull_off"),
)


def read(path):
    """Read the table with kinds of rows; errors as of `committed.read`."""
    table = committed.read(path, COLUMNS, "remaining_measured")
    return table.assign(
        wide=table.window > 1,  # cells of two by two of the longest waves or more
        weak=table["set"].str.contains("weak"),  # from weak to tough adhesion
        held=table.role == "unseen",
    )
