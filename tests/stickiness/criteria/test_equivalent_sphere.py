"""Attraction at the edges of a contact against closed forms and against full simulation."""

import numpy as np
import pytest
from references.adhesion import JKRSphere, MaugisSphere, MaugisWave
from references.contact import Hertz, Westergaard
from scipy.optimize import brentq

from stickiness.criteria import equivalent_sphere

pytestmark = pytest.mark.processors

RADIUS = 1.0


def sphere_effect(contact_radius, attractive_over_contact, strength):
    """R and tau from Maugis' curve of the sphere, which knows nothing of the module."""
    a, t = contact_radius, attractive_over_contact
    force = 4 * a**3 / (3 * RADIUS)
    reach = float(Hertz(RADIUS, force).gap(a * np.sqrt(1 + t)))
    maugis = MaugisSphere(RADIUS, strength * reach, reach)
    lost = force - maugis.at_contact_radius(a).force
    return lost / (strength * np.pi * a**2 * t)


@pytest.mark.parametrize("t", [1e-4, 0.03, 0.5, 4.0, 80.0])
@pytest.mark.parametrize("tau", [1e-4, 0.2, 3.0, 1e3])
def test_effect_is_that_of_maugis_sphere(t, tau):
    a = 0.1
    # tau = sigma_0 d/range with range/d = (8/3pi) sqrt(t) a/R, the small zone's, at any t
    strength = tau * 8 / (3 * np.pi) * np.sqrt(t) * a / RADIUS
    # a difference of forces, of which weak attraction leaves few digits
    lost_digits = 1e-12 / (strength * t / a)
    assert equivalent_sphere.effect(t, tau) == pytest.approx(
        sphere_effect(a, t, strength), rel=1e-8 + lost_digits
    )


@pytest.mark.parametrize("t", [1e-6, 1e-2, 1.0, 100.0])
def test_limits_of_the_effect(t):
    assert equivalent_sphere.effect(t, 1e-9) == pytest.approx(
        equivalent_sphere.weak_effect(t), rel=1e-8
    )
    # weakest: DMT's at long range, the edge law at short range
    assert equivalent_sphere.weak_effect(1e8) == pytest.approx(1, abs=1e-3)
    assert equivalent_sphere.weak_effect(1e-10) * 1e-5 == pytest.approx(4 / np.pi, rel=1e-4)


@pytest.mark.parametrize("t", [0.01, 0.3, 1.0, 30.0])
def test_weak_effect_at_equal_approach_is_that_of_maugis_sphere(t):
    """Maugis' curve at the approach that Hertz has for the radius a, next to no adhesion."""
    a, strength = 0.1, 1e-7
    force = 4 * a**3 / (3 * RADIUS)
    reach = float(Hertz(RADIUS, force).gap(a * np.sqrt(1 + t)))
    maugis = MaugisSphere(RADIUS, strength * reach, reach)
    held = brentq(
        lambda x: maugis.at_contact_radius(x).indentation - a**2 / RADIUS, a, 1.01 * a, xtol=1e-15
    )
    found = (force - maugis.at_contact_radius(held).force) / (strength * np.pi * a**2 * t)
    assert held > a
    assert found == pytest.approx(equivalent_sphere.weak_effect_at_approach(t), rel=2e-4)
    assert found < 1 < equivalent_sphere.weak_effect(t)


@pytest.mark.parametrize("t", [1e-6, 1e-3, 1.0, 30.0])
def test_tough_effect_is_that_of_jkr(t):
    a, tau = 0.1, 1e6
    strength = tau * 8 / (3 * np.pi) * np.sqrt(t) * a / RADIUS
    force = 4 * a**3 / (3 * RADIUS)
    work = strength * float(Hertz(RADIUS, force).gap(a * np.sqrt(1 + t)))
    lost = force - JKRSphere(RADIUS, work).force(a)
    for found in (equivalent_sphere.effect(t, tau), equivalent_sphere.tough_effect(t, tau)):
        assert found * strength * np.pi * a**2 * t == pytest.approx(lost, rel=2e-3)


def test_where_edges_are_tough():
    # The advance is sqrt(y) of the weak one, hence sqrt(1 - y^(3/2)) of the tough one, with
    # y^(3/2) + (4/pi) tau y = 1 of small zones.
    y = (1 - 0.9**2) ** (2 / 3)
    least = np.pi / 4 * (1 - y**1.5) / y  # 1.93
    found = equivalent_sphere.effect(1e-4, least) / equivalent_sphere.tough_effect(1e-4, least)
    assert found == pytest.approx(1 - equivalent_sphere.TOUGH_WITHIN, rel=1e-3)
    assert abs(least / equivalent_sphere.TOUGH - 1) < 0.05
    tau = np.geomspace(equivalent_sphere.TOUGH, 1e5, 30)
    assert np.all(equivalent_sphere.tough(np.geomspace(1e-4, 1, 9)[:, None], tau))
    # Wide zones are strong before they are tough; at small strength the effect crosses the limit.
    wide = equivalent_sphere.tough(10.0, [0.03, 0.1, 0.3, 1.0, 4.0, 11.0, 15.0])
    np.testing.assert_array_equal(wide, [False] * 6 + [True])


