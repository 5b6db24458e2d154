"""Traction laws: integrals, derivatives, strengths."""

import numpy as np
import pytest
from scipy.integrate import quad

from stickiness import adhesive

LAWS = (adhesive.Maugis, adhesive.Exponential, adhesive.LennardJones)
LENGTH, RANGE = 0.3, 0.7


def _law(kind):
    return kind(adhesion_length=LENGTH, range=RANGE)


@pytest.mark.parametrize("kind", LAWS)
def test_traction_integrates_to_adhesion_length(kind):
    law = _law(kind)
    # Split at the range: the Maugis law jumps there.
    near = quad(lambda u: float(law.traction(u)), 0, RANGE, epsrel=1e-11)[0]
    far = quad(lambda u: float(law.traction(u)), RANGE * (1 + 1e-14), np.inf, epsrel=1e-11)[0]
    assert near + far == pytest.approx(LENGTH, rel=1e-9)


@pytest.mark.parametrize("kind", LAWS)
@pytest.mark.parametrize("u", [0.05, 0.3, 0.69, 0.8, 3.0])
def test_potential_is_minus_the_integral_of_the_traction_beyond(kind, u):
    law = _law(kind)
    stops = sorted({u, max(u, RANGE)})
    parts = [
        quad(lambda x: float(law.traction(x)), a, b, epsrel=1e-11)[0]
        for a, b in zip(stops, [*stops[1:], np.inf], strict=True)
    ]
    # Absolute: beyond the range the Maugis integral is a rounding of the jump's end point.
    assert law.potential(u) == pytest.approx(-sum(parts), rel=1e-8, abs=1e-12)


@pytest.mark.parametrize("kind", LAWS)
def test_derivative_by_central_differences(kind):
    law = _law(kind)
    u = np.array([0.01, 0.1, 0.3, 0.5, 1.0, 2.0])
    step = 1e-5
    # Truncation error step^2 f'''/6 is below 1e-7 of the largest derivative for RANGE = 0.7.
    numeric = (law.traction(u + step) - law.traction(u - step)) / (2 * step)
    scale = 16 * LENGTH / RANGE**2
    np.testing.assert_allclose(law.derivative(u), numeric, atol=1e-7 * scale)


@pytest.mark.parametrize("kind", LAWS)
def test_strength_is_the_largest_traction(kind):
    law = _law(kind)
    u = np.linspace(0, 3, 30001)
    assert law.traction(u).max() == pytest.approx(law.strength, rel=1e-7)
    assert law.traction(u).max() <= law.strength * (1 + 1e-14)


def test_lennard_jones_strength_and_maugis_stress():
    law = _law(adhesive.LennardJones)
    assert law.traction(law.strength_gap) == pytest.approx(law.strength, rel=1e-14)
    assert law.strength_gap + RANGE == pytest.approx(3 ** (1 / 6) * RANGE, rel=1e-14)
    assert law.derivative(law.strength_gap) == pytest.approx(0, abs=1e-13)
    assert law.maugis_stress == pytest.approx(9 * np.sqrt(3) / 16 * law.strength, rel=1e-14)
    assert law.traction(0.0) == 0
    assert law.traction(-0.1) < 0


def test_maugis_includes_its_range():
    law = _law(adhesive.Maugis)
    assert law.traction(RANGE) == LENGTH / RANGE
    assert law.traction(np.nextafter(RANGE, 1)) == 0


@pytest.mark.parametrize("kind", LAWS)
@pytest.mark.parametrize("bad", [0.0, np.nan, "1"])
def test_laws_reject_bad_parameters(kind, bad):
    with pytest.raises(ValueError, match="adhesion_length must be (positive|a number)"):
        kind(adhesion_length=bad, range=1.0)
    with pytest.raises(ValueError, match="range must be (positive|a number)"):
        kind(adhesion_length=1.0, range=bad)


def test_lennard_jones_rejects_gaps_beyond_the_wall():
    with pytest.raises(ValueError, match="gap must exceed"):
        _law(adhesive.LennardJones).traction([0.0, -RANGE])
