"""Numbers of claims in words."""

import numpy as np
import pytest

from claims.texts import power_of_ten, quote_number


def test_quoted_leaves_out_an_unknown_error():
    assert quote_number(1.234, 0.056) == "1.23 ± 0.06"
    assert quote_number(1.234, np.nan) == "1.23"


@pytest.mark.parametrize(
    ("number", "text"), [(10.0, "10"), (1000.0, "1000"), (5e4, "5e4"), (1e6, "1e6")]
)
def test_magnifications_in_words(number, text):
    assert power_of_ten(number) == text
