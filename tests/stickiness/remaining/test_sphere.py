"""Pull-off of a sphere from a rough surface: JKR and DMT, roughness, limits."""

import numpy as np
import pytest
from references.adhesion import MaugisSphere

from stickiness.remaining import Roughness, sphere

RADIUS, LENGTH = 1.0, 1e-6
TOUGH, WEAK = 1e-8, 10.0  # ranges; Tabor's parameters (l_a^2/range^3)^(1/3) of 1e4 and 1e-5


def rough(h_rms, q0=1e4):
    """A surface whose energy of full contact is that of H = 0.8 in the end, 2/3 q0 h_rms^2."""
    h_rms = np.asarray(h_rms, dtype=float)
    return Roughness(h_rms=h_rms, q0=q0, elastic_energy=2 / 3 * q0 * h_rms**2)


def draw(count, seed=3):
    """Surfaces, radii, adhesion lengths and ranges from full contact to none."""
    random = np.random.default_rng(seed)
    h = 10 ** random.uniform(-4, 0, count)
    surface = Roughness(h_rms=h, q0=1.0, elastic_energy=0.6 * h**2)
    length = surface.elastic_energy * 10 ** random.uniform(-2, 4, count)
    reach = h * 10 ** random.uniform(-4, 2, count)
    return surface, 10 ** random.uniform(0, 5, count), length, reach


# Nothing pins the edge on a smooth surface.
@pytest.mark.parametrize("sign", [-1, 0, 1])
@pytest.mark.parametrize(("reach", "factor"), [(TOUGH, 1.5), (WEAK, 2.0)])
def test_a_smooth_surface_is_jkr_or_dmt(reach, factor, sign):
    work = 1
    found = sphere.pull_off(rough(1e-14).deviating(sign), RADIUS, LENGTH, reach)
    assert found.force == pytest.approx(work * factor * np.pi * RADIUS * LENGTH, rel=0.002)
    assert found.relative == pytest.approx(work, abs=2e-3)
    assert found.work == pytest.approx(work, abs=1e-6)


def test_smooth_spheres_are_those_of_maugis():
    random = np.random.default_rng(5)
    smooth = Roughness(h_rms=1e-12, q0=1e-3, elastic_energy=1e-27)
    for radius, length, reach in 10 ** random.uniform(-2, 2, (25, 3)):
        found = sphere.pull_off(smooth, radius, length, reach)
        expected = -MaugisSphere(radius, length, reach).pull_off.force
        assert found.force == pytest.approx(expected, rel=0.002)


@pytest.mark.parametrize("sign", [-1, 0, 1])
def test_a_rough_sphere_is_that_of_maugis_with_what_remains_and_its_distance(sign):
    surface, radius, length, reach = draw(300)
    at_limit = surface.deviating(sign)
    found = sphere.pull_off(at_limit, radius, length, reach)
    # Whatever the limit, zone and distance are those of the value.
    distance = surface.distance(length, reach)
    held = surface.share(length, reach) * length
    contact, derjaguin = np.cbrt(9 * np.pi / 8 * held * radius**2), np.sqrt(2 * radius * distance)
    np.testing.assert_allclose(found.zone_radius, np.maximum(contact, derjaguin), rtol=1e-9)
    assert min(np.sum(contact > derjaguin), np.sum(contact < derjaguin)) > 50
    held = at_limit.share(length, reach) * length
    checked = np.flatnonzero(held > 0.05 * length)[:40]
    factors = []
    for i in checked:
        expected = -MaugisSphere(radius[i], held[i], distance[i]).pull_off.force
        assert found.force[i] == pytest.approx(expected, rel=0.003)
        factors.append(found.force[i] / (np.pi * radius[i] * held[i]))
    assert len(checked) == 40
    assert min(factors) < 1.6
    assert max(factors) > 1.9


def test_errors_of_share_radius_and_place_add_in_quadrature():
    surface, radius, length, reach = draw(300)
    curvature = 0.3 / radius.max()

    def find_change(**errors):
        pull_offs = [
            sphere.pull_off(surface.deviating(eta), radius, length, reach, **errors)
            for eta in (0, 1)
        ]
        return np.log(pull_offs[1].force / pull_offs[0].force)

    parts = [find_change(), find_change(curvature=curvature), find_change(error=0.5)]
    of_share, with_radius, with_place = np.square(parts)
    both = find_change(error=0.5, curvature=curvature)
    np.testing.assert_allclose(both**2, with_radius + with_place - of_share, atol=1e-9)
    value = sphere.pull_off(surface, radius, length, reach)
    lost = np.maximum(-np.log(value.relative), 0)
    np.testing.assert_allclose(with_place - of_share, 0.25 * lost, atol=1e-9)


def test_limits_hold_the_value():
    surface, *at = draw(2000)
    low, value, high = (
        sphere.pull_off(surface.deviating(eta), *at, error=0.5) for eta in (-1, 0, 1)
    )
    for name in ("work", "force", "relative"):
        found = [getattr(pull_off, name) for pull_off in (low, value, high)]
        assert np.all(found[0] <= found[1] * (1 + 1e-12)), name
        assert np.all(found[1] <= found[2] * (1 + 1e-12)), name
        assert np.mean(found[0] < found[2]) > 0.9


@pytest.mark.parametrize("name", ["radius", "adhesion_length", "range"])
@pytest.mark.parametrize("bad", [0.0, -1.0, np.nan, np.inf, "1"])
def test_bad_arguments_are_named(name, bad):
    given = {"radius": RADIUS, "adhesion_length": LENGTH, "range": TOUGH} | {name: bad}
    with pytest.raises(ValueError, match=f"^{name} must be"):
        sphere.pull_off(rough(1e-6), **given)
