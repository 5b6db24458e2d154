"""How much the roughness of a surface differs from place to place, beyond that of Gaussian heights.

A scan of even roughness tells that of a larger contact. If the quarters of a scan differ, which are
half as long, so may the scan differ from a contact twice as long.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.measured.psd import autocorrelation

ROUNDING = 1e-6  #: slope along an axis, over the steepest, below which there is none


def find_unevenness(heights: ArrayLike, lags: Sequence[int]) -> float:
    """Find the standard deviation of ln of the mean square slope among the quarters of a map.

    Parameters
    ----------
    heights : (nx, ny) or (n,) array
        Levelled heights of a map, or of a profile, which has halves; not flat.
    lags : sequence of int
        Points along every axis over which a slope is taken: half of the shortest wave resolved.

    Returns
    -------
    float
        Without the scatter that Gaussian heights with these waves have in the mean; 0 below that.
        Of a third of Gaussian maps something is left: their scatter is above its mean.
    """
    heights = np.asarray(heights, dtype=float)
    slopes = [_difference(heights, axis, lag) for axis, lag in enumerate(lags)]
    # Along grooves there is no slope but that of rounding.
    steepest = max(np.mean(slope**2) for slope in slopes)
    slopes = [slope for slope in slopes if np.mean(slope**2) > ROUNDING**2 * steepest]
    count = 2**heights.ndim
    logs = np.zeros(count)
    chance = 0.0
    for slope in slopes:
        square = slope**2 / np.mean(slope**2)
        of_parts = np.array([part.mean() for part in _halve(square)])
        logs += np.log(np.maximum(of_parts, ROUNDING**2)) / len(slopes)
        # The mean square of Gaussian values has the relative variance 2/n, with n the number of
        # independent ones, of which 1/n is the mean of the squared correlation. That of a sample is
        # twice as much, for its noise is as large.
        chance += count * np.mean(autocorrelation(slope) ** 2) / len(slopes) ** 2
    return float(np.sqrt(max(float(np.var(logs, ddof=1)) - chance, 0.0)))


def _difference(heights: NDArray, axis: int, lag: int) -> NDArray:
    """Differences of heights over a number of points along an axis."""
    shifted = np.arange(lag, heights.shape[axis])
    return heights.take(shifted, axis) - heights.take(shifted - lag, axis)


def _halve(field: NDArray) -> list[NDArray]:
    """Parts of half the length along every axis."""
    middles = [points // 2 for points in field.shape]
    halves = [(slice(middle), slice(middle, None)) for middle in middles]
    return [field[part] for part in product(*halves)]
