"""Pull-off of spheres from rough heights, by direct sums and by boundary elements.

- `touching_force`: rigid solids (Bradley, doi:10.1080/14786443209461990), which pull off where the
  sphere first touches: the sum of the traction over the gaps.
- `pull_off_force`: an elastic half-space, by the states of `adhesive.solve` at rising mean gaps,
  from a load of twice JKR's pull-off on. Paraboloids stand for spheres.
"""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import NDArray

from stickiness import adhesive
from stickiness.traction_laws import TractionLaw

PRESSED = 2.0  #: load before separation, over JKR's pull-off force
STEP = 0.08  #: of the mean gap, over the square of the contact radius over that of the sphere


def touching_force(
    heights: NDArray,
    length: float,
    radius: float,
    law: TractionLaw,
    centre: tuple[int, int],
    reach: float,
) -> float:
    """Force [E* length^2] on a rigid sphere above a point of periodic heights, at first touch.

    Gaps are summed up to the distance `reach` from its axis.
    """
    points = len(heights)
    pixel = length / points
    steps = min(int(np.ceil(reach / pixel)), points // 2 - 1)
    offset = np.arange(-steps, steps + 1)
    square = np.add.outer(offset**2, offset**2) * pixel**2
    patch = heights[np.ix_(*((each + offset) % points for each in centre))]
    below = patch - square / (2 * radius)
    return float(law.traction(below.max() - below).sum()) * pixel**2


def pull_off_force(heights: NDArray, length: float, radius: float, law: TractionLaw) -> float:
    """Largest tension [E* length^2] of a sphere in the middle of a periodic cell of heights."""
    points = len(heights)
    x = (np.arange(points) - points // 2) * length / points
    shape = heights - np.add.outer(x**2, x**2) / (2 * radius)
    jkr = 1.5 * np.pi * radius * law.adhesion_length
    step = STEP * np.cbrt(9 * np.pi / 8 * law.adhesion_length * radius**2) ** 2 / radius
    step = max(step, STEP * 2 * law.range)
    best = 0.0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of coarse pixels
        state = adhesive.solve(shape, length, law, pressure=PRESSED * jkr / length**2, tol=1e-4)
        gap = state.mean_gap
        for _ in range(400):
            gap += step
            state = adhesive.solve(shape, length, law, mean_gap=gap, start=state, tol=1e-4)
            force = -state.mean_pressure * length**2
            best = max(best, force)
            if state.repulsive_area_fraction == 0 and force < 0.02 * jkr:
                return best
    raise AssertionError("the sphere does not pull off")
