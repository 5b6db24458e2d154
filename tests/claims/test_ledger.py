"""The registry of claims."""

import types

import numpy as np
import pytest

from claims.ledger import NOT, claim, collect, grade


def test_an_unknown_error_grades_as_not_reproduced():
    assert grade(abs(3 - 3) < np.nan, False) == NOT


def topic(*numbers):
    """A module with claims of these numbers."""
    made = {f"claim_{n}_{at}": claim(n)(dict) for at, n in enumerate(numbers)}
    return types.SimpleNamespace(**made)


@pytest.mark.parametrize(
    ("numbers", "message"),
    [((1, 2, 2), "two claims have the number 2"), ((1, 3), "no claim has the number 2")],
)
def test_a_number_given_twice_or_never_is_an_error(numbers, message):
    with pytest.raises(ValueError, match=message):
        collect(topic(*numbers))


def test_a_claim_is_given_its_own_files_alone():
    examined = claim(1, "a", "b")(dict)
    assert examined({"a": 1, "b": 2, "c": 3}) == {"a": 1, "b": 2}
    with pytest.raises(KeyError, match="b"):
        examined({"a": 1})
