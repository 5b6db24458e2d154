"""Contact of elastic layers without adhesion."""

import numpy as np
import pytest
from references.contact import assert_contact_conditions, displacement, elastic_pressure

from stickiness import repulsive, spectrum, surface
from stickiness.solids import Film, Layer

LENGTH = 4 * np.pi  # two waves of wave number one
ROUGH = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=16.0, h_rms=1.0)
FILM = Film(1e4, 0.4, 0.1)


@pytest.fixture(scope="module")
def heights():
    return surface.synthesise(ROUGH, n=128, length=LENGTH, seed=3)


def flattening_pressure(heights, solid):
    """Root mean square pressure of full contact."""
    return elastic_pressure(heights, (LENGTH, LENGTH), solid).std()


MODERATE = [(0.2, 0.4), (1.0, 0.03), (3.0, 0.4)]  # thickness, share of the flattening pressure
EXTREME = [(1e-4, 0.2), (1e-2, 0.2), (1e3, 0.2)]
PRESSED = [
    (Layer(thickness, poisson, backing), load)
    for poisson, backing in [(0.5, "bonded"), (0.3, "bonded"), (0.5, "slip"), (0.5, FILM)]
    for thickness, load in MODERATE + (EXTREME if backing != FILM else [])
]


@pytest.mark.slow
@pytest.mark.parametrize(("solid", "load"), PRESSED, ids=str)
def test_contact_conditions(heights, solid, load):
    pressure = load * flattening_pressure(heights, solid)
    contact = repulsive.solve(heights, LENGTH, pressure, tol=1e-7, solid=solid)
    image = displacement(contact.pressure, (LENGTH, LENGTH), solid)
    assert_contact_conditions(contact, heights, image, heights.std(), 1e-7)
    assert 0 < contact.area_fraction < 1


@pytest.mark.parametrize("backing", ["bonded", "slip", FILM], ids=str)
def test_a_single_wave_in_full_contact(backing):
    """The mean pressure that just closes a wave is its stiffness times the amplitude."""
    x = 2 * np.pi * np.arange(64) / 64
    wave = 0.01 * np.cos(x)[:, None] * np.ones(64)
    solid = Layer(0.4, 0.4, backing)
    closing = 0.01 * solid.stiffness(1.0)
    full = repulsive.solve(wave, 2 * np.pi, 1.001 * closing, solid=solid)
    assert full.area_fraction == 1
    expected = 1.001 * closing + closing * np.cos(x)
    np.testing.assert_allclose(full.pressure[:, 0], expected, rtol=1e-9, atol=1e-12)
    assert repulsive.solve(wave, 2 * np.pi, 0.98 * closing, solid=solid).area_fraction < 1


def test_a_thin_compressible_layer_is_a_bed_of_springs(heights):
    """Winkler: the pressure is the overlap over the compliance of long waves."""
    solid = Layer(1e-3, 0.3)
    spring = solid.compliance(1e-4)
    pressure = 0.3 * heights.std() / spring
    contact = repulsive.solve(heights, LENGTH, pressure, solid=solid)
    level = (heights - spring * contact.pressure)[contact.pressure > 0]
    # every point in contact has sunk to one level, all others lie below it
    assert np.ptp(level) < 1e-3 * heights.std()
    assert heights[contact.pressure == 0].max() < level.max() + 1e-3 * heights.std()


def test_where_active_sets_cycle_projected_gradients_go_on(heights):
    solid = Layer(0.01, 0.5)
    pressure = 0.3 * flattening_pressure(heights, solid)
    contact = repulsive.solve(heights, LENGTH, pressure, solid=solid)
    assert contact.residual <= 1e-8
    assert contact.iterations > 60
    with pytest.raises(repulsive.ConvergenceError) as failure:
        repulsive.solve(heights, LENGTH, pressure, solid=solid, max_iterations=2)
    assert failure.value.contact.iterations <= 2


def press_paraboloid(radius, solid):
    """Load and approach, over E*/R, that press a paraboloid into a contact of a given radius.

    Hankel's transform of the pressure as ``int f(t) cos(qt) dt`` over the radius leaves Fredholm's
    equation f(t) + (2/pi) int int (S - 1) cos(qs) cos(qt) dq f(s) ds = (approach - t^2)/pi; f
    vanishes at the edge (Lebedev and Ufliand's method).
    """
    x, w = np.polynomial.legendre.leggauss(60)
    t, dt = radius * (1 + x) / 2, radius * w / 2
    waves, dq = np.polynomial.legendre.leggauss(400)
    longest = 20 / solid.thickness  # S - 1 vanishes beyond
    q, dq = longest * (1 + waves) / 2, longest * dq / 2
    away = dq * (solid.factor(q) - 1)
    at_edge = 2 / np.pi * (np.cos(radius * q) * away) @ np.cos(np.outer(q, t)) * dt
    coupling = (
        np.eye(60) + 2 / np.pi * (np.cos(np.outer(t, q)) * away) @ np.cos(np.outer(q, t)) * dt
    )
    flat, curved = (np.linalg.solve(coupling, b) / np.pi for b in (np.ones(60), -(t**2)))
    # f at the edge by the equation itself, then the approach for which it vanishes
    edge_flat = 1 / np.pi - at_edge @ flat
    edge_curved = -(radius**2) / np.pi - at_edge @ curved
    approach = -edge_curved / edge_flat
    return 2 * np.pi * dt @ (approach * flat + curved), approach


@pytest.mark.slow
@pytest.mark.parametrize(
    ("poisson", "backing", "thickness"),
    [(0.5, "bonded", 0.5), (0.3, "bonded", 1.0), (0.5, "slip", 2.0)],
)
def test_a_paraboloid_on_a_layer(poisson, backing, thickness):
    n, side, radius = 512, 12.0, 1.5
    solid = Layer(thickness, poisson, backing)
    assert press_paraboloid(1.0, Layer(1e3, 0.3)) == pytest.approx((4 / 3, 1.0), rel=2e-3)  # Hertz
    load, approach = press_paraboloid(radius, solid)
    x = (np.arange(n) - n / 2) * (side / n)
    heights = -(x[:, None] ** 2 + x[None, :] ** 2) / 2
    contact = repulsive.solve(heights, side, load / side**2, tol=1e-6, solid=solid)
    found = np.sqrt(contact.area_fraction * side**2 / np.pi)
    assert found == pytest.approx(radius, rel=5e-3)
    # Displacements are counted from their mean: the mean gap is the rigid displacement of files.
    assert contact.mean_gap == pytest.approx(contact.shift - heights.mean(), rel=1e-5)
    # and by that of the backing: a layer that cannot slip hands nothing to its neighbours
    if backing == "bonded":
        moved = solid.mean_compliance * contact.mean_pressure - contact.shift
        assert moved == pytest.approx(approach, rel=1e-2)
