"""Value and limits of a number, from all that it may be.

What a surface may be, and by how much the model may err there, are the rows of a table, see
`scenarios`. A number of all rows becomes one number with limits here, and nowhere else. The limits
cover 90 %. Files hold them along the dimension `limit`.
"""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from stickiness.limited import Limited

LIMITS = ("low", "value", "high")  #: along the dimension `limit` of files
LOW, VALUE, HIGH = range(3)  #: their places
#: Unit and description of that dimension.
LIMIT_TEXT = ("1", "value, and the limits of all that is unknown, which cover 90 %")
QUANTILES = (0.05, 0.5, 0.95)  #: of the rows, low limit, value and high limit
_ROUNDING = 1e-9  # of sums of weights


def find_limits(values: ArrayLike, weights: NDArray, withstands: ArrayLike = True) -> NDArray:
    """Low limit, value and high limit of a number: weighted quantiles over all that it may be.

    They are values of rows, so that limits of shares, margins and thresholds agree with each other.

    Parameters
    ----------
    values : (..., n) array
        The number in every row.
    weights : (n,) array
        Weights of the rows; their sum is 1.
    withstands : (..., n) array
        Whether a layer takes the heights of a row. For the low limit, nothing remains where not.

    Returns
    -------
    (..., 3) array
        In the order of `LIMITS`.
    """
    values = np.asarray(values, dtype=float)
    least = np.where(withstands, values, 0.0)
    sorted_rows = [_sort(least, weights), _sort(values, weights)]
    chosen = [sorted_rows[0], sorted_rows[1], sorted_rows[1]]
    return np.stack(
        [_find_quantile(*rows, part) for rows, part in zip(chosen, QUANTILES, strict=True)],
        axis=-1,
    )


def _sort(values: NDArray, weights: NDArray) -> tuple[NDArray, NDArray]:
    """Values in rising order, and the sums of the weights up to each."""
    order = np.argsort(values, axis=-1)
    return np.take_along_axis(values, order, axis=-1), np.cumsum(weights[order], axis=-1)


def _find_quantile(values: NDArray, reached: NDArray, part: float) -> NDArray:
    """Least value up to which the weights reach a part of the whole, along the last axis."""
    place = np.argmax(reached >= part - _ROUNDING, axis=-1)
    return np.take_along_axis(values, place[..., None], axis=-1)[..., 0]


def read_limited(numbers: xr.DataArray) -> Limited:
    """Read a number with limits along the dimension `limit`."""
    value, low, high = (numbers.sel(limit=name, drop=True) for name in ("value", "low", "high"))
    if numbers.ndim == 1:
        return Limited(float(value), float(low), float(high))
    return Limited(value, low, high)
