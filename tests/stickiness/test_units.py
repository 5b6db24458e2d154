"""Values with units."""

import re

import pytest

from stickiness.units import si


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("0.1 um", "m", 1e-7),
        ("50 mJ/m^2", "J/m^2", 0.05),
        ("1e3 1/m", "1/m", 1e3),
        ("1e-3 m^0.4", "m^0.4", 1e-3),
        ("1 mPa*s", "Pa*s", 1e-3),
        ("0.9 mPa·s", "Pa*s", 9e-4),
    ],
)
def test_converts_to_si(text, unit, value):
    assert si(text, unit) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize("text", ["5", "5 K", "five m", "", "5 mm^2", "m m m 3", 0.1, None])
def test_anything_else_says_what_is_expected(text):
    with pytest.raises(ValueError, match="a length is wanted, e.g. '10 um'"):
        si(text, "m")


@pytest.mark.parametrize(
    ("text", "unit", "message"),
    [
        ("2,5 nm", "m", "decimal point"),
        ("30 kpa", "Pa", "'30 kpa' cannot be read: did you mean '30 kPa'?"),
        ("30 mPa", "Pa", "mPa is millipascal, a thousandth of a pascal; did you mean '30 MPa'?"),
        ("2 Mm", "m", "Mm is megametre, a thousand kilometres; did you mean '2 mm'?"),
        ("10 Um", "m", "did you mean '10 um'?"),
        ("50 mj/m2", "J/m^2", "did you mean '50 mJ/m^2'?"),
        ("2 mm", "Pa", "'2 mm' is a length; a pressure is wanted, e.g. '2 MPa'"),
        ("5 mN", "J/m^2", "'5 mN' is a force; an energy per area is wanted, e.g. '50 mJ/m^2'"),
        ("1e-3", "m^0.4", "has no unit; a number in m^0.4 is wanted, e.g. '1e-3 m^0.4'"),
        ("3 kg*m", "Pa", "is in kg·m; a pressure is wanted"),
    ],
)
def test_a_wrong_unit_is_named_in_words(text, unit, message):
    with pytest.raises(ValueError, match=re.escape(message)) as caught:
        si(text, unit)
    assert "[" not in str(caught.value)  # no dimensions as pint prints them
