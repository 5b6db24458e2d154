"""Checks and conversions of arguments that public functions share."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from inspect import signature
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray


def numbers(name: str, value: ArrayLike) -> NDArray:
    """Return `value` as an array of floats; ValueError unless it holds real numbers."""
    array = np.asarray(value)
    if array.dtype.kind not in "biuf":
        raise ValueError(f"{name} must be a number, got {value!r}")
    return np.asarray(array, dtype=float)


def positive(**values: ArrayLike) -> tuple[NDArray, ...]:
    """Return the named values as float arrays; ValueError unless all are positive and finite."""
    return _check(values, lambda x: np.isfinite(x) & (x > 0), "must be positive and finite")


def takes_positive(function: Callable) -> Callable:
    """Let a function have its arguments as positive and finite float arrays; default None stays."""
    expected = signature(function)
    optional = {
        name for name, parameter in expected.parameters.items() if parameter.default is None
    }

    @wraps(function)
    def checked(*args, **kwargs):
        try:
            bound = expected.bind(*args, **kwargs)
        except TypeError as error:
            raise TypeError(f"{function.__name__}: {error}") from None
        bound.apply_defaults()
        numeric = {
            name: value
            for name, value in bound.arguments.items()
            if value is not None or name not in optional
        }
        bound.arguments |= dict(zip(numeric, positive(**numeric), strict=True))
        return function(**bound.arguments)

    return checked


def finite(**values: ArrayLike) -> tuple[NDArray, ...]:
    """Return the named values as float arrays; ValueError unless all are finite."""
    return _check(values, np.isfinite, "must be finite")


def nonnegative(**values: ArrayLike) -> tuple[NDArray, ...]:
    """Return the named values as float arrays; ValueError if any is negative or NaN."""
    return _check(values, lambda x: x >= 0, "must not be negative or NaN")


def _check(values: dict[str, ArrayLike], allowed: Callable, demand: str) -> tuple[NDArray, ...]:
    arrays = []
    for name, value in values.items():
        arrays.append(numbers(name, value))
        if not np.all(allowed(arrays[-1])):
            raise ValueError(f"{name} {demand}, got {value!r}")
    return tuple(arrays)


def number(name: str, value: float, *, zero: bool = False, most: float = np.inf) -> float:
    """Return one finite number: positive (or, with `zero`, not negative) and at most `most`."""
    array = numbers(name, value)
    allowed = array.ndim == 0 and np.isfinite(array) and (array > 0 or (zero and array == 0))
    if not (allowed and array <= most):
        kind = "non-negative" if zero else "positive"
        limit = f"at most {most:g}" if np.isfinite(most) else "finite"
        raise ValueError(f"{name} must be {kind} and {limit}, got {value!r}")
    return float(array)


def integer(name: str, value: int, least: int) -> int:
    """Return `value` as an int; ValueError unless it is a whole number of at least `least`."""
    is_number = isinstance(value, int | float | np.integer) and not isinstance(value, bool)
    if not (is_number and value % 1 == 0 and value >= least):
        raise ValueError(f"{name} must be an integer of at least {least}, got {value!r}")
    return int(value)


def grid(name: str, values: ArrayLike, square: bool = False) -> NDArray:
    """Return finite, unmasked real values on a (square) grid ``(n0, n1)`` as floats in C order."""
    masked = int(np.count_nonzero(np.ma.getmask(values)))
    if masked:
        raise ValueError(
            f"{name} must not be masked, got {masked} masked points: fill them or cut them off"
        )
    array = np.asarray(values)
    if array.dtype.kind not in "iuf":
        raise ValueError(f"{name} must be real numbers, got an array of {array.dtype}")
    array = np.ascontiguousarray(array, dtype=float)
    if array.ndim != 2 or array.size == 0 or (square and array.shape[0] != array.shape[1]):
        shape = "square array (n, n)" if square else "grid (n0, n1)"
        raise ValueError(f"{name} must be a {shape}, got shape {array.shape}")
    bad = array.size - int(np.count_nonzero(np.isfinite(array)))
    if bad:
        raise ValueError(f"{name} must be finite, got {bad} NaN or infinite values")
    return array


def plain(value: ArrayLike) -> Any:
    """Return a Python scalar for a scalar, so that results print and serialise as one expects."""
    value = np.asarray(value)
    return value if value.ndim else value.item()
