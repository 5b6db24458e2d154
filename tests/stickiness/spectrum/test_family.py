"""Families of spectra: moments, energies, cuts and sums are those of every spectrum."""

from dataclasses import replace

import numpy as np
import pytest

from stickiness.solids import HALF_SPACE, Film, Layer, Skin
from stickiness.spectrum import SelfAffine, Shells, SpectrumFamily, Tabulated, combine

ONE = SelfAffine(hurst=0.8, q0=1.0, q1=64.0, h_rms=1.0)
HIGHER = SelfAffine(hurst=0.8, q0=1.0, q1=64.0, h_rms=3.0)
OTHER = SelfAffine(hurst=0.5, q0=2.0, q1=500.0, C0=0.3, q_rolloff=6.0)
TURNED = SelfAffine(hurst=0.7, q0=3.0, q1=40.0, h_rms=0.5, anisotropy=4.0, angle=0.3)
TABLE = Tabulated([1.0, 2.0, 7.0, 500.0], [3.0, 1.0, 0.9, 1e-9])
SHELLS = Shells([1.0, 2.0, 4.0], [4.0, 1.0, 0.1])
SPECTRA = [ONE, OTHER, TURNED, TABLE, SHELLS, combine(ONE, OTHER)]
SOLIDS = [Layer(0.3, 0.5), Layer(0.3, 0.5, Film(50.0, 0.4, 0.1)), Skin(0.05, 30.0, 0.35, 0.5)]
EXACT = 1e-12


def scaled(spectrum, *factors):
    """Drawn spectra: that of one times factors."""
    one = SpectrumFamily.of(spectrum)
    return SpectrumFamily(one.q, one.area, np.array(factors)[:, None] * one.psd)


def change_modulus(solid, factor):
    """The film or skin as it is beside a solid whose modulus is multiplied."""
    if isinstance(solid, Skin):
        return replace(solid, modulus_ratio=solid.modulus_ratio / factor)
    film = replace(solid.backing, modulus_ratio=solid.backing.modulus_ratio / factor)
    return replace(solid, backing=film)


@pytest.mark.parametrize("spectrum", SPECTRA)
def test_moments_and_energies_are_those_of_the_spectrum(spectrum):
    family = SpectrumFamily.of(spectrum)
    averaged = spectrum.averaged()
    for order in (0, 1, 2, 4):
        expected = averaged.total_variance(order)
        np.testing.assert_allclose(family.variance(order), expected, rtol=EXACT)
    for solid in (HALF_SPACE, *SOLIDS):
        expected = averaged.elastic_energy(solid)
        np.testing.assert_allclose(family.energy(solid), expected, rtol=EXACT)


@pytest.mark.parametrize("solid", SOLIDS[1:])
def test_energies_at_another_modulus_are_those_beside_the_same_film_or_skin(solid):
    family = SpectrumFamily.of(ONE, HIGHER)
    factors = np.array([1e-3, 0.5, 20.0])
    expected = [family.energy(change_modulus(solid, factor)) for factor in factors]
    np.testing.assert_allclose(family.energy(solid, factors[:, None]), expected, rtol=EXACT)
    of_rows = family.energy(solid, factors[:2])
    np.testing.assert_allclose(of_rows, np.diag(expected), rtol=EXACT)
    assert family.energy(solid, 0.5) == pytest.approx(expected[1], rel=EXACT)


@pytest.mark.parametrize("spectrum", SPECTRA)
def test_a_cut_parts_the_waves_at_the_wave_number(spectrum):
    """What stands for no waves has 1e-12 of the heights, and 2e-10 of the curvature."""
    family = SpectrumFamily.of(spectrum)
    for q in (1.5, 3.3, 11.0):
        above, below = family.above(q), family.below(q)
        for order in (0, 1, 4):
            expected = spectrum.averaged().variance_above(q, order)
            whole = family.variance(order)
            atol = 1e-9 * whole.item()
            np.testing.assert_allclose(above.variance(order), expected, rtol=1e-11, atol=atol)
            both = above.variance(order) + below.variance(order)
            np.testing.assert_allclose(both, whole, rtol=1e-9)


def test_rings_of_drawn_spectra_are_cut_evenly_in_the_logarithm_of_the_wave_number():
    family = scaled(ONE, 1.0, 4.0)
    for q in (0.5, 1.7, 9.3, 80.0):
        parts = [family.above(q), family.below(q)]
        whole = sum(part.variance() for part in parts)
        np.testing.assert_allclose(whole, family.variance(), rtol=1e-11)
    ring = SpectrumFamily(np.array([1.0]), np.array([1.5 * np.pi]), np.ones((1, 1)))
    # Between q^2 of 1/2 and 2, whose geometric mean is that of the ring.
    assert ring.above(2**0.25).variance() == pytest.approx(1.5 * np.pi / 4)
    assert ring.ending_rings(1.0).variance() == pytest.approx(0.5 * np.pi)


@pytest.mark.parametrize(
    "family",
    [SpectrumFamily.of(ONE), scaled(ONE, 1.0, 2.0), SpectrumFamily.of(SHELLS)],
    ids=["function", "drawn", "shells"],
)
def test_a_spectrum_with_no_waves_left_is_smooth(family):
    for rest in (family.above(1e3), family.below(0.1)):
        assert rest.count == family.count
        assert np.all((rest.variance() > 0) & (rest.variance() < 1e-11 * family.variance()))


def test_drawn_spectra_end_one_by_one():
    psd = np.array([[1.0, 1.0, 0.0], [1.0, 1.0, 1.0]])
    family = SpectrumFamily(np.array([1.0, 2.0, 4.0]), np.array([0.1, 0.2, 0.4]), psd)
    rest = family.above(3.0)
    assert rest.variance()[0] < 1e-11
    assert rest.variance()[1] == pytest.approx(0.4)
    assert family.up_to(2.0).variance() == pytest.approx([0.3, 0.3])


@pytest.mark.parametrize(
    "families",
    [
        [SpectrumFamily.of(ONE), SpectrumFamily.of(OTHER)],
        [scaled(ONE, 1.0, 2.0), scaled(OTHER, 3.0, 1.0)],
        [scaled(ONE, 1.0), SpectrumFamily.of(OTHER)],
    ],
    ids=["functions", "drawn", "one of each"],
)
def test_families_add(families):
    both = families[0] + families[1]
    for order in (0, 2, 4):
        expected = sum(each.variance(order) for each in families)
        np.testing.assert_allclose(both.variance(order), expected, rtol=EXACT)
    for solid in SOLIDS:
        expected = sum(each.energy(solid) for each in families)
        np.testing.assert_allclose(both.energy(solid), expected, rtol=EXACT)


def test_rows_are_taken_and_interpolated_in_the_logarithm():
    ends = SpectrumFamily.of(ONE, HIGHER)
    between = ends.between(np.array([0.0, 0.5, 1.0]))
    np.testing.assert_allclose(between.variance(), [1.0, 3.0, 9.0], rtol=EXACT)
    turned = ends.take(np.array([1, 0, 1]))
    np.testing.assert_allclose(turned.variance(), [9.0, 1.0, 9.0], rtol=EXACT)
    np.testing.assert_allclose(
        turned.above(4.0).energy(), ends.above(4.0).energy()[[1, 0, 1]], rtol=EXACT
    )
