"""The shape of a claim."""

import numpy as np
import pytest

from claims.ledger import NOT, claim, grade


def test_an_unknown_error_grades_as_not_reproduced():
    assert grade(abs(3 - 3) < np.nan, False) == NOT


def test_a_claim_is_given_the_files_that_its_parameters_name():
    examined = claim(1)(lambda a, b: (a, b))
    assert examined.files == ("a", "b")
    assert examined({"b": 2, "a": 1, "c": 3}) == (1, 2)
    with pytest.raises(KeyError, match="b"):
        examined({"a": 1})
