"""What is predicted beside what was simulated: errors, and limits made of them."""

import numpy as np
import pandas as pd
import pytest

from limits.comparisons import Comparison
from stickiness.limited import Limited
from stickiness.remaining import errors

ROWS = pd.DataFrame(
    {"simulated": [1.0, 3.0], "value": [2.0, 2.0], "set": ["a", "b"], "seed": [1, 1]}
)


def compare(**columns):
    return Comparison(errors.LARGER, ROWS.assign(**columns))


def test_errors_are_in_their_unit():
    comparison = compare(unit=[2.0, -2.0])
    assert comparison.error.tolist() == [-0.5, -0.5]
    assert comparison.needed.tolist() == [1, 1]
    assert comparison.where(comparison.rows["set"] == "b").simulated.tolist() == [3]


def test_a_prediction_without_limits_takes_those_of_the_error():
    spread = Limited(value=-1.0, low=-3.0, high=0.0)
    up, down = (compare(unit=unit).limit(spread) for unit in (1.0, -1.0))
    assert [limit[0] for limit in up] == [1, -1, 2]
    assert [limit[0] for limit in down] == [3, 2, 5]


def test_the_error_adds_to_limits_in_quadrature():
    comparison = compare(low=-1.0, high=6.0)
    limited = comparison.limit(Limited(value=0.0, low=-4.0, high=3.0))
    np.testing.assert_allclose([limit[0] for limit in limited], [2, -3, 7])
    assert comparison.half_width == pytest.approx([3, 4])  # below, and above
