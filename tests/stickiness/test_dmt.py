"""Areas and attraction over gaps, weak limit, against closed forms and finer grids; fit of a_V."""

import numpy as np
import pytest
from references.contact import Hertz

from stickiness import adhesive, dmt, repulsive, spectrum, surface
from stickiness.criteria import equivalent_sphere

LAWS = (adhesive.Maugis, adhesive.Exponential, adhesive.LennardJones)


HERTZ = Hertz(1.0, 4 / 3)  # of unit radius a = R = 1


def _hertz_gap(n, side=8.0):
    """Gap outside a Hertzian contact on an n x n grid."""
    x = (np.arange(n) + 0.5) / n * side - side / 2
    return HERTZ.gap(np.hypot(*np.meshgrid(x, x, indexing="ij")))


def test_attractive_area_definition():
    gap = np.array([[0.0, 0.0], [0.1, 0.4]])
    assert dmt.attractive_area(gap, 0.05) == 0.0
    assert dmt.attractive_area(gap, 0.1) == 0.25
    np.testing.assert_array_equal(dmt.attractive_area(gap, [0.1, 0.4, 9.0]), [0.25, 0.5, 0.5])
    # A mask decides what contact is, down to gaps of rounding size of either sign.
    contact = np.array([[True, False], [False, False]])
    gap[0] = -1e-12, 1e-12
    assert dmt.attractive_area(gap, 0.1, contact) == 0.5


@pytest.mark.parametrize("kind", LAWS)
def test_attraction_of_hertz_gap_against_radial_integral(kind):
    n, side = 1024, 8.0
    law = kind(adhesion_length=0.02, range=0.4)
    gap = _hertz_gap(n, side)
    x = (np.arange(n) + 0.5) / n * side - side / 2
    near = np.hypot(*np.meshgrid(x, x, indexing="ij")) < side / 2
    ranges = np.union1d(np.geomspace(1e-6, 1.0, 385) * gap.max(), [law.range])
    gap = np.where(near, gap, 0.0)
    area = dmt.attractive_area(gap, ranges)
    attraction = dmt.sum_over_gaps(area, ranges, law.traction)
    # The midpoint of many thin rings: immune to the jump of the Maugis law but for one ring.
    r = 1 + (np.arange(200000) + 0.5) * (side / 2 - 1) / 200000
    ring = 2 * np.pi * r * (side / 2 - 1) / 200000
    exact = np.sum(law.traction(HERTZ.gap(r)) * ring) / side**2
    # Pixels on the circles at contact edge and range: see the area test; 0.3 % of this area.
    assert attraction == pytest.approx(exact, rel=3e-3)
    assert dmt.adhesive_pressure(gap, law) == pytest.approx(exact, rel=3e-3)
    # The potential counts the near gaps most; contact points are left out.
    exact = np.sum(law.potential(HERTZ.gap(r)) * ring) / side**2
    potential = dmt.sum_over_gaps(area, ranges, law.potential)
    assert potential == pytest.approx(exact, rel=3e-3)


@pytest.mark.slow
def test_local_exponent_of_edge_gaps_is_two_thirds():
    # Strips beside straight edges, u = x^(3/2): the attractive area is exactly eps^(2/3).
    eps = np.geomspace(1e-3, 1e-1, 12)
    np.testing.assert_allclose(dmt.local_exponent(eps, eps ** (2 / 3)), 2 / 3, rtol=1e-12)
    # Beside a Hertzian edge too, once the gap is small: relative corrections are of order of
    # the strip's width over the radius, here (9 pi eps/(8 sqrt(2)))^(2/3) < 2 %.
    gap = _hertz_gap(2048, side=2.5)
    eps = np.geomspace(2e-4, 1e-3, 5)
    np.testing.assert_allclose(
        dmt.local_exponent(eps, dmt.attractive_area(gap, eps)), 2 / 3, rtol=0.04
    )


@pytest.mark.parametrize("range_", [0.003, 0.1, 3.0])
def test_weak_limit_of_a_sphere_is_what_reciprocity_gives(range_):
    """Hertzian contacts of a sphere of radius 1 at three approaches, and a constant traction."""
    law = adhesive.Maugis(adhesion_length=1.0, range=range_)

    def contact(approach):
        radius = np.sqrt(approach)
        ends = np.geomspace(1e-7, 30, 200_001)
        r, width = 1 + (ends[1:] + ends[:-1]) / 2, np.diff(ends)
        gap = approach * HERTZ.gap(r)
        within = np.pi * radius**2
        open_gaps = np.sum(law.potential(gap) * 2 * np.pi * r * width) * radius**2
        attractive = np.sum((gap <= range_) * 2 * np.pi * r * width) * radius**2
        return 4 / 3 * radius**3, 7 - approach, open_gaps - within, attractive / within

    states = [contact(approach) for approach in (0.99, 1.0, 1.01)]
    *given, (_, t, _) = np.transpose(states)
    found = dmt.weak_attraction(*given)[1] / (law.maugis_stress * np.pi * t)
    assert found == pytest.approx(equivalent_sphere.weak_effect_at_approach(t), rel=3e-4)


