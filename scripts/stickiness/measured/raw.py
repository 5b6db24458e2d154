"""Content of a file of heights before anything is done to it, and lengths that tell its size."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from stickiness.units import si

Length = str | float  # "10 um", or metres


@dataclass(frozen=True)
class Raw:
    """Content of a file, heights in the file's own unit."""

    heights: NDArray  #: (nx, ny), the first axis along x, or a line profile (n,); NaN where missing
    #: grid steps [m]; None: the file does not tell (all below likewise)
    steps: tuple[float, ...] | None
    unit: str | None  #: of the heights
    source: str  #: file, and variable or channel
    positions: NDArray | None = None  #: (n,), where a line profile was taken if not evenly
    position_unit: str | None = None
    #: (2,) grid steps of a list of points x y z, in `position_unit`, in place of `steps`
    grid: tuple[float, float] | None = None


def metres(value: Length, name: str) -> float:
    """Convert "10 um", or a number of metres, to metres; errors name `name`."""
    try:
        length = value if isinstance(value, int | float) else si(value, "m")
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None
    if not (np.isfinite(length) and length > 0):
        raise ValueError(f"{name} must be positive and finite, got {value!r}")
    return float(length)


def sides(value: Length | Sequence[Length], shape: tuple[int, ...], name: str) -> tuple[float, ...]:
    """Sides along every axis; a single value is that along x, with square pixels."""
    if isinstance(value, str | int | float):
        x = metres(value, name)
        return tuple(x * n / shape[0] for n in shape)
    if len(value) != len(shape):
        many = "one length or two (x, y)" if len(shape) == 2 else "one length for a line profile"
        raise ValueError(f"{name} must be {many}, got {value!r}")
    return tuple(metres(v, name) for v in value)
