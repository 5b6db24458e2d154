"""Checks and conversions of arguments that public functions share."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from inspect import signature
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

#: Of lengths whose powers stay in the range of floats; files mark missing points by up to 3.4e38.
LEAST_SIZE, LARGEST_SIZE = 1e-40, 1e40


def numbers(name: str, value: ArrayLike) -> NDArray:
    """Return `value` as an array of floats; ValueError unless it holds real numbers, unmasked."""
    masked = int(np.count_nonzero(np.ma.getmask(value)))
    if masked:
        raise ValueError(
            f"{name} must not be masked, got {masked} masked points: fill them or cut them off"
        )
    try:
        array = np.asarray(value)
    except ValueError:
        raise ValueError(f"{name} must have rows of one length, got {value!r}") from None
    if array.dtype.kind not in "iuf":
        demand = "real numbers" if array.ndim else "a number"
        what = repr(value) if array.size < 4 else f"an array of {array.dtype}"
        raise ValueError(f"{name} must be {demand}, got {what}")
    with np.errstate(over="ignore"):  # of longer floats
        return array.astype(float, copy=False)


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


def flag(name: str, value: bool) -> bool:
    """Return a truth value; ValueError unless it is one."""
    if not isinstance(value, bool | np.bool_):
        raise ValueError(f"{name} must be True or False, got {value!r}")
    return bool(value)


def grid(name: str, values: ArrayLike, square: bool = False) -> NDArray:
    """Return finite, unmasked real values on a (square) grid ``(n0, n1)`` as floats in C order."""
    array = numbers(name, values)
    if array.ndim != 2 or array.size == 0 or (square and array.shape[0] != array.shape[1]):
        shape = "square array (n, n)" if square else "grid (n0, n1)"
        raise ValueError(f"{name} must be a {shape}, got shape {array.shape}")
    bad = array.size - int(np.count_nonzero(np.isfinite(array)))
    if bad:
        raise ValueError(f"{name} must be finite, got {bad} NaN or infinite values")
    _check_size(name, max(float(array.max()), -float(array.min())))
    return np.ascontiguousarray(array)


def with_gaps(name: str, values: ArrayLike) -> NDArray:
    """Return real values of any shape as floats, NaN where they are masked or infinite."""
    data = np.ma.getdata(values) if np.ma.isMaskedArray(values) else values
    array = np.where(np.ma.getmask(values), np.nan, numbers(name, data))
    known = np.abs(array[np.isfinite(array)])
    # The largest of them may stand for a missing point.
    _check_size(name, float(np.median(known)) if known.size else 0.0)
    return np.where(np.isinf(array), np.nan, array)


def _check_size(name: str, size: float) -> None:
    """Raise a ValueError if the largest or typical value is neither zero nor of a usable size."""
    if size > 0 and not LEAST_SIZE <= size <= LARGEST_SIZE:
        raise ValueError(
            f"{name} must be zero or {LEAST_SIZE:g} to {LARGEST_SIZE:g} in size, got {size:.3g}: "
            "take another unit"
        )


def side(name: str, value: float) -> float:
    """Return one length; ValueError unless it is a number from `LEAST_SIZE` to `LARGEST_SIZE`."""
    array = numbers(name, value)
    if array.ndim or not LEAST_SIZE <= array <= LARGEST_SIZE:
        raise ValueError(
            f"{name} must be one positive number, {LEAST_SIZE:g} to {LARGEST_SIZE:g}, got {value!r}"
        )
    return float(array)


def check_length(
    length: float | tuple[float, float], shape: tuple[int, ...]
) -> tuple[float, float]:
    """Return the sides of a grid of `shape` points from one (pixels are then square) or both."""
    sides = numbers("length", length)
    usable = sides.shape in ((), (1,), (2,))
    if not (usable and np.all((sides >= LEAST_SIZE) & (sides <= LARGEST_SIZE))):
        raise ValueError(
            f"length must be one or two positive numbers, {LEAST_SIZE:g} to {LARGEST_SIZE:g}, "
            f"got {length!r}"
        )
    first = float(sides.flat[0])
    return first, float(sides[1]) if sides.size == 2 else first * shape[1] / shape[0]


def plain(value: ArrayLike) -> Any:
    """Return a Python scalar for a scalar, so that results print and serialise as one expects."""
    value = np.asarray(value)
    return value if value.ndim else value.item()
