"""Numbers as readers see them."""

import numpy as np
import pytest

from common import formatting as numbers


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (1e-6, "10⁻⁶"),
        (-1e7, "−10⁷"),
        (1.04e-6, "1.04 × 10⁻⁶"),
        (0.0012345, "0.00123"),
        (12345.0, "12300"),
        (123456.0, "1.23 × 10⁵"),
        (9.9996e-7, "10⁻⁶"),
        (np.inf, "∞"),
    ],
)
def test_number(value, text):
    assert numbers.number(value) == text


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (1.8912, 0.0331, "1.891 ± 0.033"),
        (3.68, 1.0, "3.7 ± 1.0"),
        (0.99, 0.0996, "0.99 ± 0.10"),
        (-4.2e-6, 3e-7, "(−4.20 ± 0.30) × 10⁻⁶"),
        (67720, 120, "67720 ± 120"),
        (2.0, np.nan, "2"),
        (np.nan, np.nan, "–"),
    ],
)
def test_value_with_error(value, error, text):
    assert numbers.with_error(value, error) == text


@pytest.mark.parametrize(
    ("low", "high", "text"),
    [
        (1.0, 1.0004, "1"),
        (0.1, 20.0, "0.1 … 20"),
        (20.0, 0.1, "0.1 … 20"),
        (5.08e-4, 1.61e-3, "(5.08 … 16.1) × 10⁻⁴"),
        (3e-9, 2e-9, "(2 … 3) × 10⁻⁹"),
        (7e-6, 3.0, "7 × 10⁻⁶ … 3"),
        (2e4, 3e6, "(0.02 … 3) × 10⁶"),
        (0.0, np.inf, "0 … ∞"),
    ],
)
def test_interval_is_in_increasing_order(low, high, text):
    assert numbers.interval(low, high) == text


@pytest.mark.parametrize(
    ("low", "high", "text"),
    [
        (0.91, 1.0, "0.91 … 1.0"),
        (3e-9, 5.4e-9, "(3.0 … 5.4) × 10⁻⁹"),
        (0.2, 2.0, "0.2 … 2"),
        (153.0, 188.0, "150 … 190"),
        (9.96, 12.3, "10 … 12"),
    ],
)
def test_ends_of_an_interval_have_as_many_decimals_where_they_are_close(low, high, text):
    assert numbers.interval(low, high, 2) == text


def test_quantity_keeps_its_prefix_when_rounding_up():
    assert numbers.quantity(999.9999, 999.9999, "Pa") == "1 kPa"
    assert numbers.quantity(2e-12, 2e-12, "m") == "0.002 nm"


def test_quantity_has_the_prefix_of_what_stands_beside():
    assert numbers.quantity(7.3e-7, 7.3e-7, "m", 2) == "730 nm"
    assert numbers.quantity(7.3e-7, 7.3e-7, "m", 2, beside=1.7e-6) == "0.73 µm"


def test_quantity_with_error_is_rounded_to_it():
    assert numbers.quantity_with_error(1.6347e2, 20.49, "m") == "(163 ± 20) m"
    assert numbers.quantity_with_error(2.7049e-8, 2.449e-9, "m") == "(27.0 ± 2.4) nm"


@pytest.mark.parametrize(
    ("share", "text"),
    [
        (0.0, "0 %"),
        (3e-6, "< 0.01 %"),
        (0.0044, "0.44 %"),
        (0.1, "10 %"),
        (1.0, "100 %"),
        (np.nan, "–"),
    ],
)
def test_percent(share, text):
    assert numbers.percent(share) == text


def test_changes_have_a_sign():
    assert numbers.change(0.034) == "+3 %"
    assert numbers.change(-0.4) == "−40 %"
    assert numbers.difference(0.1, 0.03) == "(+10.0 ± 3.0) %"
    assert numbers.difference(-0.012, 0.0031) == "(−1.20 ± 0.31) %"


@pytest.mark.parametrize(
    ("text", "pieces"),
    [
        ("(2.4 … 4.4) × 10⁻⁹", 1),
        ("7 × 10⁻⁶ … 3", 3),
        ("87 … 100 % (87 to 100 %)", 4),
        ("(163 ± 33) m", 1),
        ("7.7 … 9.4 mPa", 3),
        ("50 mJ/m² at 1 Hz", 3),
        ("H = 0.8, l<sub>a</sub> = 0.05 range", 3),
        ("10⁻³ m<sup>0.4</sup>", 1),
        ("< 0.01 %", 1),
        ("0.73 µm (0.34 … 1.7 µm)", 2),
        ("≤ (0.13 … 4.7) × 10⁻⁴", 1),
        ("5 materials on 7 surfaces", 5),
    ],
)
def test_a_number_does_not_break(text, pieces):
    kept = numbers.keep_whole(text)
    assert len(kept.split(" ")) == pieces
    assert kept.replace("\u00a0", " ") == text


def test_what_rounds_to_none_has_no_sign():
    assert numbers.change(-0.004) == numbers.change(0.004) == "0 %"
    assert numbers.difference(-1e-6, 0.03) == "(0.0 ± 3.0) %"
    assert numbers.difference(1e-6, 0.03) == "(0.0 ± 3.0) %"


def test_a_quantity_without_an_error_has_no_brackets():
    assert numbers.quantity_with_error(1.2e-6, 0.0, "m") == "1.2 µm"
    assert numbers.quantity_with_error(1.2e-6, 1e-7, "m") == "(1.20 ± 0.10) µm"


def test_nothing_has_the_prefix_of_what_stands_beside():
    assert numbers.quantity(0.0, 0.0, "J/m²", beside=8e-8) == "0 nJ/m²"


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (0.1793, 0.0030, "(0.179 ± 0.003) %"),
        (36.659, 1.109, "(36.7 ± 1.2) %"),
        (3.1348, 6.9e-4, "(3.13 ± 0.01) %"),
        (123.4, 2.4, "(123 ± 3) %"),
        (9.996, 0.1, "(10.0 ± 0.1) %"),
    ],
)
def test_a_rough_error_is_rounded_up_to_the_last_digit(value, error, text):
    assert numbers.with_rough_error(value, error, "%") == text
