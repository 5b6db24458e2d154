"""Lowest points of splines, which gamma is found by."""

import numpy as np
from scipy.interpolate import CubicSpline

from fits.fit_gamma import GRID, lowest


def test_lowest_points_are_those_of_a_fine_grid():
    x, rng = np.log(GRID), np.random.default_rng(0)
    centre, bend, wave = rng.uniform(-2.2, 0.3, 200), rng.uniform(0.1, 2, 200), rng.normal(size=200)
    rows = bend[:, None] * (x - centre[:, None]) ** 2 + 0.05 * wave[:, None] * np.sin(4 * x)
    curves = CubicSpline(x, rows, axis=1)
    fine = np.linspace(x[0], x[-1], 4001)
    values = curves(fine)
    found = lowest(curves)
    np.testing.assert_allclose(np.log(found), fine[values.argmin(axis=1)], atol=fine[1] - fine[0])
    for end, want in ((x, GRID[0]), (-x, GRID[-1]), ((x + 1) ** 2, np.exp(-1))):
        np.testing.assert_allclose(lowest(CubicSpline(x, end)), want, rtol=1e-12)
    at = np.array([curves(np.log(g))[i] for i, g in enumerate(found)])
    assert np.all(at <= values.min(axis=1) + 1e-15)
