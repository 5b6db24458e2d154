"""Values with units."""

import pytest

from stickiness.core.units import si


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("0.1 um", "m", 1e-7),
        ("50 mJ/m^2", "J/m^2", 0.05),
        ("2 MPa", "Pa", 2e6),
        ("1e3 1/m", "1/m", 1e3),
        ("1e-3 m^0.4", "m^0.4", 1e-3),
        ("1 km", "m", 1e3),
    ],
)
def test_converts_to_si(text, unit, value):
    assert si(text, unit) == pytest.approx(value, rel=1e-12)


def test_a_decimal_comma_is_refused():
    with pytest.raises(ValueError, match="decimal point"):
        si("2,5 nm", "m")


@pytest.mark.parametrize("text", ["5", "5 K", "five m", "", "5 mm^2", "m m m 3", 0.1, None])
def test_anything_else_says_what_is_expected(text):
    with pytest.raises(ValueError, match="expected a number with a unit of the dimension of m"):
        si(text, "m")
