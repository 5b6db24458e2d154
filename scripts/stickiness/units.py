"""Values with units as strings in the configuration, parsed by pint into SI."""

from __future__ import annotations

import contextlib
import difflib
import math
import os
import re
from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:  # else where it is used: most jobs read no units, and importing takes 0.3 s
    import pint

# Quantities that messages name: SI unit, words, example, and units that a misspelt one may mean.
_QUANTITIES = (
    ("m", "a length", "10 um", "km m cm mm um nm pm"),
    ("Pa", "a pressure", "2 MPa", "Pa kPa MPa GPa"),
    ("J/m^2", "an energy per area", "50 mJ/m^2", "J/m^2 mJ/m^2 N/m mN/m uJ/m^2 erg/cm^2"),
    ("1/m", "a wave number", "1e3 1/m", "1/m 1/mm 1/um 1/nm"),
    ("s", "a time", "1 ms", "s ms us"),
    ("Hz", "a frequency", "1 Hz", "Hz kHz MHz"),
    ("N", "a force", "5 mN", ""),
    ("J", "an energy", "1 uJ", ""),
)
# Units that exist and are nearly always typing errors: what they are, and what is meant.
_ASKED_BACK = {
    "mPa": ("millipascal, a thousandth of a pascal", "MPa", "1e-3 Pa"),
    "Mm": ("megametre, a thousand kilometres", "mm", "1e6 m"),
    "Pm": ("petametre", "pm", "1e15 m"),
}
_SECONDS = r"\s*[*·⋅\s]\s*s(?:econds?)?(?![A-Za-z])"  # behind mPa: a viscosity, where it is common


@cache
def _registry() -> pint.UnitRegistry:
    import pint

    # Folder in which pint keeps units, ready made.
    with contextlib.suppress(Exception):  # no such variable, a folder or file that is of no use
        return pint.UnitRegistry(cache_folder=os.environ["STICKINESS_UNITS"])
    return pint.UnitRegistry()


@cache  # a configuration is read more than once: for its checks and for its values
def _parsed(value: str) -> pint.Quantity:
    return _registry().Quantity(value)


class Quantity(float):
    """A number in SI units that remembers how it was written.

    It calculates as a float and is shown as the text: ``Quantity.read("10 um", "m")`` is 1e-5 and
    prints ``10 um``.

    Parameters
    ----------
    value : float
        The number in SI units.
    text : str
        The text with its unit.
    """

    text: str

    def __new__(cls, value: float, text: str) -> Quantity:
        """Make a number that remembers a text."""
        quantity = super().__new__(cls, value)
        quantity.text = text
        return quantity

    @classmethod
    def read(cls, text: str, unit: str) -> Quantity:
        """Read a text such as "10 um" in the SI unit `unit`; see `si` for what is raised."""
        return cls(si(text, unit), text)

    def __repr__(self) -> str:
        """Show the text in quotes, as in the configuration."""
        return repr(self.text)

    def __str__(self) -> str:
        """Show the text."""
        return self.text

    def __reduce__(self) -> tuple[type, tuple[float, str]]:
        """Return what a copy is made from, for pickling."""
        return Quantity, (float(self), self.text)


def write_quantities(entry: Any) -> Any:
    """Return an entry of the configuration with the texts of its quantities in place of numbers."""
    if isinstance(entry, Quantity):
        return entry.text
    if isinstance(entry, Mapping):
        return {key: write_quantities(value) for key, value in entry.items()}
    if isinstance(entry, list | tuple):
        return [write_quantities(value) for value in entry]
    return entry


def si(value: str, unit: str) -> float:
    """Magnitude of a string such as "0.1 um" in the SI unit `unit`, which fixes its dimension.

    A ValueError says which kind of quantity the value is and which is wanted. It suggests a unit
    for one that does not exist, and asks back for units that are nearly always typing errors.
    """
    import pint

    known = _known(_registry().Unit(unit).dimensionality)
    _, words, example, units = known or (unit, f"a number in {unit}", f"1e-3 {unit}", "")
    wanted = f"{words} is wanted, e.g. {example!r}"
    if not isinstance(value, str):
        raise ValueError(f"{value!r} has no unit: {wanted}, as a text with its unit")
    if "," in value:  # a comma would be dropped, and 2,5 nm become 25 nm
        raise ValueError(f"{value!r} holds a comma: write the number with a decimal point")
    if not re.match(r"\s*[-+]?(\.?\d|nan|inf)", value):
        raise ValueError(f"{value!r} does not begin with a number: {wanted}")
    if re.search(r"[±~\[\]]|\+/-|\d\s*[-–]\s*\d", value):
        raise ValueError(f"{value!r} is no single number with a unit: {wanted}")
    for typed, (meaning, meant, instead) in _ASKED_BACK.items():
        if re.search(rf"(?<![A-Za-z]){typed}(?![A-Za-z])(?!{_SECONDS})", value):
            raise ValueError(
                f"{value!r}: {typed} is {meaning}; did you mean {value.replace(typed, meant)!r}? "
                f"If not, write it in SI units, e.g. {instead!r}"
            )
    try:
        quantity = _parsed(value)
    except Exception:  # pint raises tokenizer, attribute and type errors alike on malformed text
        raise ValueError(f"{value!r} cannot be read: {_meant(value, units) or wanted}") from None
    try:
        magnitude = float(quantity.to(unit).magnitude)
    except pint.DimensionalityError:
        other = _known(quantity.dimensionality)
        kind = f"is {other[1]}" if other else f"is in {quantity.units:~P}"
        kind = "has no unit" if quantity.dimensionless else kind
        raise ValueError(f"{value!r} {kind}; {wanted}") from None
    except (AttributeError, TypeError):  # a number without a unit is a float
        raise ValueError(f"{value!r} has no unit; {wanted}") from None
    if not math.isfinite(magnitude):
        raise ValueError(f"{value!r} is not finite: {wanted}")
    return magnitude


@cache
def _known(dimension: Any) -> tuple[str, str, str, str] | None:
    """Return what messages say of quantities of a dimension."""
    units = _registry().Unit
    return next((q for q in _QUANTITIES if units(q[0]).dimensionality == dimension), None)


def _meant(value: str, units: str) -> str | None:
    """Ask whether the closest unit of the wanted kind is meant, if one is close."""
    match = re.fullmatch(r"\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*(\S.*?)\s*", value)
    if match is None:
        return None
    number, written = match.groups()
    # A power that is written is meant: N/m2 is no N/m.
    spellings = {
        known.lower().replace("^", ""): known
        for known in units.split()
        if ("2" in known) == ("2" in written)
    }
    close = difflib.get_close_matches(written.lower().replace("^", ""), spellings, n=1, cutoff=0.6)
    return f"did you mean '{number} {spellings[close[0]]}'?" if close else None
