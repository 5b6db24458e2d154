"""What files say of signs and of convergence."""

import numpy as np
import xarray as xr

from common.conventions import add_convergence
from stickiness import surface
from stickiness.repulsive import solver
from stickiness.solids import Layer
from stickiness.spectrum import SelfAffine


def test_a_state_beyond_the_tolerance_or_missing_is_not_converged():
    data = xr.Dataset({"adhesive_residual": ("state", [1e-6, 1e-4, 2e-4, np.nan])})
    found = add_convergence(data, 1e-4, "adhesive_")
    assert found.adhesive_converged.values.tolist() == [1, 1, 0, 0]
    assert "at most 0.0001" in found.adhesive_converged.long_name


def test_the_mean_gap_is_the_rigid_displacement():
    """As its sign convention says: displacements are counted from their mean."""
    heights = surface.synthesise(
        SelfAffine(hurst=0.8, q0=1.0, q1=8.0, h_rms=0.01), 64, 2 * np.pi, 1
    )
    for solid in ({}, {"solid": Layer(thickness=0.3, poisson=0.4, backing="bonded")}):
        contact = solver.solve(heights, 2 * np.pi, 0.002, **solid)
        np.testing.assert_allclose(contact.shift, contact.mean_gap, rtol=1e-7)