@pytest.mark.parametrize("range_", [0.1, 0.3])
@pytest.mark.parametrize(("kind", "error"), [(adhesive.Exponential, 1e-4), (adhesive.Maugis, 3e-3)])
def test_weak_adhesion_tends_to_its_limit_and_not_to_the_sum(kind, error, range_):
    """Full solutions at the same mean gap and at the same load; Maugis' traction counts pixels."""
    law = kind(adhesion_length=1e-5 * range_, range=range_)
    band, side = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=8.0, h_rms=1.0), 2 * np.pi
    heights = surface.synthesise(band, 64, side, seed=3)
    loads = 0.1 * np.exp([-3e-4, 0, 3e-4])
    path = list(repulsive.load_path(heights, side, loads, tol=1e-11))
    gaps, potential = np.transpose([(c.mean_gap, law.potential(c.gap).mean()) for c in path])
    limit, alone = dmt.weak_attraction(loads, gaps, potential)[1], path[1]

    held = adhesive.solve(heights, side, law, mean_gap=gaps[1], start=alone.gap, tol=1e-11)
    assert loads[1] - held.mean_pressure == pytest.approx(limit, rel=error)
    assert limit < 0.75 * dmt.adhesive_pressure(alone.gap, law)
    pressed = adhesive.solve(heights, side, law, loads[1], start=alone.gap, tol=1e-11)
    slope = (potential[2] - potential[0]) / (loads[2] - loads[0])
    assert pressed.mean_gap - gaps[1] == pytest.approx(slope, rel=error)


def test_weak_limit_of_a_power_of_the_gap_is_exact_between_any_loads():
    loads = np.array([0.01, 0.05, 0.2, 0.9])
    gaps = np.stack([2 - np.log(loads), 3 - 2 * np.log(loads)])
    found = dmt.weak_attraction(loads, gaps, -0.3 * loads**0.7)
    # d potential/d ln(load) over d gap/d ln(load)
    np.testing.assert_allclose(found, 0.21 * loads**0.7 / [[1], [2]], rtol=1e-12)


def test_boundary_strip_of_a_disc_and_a_square():
    n, r = 400, 100
    x = np.arange(n) - n / 2 + 0.5
    disc = np.hypot(*np.meshgrid(x, x, indexing="ij")) < r
    # The staircase around a convex shape is as long as its bounding box: 8 r sides.
    assert dmt.boundary_strip(disc) == pytest.approx(dmt.STRIP_WIDTH * 8 * r / n**2, rel=1e-12)
    assert dmt.boundary_strip(np.ones((8, 8), bool)) == 0.0
    square = np.zeros((8, 8), bool)
    square[:3, :3] = True
    # Periodic neighbours count once: 12 sides.
    assert dmt.boundary_strip(square) == pytest.approx(dmt.STRIP_WIDTH * 12 / 64, rel=1e-12)


# --- fit of a_V ----------------------------------------------------------------------------

EPS = np.geomspace(1e-3, 1.0, 31)


def test_fit_recovers_an_exact_law_in_any_units():
    h_rms, q0, a_v, pressure = 2e-6, 3e4, 2.7, 0.065 * 2e-6 * 3e4
    area = 1.5 * a_v * 0.065 * EPS ** (2 / 3)
    fit = dmt.fit_a_v(EPS * h_rms, area, pressure, h_rms, q0)
    assert fit.value == pytest.approx(a_v, rel=1e-12)
    assert fit.standard_error < 1e-10
    assert fit.window == (0.01, 0.1)


def test_fit_pools_several_loads():
    eps = np.tile(EPS, 2)
    pressure = np.repeat([0.01, 0.05], EPS.size)
    area = 1.5 * 3.0 * pressure * eps ** (2 / 3)
    assert dmt.fit_a_v(eps, area, pressure).value == pytest.approx(3.0, rel=1e-12)


def test_standard_error_matches_the_scatter_of_fits():
    rng = np.random.default_rng(1)
    truth = 1.5 * 3.0 * 0.065 * EPS ** (2 / 3)
    fits = [
        dmt.fit_a_v(EPS, truth + 1e-3 * rng.standard_normal(EPS.size), 0.065) for _ in range(2000)
    ]
    values = np.array([fit.value for fit in fits])
    errors = np.array([fit.standard_error for fit in fits])
    # 2000 fits know their scatter to 1.6 %, their mean to scatter/45: three deviations each.
    assert values.std() == pytest.approx(np.sqrt(np.mean(errors**2)), rel=0.05)
    assert values.mean() == pytest.approx(3.0, abs=3 * values.std() / np.sqrt(2000))
