"""Intervals that cover 90 %, of the normal distribution and of Student's t; shape of heights."""

from __future__ import annotations

import math

import numpy as np
import scipy  # scipy.special is loaded when first used, a third of a second
from numpy.typing import ArrayLike, NDArray

COVERS = 1.645  #: standard deviations that cover 90 % of a normal distribution
_QUANTILE = 0.95  # one-sided, of the same


def covering_multiple(freedom: ArrayLike) -> NDArray:
    """Return how many standard errors with so many degrees of freedom cover 90 %."""
    return scipy.special.stdtrit(freedom, _QUANTILE)


def students_t(seeds: int) -> float:
    """Return how many standard errors cover 90 % of plain means; NaN for a single seed."""
    return float(covering_multiple(seeds - 1)) if seeds > 1 else math.nan


def measure_shape(heights: NDArray) -> tuple[float, float]:
    """Skewness and kurtosis, which is 3 for Gaussian heights: means of powers over the rms height.

    Those of `scipy.stats`, which takes longer to load than both of any map to compute.
    """
    deviation = heights - heights.mean()
    square = deviation**2
    variance = square.mean()
    skewness = np.mean(square * deviation) / variance**1.5
    kurtosis = np.mean(square**2) / variance**2
    return float(skewness), float(kurtosis)
