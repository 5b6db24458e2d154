"""Numbers as text for readers: rounded to what is known, with powers of ten and SI prefixes."""

import math
import os
import re
from collections.abc import Callable, Sequence
from pathlib import Path

NOTHING = "–"
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_PREFIXES = {9: "G", 6: "M", 3: "k", 0: "", -3: "m", -6: "µ", -9: "n"}
_PLAIN = range(-3, 5)  # decimal exponents written without a power of ten
_LEAST_SHARE = 1e-4  # that a percentage tells from none
FAR = 1e3  #: ratio of limits beyond which a value between them says nothing

# Control characters, those that turn the direction of writing, and halves of characters.
_UNPRINTABLE = re.compile("[\x00-\x09\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\ud800-\udfff]")

Write = Callable[[Sequence[float]], tuple[list[str], str]]  # texts of values, and their unit


def printable(text: str) -> str:
    """Text without what terminals obey instead of showing it."""
    return _UNPRINTABLE.sub("", text)


def relative_path(path: Path, folder: Path) -> str:
    """Path from a folder; on another drive, where there is none, the whole path."""
    try:
        return os.path.relpath(path, folder)
    except ValueError:
        return str(path.absolute())


def number(value: float, digits: int = 3) -> str:
    """Value to `digits` significant digits, without trailing zeros."""
    value = float(value)
    if math.isnan(value):
        return NOTHING
    sign = "−" if value < 0 else ""
    if math.isinf(value):
        return f"{sign}∞"
    power = _exponent(value, digits)
    plain = power in _PLAIN
    text = _fixed(abs(value) / (1.0 if plain else 10.0**power), digits - 1 - plain * power)
    text = text.rstrip("0").rstrip(".") if "." in text else text
    if plain:
        return sign + text
    return sign + (_power_of_ten(power) if text == "1" else f"{text} × {_power_of_ten(power)}")


def with_error(value: float, error: float) -> str:
    """``value ± error``, rounded to two digits of the error; one not known or of 0 is left out."""
    value = float(value)
    error = float(error)
    if not (math.isfinite(value) and math.isfinite(error) and error > 0):
        return number(value, 4 if error == 0 else 3)
    power = _exponent(max(abs(value), error), 4)
    plain = power in _PLAIN
    if not plain:
        value = value / 10.0**power
        error = error / 10.0**power
    decimals = 1 - _exponent(error, 2)
    text = f"{_fixed(value, decimals)} ± {_fixed(error, decimals)}"
    return text if plain else f"({text}) × {_power_of_ten(power)}"


def interval(low: float, high: float, digits: int = 3) -> str:
    """``low … high`` in increasing order, or one number where they agree."""
    return " … ".join(dict.fromkeys(number(x, digits) for x in sorted((low, high))))


def quantity(low: float, high: float, unit: str, digits: int = 3, beside: float = 0.0) -> str:
    """Interval in the SI prefix that suits its larger end, or what is not far larger beside it."""
    largest = max(abs(low), abs(high))
    near = largest < beside < 1e3 * largest or largest == 0
    factor, unit = unit_for(beside if near else largest, unit, digits)
    return f"{interval(low * factor, high * factor, digits)} {unit}"


def amount(value: float, unit: str, digits: int = 3) -> str:
    """One value in the SI prefix that suits it."""
    return quantity(float(value), float(value), unit, digits)


def quantity_with_error(value: float, error: float, unit: str) -> str:
    """``(value ± error)``, rounded to two digits of the error, in the SI prefix that suits it."""
    factor, unit = unit_for(max(abs(value), error), unit)
    text = with_error(value * factor, error * factor)
    return f"({text}) {unit}" if "±" in text else f"{text} {unit}"


