"""Warnings of numbers that are probably in another unit, or beyond what a grid can show.

Contact scales: heights times a factor only take pressures with them, so that surfaces of unit
height and slopes of 30 are as good as any. The limits here hold in all such units, and therefore
catch gross mistakes only: pascals for units of E*, micrometres beside metres.
"""

from __future__ import annotations

import warnings

__all__ = ["PlausibilityWarning", "warn_of_heights", "warn_of_pressure"]

_MOST_PRESSURE = 1000.0  # over the rms slope; half of that slope is what flattens a surface
_MOST_HEIGHT, _LEAST_HEIGHT = 100.0, 1e-9  # rms height over the side of the cell


class PlausibilityWarning(UserWarning):
    """An argument is allowed, but the result is probably not what was meant."""


def warn_of_pressure(pressure: float, rms_slope: float, stacklevel: int = 3) -> None:
    """Warn if a mean pressure [E*] exceeds all that contact of a rms slope could need.

    Beyond 1000 times the slope contact is full anyway. In units in which heights stand for lengths
    larger than they are, pressures may be above 1.
    """
    if pressure > max(1.0, _MOST_PRESSURE * rms_slope):
        warnings.warn(
            f"pressure = {pressure!r} is in units of E* and closes any gap of this surface "
            f"(rms slope {rms_slope:.3g}) many times over: divide pascals by E*",
            PlausibilityWarning,
            stacklevel=stacklevel,
        )


def warn_of_heights(rms_height: float, length: float, stacklevel: int = 3) -> None:
    """Warn if heights and the side of the cell can hardly be in one unit of length."""
    if rms_height > 0 and not _LEAST_HEIGHT <= rms_height / length <= _MOST_HEIGHT:
        warnings.warn(
            f"heights of {rms_height:.3g} rms on a cell of length = {length:.3g}: heights and "
            "length must be in one unit, are they?",
            PlausibilityWarning,
            stacklevel=stacklevel,
        )
