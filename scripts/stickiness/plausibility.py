"""Warnings of numbers that are probably in another unit, or beyond what a grid can show.

Contact scales with the heights, so that slopes of 30 are as good as any. The limits here hold in
all such units, and catch gross mistakes only: pascals for units of E*, micrometres beside metres.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from typing import NamedTuple

_MOST_PRESSURE = 1000.0  # over the rms slope; half of that slope is what flattens a surface
_MOST_HEIGHT, _LEAST_HEIGHT = 100.0, 1e-9  # rms height over the side of the cell
LONGEST_SIDE = 0.5  #: [m]; the longest travel of profilometers is 0.3 m
SHORTEST_SIDE = 1e-9  #: [m]; a few atoms
LARGEST_SLOPE = 20.0  #: rms gradient of real surfaces, above the 1 that theory can treat
REFUSED_SIDE = (
    f"is longer than {LONGEST_SIDE:g} m, which no microscope or profilometer measures; correct it "
    "(2 mm, not 2 m?), or give plausibility: ignore if it is so"
)


class PlausibleRange(NamedTuple):
    """Values of real solids and surfaces in SI units, most with room to spare."""

    least: float
    usual: float  #: above, a value is improbable
    most: float
    reason: str
    unit: str = ""  #: empty if the reason says what to give


_OF_LENGTH = "give the side of the heights in m (2e-3 for 2 mm)"
_OF_SLOPE = (
    "small slopes are assumed; check the units of heights and lengths, and how far waves are "
    "extrapolated"
)
_OF_WORK = (
    "solids other than clean metals have up to 0.1 J/m^2; is it in mJ/m^2, or an energy of "
    "peeling, which includes dissipation? If it was measured on smooth surfaces, set "
    "work_on_smooth: true"
)
_OF_HEIGHT = "atoms are larger than 0.05 nm; give heights in m (1e-6 for 1 um)"
#: By the name of the argument, or of the key in the configuration.
PLAUSIBLE = {
    "length": PlausibleRange(SHORTEST_SIDE, LONGEST_SIDE, LONGEST_SIDE, _OF_LENGTH),
    "h_rms": PlausibleRange(5e-11, LONGEST_SIDE, LONGEST_SIDE, _OF_HEIGHT),
    "rms_slope": PlausibleRange(1e-7, 1.0, 1.0, _OF_SLOPE),
    "youngs_modulus": PlausibleRange(
        10.0, 1e13, 1e13, "gels are stiffer and diamond is softer", "Pa"
    ),
    "work_of_adhesion": PlausibleRange(1e-6, 0.2, 10.0, _OF_WORK, "J/m^2"),
    "poisson_ratio": PlausibleRange(
        0.0, 0.5, 0.5, "hardly any solid becomes wider when it is stretched"
    ),
    "range": PlausibleRange(1e-11, 1e-7, 1e-5, "molecules attract over 0.2 to 1 nm", "m"),
    "thickness": PlausibleRange(1e-10, 1e-2, 1.0, "adhesives have 1 um to 3 mm", "m"),
    "skin_thickness": PlausibleRange(
        1e-10, 1e-3, 1.0, "oxides have 1 nm to 30 um, paints 0.3 mm", "m"
    ),
}
PLAUSIBLE["plane_strain_modulus"] = PLAUSIBLE["youngs_modulus"]


class PlausibilityWarning(UserWarning):
    """An argument is allowed, but the result is probably not what was meant."""


def warn_of_pressure(pressure: float, rms_slope: float) -> None:
    """Warn if a mean pressure [E*] is far above that at which contact is full anyway."""
    # Heights in units larger than those of lengths have pressures above 1.
    if pressure > max(1.0, _MOST_PRESSURE * rms_slope):
        text = f"pressure = {pressure!r} is far above the pressure of full contact (rms slope "
        text += f"{rms_slope:.3g}); pressures are in units of E*: divide pascals by E*"
        warnings.warn(text, PlausibilityWarning, stacklevel=3)


def warn_of_heights(rms_height: float, length: float) -> None:
    """Warn if heights and the side of the cell can hardly be in one unit of length."""
    if rms_height > 0 and not _LEAST_HEIGHT <= rms_height / length <= _MOST_HEIGHT:
        text = f"heights of {rms_height:.3g} rms on a cell of length = {length:.3g}: heights and "
        warnings.warn(text + "length must have the same unit", PlausibilityWarning, stacklevel=3)


def find_doubts(**values: float) -> Iterator[str]:
    """Sentences about values, by their name in `PLAUSIBLE`, that hardly any real pair has in SI."""
    for name, value in values.items():
        low, high, _, reason, unit = PLAUSIBLE[name]
        if not low <= value <= high:
            text = f"{name} = {value:.3g} is outside {low:g} to {high:g}: {reason}"
            yield text + (f"; give it in {unit}" if unit else "")
