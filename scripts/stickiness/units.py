"""Numbers with units in texts, of the configuration, the command, Python and files, to SI.

The number is read here, and the unit alone by pint. Pint takes "1 500 um" for a product of two
numbers, drops the comma of "2,5 nm", and divides by the 25 of "N/25mm".
"""

from __future__ import annotations

import math
import os
import re
import unicodedata
from collections.abc import Mapping
from contextlib import suppress
from functools import cache, partial
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:  # else where it is used: most jobs read no units, and importing takes 0.3 s
    import pint

# Quantities that messages name: SI unit, words, example, and units whose case may be mistaken. Of
# wave numbers none: a line pair per mm is 2 pi per mm.
_QUANTITIES = (
    ("m", "a length", "10 um", "km m cm mm um nm pm"),
    ("Pa", "a pressure", "2 MPa", "Pa kPa MPa GPa"),
    ("J/m^2", "an energy per area", "50 mJ/m^2", "J/m^2 mJ/m^2 N/m mN/m uJ/m^2 erg/cm^2"),
    ("1/m", "a wave number", "1e3 1/m", ""),
    ("s", "a time", "1 ms", "s ms us"),
    ("Hz", "a frequency", "1 Hz", "Hz kHz MHz"),
    ("N", "a force", "5 mN", ""),
    ("J", "an energy", "1 uJ", ""),
    ("Pa*s", "a viscosity, which is no modulus", "1 Pa*s", ""),
    (
        "kg/m^2",
        "a mass per area (divided by the density a thickness: 1 g/m^2 of 1 g/cm^3 is 1 um)",
        "20 g/m^2",
        "",
    ),
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
_TYPED = str.maketrans("−×’\t", "-*' ")
_RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺"
_LOWERED = str.maketrans(_RAISED, "0123456789-+")
# Names that pint should know as well, and spellings that it takes for something else.
_ALIASES = {
    "psi": "PSI = Psi",
    "angstrom": "Angstrom = Ang",
    "micron": "mu = mkm = мкм",  # noqa: RUF001
    "force_kilogram": "kp",
}
_SPELLINGS = (
    (r"\bmils?\b", "thou"),  # of an inch; an angle in pint
    (r"(?<=[^\W\d_])([-+]?[0-9])(?!\w)", r"^\1"),  # N/mm2, J m-2
    (r"(?<=[^\W\d_])\.(?=[^\W\d_])", "*"),  # N.m
    (r"(?<![^\W\d_])([A-Za-zµμ]?(?:Pa|N|J))s\b", r"\1*s"),  # a plural in pint
    (r"\bgsm\b", "g/m^2"),
)
# Decimals that end in zero may be thousands of a country that writes them with points.
_THOUSANDS = re.compile(r"([-+]?[1-9][0-9]{0,2}\.[0-9]{2}0)(?![0-9.eE]| ?[x*·⋅])")
# Sums, products, ranges and errors.
_NO_SINGLE = re.compile(r"[±~\[\]]|\+/-|[0-9] ?[-–+] ?[0-9]")
_NO_UNIT = re.compile(r"[.'_]| ?[0-9](?! ?/)| ?[x*·⋅/] ?[0-9]")
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
    try:  # pint keeps its units ready made in a folder, by default in the user's cache
        folder = os.environ.get("STICKINESS_UNITS", ":auto:")
        registry: pint.UnitRegistry = pint.UnitRegistry(
            cache_folder=folder, preprocessors=spellings.copy()
        )
    except Exception:  # a folder or file that is of no use
        registry = pint.UnitRegistry(preprocessors=spellings.copy())
    for unit, names in _ALIASES.items():
        registry.define(f"@alias {unit} = {names}")
    return registry


@cache  # a configuration is read more than once: for its checks and for its values
def _parse_unit(text: str) -> pint.Unit:
    """Return a unit, of which pint takes no numbers but powers and a 1 above the stroke."""
    if re.search(r"(?:\^|\*\*)[^*/ ]*(?:\^|\*\*)", text):  # 9**9**9 would not end
        raise ValueError("power of a power")
    if re.search(r"[^\w\s^*/().%°·⋅+-]", text):  # pint drops such signs: of "?m" the first is lost
        raise ValueError("sign that no unit has")
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
        """Read a text such as "10 um" in the SI unit `unit`; see `si` for what is raised.

        A person may also mean thousands by "200.000 Pa", of which it asks.
        """
        quantity = cls(si(text, unit), text)
        if match := _THOUSANDS.match(_write_plainly(text)):
            number, rest = match[1], _write_plainly(text)[match.end() :]
            readings = f"'{float(number):g}{rest}' or '{number.replace('.', '')}{rest}'"
            raise ValueError(f"{text!r} may have decimals or thousands; did you mean {readings}?")
        return quantity

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

    A ValueError says which kind of quantity the value is and which is wanted. It suggests the unit
    that differs by its case alone, and asks back for what can mean two things or is nearly always a
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
    not_single = f"{value!r} is no single number with a unit: {wanted}"
    if _NO_SINGLE.search(text) or _NO_UNIT.match(written):
        raise ValueError(not_single)
    try:
        quantity = _find_number(match) * _parse_unit(written.strip())
    except Exception:  # pint raises tokenizer, attribute and type errors alike on malformed text
        meant = _find_unit(written.strip(), units)
        what = f"did you mean '{number} {meant}'?" if meant else wanted
        raise ValueError(f"{value!r} cannot be read: {what}") from None
    if _registry().get_group("Printer").members & dict(quantity.unit_items()).keys():
        raise ValueError(f"{value!r} is in points of a screen or of print: {wanted}")
    roots = [_registry().get_root_units(name)[1] for name, _ in quantity.unit_items()]
    if not quantity.dimensionless and _registry().Unit("") in roots:  # percent, parts per million
        raise ValueError(not_single)
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


def is_unit(text: str) -> bool:
    """Whether a text can be read as a unit of any kind, with a factor or without."""
    plain = _write_plainly(text)
    with suppress(Exception):  # pint raises errors of many kinds
        match = _NUMBER.match(plain)
        return bool(plain) and bool(_parse_unit(plain[match.end() if match else 0 :].strip()))
    return False


def _write_plainly(value: str) -> str:
    """Write signs, blanks, raised digits and joined letters as a keyboard has them."""
    with suppress(UnicodeError):  # "Âµm": UTF-8 that was read as Latin-1
        value = value.encode("latin-1").decode("utf-8")
    raised = re.sub(f"[{_RAISED}]+", lambda match: "^" + match[0].translate(_LOWERED), value)
    plain = unicodedata.normalize("NFKC", raised).translate(_TYPED)
    # A power of ten alone is one times it.
    return re.sub(r"^([-+]?)10(?=\^|\*\*)", r"\g<1>1*10", " ".join(plain.split()))


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
        readings.append(number.replace(",", ".").rstrip("0").rstrip("."))
    if re.fullmatch(r"[-+]?[1-9][0-9]{0,2}(,[0-9]{3})+(\.[0-9]*)?", number):
        readings.append(number.replace(",", ""))
    if re.fullmatch(r"[-+]?[1-9][0-9]{0,2}(\.[0-9]{3})+,[0-9]+", number):
        readings.append(number.replace(".", "").replace(",", "."))
    asked = " or ".join(f"'{reading}{rest}'" for reading in readings)
    meant = f"; did you mean {asked}?" if asked else ""
    return f" holds a comma, where a decimal point is wanted{meant}"


def _find_unit(written: str, units: str) -> str | None:
    """Return the unit of the wanted kind that differs from what is written by its case alone."""
    # A power that is written is meant: N/m2 is no N/m.
    spellings = {known.lower().replace("^", ""): known for known in units.split()}
    return spellings.get(written.lower().replace("^", ""))
