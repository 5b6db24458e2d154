"""Numbers as text for readers: rounded to what is known, with powers of ten and SI prefixes."""

import math
import re
from collections.abc import Iterable

_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_PREFIXES = {9: "G", 6: "M", 3: "k", 0: "", -3: "m", -6: "µ", -9: "n"}
_PLAIN = range(-3, 5)  # decimal exponents written without a power of ten
_LEAST_SHARE = 1e-4  # that a percentage tells from none
_UNITS = r"%|°C?|1/m|[GMkmµn]?(?:Pa|m|J|N|Hz|s)(?:/m²)?"
_NO_BREAK = "\u00a0"
NOTHING = "–"


def number(value: float, digits: int = 3) -> str:
    """Value to `digits` significant digits, without trailing zeros."""
    if not math.isfinite(value):
        return NOTHING if math.isnan(value) else _signed(value, "∞")
    power = _exponent(value, digits)
    if power in _PLAIN:
        text = _fixed(abs(value), digits - 1 - power)
    else:
        text = _fixed(abs(value) / 10.0**power, digits - 1)
    text = text.rstrip("0").rstrip(".") if "." in text else text
    if text == "1" and power not in _PLAIN:
        return _signed(value, _ten_to(power))
    return _signed(value, text + _times_ten_to(power))


def with_error(value: float, error: float) -> str:
    """``value ± error``, rounded to two digits of the error; one not known or of 0 is left out."""
    if not (math.isfinite(value) and math.isfinite(error) and error > 0):
        return number(value, 4 if error == 0 else 3)
    power = _exponent(max(abs(value), error), 4)
    scale = 1.0 if power in _PLAIN else 10.0**power
    decimals = 1 - _exponent(error / scale, 2)
    shown, spread = (_fixed(abs(x) / scale, decimals) for x in (value, error))
    text = f"{_signed(value, shown) if float(shown) else shown} ± {spread}"
    return text if power in _PLAIN else f"({text}){_times_ten_to(power)}"


def interval(low: float, high: float, digits: int = 3) -> str:
    """``low … high`` in increasing order, or one number where they agree."""
    low, high = sorted((low, high))
    texts = number(low, digits), number(high, digits)
    if texts[0] == texts[1]:
        return texts[0]
    powers = [_exponent(value, digits) for value in (low, high)]
    if all(power in _PLAIN for power in powers):
        return " … ".join(_align(low, high, texts, digits))
    if abs(powers[1] - powers[0]) > 2:
        return " … ".join(texts)
    shared = max(powers, key=abs) if max(powers) in _PLAIN else max(powers)
    low, high = (value / 10.0**shared for value in (low, high))
    texts = _align(low, high, (number(low, digits), number(high, digits)), digits)
    return f"({' … '.join(texts)}){_times_ten_to(shared)}"


def _align(low: float, high: float, texts: tuple[str, str], digits: int) -> list[str]:
    """Numbers less than a decade apart with as many decimals as either has, if it is known so."""
    if not 0 < abs(high) < 10 * abs(low):
        return list(texts)
    decimals = [len(text.partition(".")[2]) for text in texts]
    aligned = []
    for value, text, own in zip((low, high), texts, decimals, strict=True):
        wanted = min(digits - 1 - _exponent(value, digits), max(decimals))
        aligned.append(_signed(value, _fixed(abs(value), wanted)) if wanted > own else text)
    return aligned


def quantity(low: float, high: float, unit: str, digits: int = 3, beside: float = 0.0) -> str:
    """Interval in the SI prefix that suits its larger end, or what is not far larger beside it."""
    largest = max(abs(low), abs(high))
    near = largest < beside < 1e3 * largest or largest == 0
    scale, prefix = prefixed(beside if near else largest, digits)
    return f"{interval(low / scale, high / scale, digits)} {prefix}{unit}"


def amount(value: float, unit: str, digits: int = 3) -> str:
    """One value in the SI prefix that suits it."""
    return quantity(value, value, unit, digits)


def quantity_with_error(value: float, error: float, unit: str) -> str:
    """``(value ± error)``, rounded to two digits of the error, in the SI prefix that suits it."""
    scale, prefix = prefixed(max(abs(value), error), 3)
    text = with_error(value / scale, error / scale)
    return f"({text}) {prefix}{unit}" if "±" in text else f"{text} {prefix}{unit}"


def with_rough_error(value: float, error: float, unit: str, digits: int = 3) -> str:
    """``(value ± error) unit``, the value to `digits` digits, the error rounded up to its last."""
    decimals = max(digits - 1 - _exponent(value, digits), 0)
    error = math.ceil(round(error * 10**decimals, 6)) / 10**decimals
    return f"({value:.{decimals}f} ± {error:.{decimals}f}) {unit}"


