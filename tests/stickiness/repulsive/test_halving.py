"""Sums between a grid and one half as fine."""

import numpy as np
import pytest

from stickiness.repulsive import halving


@pytest.mark.parametrize("shape", [(2, 2), (6, 8), (5, 9), (130, 71)])
def test_both_ways_are_transposes(shape):
    rng = np.random.default_rng(1)
    field = rng.normal(size=shape).astype(np.float32)
    gathered = halving.gather(field)
    coarse = rng.normal(size=gathered.shape).astype(np.float32)
    spread = np.zeros(shape, np.float32)
    halving.spread(coarse, spread)
    assert np.vdot(gathered, coarse) == pytest.approx(np.vdot(field, spread), rel=1e-4)


def test_the_way_to_the_fine_grid_interpolates_and_adds():
    coarse = np.float32([[0, 1], [2, 5]])
    fine = np.ones((4, 4), np.float32)
    halving.spread(coarse, fine)
    interpolated = [[0, 0.5, 1, 0.5], [1, 2, 3, 2], [2, 3.5, 5, 3.5], [1, 2, 3, 2]]
    assert np.array_equal(fine, 1 + 4 * np.array(interpolated))


def test_points_are_weighted_by_their_distance():
    field = np.zeros((6, 8))
    field[1, 3] = 1.0
    sums = np.zeros((3, 4))
    sums[0:2, 1:3] = 1  # on both sides along both axes
    assert np.array_equal(halving.gather(field), sums)
    field[2, 4] = 1.0
    sums[1, 2] += 4
    assert np.array_equal(halving.gather(field), sums)
