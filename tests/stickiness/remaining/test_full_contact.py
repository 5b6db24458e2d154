"""Energy of full contact against closed forms, the spectrum and another code."""

import numpy as np
import pytest
from helpers.peers import import_peer
from helpers.rough import periodic

from stickiness import full_contact_energy
from stickiness.solids import HALF_SPACE, Film, Layer
from stickiness.spectrum import SelfAffine
from stickiness.surface import realised_spectrum, synthesise

pytestmark = pytest.mark.processors

ROUGH = SelfAffine(hurst=0.8, q0=1.0, q1=30.0, h_rms=0.01)


@pytest.mark.parametrize("shape", [(32, 32), (31, 40)])
def test_one_wave_costs_the_closed_form(shape):
    """E* q a^2/(8 S), S of a bonded layer as in doi:10.1016/j.jmps.2007.05.009."""
    sides, nu, amplitude = (1e-3, 2e-3), 0.4, 3e-6
    x, y = np.meshgrid(*(np.arange(n) / n for n in shape), indexing="ij")
    heights = amplitude * np.cos(2 * np.pi * (2 * x + 3 * y) + 0.3)
    q = 2 * np.pi * np.hypot(2 / sides[0], 3 / sides[1])
    k = 2e-4 * q
    above = (3 - 4 * nu) * np.sinh(2 * k) - 2 * k
    bonded = above / ((3 - 4 * nu) * np.cosh(2 * k) + 2 * k**2 + 5 - 12 * nu + 8 * nu**2)
    slipping = (np.cosh(2 * k) - 1) / (np.sinh(2 * k) + 2 * k)
    solids = (HALF_SPACE, 1.0), (Layer(2e-4, nu), bonded), (Layer(2e-4, nu, "slip"), slipping)
    for solid, factor in solids:
        energy = full_contact_energy(heights, 2e6, sides, solid, edges="given")
        assert energy == pytest.approx(2e6 * q * amplitude**2 / 8 / factor, rel=1e-10)


@pytest.mark.parametrize("solid", [HALF_SPACE, Layer(0.1, 0.3, Film(50.0, 0.4, 0.05))])
def test_periodic_heights_store_what_their_spectrum_does(solid):
    heights = synthesise(ROUGH, 96, 2 * np.pi, 4)
    of_spectrum = full_contact_energy(realised_spectrum(heights, 2 * np.pi), 3.0, solid=solid)
    of_heights = full_contact_energy(heights, 3.0, 2 * np.pi, solid, edges="given")
    assert of_heights == pytest.approx(of_spectrum, rel=1e-9)


def test_part_of_a_surface_stores_nearly_as_much():
    """As documented; a tilt of the specimen does not count."""
    rough = SelfAffine(hurst=0.8, q0=1.0, q1=128.0, h_rms=0.01, q_rolloff=16.0)
    heights = synthesise(rough, 512, 2 * np.pi, 5)
    whole = full_contact_energy(heights, 1.0, 2 * np.pi, edges="given")
    part = heights[:256, :256] + 0.1 * np.arange(256)[:, None]
    assert full_contact_energy(part, 1.0, np.pi) == pytest.approx(whole, rel=0.07)
    assert full_contact_energy(part, 1.0, np.pi, edges="given") > 3 * whole


def test_what_does_not_belong_is_refused():
    with pytest.raises(ValueError, match="a spectrum has none, got 1.0"):
        full_contact_energy(ROUGH, 1.0, 1.0)
    with pytest.raises(ValueError, match="length is of heights, which need it"):
        full_contact_energy(np.zeros((4, 4)), 1.0)


@pytest.mark.peers
@pytest.mark.parametrize("shape", [(64, 64), (48, 81)])
def test_same_energy_as_contact_mechanics(shape):
    """Of a half-space and of a bonded layer, which is all that it has."""
    peer, heights = import_peer("ContactMechanics"), 0.01 * periodic(shape, seed=1)
    for solid, options in (HALF_SPACE, {}), (Layer(0.2, 0.3), {"thickness": 0.2, "poisson": 0.3}):
        young = 1 - 0.3**2 if options else 1.0
        substrate = peer.PeriodicFFTElasticHalfSpace(shape, young, (1.0, 1.0), **options)
        stored = substrate.evaluate(heights - heights.mean(), pot=True, forces=True)[0]
        ours = full_contact_energy(heights, 1.0, (1.0, 1.0), solid, edges="given")
        assert ours == pytest.approx(float(stored), rel=1e-9)
