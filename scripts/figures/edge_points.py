"""Points of simulated adhesion beside the equivalent sphere, as Figure 10 and texts take them."""

from collections.abc import Iterable

import numpy as np
import xarray as xr
from numpy.typing import NDArray

COLUMNS = (
    *("attractive_over_contact", "edge_strength"),
    *("effect", "over_model", "over_model_total_error"),
)
LARGEST_ERROR = 0.25  # of a point that is drawn; covers 90 %
# Tabor parameters between which ratios are averaged: from about 0.2 on they have a trend.
BINS = (1e-3, 0.01, 0.05, 0.2, 0.5, 1.0, 1.5, 2.5, 4.0)


def select_certain(data: xr.Dataset) -> NDArray:
    """Points with an error small enough to say something, by `COLUMNS`: ``(column, point)``."""
    dims = data.effect.dims
    columns = np.array([data[name].transpose(*dims).values.ravel() for name in COLUMNS])
    return columns[:, columns[-1] < LARGEST_ERROR]


def join_certain(files: Iterable[xr.Dataset]) -> NDArray:
    """The points of all files, ``(column, point)``."""
    return np.concatenate([select_certain(data) for data in files], axis=1)
