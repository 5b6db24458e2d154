"""The page of validation is that of the committed tables and of the library as it is."""

import numpy as np
import pytest

from limits import validation
from stickiness.limited import Limited


def test_the_page_is_up_to_date():
    written = validation.PAGE.read_text(encoding="utf-8")
    assert validation.page() == written, "run PYTHONPATH=scripts python -m limits.validation"


def test_limits_hold_what_lies_between_them():
    predicted = Limited(np.full(3, 0.2), np.full(3, 0.1), np.full(3, 0.3))
    inside = validation.find_inside(predicted, np.array([0.05, 0.15, 0.35]))
    assert inside.tolist() == [False, True, False]


def test_a_table_of_shares_counts_false_decisions():
    predicted = Limited(np.array([0.3, 0.3]), np.array([0.2, 0.05]), np.array([0.4, 0.4]))
    row = validation.Compared("name", "model", predicted, np.array([0.05, 0.05]))
    cells = validation.tabulate_shares([row]).splitlines()[-1].strip("| ").split(" | ")
    assert cells[0] == "name"
    assert cells[-2:] == ["50 %", "1"]
    assert float(cells[3]) == pytest.approx(0.25)
