"""Traction laws: integrals, derivatives, strengths."""

import itertools

import numpy as np
import pytest
from scipy.integrate import quad

from stickiness import adhesive, traction_laws

LAWS = (adhesive.Maugis, adhesive.Exponential, adhesive.LennardJones, adhesive.VanDerWaals)
LENGTH, RANGE = 0.3, 0.7


@pytest.fixture(params=LAWS)
def law(request):
    return request.param(adhesion_length=LENGTH, range=RANGE)


@pytest.mark.parametrize("u", [0.0, 0.05, 0.3, 0.69, 0.8, 3.0])
def test_potential_is_minus_the_integral_of_the_traction_beyond(law, u):
    stops = [u, max(u, RANGE), np.inf]  # split at the range, where the Maugis law jumps
    total = sum(
        quad(lambda x: float(law.traction(x)), a, b, epsrel=1e-11)[0]
        for a, b in itertools.pairwise(stops)
    )
    # Absolute: beyond the range the Maugis integral is a rounding of the jump's end point.
    assert law.potential(u) == pytest.approx(-total, rel=1e-8, abs=1e-12)
    if u == 0:
        assert total == pytest.approx(LENGTH, rel=1e-9)


def test_derivative_and_strength(law):
    u, step = np.array([0.01, 0.1, 0.3, 0.5, 1.0, 2.0]), 1e-5
    # Truncation error step^2 f'''/6 is below 1e-7 of the largest derivative for RANGE = 0.7.
    numeric = (law.traction(u + step) - law.traction(u - step)) / (2 * step)
    np.testing.assert_allclose(law.derivative(u), numeric, atol=1e-7 * 16 * LENGTH / RANGE**2)
    largest = law.traction(np.linspace(0, 3, 30001)).max()
    assert largest == pytest.approx(law.strength, rel=1e-7)
    assert largest <= law.strength * (1 + 1e-14)


def test_lennard_jones_strength_and_maugis_stress():
    law = adhesive.LennardJones(LENGTH, RANGE)
    assert law.traction(law.strength_gap) == pytest.approx(law.strength, rel=1e-14)
    assert law.strength_gap + RANGE == pytest.approx(3 ** (1 / 6) * RANGE, rel=1e-14)
    assert law.derivative(law.strength_gap) == pytest.approx(0, abs=1e-13)
    assert law.maugis_stress == pytest.approx(9 * np.sqrt(3) / 16 * law.strength, rel=1e-14)
    assert law.traction(0.0) == 0
    assert law.traction(-0.1) < 0
    with pytest.raises(ValueError, match="gap must exceed"):
        law.traction([0.0, -RANGE])


def test_van_der_waals_is_that_of_a_hamaker_constant():
    work, cut_off, modulus = 0.05, 0.165e-9, 1e9  # J/m^2, m, Pa
    hamaker = 12 * np.pi * cut_off**2 * work
    law = adhesive.VanDerWaals(work / modulus, cut_off)
    separations = np.array([0.165e-9, 1e-9, 10e-9])
    expected = hamaker / (6 * np.pi * separations**3)
    assert modulus * law.traction(separations - cut_off) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("name", traction_laws.PREDICTED)
def test_strength_by_name_and_range_of_the_maugis_law_alike(name):
    law = traction_laws.LAWS[name](LENGTH, RANGE)
    strength = traction_laws.find_strength([[name, "exponential"]])
    assert strength * LENGTH / RANGE == pytest.approx(np.array([[law.strength, LENGTH / RANGE]]))
    alike = adhesive.Maugis(LENGTH, law.maugis_range)
    assert alike.strength == pytest.approx(law.strength, rel=1e-14)


def test_maugis_includes_its_range():
    law = adhesive.Maugis(LENGTH, RANGE)
    assert law.traction(RANGE) == LENGTH / RANGE
    assert law.traction(np.nextafter(RANGE, 1)) == 0


@pytest.mark.parametrize("kind", LAWS)
@pytest.mark.parametrize("bad", [0.0, np.nan, "1"])
def test_laws_reject_bad_parameters(kind, bad):
    with pytest.raises(ValueError, match="adhesion_length must be (positive|a number)"):
        kind(adhesion_length=bad, range=1.0)
    with pytest.raises(ValueError, match="range must be (positive|a number)"):
        kind(adhesion_length=1.0, range=bad)
