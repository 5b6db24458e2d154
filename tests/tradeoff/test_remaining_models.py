"""Cost and error of models of what remains, from a table of known errors."""

import numpy as np
import pandas as pd
import pytest

from common import remaining_models

#: Relative errors of models on Gaussian heights; on others they are twice as large.
ERRORS = {"theory": 0.3, "shaped": -0.2, "bound": -0.4, "states": 0.05}
#: Absolute errors where little remains.
SMALL_ERRORS = {"theory": 0.02, "shaped": -0.01, "bound": -0.03, "states": 0.004}
SECONDS = {"theory": 0.002, "bound": 1.0, "states": 3.0, "simulated": 0.5}


@pytest.fixture
def table():
    """Nine pairs of ten with the errors, of Gaussian and other heights, much and little of each."""
    rows = []
    for kind, factor in (("Gaussian", 1.0), ("skewed", 2.0), ("transformed", 2.0)):
        for number in range(11):
            scale = factor * (0.5 if number < 9 else 1.0 if number == 9 else 10.0)
            for simulated, errors in ((0.2, ERRORS), (0.0, SMALL_ERRORS)):
                shares = {
                    name: simulated + scale * error * (simulated or 1.0)
                    for name, error in errors.items()
                }
                seconds = {f"seconds_{name}": value for name, value in SECONDS.items()}
                rows.append({"kind": kind, "simulated": simulated} | shares | seconds)
        rows.append(rows[-1] | {"simulated": np.nan})  # did not converge
    return pd.DataFrame(rows)


def test_errors_cover_90_per_cent_of_the_simulations(table):
    rows = {row["model"]: row for row in remaining_models.condense(table)}
    for name, error in ERRORS.items():
        little = abs(SMALL_ERRORS[name])
        assert rows[name]["gaussian"] == pytest.approx(abs(error))
        assert rows[name]["gaussian_little"] == pytest.approx(little)
        assert rows[name]["other"] == pytest.approx(2 * abs(error))
        assert rows[name]["other_little"] == pytest.approx(2 * little)
    assert rows["simulated"]["gaussian"] == rows["simulated"]["other_little"] == 0


def test_contacts_on_the_heights_serve_for_all_pairs(table):
    rows = {row["model"]: row for row in remaining_models.condense(table)}
    seconds = {name: row["seconds"] for name, row in rows.items()}
    assert seconds == pytest.approx(SECONDS | {"shaped": SECONDS["theory"]})
    assert {name for name, row in rows.items() if row["serves_all"]} == {"bound", "states"}
