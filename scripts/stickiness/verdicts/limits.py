"""Value and limits of a number, from all that it may be.

What a surface may be, and by how much the model may err there, are the rows of a table, see
`meeting`. A number of all rows becomes one number with limits here, and nowhere else. The limits
cover 90 %. Files hold them along the dimension `limit`.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from stickiness.limited import Limited

LIMITS = ("low", "value", "high")  #: along the dimension `limit` of files
LOW, VALUE, HIGH = range(3)  #: their places
#: Unit and description of that dimension.
LIMIT_TEXT = ("1", "value, and the limits of all that is unknown, which cover 90 %")
QUANTILES = (0.05, 0.5, 0.95)  #: of draws, low limit, value and high limit
ROUGH_END = 1  #: row of a surface that is known between its ends, which has its value


def limit_drawn(values: ArrayLike, withstands: ArrayLike = True) -> NDArray:
    """Low limit, value and high limit of a number that was found for every draw.

    They are values of rows, so that limits of shares, margins and thresholds agree with each other.

    Parameters
    ----------
    values : (..., n) array
        The number in every row.
    withstands : (..., n) array
        Whether a layer takes the heights of a row. For the low limit, nothing remains where not.

    Returns
    -------
    (..., 3) array
        In the order of `LIMITS`.
    """
    values = np.asarray(values, dtype=float)
    least = np.where(withstands, values, 0.0)
    return np.stack(
        [
            np.quantile(rows, part, axis=-1, method="inverted_cdf")
            for rows, part in zip((least, values, values), QUANTILES, strict=True)
        ],
        axis=-1,
    )


def limit_between_ends(values: ArrayLike, withstands: ArrayLike = True) -> NDArray:
    """The same of a surface that is known between a smooth and a rough end, ``(..., 6)``.

    The first two rows are both ends without an error of the model, see `meeting.deviate`.
    """
    values = np.asarray(values, dtype=float)
    least = np.where(withstands, values, 0.0)
    return np.stack([least.min(-1), values[..., ROUGH_END], values.max(-1)], axis=-1)


def read_limited(numbers: xr.DataArray) -> Limited[Any]:
    """Read a number with limits along `limit`: floats, arrays if it has other dimensions."""
    value, low, high = (numbers.sel(limit=name, drop=True) for name in ("value", "low", "high"))
    if numbers.ndim == 1:
        return Limited(float(value), float(low), float(high))
    return Limited(value, low, high)
