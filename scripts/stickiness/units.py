"""Values with units as strings in the configuration, parsed by pint into SI."""

from __future__ import annotations

import contextlib
import difflib
import math
import os
import re
from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # else where it is used: most jobs read no units, and importing takes 0.3 s
    import pint

# Quantities that messages name: SI unit, words, example. The first of a dimension is its name.
_QUANTITIES = (
    ("m", "a length", "10 um"),
    ("Pa", "a pressure", "2 MPa"),
    ("J/m^2", "an energy per area", "50 mJ/m^2"),
    ("1/m", "a wave number", "1e3 1/m"),
    ("s", "a time", "1 ms"),
    ("Hz", "a frequency", "1 Hz"),
    ("N", "a force", "5 mN"),
    ("J", "an energy", "1 uJ"),
)
# Spellings by which a unit that pint does not know is recognised, by the SI unit that is wanted.
_SPELLINGS = {
    "m": ["km", "m", "cm", "mm", "um", "nm", "pm"],
    "Pa": ["Pa", "kPa", "MPa", "GPa"],
    "J/m^2": ["J/m^2", "mJ/m^2", "N/m", "mN/m", "uJ/m^2", "erg/cm^2"],
    "1/m": ["1/m", "1/mm", "1/um", "1/nm"],
    "s": ["s", "ms", "us"],
    "Hz": ["Hz", "kHz", "MHz"],
}
# Units that exist and are nearly always typing errors: what they are, and what is meant.
_ASKED_BACK = {
    "mPa": ("millipascal, a thousandth of a pascal", "MPa", "1e-3 Pa"),
    "Mm": ("megametre, a thousand kilometres", "mm", "1e6 m"),
    "Pm": ("petametre", "pm", "1e15 m"),
}


CACHE = "STICKINESS_UNITS"  #: environment variable: folder in which pint keeps units, ready made


@cache
def _registry() -> pint.UnitRegistry:
    import pint

    with contextlib.suppress(Exception):  # no such variable, a folder or file that is of no use
        return pint.UnitRegistry(cache_folder=os.environ[CACHE])
    return pint.UnitRegistry()


@cache  # a configuration is read more than once: for its checks and for its values
def _parsed(value: str) -> pint.Quantity | float:
    return _registry().Quantity(value)


def si(value: str, unit: str) -> float:
    """Magnitude of a string such as "0.1 um" in the SI unit `unit`, which fixes its dimension.

    A ValueError says which kind of quantity the value is and which is wanted. It suggests a unit
    for one that does not exist, and asks back for units that are nearly always typing errors, such
    as mPa.

    Examples
    --------
    >>> si("50 mJ/m^2", "J/m^2")
    0.05
    """
    import pint

    wanted = _wanted(unit)
    if not isinstance(value, str):
        raise ValueError(f"{value!r} has no unit: {wanted}, as a text with its unit")
    if "," in value:  # a comma would be dropped, and 2,5 nm become 25 nm
        raise ValueError(f"{value!r} holds a comma: write the number with a decimal point")
    _ask_back(value)
    try:
        quantity = _parsed(value)
        magnitude = float(quantity.to(unit).magnitude)
    except pint.DimensionalityError:
        raise ValueError(f"{value!r} {_kind(quantity)}; {wanted}") from None
    except Exception:  # pint raises tokenizer, attribute and type errors alike on malformed text
        raise ValueError(f"{value!r} cannot be read: {_meant(value, unit) or wanted}") from None
    if not math.isfinite(magnitude):
        raise ValueError(f"{value!r} is not finite: {wanted}")
    return magnitude


@cache
def _wanted(unit: str) -> str:
    """Say which quantity is wanted, by its SI unit."""
    for name, words, example in _QUANTITIES:
        if _registry().Unit(name).dimensionality == _registry().Unit(unit).dimensionality:
            return f"{words} is wanted, e.g. {example!r}"
    return f"a number in {unit} is wanted, e.g. '1e-3 {unit}'"


def _kind(quantity: pint.Quantity | float) -> str:
    """Say which kind of quantity a value is, in words."""
    dimension = getattr(quantity, "dimensionality", {})
    if not dimension:
        return "has no unit"
    for name, words, _ in _QUANTITIES:
        if _registry().Unit(name).dimensionality == dimension:
            return f"is {words}"
    return f"is in {quantity.units:~P}"


def _ask_back(value: str) -> None:
    """Refuse a unit that exists but is nearly always a typing error."""
    for unit, (words, meant, instead) in _ASKED_BACK.items():
        if re.search(rf"(?<![A-Za-z]){unit}(?![A-Za-z])", value):
            raise ValueError(
                f"{value!r}: {unit} is {words}; did you mean {value.replace(unit, meant)!r}? "
                f"If not, write it in SI units, e.g. {instead!r}"
            )


def _meant(value: str, unit: str) -> str | None:
    """Ask whether the closest unit of the wanted kind is meant, if one is close."""
    match = re.fullmatch(r"\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*(\S.*?)\s*", value)
    if match is None:
        return None
    number, written = match.groups()
    spellings = {known.lower().replace("^", ""): known for known in _SPELLINGS.get(unit, ())}
    close = difflib.get_close_matches(written.lower().replace("^", ""), spellings, n=1, cutoff=0.6)
    return f"did you mean '{number} {spellings[close[0]]}'?" if close else None
