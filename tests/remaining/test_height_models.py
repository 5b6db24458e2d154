"""Models of what remains on skewed heights beside full simulation, on a tiny grid."""

import numpy as np
import pytest
from helpers.entries import model_surface
from helpers.jobs import make_job

from common.model_surfaces import make_heights
from remaining import compare_height_models
from stickiness import datasets
from stickiness.remaining.height_simulation import find_trial_states

SURFACES = [
    model_surface(magnification=4, window=2, heights={"skewness": skewness})
    for skewness in (-1.5, 1.5)
]
PIXEL = 2 * np.pi / 16  # four on the shortest wave


@pytest.fixture(scope="module")
def compared(tmp_path_factory):
    path = tmp_path_factory.mktemp("remaining") / "heights.nc"
    energies = [0.3, 0.5, 1.0, 2.0]
    params = {"surfaces": SURFACES, "seed": 1, "energies": energies}
    compare_height_models.main(make_job(path, params | {"simulated_energies": energies}))
    return datasets.read(path)


def test_surfaces_differ_in_their_skewness_alone(compared):
    assert compared.height_skewness.values == pytest.approx([-1.5, 1.5], abs=0.3)
    worn, peaks = compared.full_contact_energy.values
    assert worn == pytest.approx(peaks, rel=1e-6)
    worn, peaks = compared.theory.values
    assert worn == pytest.approx(peaks, rel=1e-6)
    length = compared.energy_ratio * compared.full_contact_energy
    assert (compared.range**2 / length).values == pytest.approx(2 * PIXEL)


def test_simulation_is_above_the_bound_and_within_limits_of_the_states(compared):
    simulated = compared.simulated.values
    assert (compared.bound.values <= simulated * 1.001).all()
    worn, peaks = simulated
    assert (worn > peaks).all()
    low, _, high = compared.states.transpose("limit", ...).values
    assert (low <= simulated).all()
    assert (simulated <= high).all()


def test_bound_is_that_of_states_without_adhesion(compared):
    """Their loads are by the slope on the grid, and their gaps are counted in bins."""
    worn = compared.sel(skewness=-1.5, energy_ratio=[0.3, 0.5, 1.0])
    heights = make_heights(SURFACES[0], points=32, seed=1)
    states = find_trial_states(heights, 4 * np.pi).without_adhesion()
    lengths = (worn.energy_ratio * worn.full_contact_energy).values
    assert worn.bound.values == pytest.approx(states.share(lengths, worn.range.values), rel=5e-3)
