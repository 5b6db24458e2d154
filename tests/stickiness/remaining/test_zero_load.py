"""Adhesion that remains at zero load: what descents count for that stop on their way."""

from dataclasses import replace

import numpy as np
import pytest

from stickiness import surface
from stickiness.adhesive import solver as adhesive
from stickiness.remaining import zero_load
from stickiness.remaining.height_simulation import find_trial_states
from stickiness.solids import Layer
from stickiness.spectrum import SelfAffine
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


def test_the_longest_waves_tell_whether_a_layer_is_stiff(monkeypatch, state):
    starts = []

    def descend(*_, start, **__):
        starts.append(start)
        return state

    monkeypatch.setattr(adhesive, "solve", descend)
    layer = Layer(4.0, 0.5)  # that the longest waves of a square cell would not feel
    for sides, is_stiff in (((1, 1), False), ((4, 1), True), ((1, 4), True)):
        starts.clear()
        heights = np.tile(WAVE[:, None] * WAVE, sides)
        zero_load.share_at_zero_load(heights, LENGTH * np.array(sides), LAW, solid=layer)
        assert (len(starts) > 4) == is_stiff  # contact is made at longer ranges, too


def test_contact_on_a_thin_layer_is_made_at_longer_ranges():
    """States that were simulated for other works of adhesion bound the share from below."""
    rough = SelfAffine(hurst=0.8, q0=1.0, q1=8.0, h_rms=1.0)
    heights = surface.synthesise(rough, n=64, length=2 * LENGTH, seed=1)
    layer = Layer(0.2, 0.5)
    states = find_trial_states(heights, 2 * LENGTH, solid=layer)
    law = Exponential(adhesion_length=0.5 * states.full_contact_energy, range=0.2)
    bound = states.share(np.array([law.adhesion_length]), np.array([law.range]))[0]
    share = zero_load.share_at_zero_load(heights, 2 * LENGTH, law, solid=layer, tol=1e-3)
    assert share > 0.99 * bound