def prefixed(largest: float, digits: int) -> tuple[float, str]:
    """Scale and SI prefix that suit a number once it is rounded."""
    power = 3 * (_exponent(largest, digits) // 3)
    power = min(max(power, min(_PREFIXES)), max(_PREFIXES))
    return 10.0**power, _PREFIXES[power]


def unit_for(largest: float, unit: str) -> tuple[float, str]:
    """Factor on SI values, and the prefixed unit, that suit a largest value.

    Examples
    --------
    >>> unit_for(3e-4, "m")
    (1000000.0, 'µm')
    """
    scale, prefix = prefixed(largest, 3)
    return 1 / scale, f"{prefix}{unit}"


def superscripted(unit: str) -> str:
    """A unit with ``^2`` as ``²``; broken exponents stay."""
    return re.sub(r"\^(-?\d+)(?![\d.])", lambda found: found[1].translate(_SUPERSCRIPTS), unit)


def percent(share: float) -> str:
    """Share as a percentage to two digits; one that is tiny as less than the least shown."""
    if math.isnan(share):
        return NOTHING
    if 0 < share < _LEAST_SHARE:
        return f"< {number(100 * _LEAST_SHARE)} %"
    return f"{number(100 * share, 2)} %"


def change(share: float) -> str:
    """Relative change in whole per cent, with its sign."""
    text = f"{100 * share:+.0f} %".replace("-", "−")
    return "0 %" if text[1:] == "0 %" else text


def difference(value: float, error: float) -> str:
    """Relative difference with its error in per cent and with its sign: ``(+10.0 ± 3.0) %``."""
    text = with_error(100 * value, 100 * error)
    sign = "+" if value > 0 and re.search("[1-9]", text.partition("±")[0]) else ""
    return f"({sign}{text}) %"


def write_powers(text: str) -> str:
    """Text with numbers such as 1e-5 as powers of ten, and with the signs ±, ≤, − and µ."""

    def write(found):
        mantissa, power = found[1], _ten_to(int(found[2]))
        return power if mantissa == "1" else f"{mantissa} × {power}"

    text = re.sub(r"(?<=\s)\+-(?=\s)", "±", re.sub(r"<=|&lt;=", "≤", text))
    text = re.sub(r"(\d |\[)um\b", r"\1µm", text)
    text = re.sub(r"(?<![\w.])(\d+(?:\.\d+)?)e([+-]?\d+)(?!\w)", write, text)
    return re.sub(r"(?:(?<=[\s(=])|^)-(?=\d)", "−", text)


def keep_whole(text: str) -> str:
    """Text with no-break spaces inside its numbers and inside limits in brackets."""
    text = re.sub(rf"(?<=[\d)⁰¹²³⁴-⁹]) (?=×|±|(?:{_UNITS})(?![A-Za-z0-9]))", _NO_BREAK, text)
    text = re.sub(r"(?<=[×±≤≥<=]) (?=[−\d(])|(?<=[\w>]) (?==)", _NO_BREAK, text)
    whole = re.compile(rf"\([^()…]+ … [^()…]+\){_NO_BREAK}×|\([\d.]+ (?:to|…) [\d.]+[^()]{{0,8}}\)")
    return whole.sub(lambda found: found[0].replace(" ", _NO_BREAK), text)


def _exponent(value: float, digits: int) -> int:
    """Decimal exponent of the value once it is rounded; 0 where it has none."""
    if not math.isfinite(value):
        return 0
    return int(f"{value:.{digits - 1}e}".partition("e")[2])


def _fixed(value: float, decimals: int) -> str:
    return f"{round(value, decimals):.{max(decimals, 0)}f}"


def _ten_to(power: int) -> str:
    return f"10{str(power).translate(_SUPERSCRIPTS)}"


def _times_ten_to(power: int) -> str:
    return "" if power in _PLAIN else f" × {_ten_to(power)}"


def _signed(value: float, text: str) -> str:
    return f"−{text}" if value < 0 else text


def table(columns: Iterable[object], rows: Iterable[Iterable[object]]) -> str:
    """Markdown table with these column heads and rows of texts."""
    columns = list(columns)
    lines = [columns, ["---"] * len(columns), *rows]
    return "\n".join("| " + " | ".join(map(_escaped, line)) + " |" for line in lines) + "\n"


def _escaped(text: object) -> str:
    return str(text).replace("|", "\\|").replace("\n", " ")
