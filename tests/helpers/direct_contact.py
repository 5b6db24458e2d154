"""Contact of few points by a direct method: linear systems on ever better sets of contact."""

import numpy as np
import pytest


def solve_directly(compliance, heights, load):
    """Pressure of all points, flat, which of them touch, and shift, from a dense compliance."""
    n = heights.size
    active = np.ones(n, bool)
    for _ in range(100):
        size = active.sum()
        system = np.ones((size + 1, size + 1))
        system[:size, :size] = compliance[np.ix_(active, active)]
        system[size, size] = 0
        solution = np.linalg.solve(system, np.append(heights.ravel()[active], load * n))
        pressure = np.zeros(n)
        pressure[active] = solution[:size]
        gap = compliance @ pressure + solution[size] - heights.ravel()
        wrong = (pressure < 0) | ((gap < -1e-12) & ~active)
        if not wrong.any():
            return pressure, active, solution[size]
        active = np.where(pressure < 0, False, active | (gap < -1e-12))
    pytest.fail("the direct method did not settle")
