"""Checks and conversions of arguments that closed-form functions share."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray


def positive(**values: ArrayLike) -> tuple[NDArray, ...]:
    """Return the named values as float arrays; ValueError unless all are positive and finite."""
    arrays = []
    for name, value in values.items():
        array = np.asarray(value, dtype=float)
        if not (np.all(np.isfinite(array)) and np.all(array > 0)):
            raise ValueError(f"{name} must be positive and finite, got {value!r}")
        arrays.append(array)
    return tuple(arrays)


def plain(value: ArrayLike) -> bool | float | NDArray:
    """Return a Python scalar for a scalar, so that results print and serialise as one expects."""
    value = np.asarray(value)
    return value if value.ndim else value.item()


def is_number(value: object) -> bool:
    """Whether a value is one finite real number, also as an array without dimensions."""
    array = np.asarray(value)
    real = np.issubdtype(array.dtype, np.floating) or np.issubdtype(array.dtype, np.integer)
    return array.ndim == 0 and real and bool(np.isfinite(array))
