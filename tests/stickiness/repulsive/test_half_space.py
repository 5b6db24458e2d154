"""Operators of the half-space against plain transforms of numpy."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from references.contact import displacement

from stickiness.repulsive import half_space


@pytest.mark.parametrize("shape", [(16, 16), (17, 13), (1, 8), (5, 1), (64, 48), (31, 128)])
def test_half_space_equals_plain_transforms(shape):
    rng = np.random.default_rng(3)
    sides = (0.7, 1.9)
    operator = half_space.HalfSpace(shape, sides)
    pressure = rng.standard_normal(shape)
    expected = displacement(pressure, sides)
    np.testing.assert_allclose(operator.compliance(pressure), expected, atol=1e-14)
    back = operator.stiffness(expected)
    np.testing.assert_allclose(back, pressure - pressure.mean(), atol=1e-13)
    unit = np.zeros(shape)
    unit[0, 0] = 1
    # the diagonal of the stiffness matrix is what a single lifted pixel feels
    assert operator.stiffness(unit)[0, 0] == pytest.approx(operator.mean_stiffness)


def test_half_space_with_some_rows_only():
    rng = np.random.default_rng(4)
    operator = half_space.HalfSpace((37, 24), (1.0, 1.0))
    for chosen in ([0, 3, 4, 36], [5], list(range(10, 30))):
        rows = np.array(chosen)
        pressure = np.zeros((37, 24))
        pressure[rows] = rng.standard_normal((rows.size, 24))
        expected = displacement(pressure, (1.0, 1.0))
        result = operator.compliance(pressure, rows_in=rows, rows_out=rows)
        np.testing.assert_allclose(result[rows], expected[rows], atol=1e-14)
        np.testing.assert_allclose(operator.compliance(pressure), expected, atol=1e-14)


def test_operators_are_kept_for_a_thread_and_can_be_freed():
    one = half_space.half_space((8, 8), (1.0, 1.0))
    assert half_space.half_space((8, 8), (1.0, 1.0)) is one
    with ThreadPoolExecutor(1) as other:
        assert other.submit(half_space.half_space, (8, 8), (1.0, 1.0)).result() is not one
    half_space.clear_caches()
    assert half_space.half_space((8, 8), (1.0, 1.0)) is not one
