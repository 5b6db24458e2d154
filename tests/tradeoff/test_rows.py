"""Rows of the table of errors and costs."""

import numpy as np
import pytest
import xarray as xr

from tradeoff.rows import Trial


def test_rows_hold_the_error_of_single_seeds_and_the_bias_of_their_mean():
    """Errors of -10 % to +10 % cancel in the mean; nine of ten seeds stay within 9 %."""
    seeds, loads = np.arange(21), [0.01, 0.1]
    errors = np.linspace(-0.1, 0.1, 21)
    exact = xr.DataArray(np.full((21, 2), 4.0), {"seed": seeds, "pressure": loads})
    seconds = xr.DataArray([3.0, 6.0], {"pressure": loads})
    trial = Trial("pixels", "4", "one surface", unit=1.5, memory=7.0)
    value = exact * (1 + xr.DataArray(errors, {"seed": seeds}))
    rows = trial.compare({"area": value}, {"area": exact}, seconds)
    assert [row[:4] for row in rows] == [
        ("pixels", "4", "one surface, p = 0.01", "area"),
        ("pixels", "4", "one surface, p = 0.1", "area"),
    ]
    for (_, _, _, _, error, bias, cost, time, memory), spent in zip(rows, (3, 6), strict=True):
        assert error == pytest.approx(0.09, abs=0.005)
        assert bias == pytest.approx(0, abs=1e-12)
        assert (cost, time, memory) == (spent / 1.5, spent, 7)


def test_a_bias_that_was_not_measured_is_missing():
    trial = Trial("seeds", "4 plain", "one surface", unit=2.0)
    ((*_, error, bias, cost, time, memory),) = trial.list_rows({("area", 0.1): 0.2}, {}, 8.0)
    assert (error, cost, time) == (0.2, 4, 8)
    assert np.isnan(bias)
    assert np.isnan(memory)
