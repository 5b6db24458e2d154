"""Values with units as strings in the configuration, parsed by pint into SI."""

from __future__ import annotations

import math
from functools import cache

import pint


@cache
def _registry() -> pint.UnitRegistry:
    return pint.UnitRegistry()


def si(value: str, unit: str) -> float:
    """Magnitude of a string such as "0.1 um" in the SI unit `unit`, which fixes its dimension.

    Raises
    ------
    ValueError
        If `value` is not a number with a unit of that dimension.

    Examples
    --------
    >>> si("50 mJ/m^2", "J/m^2")
    0.05
    """
    expected = f"expected a number with a unit of the dimension of {unit}"
    if not isinstance(value, str):
        raise ValueError(f"{value!r} has no unit: {expected}, as a string")
    if "," in value:  # a comma would be dropped, and 2,5 nm become 25 nm
        raise ValueError(f"{value!r} holds a comma: write the number with a decimal point")
    try:
        quantity = _registry().Quantity(value)
        magnitude = float(quantity.to(unit).magnitude)
    except pint.DimensionalityError:
        raise ValueError(
            f"{value!r} has the dimension {quantity.dimensionality}: {expected}"
        ) from None
    except Exception:  # pint raises tokenizer, attribute and type errors alike on malformed text
        raise ValueError(f"{value!r} cannot be read: {expected}") from None
    if not math.isfinite(magnitude):
        raise ValueError(f"{value!r} is not finite: {expected}")
    return magnitude
