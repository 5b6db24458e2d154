"""Adhesion that remains at zero load: what descents count for that stop on their way."""

from dataclasses import replace

import numpy as np
import pytest

from stickiness.adhesive import solver as adhesive
from stickiness.remaining import zero_load
from stickiness.traction_laws import Exponential

LENGTH = 2 * np.pi
WAVE = np.cos(LENGTH * np.arange(16) / 16)
LAW = Exponential(adhesion_length=0.2, range=0.2)


@pytest.fixture(scope="module")
def state():
    return adhesive.solve(WAVE[:, None] * WAVE, LENGTH, LAW, pressure=0.0)


@pytest.mark.parametrize(
    ("energies", "stopped", "share"),
    [
        ([-0.02, -0.1, -0.05, -0.05], [], 0.5),
        ([-0.02, -0.1, -0.05, -0.05], [0, 3], 0.5),  # less deep than another
        ([-0.02, -0.1, -0.05, -0.05], [1], np.nan),  # deeper than all others
        ([0.0, 0.0, 0.01, 0.01], [2, 3], 0.0),
        ([-0.02, -0.1, -0.05, -0.05], [0, 1, 2, 3], np.nan),
    ],
)
def test_a_descent_that_stopped_deepest_leaves_the_share_open(
    monkeypatch, state, energies, stopped, share
):
    numbers = iter(range(4))

    def descend(*_, **__):
        number = next(numbers)
        end = replace(state, elastic_energy=energies[number], interaction_energy=0.0)
        if number in stopped:
            raise adhesive.ConvergenceError("iterations are spent", end)
        return end

    monkeypatch.setattr(adhesive, "solve", descend)
    remaining = zero_load.share_at_zero_load(WAVE[:, None] * WAVE, LENGTH, LAW)
    assert remaining == pytest.approx(share, nan_ok=True)
