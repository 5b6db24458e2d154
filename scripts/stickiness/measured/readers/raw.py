"""What readers of files return, and lengths in them."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from stickiness.units import si, si_of_unit

Length = str | float  # "10 um", or metres
INCOMPLETE = "the file is incomplete, its end is missing: copy it again"
MOST_POINTS = 2**27  #: of a map, 11585 x 11585; they take 1 GB, and their analysis ten times that
_NAME_AND_UNIT = re.compile(r"(.*?)(?:[\s_]*[\[(]\s*([^\])]+?)\s*[\])]|_([cmnpuµμ]?m))?")


@dataclass(frozen=True)
class Raw:
    """Content of a file; what the file does not tell is None."""

    heights: NDArray  #: (nx, ny), the first axis along x, or a line profile (n,); NaN where missing
    source: str  #: file, and variable or channel
    unit: str | None = None  #: of the heights
    others: tuple[str, ...] = ()  #: channels or variables to choose from, if none was named
    places: NDArray | None = None  #: steps of a map, or positions on a line (n,)
    place_unit: str | None = None
    periodic: bool = False  #: whether the file says that the heights go on periodically
    missing_value: float | None = None  #: number that marks missing points
    remarks: tuple[str, ...] = ()  #: what was done to the content unasked, without the source


def read_head(path: str | Path, size: int) -> bytes:
    """First bytes of a file, at most `size`."""
    with Path(path).open("rb") as file:
        return file.read(size)


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
    """Sides along every axis [m]; a single value is that along x, with square pixels."""
    if isinstance(value, str | int | float):
        x = metres(value, name)
        return tuple(x * n / shape[0] for n in shape)
    if len(value) != len(shape):
        many = "one length or two (x, y)" if len(shape) == 2 else "one length for a line profile"
        raise ValueError(f"{name} must be {many}, got {value!r}")
    return tuple(metres(side, name) for side in value)


def fold(column: NDArray, ratio: Sequence[float]) -> NDArray | None:
    """Map whose rows follow each other in a column, with square pixels and sides in this ratio."""
    if len(ratio) != 2:
        return None
    nx = round((column.size * ratio[0] / ratio[1]) ** 0.5)
    ny = round(nx * ratio[1] / ratio[0])
    return column.reshape(ny, nx).T if min(nx, ny) > 1 and nx * ny == column.size else None


def metres_per(unit: str, name: str) -> float:
    """Length of a unit in metres; errors name `name`."""
    try:
        factor = si_of_unit(unit, "m")
        if factor <= 0:
            raise ValueError(f"must be above zero, got {unit!r}")
        return factor
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None


def is_length(unit: str) -> bool:
    """Whether a text is a unit of length."""
    try:
        return si_of_unit(unit, "m") > 0
    except ValueError:
        return False


def split_unit(name: str) -> tuple[str, str | None]:
    """Name and unit of a column or an array that is called "z [um]", "z (um)" or "z_um"."""
    match = _NAME_AND_UNIT.fullmatch(name)
    assert match is not None  # of any text
    return match[1], match[2] or match[3]


def check_count(shape: Sequence[int]) -> None:
    """Check before memory is asked for that not too many points are read."""
    if math.prod(map(int, shape)) > MOST_POINTS:
        raise ValueError(
            f"{' x '.join(map(str, shape))} points are more than the {MOST_POINTS:.2g} that are "
            "read: export a part of them, or every second one"
        )


def find_step(positions: NDArray, name: str) -> float:
    """Step of evenly spaced positions; errors name the axis."""
    steps = np.diff(np.asarray(positions, dtype=float))
    if not len(steps) or not np.ptp(steps) <= 1e-3 * abs(steps.mean()):
        raise ValueError(f"{name!r} is not evenly spaced; resample the heights to a regular grid")
    return abs(float(steps.mean()))
