"""Value and limits of a number, from all that it may be.

What a surface may be, and by how much the model may err there, are the rows of a table, see
`scenarios`. A number of all rows becomes one number with limits here, and nowhere else. The limits
cover 90 %. Files hold them along the dimension `limit`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from stickiness.limited import Limited

LIMITS = ("low", "value", "high")  #: along the dimension `limit` of files
LOW, VALUE, HIGH = range(3)  #: their places
#: Unit and description of that dimension.
LIMIT_TEXT = ("1", "value, and the limits of all that is unknown, which cover 90 %")
QUANTILES = (0.05, 0.5, 0.95)  #: of the rows, low limit, value and high limit


def find_limits(values: ArrayLike, weights: NDArray, withstands: ArrayLike = True) -> NDArray:
    """Low limit, value and high limit of a number: weighted quantiles over all that it may be.

    They are values of rows, so that limits of shares, margins and thresholds agree with each other.

    Parameters
    ----------
    values : (..., n) array
        The number in every row.
    weights : (n,) array
        Weights of the rows, whole numbers, whose sums are exact.
    withstands : (..., n) array
        Whether a layer takes the heights of a row. For the low limit, nothing remains where not.

    Returns
    -------
    (..., 3) array
        In the order of `LIMITS`.
    """
    values = np.asarray(values, dtype=float)
    least = np.where(withstands, values, 0.0)

    def find_quantiles(rows: NDArray, parts: Sequence[float]) -> NDArray:
        return np.quantile(rows, parts, axis=-1, weights=weights, method="inverted_cdf")

    low = find_quantiles(least, QUANTILES[:1])
    value_and_high = find_quantiles(values, QUANTILES[1:])
    return np.moveaxis(np.concatenate([low, value_and_high]), 0, -1)


def read_limited(numbers: xr.DataArray) -> Limited[Any]:
    """Read a number with limits along `limit`: floats, arrays if it has other dimensions."""
    value, low, high = (numbers.sel(limit=name, drop=True) for name in ("value", "low", "high"))
    if numbers.ndim == 1:
        return Limited(float(value), float(low), float(high))
    return Limited(value, low, high)