def unit_for(largest: float, unit: str, digits: int = 3) -> tuple[float, str]:
    """Factor on SI values, and the prefixed unit, that suit a largest value once it is rounded."""
    power = 3 * (_exponent(largest, digits) // 3)
    power = min(max(power, min(_PREFIXES)), max(_PREFIXES))
    return 10.0**-power, _PREFIXES[power] + unit


def in_unit(unit: str, digits: int = 2) -> Write:
    """Writer of values in the SI prefix that suits the largest of them, for `limited`."""

    def write(values: Sequence[float]) -> tuple[list[str], str]:
        factor, prefixed = unit_for(max(map(abs, values)), unit, digits)
        return [number(value * factor, digits) for value in values], f" {prefixed}"

    return write


def in_units_of(size: float, unit: str = "", digits: int = 2) -> Write:
    """Writer of values over a fixed size, for `limited`."""
    return lambda values: ([number(value / size, digits) for value in values], unit)


in_percent = in_units_of(0.01, " %")


def limited(
    value: float,
    low: float,
    high: float,
    write: Write,
    *,
    least: float = 0.0,
    most: float = math.inf,
) -> str:
    """Value with its limits, ``x (a to b)``, or what of these a reader can use.

    Numbers below `least` are nothing, those above `most` have no bound. A value that is nothing
    beside its high limit is left out ("below b"), as is one that is not known, and one between
    limits more than `FAR` apart ("a to b").
    """
    value, low, high = (
        0.0 if x < least else math.inf if x > most else float(x) for x in (value, low, high)
    )

    def show(*numbers: float) -> str:
        texts, unit = write([x for x in numbers if math.isfinite(x)])
        return " to ".join(dict.fromkeys(texts)) + unit

    if math.isnan(low) or math.isnan(high):
        return NOTHING
    if high == 0:
        return show(0.0)
    if low == high == math.inf:
        return "any"
    if high == math.inf:
        has_value = 0 < value < math.inf
        if low == 0:
            return f"{show(value)} (no limits)" if has_value else "no limits"
        if not has_value:
            return f"at least {show(low)}"
        texts, unit = write([value, low])
        return f"{texts[0]}{unit} (at least {texts[1]}{unit})"
    if low == 0 and not value * FAR >= high:
        return f"below {show(high)}"
    if low > 0 and high > FAR * low:
        return f"{show(low)} to {show(high)}"
    if math.isnan(value):
        return show(low, high)
    texts, unit = write([value, low, high])
    if len(set(texts)) == 1:
        return f"{texts[0]}{unit}"
    return f"{texts[0]}{unit} ({texts[1]} to {texts[2]}{unit})"


def duration(seconds: float) -> str:
    """Time in the unit that a person would use."""
    for unit, size in (("d", 86400), ("h", 3600), ("min", 60)):
        if seconds == size or seconds >= 2 * size:
            return f"{number(seconds / size)} {unit}"
    return amount(seconds, "s")


def percent(share: float) -> str:
    """Share as a percentage to two digits; one that is tiny as less than the least shown."""
    share = float(share)
    if math.isnan(share):
        return NOTHING
    if 0 < share < _LEAST_SHARE:
        return f"< {number(100 * _LEAST_SHARE)} %"
    return f"{number(100 * share, 2)} %"


def change(share: float) -> str:
    """Relative change in whole per cent, with its sign."""
    rounded = round(100 * float(share))
    return f"{rounded:+d} %".replace("-", "−") if rounded else "0 %"


def table(columns, rows) -> str:
    """Markdown table with these column heads and rows of texts."""
    columns = list(columns)
    lines = [
        " | ".join(str(cell).replace("|", "\\|").replace("\n", " ") for cell in line)
        for line in (columns, ["---"] * len(columns), *rows)
    ]
    return "".join(f"| {line} |\n" for line in lines)


def _exponent(value: float, digits: int) -> int:
    """Decimal exponent of the value once it is rounded; 0 where it has none."""
    if not math.isfinite(value):
        return 0
    return int(f"{value:.{digits - 1}e}".partition("e")[2])


def _fixed(value: float, decimals: int) -> str:
    """Value with so many decimals; nothing is written as −0."""
    text = f"{round(value, decimals):.{max(decimals, 0)}f}".replace("-", "−")
    return text if text.strip("−0.") else text.removeprefix("−")


def _power_of_ten(power: int) -> str:
    return f"10{str(power).translate(_SUPERSCRIPTS)}"
