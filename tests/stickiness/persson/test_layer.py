"""Persson's theory of roughness on layers: limits, energy, simulation."""

import numpy as np
import pytest
from scipy.special import erf

from stickiness import persson, repulsive, surface
from stickiness.solids import HalfSpace, Layer
from stickiness.spectrum import SelfAffine, Shells

ROUGH = SelfAffine(hurst=0.8, q0=1.0, q1=64.0, h_rms=1.0)
SHELLS = Shells([1.0, 3.0, 9.0], [0.5, 0.1, 0.02])
LOADS = np.array([1e-3, 0.02, 0.2, 1.0])  # over the rms pressure of full contact
SOLIDS = [
    Layer(1e-3, 0.5),
    Layer(0.3, 0.5),
    Layer(1e-3, 0.3),
    Layer(1.0, 0.5, "slip"),
]


def loads(theory):
    return LOADS * np.sqrt(theory._setting.m2 / 2)


@pytest.mark.parametrize("correction", ["yang2008", "wang2017", "xu2024"])
def test_thick_layers_are_half_spaces(correction):
    half = persson.Persson(ROUGH, correction=correction)
    assert half.solid == HalfSpace()
    thick = persson.Persson(ROUGH, correction=correction, solid=Layer(1e3, 0.5))
    p = loads(half)
    np.testing.assert_allclose(thick.area_fraction(p), half.area_fraction(p), rtol=1e-12)
    np.testing.assert_allclose(thick.area_fraction(p, 8.0), half.area_fraction(p, 8.0), rtol=1e-12)
    # Almost all of the gap is decided next to q0, where pressures are small.
    p = np.append(p, [1e-12, 1e-8, 1e-6, 1e-4])
    np.testing.assert_allclose(thick.mean_gap(p), half.mean_gap(p), rtol=1e-9)


@pytest.mark.parametrize("rough", [ROUGH, SHELLS], ids=["continuous", "shells"])
@pytest.mark.parametrize("solid", SOLIDS, ids=str)
def test_mean_gap_over_pressure_is_the_energy_of_full_contact(solid, rough):
    theory = persson.Persson(rough, solid=solid)
    log_p = np.linspace(-30, np.log(30), 500)
    p = np.exp(log_p) * np.sqrt(theory._setting.m2)
    energy = np.trapezoid(theory.mean_gap(p) * p, log_p)
    assert energy == pytest.approx(rough.elastic_energy(solid), rel=1e-8)


@pytest.mark.parametrize("solid", SOLIDS, ids=str)
def test_area_by_the_variance_of_the_pressure(solid):
    """A = erf(p/sqrt(2 V)), V the variance of the pressure in full contact, if uncorrected."""
    theory = persson.Persson(SHELLS, gamma=1.0, solid=solid)
    variance = np.sum(SHELLS.variance * solid.stiffness(SHELLS.q) ** 2)
    p = LOADS * np.sqrt(variance)
    np.testing.assert_allclose(theory.area_fraction(p), erf(LOADS / np.sqrt(2)), rtol=1e-9)
    first = erf(p / np.sqrt(2 * 0.5 * solid.stiffness(1.0) ** 2))
    np.testing.assert_allclose(theory.area_fraction(p, 1.5), first, rtol=1e-9)


def test_the_distribution_of_gaps_is_refused():
    theory = persson.Persson(ROUGH, solid=Layer(0.3, 0.5))
    with pytest.raises(NotImplementedError, match="known for a half-space only"):
        theory.gap_density(0.1, 0.1)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("solid", "least"),
    [
        (Layer(3.0, 0.5), 0.95),
        (Layer(1.0, 0.5, "slip"), 0.88),
        (Layer(0.3, 0.3), 0.63),
        (Layer(0.5, 0.5), 0.48),
    ],
    ids=str,
)
def test_theory_meets_simulation(solid, least):
    """Theory over simulation, three surfaces, on the spectra that the windows hold."""
    length, rough = 8 * np.pi, SelfAffine(hurst=0.8, q0=1.0, q1=8.0, h_rms=1.0)
    theory = persson.Persson(surface.lattice_spectrum(rough, length), solid=solid)
    surfaces = [surface.synthesise(rough, n=128, length=length, seed=seed) for seed in range(3)]
    for load in (0.1, 0.3):
        p = load * np.sqrt(theory._setting.m2 / 2)
        found = [repulsive.solve(h, length, p, tol=1e-4, solid=solid) for h in surfaces]
        area = theory.area_fraction(p) / np.mean([c.area_fraction for c in found])
        assert least < area < 1.05
        assert theory.mean_gap(p) == pytest.approx(np.mean([c.mean_gap for c in found]), rel=0.08)
