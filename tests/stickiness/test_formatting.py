"""Numbers as readers see them."""

import numpy as np
import pytest

from stickiness import formatting

INF, NAN = np.inf, np.nan
CASES = {
    "number": [
        ((-1e7,), "−10⁷"),
        ((1.04e-6,), "1.04 × 10⁻⁶"),
        ((12345.0,), "12300"),
        ((9.9996e-7,), "10⁻⁶"),
    ],
    "with_error": [
        ((1.8912, 0.0331), "1.891 ± 0.033"),
        ((0.99, 0.0996), "0.99 ± 0.10"),
        ((-4.2e-6, 3e-7), "(−4.20 ± 0.30) × 10⁻⁶"),
        ((-1e-4, 3.0), "0.0 ± 3.0"),  # what rounds to nothing has no sign
        ((2.0, NAN), "2"),
        ((NAN, NAN), "–"),
    ],
    "interval": [
        ((1.0, 1.0004), "1"),
        ((7e-6, 3.0), "7 × 10⁻⁶ … 3"),
        ((0.0, INF), "0 … ∞"),
    ],
    "quantity": [
        ((999.9999, 999.9999, "Pa"), "1 kPa"),
        ((2e-12, 2e-12, "m"), "0.002 nm"),
        ((7.3e-7, 7.3e-7, "m", 2, 1.7e-6), "0.73 µm"),  # the prefix of what stands beside
        ((0.0, 0.0, "J/m²", 3, 8e-8), "0 nJ/m²"),
    ],
    "quantity_with_error": [
        ((2.7049e-8, 2.449e-9, "m"), "(27.0 ± 2.4) nm"),
        ((1.2e-6, 0.0, "m"), "1.2 µm"),
    ],
    "percent": [
        ((0.0,), "0 %"),
        ((3e-6,), "< 0.01 %"),
        ((1.0,), "100 %"),
        ((NAN,), "–"),
    ],
    "limited": [
        ((1.8e-8, 0.0, 17.0, formatting.in_units_of(1.0)), "below 17"),
        ((8.7e3, 4.8e3, 9.1e6, formatting.in_unit("Pa")), "4.8 kPa to 9.1 MPa"),
        ((4.5e4, 3.3e4, 8.7e4, formatting.in_unit("Pa")), "45 kPa (33 to 87 kPa)"),
        ((0.6, 0.31, 0.77, formatting.in_percent), "60 % (31 to 77 %)"),
        ((0.0, 0.0, 0.0, formatting.in_percent), "0 %"),
        ((0.5, 0.0, 0.7, formatting.in_percent), "50 % (0 to 70 %)"),
        ((NAN, 1.0, 3.3, formatting.in_units_of(1.0)), "1 to 3.3"),
        ((1.0, 1.0, 1.0, formatting.in_units_of(1.0)), "1"),
        ((5e6, 3e6, INF, formatting.in_units_of(1e6)), "5 (at least 3)"),
        ((INF, 3e6, INF, formatting.in_units_of(1e6)), "at least 3"),
        ((INF, 0.0, INF, formatting.in_units_of(1e6)), "no limits"),
        ((NAN, NAN, NAN, formatting.in_unit("Hz")), "–"),
    ],
    "change": [((0.034,), "+3 %"), ((-0.4,), "−40 %"), ((-0.004,), "0 %")],
}


def test_what_is_too_small_or_too_large_to_use_is_nothing_or_no_bound():
    bounds = {"least": 1.0, "most": 1e13}
    in_mpa = formatting.in_units_of(1e6)
    assert formatting.limited(0.2, 0.1, 0.9, in_mpa, **bounds) == "0"
    assert formatting.limited(2e12, 1.5e11, 1e21, in_mpa, **bounds).endswith(
        " (at least 1.5 × 10⁵)"
    )
    assert formatting.limited(5.3e-8, 0, 1e-4, formatting.in_percent, least=1e-3) == "0 %"


@pytest.mark.parametrize(
    ("name", "given", "text"),
    [(name, given, text) for name, cases in CASES.items() for given, text in cases],
)
def test_numbers_are_rounded_to_what_is_known(name, given, text):
    assert getattr(formatting, name)(*given) == text
