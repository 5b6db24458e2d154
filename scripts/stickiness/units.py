"""Numbers with units in texts, of the configuration, the command, Python and files, to SI.

The number is read here, and the unit alone by pint. Pint takes "1 500 um" for a product of two
numbers, drops the comma of "2,5 nm", and divides by the 25 of "N/25mm".
"""

from __future__ import annotations

import difflib
import math
import os
import re
from collections.abc import Mapping
from functools import cache, partial
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


# A number, whose groups of three digits may have a blank, an apostrophe or an underscore between
# them; a fraction, or times a power of ten.
_NUMBER = re.compile(
    r"""(?P<digits>[-+]?
            (?: nan | inf
              | (?: [0-9]{1,3} (?P<mark>[ '_])[0-9]{3} (?:(?P=mark)[0-9]{3})* (?![0-9]) | [0-9]+ )
                (?: \.[0-9]* )?
              | \.[0-9]+ )
            (?: e[-+]?[0-9]+ )? )
        (?: /(?P<divisor>[1-9][0-9]*)(?=[ ]) )?
        (?: [ ]?[x*·⋅][ ]?10(?:\^|\*\*)\(?(?P<power>[-+]?[0-9]+)\)? )?""",
    re.IGNORECASE | re.VERBOSE,
)
_TYPED = str.maketrans("−×’\t\u00a0\u2009\u202f", "-*'    ")
_RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺"
_LOWERED = str.maketrans(_RAISED, "0123456789-+")
# Names that pint should know as well, and spellings that it takes for something else.
_ALIASES = {
    "psi": "PSI = Psi",
    "angstrom": "Angstrom = Ang",
    "micron": "mu",
    "force_kilogram": "kp",
}
_SPELLINGS = (
    (r"\bmils?\b", "thou"),  # of an inch; an angle in pint
    (r"(?<=[^\W\d_])([-+]?[0-9])(?!\w)", r"^\1"),  # N/mm2, J m-2
    (r"(?<=[^\W\d_])\.(?=[^\W\d_])", "*"),  # N.m
)
# What may be measured in place of what is wanted: the force of peeling a strip, and hardness.
_PEELING = re.compile(
    r"(?<![a-z])(?:[mck]?n|newtons?|k?gf?|kp|lbs?f?|ozf?) ?/ ?(?:[0-9]|(?:in|inch|[cm]m)(?![\w^]))"
    r"|\bpli\b",
    re.IGNORECASE,
)
_SHORE = re.compile(r"\b(?:shore|sh\.?) ?-?(a|d|o+|0+)\b", re.IGNORECASE)


@cache
def _registry() -> pint.UnitRegistry:
    import pint

    spellings = [partial(re.sub, typed, meant) for typed, meant in _SPELLINGS]
    try:  # a folder in which pint keeps units, ready made
        folder = os.environ["STICKINESS_UNITS"]
        registry: pint.UnitRegistry = pint.UnitRegistry(
            cache_folder=folder, preprocessors=spellings.copy()
        )
    except Exception:  # no such variable, a folder or file that is of no use
        registry = pint.UnitRegistry(preprocessors=spellings.copy())
    for unit, names in _ALIASES.items():
        registry.define(f"@alias {unit} = {names}")
    return registry


