"""Points of the attraction at the edges of contact that are certain enough to say something."""

import numpy as np

COLUMNS = (
    *("attractive_over_contact", "edge_strength"),
    *("effect", "over_model", "over_model_total_error"),
)
LARGEST_ERROR = 0.25  # of a point that is drawn; covers 90 %


def select_certain(files):
    """Points of all files with a small enough error, by `COLUMNS`: ``(column, point)``."""
    columns = [
        [data[name].transpose(*data.effect.dims).values.ravel() for data in files]
        for name in COLUMNS
    ]
    points = np.array([np.concatenate(parts) for parts in columns])
    return points[:, points[-1] < LARGEST_ERROR]
