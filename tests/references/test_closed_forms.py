"""Closed forms against quadrature, published numbers and each other."""

import numpy as np
import pytest
from references.adhesion import AdhesiveWave, DMTSphere, JKRSphere, MaugisSphere, MaugisWave
from references.contact import Hertz

from stickiness.remaining import sphere

R, W = 2.0, 3e-5  # any radius and adhesion length; the model is scaled by R^2 W only
AMPLITUDE, WAVELENGTH = 0.02, 1.5


def test_jkr_published_numbers():
    # Johnson, Kendall & Roberts (1971): -3/2 pi R w at 0.63 of the radius at no load, which is
    # (6 pi R^2 w/K)^(1/3)
    jkr = JKRSphere(R, W)
    at_rest = (6 * np.pi * R**2 * W * 0.75) ** (1 / 3)
    assert jkr.contact_radius(0.0) == pytest.approx(at_rest, rel=1e-12)
    assert jkr.pull_off_radius / at_rest == pytest.approx(0.63, abs=0.005)
    assert jkr.force(jkr.pull_off_radius) == pytest.approx(-1.5 * np.pi * R * W, rel=1e-12)
    weak = JKRSphere(R, 1e-14)
    assert weak.contact_radius(0.01) == pytest.approx(Hertz(R, 0.01).contact_radius, rel=1e-5)


def maugis(parameter):
    """Sphere of a given Maugis parameter."""
    tabor = parameter / sphere.maugis_parameter(1.0, 1.0, 1.0)
    return MaugisSphere(R, W, np.cbrt(R * W**2) / tabor)


@pytest.mark.parametrize("parameter", [0.05, 0.1, 0.3, 0.5, 1.0, 2.0, 5.0])
def test_maugis_pull_off_published_fit(parameter):
    # Carpick, Ogletree & Salmeron, J. Colloid Interface Sci. 211, 395 (1999),
    # doi:10.1006/jcis.1998.6027; the fit is within 1.7 % of the solution, worst at 0.25
    x = 4.04 * parameter**1.4
    fitted = -7 / 4 + (x - 1) / (x + 1) / 4
    force = maugis(parameter).pull_off.force / (np.pi * R * W)
    assert force == pytest.approx(fitted, rel=0.018)
    assert -2 <= force <= -1.5


@pytest.mark.parametrize("force", [-1.4, 0.0, 1e3])
def test_maugis_tends_to_dmt_and_jkr(force):
    force *= np.pi * R * W
    stiff, soft = maugis(1e-6), maugis(1e3)
    dmt, jkr = DMTSphere(R, W), JKRSphere(R, W)
    # the corrections are of the order of sqrt(lambda) and of 1/lambda
    state = stiff.at_force(force)
    assert state.contact_radius == pytest.approx(dmt.contact_radius(force), rel=5e-3)
    assert state.indentation == pytest.approx(dmt.indentation(force), rel=5e-3)
    state = soft.at_force(force)
    assert state.contact_radius == pytest.approx(jkr.contact_radius(force), rel=1e-4)
    radius = jkr.contact_radius(force)
    assert state.indentation == pytest.approx(jkr.indentation(radius), rel=1e-3)
    assert soft.pull_off.force == pytest.approx(jkr.pull_off_force, rel=1e-5)
    assert stiff.pull_off.force == pytest.approx(dmt.pull_off_force, rel=1e-3)


def wave_of(alpha):
    stress = np.pi * AMPLITUDE / WAVELENGTH
    return AdhesiveWave(AMPLITUDE, WAVELENGTH, alpha**2 * stress**2 * WAVELENGTH / 2)


def test_wave_published_numbers():
    # Johnson (1995): at alpha = 0.57 and above an unloaded contact spreads everywhere
    assert pytest.approx(0.57, abs=5e-4) == AdhesiveWave.CRITICAL_ALPHA
    wave = wave_of(AdhesiveWave.CRITICAL_ALPHA)
    _, (fraction, pressure) = wave.turning_points
    assert pressure == pytest.approx(0, abs=1e-12 * wave.full_contact_amplitude)
    assert fraction == pytest.approx(2 / 3)


@pytest.mark.slow
def test_maugis_wave_tends_to_johnson():
    johnson = AdhesiveWave(AMPLITUDE, WAVELENGTH, 5e-5)
    load = 0.2 * johnson.full_contact_amplitude
    limit = johnson.area_fraction(load)
    errors = []
    for range_ in (4e-4, 2e-4, 1e-4):
        states, stable = MaugisWave(AMPLITUDE, WAVELENGTH, 5e-5, range_).equilibria(load)
        errors.append(limit - states[stable.index(True)].area_fraction)
    # a smooth expansion in 1/strength, i.e. the range: the error halves or better
    assert np.all(np.divide(errors[:-1], errors[1:]) > 1.9)
    assert abs(errors[-1]) < 1e-3