@cache  # a configuration is read more than once: for its checks and for its values
def _parse_unit(text: str) -> pint.Unit:
    """Return a unit, of which pint takes no numbers but powers and a 1 above the stroke."""
    if re.search(r"(?:\^|\*\*)[^*/ ]*(?:\^|\*\*)", text):  # 9**9**9 would not end
        raise ValueError("power of a power")
    return _registry().parse_units(f"1{text}" if text.startswith("/") else text)


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
    for one that does not exist, and asks back for what can mean two things or is nearly always a
    typing error. Angular frequencies become frequencies: 1 rad/s is 0.159 Hz, 60 rpm are 1 Hz.
    """
    import pint

    known = _known(_registry().Unit(unit).dimensionality)
    _, words, example, units = known or (unit, f"a number in {unit}", f"1e-3 {unit}", "")
    wanted = f"{words} is wanted, e.g. {example!r}"
    if not isinstance(value, str):
        raise ValueError(f"{value!r} has no unit: {wanted}, as a text with its unit")
    text = _write_plainly(value)
    if question := _ask_back(text, unit):
        raise ValueError(f"{value!r}{question}")
    match = _NUMBER.match(text)
    if match is None:
        raise ValueError(f"{value!r} does not begin with a number: {wanted}")
    number = match[0].strip()
    written = text[match.end() :]
    if re.search(r"[±~\[\]]|\+/-|[0-9] ?[-–] ?[0-9]", text) or re.match(
        r"[.'_]| ?[0-9](?! ?/)", written
    ):
        raise ValueError(f"{value!r} is no single number with a unit: {wanted}")
    try:
        quantity = _find_number(match) * _parse_unit(written.strip())
    except Exception:  # pint raises tokenizer, attribute and type errors alike on malformed text
        meant = _find_unit(written.strip(), units)
        what = f"did you mean '{number} {meant}'?" if meant else wanted
        raise ValueError(f"{value!r} cannot be read: {what}") from None
    if _registry().get_group("Printer").members & dict(quantity.unit_items()).keys():
        raise ValueError(f"{value!r} is in points of a screen or of print: {wanted}")
    if unit == "Hz" and "radian" in dict(quantity.to_root_units().unit_items()):
        unit = "turn/s"
    try:
        magnitude = float(quantity.to(unit).magnitude)
    except pint.DimensionalityError:
        other = _known(quantity.dimensionality)
        kind = f"is {other[1]}" if other else f"is in {quantity.units:~P}"
        kind = "has no unit" if quantity.dimensionless else kind
        raise ValueError(f"{value!r} {kind}; {wanted}") from None
    if not math.isfinite(magnitude):
        raise ValueError(f"{value!r} is not finite: {wanted}")
    return magnitude


def si_of_unit(text: str, unit: str) -> float:
    """Magnitude of a unit, as files and keys name it, in the SI unit `unit`; see `si`.

    It may have a factor, as of heights in units of "0.1 nm".
    """
    return si(text if re.match(r"\s*[-+.0-9]", text) else f"1 {text}", unit)


def _write_plainly(value: str) -> str:
    """Write signs, blanks and raised digits as a keyboard has them."""
    raised = re.sub(f"[{_RAISED}]+", lambda match: "^" + match[0].translate(_LOWERED), value)
    return " ".join(raised.translate(_TYPED).split())


def _find_number(match: re.Match) -> float:
    digits, mark, divisor, power = match.group("digits", "mark", "divisor", "power")
    number = float(digits.replace(mark, "") if mark else digits) / float(divisor or 1)
    return number * 10.0 ** int(power) if power else number


@cache
def _known(dimension: Any) -> tuple[str, str, str, str] | None:
    """Return what messages say of quantities of a dimension."""
    units = _registry().Unit
    return next((q for q in _QUANTITIES if units(q[0]).dimensionality == dimension), None)


def _ask_back(text: str, unit: str) -> str:
    """Ask what is meant by a text that can mean two things, or usually means another; or nothing.

    The answer goes on after the text.
    """
    if "," in text:
        return _ask_for_comma(text)
    if unit == "J/m^2" and _PEELING.search(text):
        return (
            " is a force of peeling per width, which is mostly dissipation: give the work of "
            "adhesion between smooth surfaces, e.g. '50 mJ/m^2'"
        )
    if unit == "Pa" and (shore := _SHORE.search(text)):
        number = re.search(r"[0-9.]+", text.replace(shore[0], ""))
        hardness = float(number[0]) if number else 0.0
        is_a = shore[1].lower() == "a" and 20 <= hardness <= 90
        about = f" (by Gent's relation about {_soften(hardness):.2g} MPa)" if is_a else ""
        return f" is a hardness: give Young's modulus{about}"
    for typed, (meaning, meant, instead) in _ASKED_BACK.items():
        if re.search(rf"(?<![A-Za-z]){typed}(?![A-Za-z])(?!{_SECONDS})", text):
            return (
                f": {typed} is {meaning}; did you mean {text.replace(typed, meant)!r}? "
                f"If not, write it in SI units, e.g. {instead!r}"
            )
    return ""


def _soften(shore: float) -> float:
    """Young's modulus [MPa] of a rubber of this Shore A hardness, by Gent (1958)."""
    return 0.0981 * (56 + 7.62336 * shore) / (0.137505 * (254 - 2.54 * shore))


def _ask_for_comma(text: str) -> str:
    """Ask which number with a decimal point is meant by one with commas."""
    written = re.match(r"[-+0-9.,]*", text)
    number, rest = (written[0], text[written.end() :]) if written else ("", text)
    readings = []
    if re.fullmatch(r"[-+]?[0-9]+,[0-9]+", number):
        readings.append(number.replace(",", "."))
    if re.fullmatch(r"[-+]?[1-9][0-9]{0,2}(,[0-9]{3})+(\.[0-9]*)?", number):
        readings.append(number.replace(",", ""))
    if re.fullmatch(r"[-+]?[1-9][0-9]{0,2}(\.[0-9]{3})+,[0-9]+", number):
        readings.append(number.replace(".", "").replace(",", "."))
    asked = " or ".join(f"'{reading}{rest}'" for reading in readings)
    meant = f"; did you mean {asked}?" if asked else ""
    return f" holds a comma, where a decimal point is wanted{meant}"


def _find_unit(written: str, units: str) -> str | None:
    """Return the unit of the wanted kind that is close to what is written, if one is."""
    # A power that is written is meant: N/m2 is no N/m.
    spellings = {
        known.lower().replace("^", ""): known
        for known in units.split()
        if ("2" in known) == ("2" in written)
    }
    close = difflib.get_close_matches(written.lower().replace("^", ""), spellings, n=1, cutoff=0.6)
    return spellings[close[0]] if close else None
