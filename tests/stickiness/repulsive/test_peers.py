"""The repulsive solution against those of Tamaas and ContactMechanics (envs/peers.txt)."""

import numpy as np
import pytest
from helpers.peers import import_peer, load_drivers
from helpers.rough import periodic

from stickiness import repulsive, solids
from stickiness.repulsive import half_space

pytestmark = pytest.mark.peers


@pytest.fixture(params=["tamaas", "ContactMechanics"])
def code(request):
    import_peer(request.param)
    drivers = load_drivers("contact_codes")
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


def assert_same_as_contact_mechanics(substrate, heights, ours, tol, stiffness, **options):
    code = import_peer("ContactMechanics.Optimization").ConstrainedConjugateGradients
    result = code.constrained_conjugate_gradients(
        substrate,
        heights,
        external_force=ours.mean_pressure,
        pentol=tol,
        maxiter=20_000,
        **options,
    )
    theirs = np.abs(np.asarray(result.jac).reshape(heights.shape)) * heights.size
    assert theirs.mean() == pytest.approx(ours.mean_pressure, rel=1e-9)
    np.testing.assert_allclose(theirs, ours.pressure, atol=10 * tol * stiffness)
    assert np.mean(theirs > 0) == pytest.approx(ours.area_fraction, abs=3 / heights.size)
    return result


@pytest.mark.parametrize("poisson", [0.0, 0.3, 0.49])
@pytest.mark.parametrize("thickness", [0.03, 0.2])
@pytest.mark.parametrize("share", [0.05, 0.3])
def test_same_solution_on_a_bonded_layer(thickness, poisson, share):
    """ContactMechanics has a layer bonded to a rigid base."""
    peer = import_peer("ContactMechanics")
    heights, tol = periodic((64, 64), seed=1), 1e-9
    solid = solids.Layer(thickness, poisson)
    pressure = share * solid.stiffness(2 * np.pi)
    ours = repulsive.solve(heights, 1.0, pressure, tol=tol, solid=solid)
    layer = peer.PeriodicFFTElasticHalfSpace(
        heights.shape, 1 - poisson**2, (1.0, 1.0), thickness=thickness, poisson=poisson
    )
    q = half_space.wavenumbers(heights.shape, (1.0, 1.0))
    stiffness = solid.stiffness(q[q > 0]).max()
    assert_same_as_contact_mechanics(layer, heights, ours, tol, stiffness)


@pytest.mark.parametrize("pressure", [0.06, 0.6, 3.0])
@pytest.mark.parametrize("shape", [(64, 64), (48, 81)])
def test_same_solution_with_free_edges(shape, pressure):
    peer = import_peer("ContactMechanics")
    n, tol = 2 * max(shape), 1e-9
    heights = periodic((n, n), 20, seed=1)[: shape[0], : shape[1]]
    heights = heights / heights.std()
    ours = repulsive.solve(heights, (1.0, 1.0), pressure, tol=tol, periodic=False)
    free = peer.FreeFFTElasticHalfSpace(shape, 1.0, (1.0, 1.0))
    stiffness = np.pi * np.hypot(*shape) / 2
    result = assert_same_as_contact_mechanics(free, heights, ours, tol, stiffness, thermotol=tol)
    assert result.success
    assert -result.offset == pytest.approx(ours.shift, abs=10 * tol)