def strength_of_edge(t, traction, exponent, effect):
    """`edge_strength` where area grows as load^exponent and small zones have the given effect.

    What an advance delta takes off the load, delta ds/(dA/dF), makes the effect (16/3pi) tau over
    exponent times traction; `edge_strength` has exponent 1 and (4/pi) t^(-1/2) in it.
    """
    found = equivalent_sphere.edge_strength(t, traction)
    return found * exponent * effect / (4 / np.pi / np.sqrt(t))


@pytest.mark.parametrize("fraction", [0.05, 0.3, 0.6, 0.9])
def test_strength_from_area_and_load_is_that_of_the_edge_of_a_wave(fraction):
    """The same where edges are straight and area goes as load^0.5 to load^2.2."""
    wave = Westergaard(1.0, 1.0, np.pi * np.sin(np.pi / 2 * fraction) ** 2)
    zone = 1e-5 * fraction
    reach, sigma = float(wave.gap(fraction / 2 + zone)), 1e-6
    law = MaugisWave(1.0, 1.0, sigma * reach, reach).at_cohesive_fraction(fraction + 2 * zone)
    # d ln(area)/d ln(load) of sin^2, both at the area that the adhesive wave has
    psi = np.pi / 2 * law.area_fraction
    load = np.pi * np.sin(psi) ** 2
    exponent = np.tan(psi) / (2 * psi)
    t = 2 * zone / fraction
    effect = (load - law.pressure) / (sigma * (law.cohesive_fraction - law.area_fraction))
    found = strength_of_edge(t, sigma * law.area_fraction / load, exponent, effect)
    assert found == pytest.approx(sigma * zone / reach, rel=2e-3)


def test_attraction_has_the_attractive_area_and_strength_of_its_load():
    """Contact area from kappa, attractive area from a_V, at any load: here by hand."""
    h, q0, slope, length, reach, a_v, load = 1e-6, 1e5, 0.5, 3e-10, 1e-9, 4.0, 0.01
    attractive = 1.5 * a_v * load * (reach / h) ** (2 / 3)  # load over E* q0 h_rms
    for kappa, given in ((2.0, {}), (2.3, {"kappa_rep": 2.3})):
        contact = kappa * load * q0 * h / slope
        found = equivalent_sphere.attraction(h, q0, slope, length, reach, a_v, **given)
        assert found.attractive_over_contact == pytest.approx(attractive / contact, rel=1e-12)
        strength = equivalent_sphere.edge_strength(
            attractive / contact, length / reach * contact / (load * q0 * h)
        )
        assert found.strength == pytest.approx(strength, rel=1e-12)
        dmt = length / reach * attractive / (load * q0 * h)
        expected = dmt * equivalent_sphere.effect(attractive / contact, strength)
        assert found.ratio == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("slope", [0.01, 3.0, 300.0])
def test_threshold_balances_attraction_and_repulsion(slope):
    known = {"h_rms": 1e-6, "q0": 1e5, "rms_slope": slope, "range": np.array([1e-11, 1e-9, 1e-6])}
    length = equivalent_sphere.adhesion_length_threshold(**known, a_v=3.0)
    found = equivalent_sphere.attraction(**known, adhesion_length=length, a_v=3.0)
    np.testing.assert_allclose(found.ratio, 1, rtol=1e-9)


def test_attraction_overtakes_repulsion_once():
    """The ratio, (4/3) tau t^(3/2) R, does not always grow with adhesion, but crosses 1 once."""
    t = np.geomspace(1e-6, 1e3, 40)[:, None]
    tau = np.geomspace(1e-7, 1e13, 400)
    sticky = 4 / 3 * tau * t**1.5 * equivalent_sphere.effect(t, tau) > 1
    np.testing.assert_array_equal(np.diff(sticky.astype(int), axis=1).sum(axis=1), 1)
    assert np.all(np.abs(np.diff(sticky.astype(int), axis=1)).sum(axis=1) == 1)


def test_error_grows_beyond_what_was_simulated():
    factors = equivalent_sphere.error_factor([1.0, 1.0, 1.0, 0.01], [0.1, 1.0, 100.0, 0.1])
    np.testing.assert_array_equal(factors, [1.3, 1.4, 2.0, 2.0])
    inside = equivalent_sphere.attraction(1.0, 1.0, 3.0, 1e-4, 0.1, 2.0)
    beyond = equivalent_sphere.attraction(1.0, 1.0, 3.0, 1e-4, 1e-6, 2.0)
    assert inside.simulated is True
    assert beyond.simulated is False
