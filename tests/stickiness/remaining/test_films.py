"""Layers on a film: what remains on them is what remains on a layer, but for the bending."""

import numpy as np
import pytest

from stickiness.remaining import Roughness, errors
from stickiness.solids import Film, Layer
from stickiness.spectrum import SelfAffine, SpectrumFamily

Q0 = np.array([1.0])
FAMILY = SpectrumFamily.of(SelfAffine(hurst=0.8, q0=1.0, q1=32.0, h_rms=1.0))
LENGTHS = np.geomspace(0.03, 3.0, 9)


def rough_on(film_modulus):
    film = Film(modulus_ratio=film_modulus, poisson=0.35, thickness=0.4)
    return Roughness.of(FAMILY, Layer(0.3, 0.45, film), q0=Q0)


def test_a_film_that_does_not_bend_is_a_rigid_base():
    on_base = Roughness.of(FAMILY, Layer(0.3, 0.45), q0=Q0)
    on_film = rough_on(1e12)
    error = errors.find_work_error(on_base, 0.0)
    assert errors.find_work_error(on_film, 0.0) == pytest.approx(error, abs=1e-6)
    found = on_film.limit_share(LENGTHS, 0.1)
    expected = on_base.limit_share(LENGTHS, 0.1)
    np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-9)


def test_a_film_that_bends_takes_energy_and_makes_the_prediction_less_certain():
    moduli = (3e4, 3e2, 3e1)
    energies = [rough_on(modulus).elastic_energy.item() for modulus in moduli]
    doubts = [errors.find_work_error(rough_on(modulus), 0.0).item() for modulus in moduli]
    assert energies == sorted(energies, reverse=True)
    assert doubts == sorted(doubts)
    # Points that are as close as the layer is thick move as on a rigid base.
    compliances = {rough_on(modulus).relative_compliance.item() for modulus in moduli}
    assert len(compliances) == 1


def test_the_modulus_of_the_layer_changes_what_bending_takes():
    softer = rough_on(3e2).at_modulus(0.1)
    # Beside a layer ten times as soft the film is ten times as stiff.
    expected = errors.find_work_error(rough_on(3e3), 0.0)
    assert errors.find_work_error(softer, 0.0) == pytest.approx(expected)
