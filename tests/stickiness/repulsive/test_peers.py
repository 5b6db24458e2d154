"""The repulsive solution against those of Tamaas and ContactMechanics (envs/peers.txt)."""

import importlib.util
import pathlib
import warnings

import numpy as np
import pytest
from helpers.rough import periodic

from stickiness import repulsive, solids
from stickiness.repulsive import half_space

pytestmark = pytest.mark.peers

DRIVERS = pathlib.Path(__file__).parents[3] / "benchmarks" / "contact_codes.py"
REASON = "reference code not installed: pip install -r envs/peers.txt"


@pytest.fixture(params=["tamaas", "ContactMechanics"])
def code(request):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the peers warn of a missing MPI on import
        pytest.importorskip(request.param, reason=REASON)
    spec = importlib.util.spec_from_file_location("contact_codes", DRIVERS)
    drivers = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(drivers)
    return {"tamaas": drivers.tamaas, "ContactMechanics": drivers.contact_mechanics}[request.param]


@pytest.mark.parametrize("hurst", [0.5, 0.8])
@pytest.mark.parametrize("scaled_pressure", [0.01, 0.1, 0.5])
@pytest.mark.parametrize("shape", [(128, 128), (80, 81), (81, 81)])
def test_same_solution(code, shape, scaled_pressure, hurst):
    if shape[0] % 2 and code.__name__ == "tamaas":
        # Seen in full contact with single waves: p_q is (n + 1) / n of |q| h_q / 2 for the
        # highest wave along axis 0 of 9 points, exact for all others and for even grids.
        pytest.skip("Tamaas 2.9.0 misplaces the highest wavenumber of an odd axis 0")
    heights = periodic(shape, 12, hurst, seed=1)
    pressure = scaled_pressure * 2 * np.pi
    ours = repulsive.solve(heights, (1.0, 1.0), pressure, tol=1e-9)
    theirs = code(heights, 1.0, pressure, 1e-9)
    assert theirs.pressure.mean() == pytest.approx(pressure, rel=1e-9)
    # residuals of 1e-9 in the gap times the largest stiffness of the grid, |q|max / 2, with a
    # margin of ten since the codes define their residuals differently
    stiffness = np.pi * np.hypot(*shape) / 2
    np.testing.assert_allclose(theirs.pressure, ours.pressure, atol=1e-9 * stiffness * 10)
    # single points at zero pressure and zero gap may fall on either side
    area = np.mean(theirs.pressure > 0)
    assert area == pytest.approx(ours.area_fraction, abs=3 / heights.size)


@pytest.mark.parametrize("poisson", [0.0, 0.3, 0.49])
@pytest.mark.parametrize("thickness", [0.03, 0.2])
@pytest.mark.parametrize("share", [0.05, 0.3])
def test_same_solution_on_a_bonded_layer(thickness, poisson, share):
    """ContactMechanics has a layer bonded to a rigid base."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        peer = pytest.importorskip("ContactMechanics", reason=REASON)
        from ContactMechanics.Optimization import ConstrainedConjugateGradients
    heights, tol = periodic((64, 64), seed=1), 1e-9
    solid = solids.Layer(thickness, poisson)
    pressure = share * solid.stiffness(2 * np.pi)
    ours = repulsive.solve(heights, 1.0, pressure, tol=tol, solid=solid)
    layer = peer.PeriodicFFTElasticHalfSpace(
        heights.shape, 1 - poisson**2, (1.0, 1.0), thickness=thickness, poisson=poisson
    )
    result = ConstrainedConjugateGradients.constrained_conjugate_gradients(
        layer, heights, external_force=pressure, pentol=tol, maxiter=20_000
    )
    theirs = np.abs(np.asarray(result.jac).reshape(heights.shape)) * heights.size
    assert theirs.mean() == pytest.approx(pressure, rel=1e-9)
    q = half_space.wavenumbers(heights.shape, (1.0, 1.0))
    stiffness = solid.stiffness(q[q > 0]).max()
    np.testing.assert_allclose(theirs, ours.pressure, atol=10 * tol * stiffness)
    assert np.mean(theirs > 0) == pytest.approx(ours.area_fraction, abs=3 / heights.size)
