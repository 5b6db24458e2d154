"""Persson's theory against its formulas evaluated directly, limits, and conservation of energy."""

import mpmath
import numpy as np
import pytest
from scipy import special

from stickiness.persson import Persson
from stickiness.persson.kernels import kernels
from stickiness.persson.theory import ENERGY_GAMMA
from stickiness.repulsive import load_path
from stickiness.solids import HALF_SPACE, Layer
from stickiness.spectrum import SelfAffine, Shells, Tabulated
from stickiness.surface import realised_spectrum, synthesise

VARIANTS = ("afferrante2018", "almqvist2011")


def power_law(magnification=1000.0, hurst=0.8, **kwargs):
    return SelfAffine(hurst=hurst, q0=1.0, q1=magnification, h_rms=1.0, **kwargs)


def test_universal_functions_agree_with_multiprecision():
    gamma = 0.45
    k = kernels(gamma)

    def integrand(t):
        return (gamma + 3 * (1 - gamma) * mpmath.erf(t) ** 2) * mpmath.exp(-t * t)

    for x in (0.03, 0.4, 1.3, 3.0):
        ends = [x, 2 * x, x + 1, x + 2, x + 4, x + 9]
        scale = mpmath.exp(x * x)
        gap = mpmath.quad(lambda t: integrand(t) / t, ends)
        assert float(k.gap_kernel(x * x)) == pytest.approx(float(scale * gap), rel=1e-10)
        # the order of the two integrations exchanged
        mean = mpmath.quad(lambda t, x=x: integrand(t) / t * (1 - x / t), ends)
        assert float(k.mean_kernel(x * x)) == pytest.approx(float(scale * mean), rel=1e-9)
    for y in (1e-4, 0.05, 0.9, 4.0):
        want = mpmath.quad(
            lambda t: 2 / (t**3 * (gamma + (1 - gamma) * mpmath.erf(t) ** 2)),
            [y, 3 * y, 10 * y, 100 * y, 1e4 * y, mpmath.inf],
        )
        assert float(k.area_scale(y)) == pytest.approx(float(want), rel=1e-9)
        assert float(k.invert_area_scale(float(want))) == pytest.approx(y, rel=1e-9)


def test_large_and_small_arguments_of_the_universal_functions():
    k = kernels(1.0)  # F(x) = E1(x^2)/2 in closed form
    for x in (1e-12, 1e-10, 1e-3, 6.0, 24.0):
        want = 0.5 * float(mpmath.exp(x * x) * mpmath.e1(x * x))
        assert float(k.gap_kernel(x * x)) == pytest.approx(want, rel=1e-9)
    y = np.array([1e-9, 1e-6, 1.0, 6.5, 40.0])
    np.testing.assert_allclose(k.area_scale(y), y**-2, rtol=1e-12)
    step = y * np.array([1e-14, 1e-8, 0.1, 0.3, 2.0])[:, None]
    exact = step * (2 * y + step) / (y * (y + step)) ** 2
    np.testing.assert_allclose(k.area_scale_step(y, step), exact, rtol=1e-12)


def test_uncorrected_area_is_the_closed_form():
    s = power_law()
    p = np.geomspace(1e-6, 30, 30)
    want = special.erf(p * np.sqrt(2) / s.rms_slope)
    np.testing.assert_allclose(Persson(s, gamma=1.0).area_fraction(p), want, rtol=1e-12)


def test_area_at_a_magnification_is_that_of_the_truncated_surface():
    s = power_law()
    theory, cut = Persson(s), Persson(s.truncated(37.0))
    p = np.array([0.01, 0.3])
    np.testing.assert_allclose(
        theory.area_fraction(p, magnification=37.0), cut.area_fraction(p), rtol=1e-12
    )
    assert theory.area_fraction(0.1, magnification=1.0) == 1.0
    assert theory.area_fraction(0.0) == 0.0


@pytest.mark.parametrize("gap", [1e-200, 1e-6, 0.1, 1.0, 8.0, 60.0])
def test_pressure_at_inverts_mean_gap(gap):
    for s in (power_law(), power_law(1.01), Shells([1.0, 2.0], [1.0, 0.1])):
        theory = Persson(s)
        assert theory.mean_gap(theory.pressure_at(gap)) == pytest.approx(gap, rel=1e-11)


@pytest.mark.slow
@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize("hurst", [0.3, 0.8, 1.0])
@pytest.mark.parametrize("magnification", [1.01, 10.0, 1e3, 1e6, 1e8])
def test_normalised_and_converged(variant, hurst, magnification):
    s = power_law(magnification, hurst)
    theory, fine = Persson(s, variant), Persson(s, variant, nodes=2)
    u = np.geomspace(1e-5, 15, 40)
    p = np.array([1e-4, 0.065, 1.0])
    np.testing.assert_allclose(theory.mean_gap(p), fine.mean_gap(p), rtol=1e-9)
    total = theory.gap_cumulative(np.inf, p) + theory.area_fraction(p)
    np.testing.assert_allclose(total, 1.0, rtol=0, atol=1e-10)
    for name in ("gap_density", "gap_cumulative"):
        coarse, best = getattr(theory, name)(u, p), getattr(fine, name)(u, p)
        seen = best > 1e-12 * best.max()
        np.testing.assert_allclose(coarse[seen], best[seen], rtol=5e-7)


@pytest.mark.slow
def test_rough_table_with_many_points():
    rng = np.random.default_rng(3)
    q = np.geomspace(1, 1e4, 2000)
    table = Tabulated(q, q**-3.6 * np.exp(0.5 * rng.normal(size=q.size)))
    p = 0.065 * table.h_rms
    coarse, fine = Persson(table), Persson(table, nodes=4)
    # a fifth of a decade of noise in C from point to point; panels keep to 250 of its 2000 kinks
    assert coarse.mean_gap(p) == pytest.approx(fine.mean_gap(p), rel=1e-9)
    u = table.h_rms * np.array([1e-3, 0.1, 2.0])
    np.testing.assert_allclose(coarse.gap_density(u, p), fine.gap_density(u, p), rtol=2e-6)


@pytest.mark.parametrize("variant", VARIANTS)
def test_dense_shells_approach_the_continuum(variant):
    s = power_law(100.0)
    edges = np.geomspace(1, 100, 20001)
    variance = s.variance_below(edges[1:]) - s.variance_below(edges[:-1])
    gradient = s.variance_below(edges[1:], 2) - s.variance_below(edges[:-1], 2)
    shells = Shells(np.sqrt(gradient / variance), variance)
    u, p = np.array([0.01, 0.1, 1.0]), 0.065
    a, b = Persson(shells, variant), Persson(s, variant)
    # shells 2e-4 apart: the square of that, and the nodes' own errors
    assert a.mean_gap(p) == pytest.approx(b.mean_gap(p), rel=4e-8)
    np.testing.assert_allclose(a.gap_density(u, p), b.gap_density(u, p), rtol=2e-7)


@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize("p", [1e-12, 1e-6, 3.0, 10.0, 50.0, 1e3])
def test_extreme_loads(variant, p):
    theory = Persson(power_law(100.0), variant)
    total = theory.gap_cumulative(np.inf, p)
    assert total == pytest.approx(1 - theory.area_fraction(p), abs=1e-10)
    assert 0 <= theory.gap_density(0.01, p) < np.inf
    assert theory.mean_gap(p) >= 0


def test_density_at_no_gap():
    s, p = power_law(100.0), 0.1
    assert Persson(s, "afferrante2018").gap_density(0.0, p) == np.inf
    wide = Persson(s, "almqvist2011")
    assert wide.gap_density(0.0, p) == pytest.approx(wide.gap_density(1e-9, p), rel=1e-6)
    for variant in VARIANTS:
        assert Persson(s, variant).gap_cumulative(0.0, p) == 0.0


def test_shapes():
    theory = Persson(power_law(10.0))
    u, p = np.linspace(0.1, 1, 6).reshape(2, 3), np.array([0.1, 0.2])
    table = theory.gap_cumulative(u, p)
    assert table.shape == (2, 2, 3)
    assert table[1, 0, 2] == pytest.approx(theory.gap_cumulative(u[0, 2], 0.2), rel=1e-12)
    assert theory.gap_density(u[:, :0], 0.1).shape == (2, 0)
    assert np.ndim(theory.mean_gap(0.1)) == np.ndim(theory.pressure_at(1.0)) == 0
    assert theory.mean_gap(p).shape == theory.pressure_at(p).shape == (2,)


SOLIDS = [HALF_SPACE, Layer(0.5, 0.5), Layer(1.0, 0.3, "slip")]
SPECTRA = {
    "power law": power_law(),
    "narrow": power_law(1.3),
    "broad": power_law(1e6, hurst=0.5),
    "shells": Shells([1.0, 3.0, 9.0], [0.5, 0.1, 0.02]),
}


@pytest.mark.parametrize("solid", SOLIDS, ids=str)
@pytest.mark.parametrize("rough", SPECTRA.values(), ids=SPECTRA)
def test_elastic_energy_is_the_work_of_the_pressure(rough, solid):
    """From p to 3 p, and from nothing to full contact, rising all the way."""
    theory = Persson(rough, correction="xu2024", gamma=ENERGY_GAMMA, solid=solid)
    scale = np.sqrt(theory._setting.m2)
    p = np.geomspace(1e-4, 3.0, 7)[:, None] * scale
    energy = theory.elastic_energy(np.hstack([p, 3 * p]))
    assert energy.shape == (7, 2)
    x, w = np.polynomial.legendre.leggauss(20)
    log_p = np.log(p) + 0.5 * np.log(3) * (1 + x)
    area = np.sum(0.5 * np.log(3) * w * np.exp(log_p) * theory.mean_gap(np.exp(log_p)), axis=1)
    ends = (p * theory.mean_gap(p) - 3 * p * theory.mean_gap(3 * p))[:, 0]
    np.testing.assert_allclose(energy[:, 1] - energy[:, 0], area + ends, rtol=1e-7)
    rising = theory.elastic_energy(np.geomspace(1e-12, 100, 300) * scale)
    assert np.all(np.diff(rising) >= -1e-14 * rising[-1])
    assert rising[-1] == pytest.approx(rough.elastic_energy(solid), rel=1e-9)
    assert theory.elastic_energy(0.0) < 1e-140
    assert theory.elastic_energy(np.inf) == pytest.approx(rough.elastic_energy(solid), rel=1e-9)
    assert theory.elastic_energy_error(100 * scale) < 1e-9


@pytest.mark.parametrize("seed", [1, 2])
def test_error_of_the_elastic_energy_towards_full_contact(seed):
    """The grid changes energies by less than a tenth of what theory and simulation differ by."""
    side = 4 * np.pi
    loads = np.array([0.1, 0.3, 1.0, 2.0, 3.0, 5.0])
    energies = []
    for points in (64, 128):
        heights = synthesise(power_law(8.0), points, side, seed)
        solved = load_path(heights, side, loads, tol=1e-6)
        energies.append([np.mean(s.pressure * (s.gap + heights - s.shift)) / 2 for s in solved])
    coarse, fine = np.array(energies)
    theory = Persson(realised_spectrum(heights, side))
    known = theory.elastic_energy(loads)
    error = theory.elastic_energy_error(loads) * known
    assert np.all(abs(fine - coarse) < 0.1 * error)
    assert np.all(abs(fine - known) < error)


@pytest.mark.parametrize("hurst", [0.5, pytest.param(0.8, marks=pytest.mark.slow)])
def test_elastic_energy_against_simulation(hurst):
    """Four longest waves a side: within the error, and closer than the correction of areas."""
    side, loads = 8 * np.pi, np.array([0.03, 0.1, 0.3, 1.0])
    errors = []
    for seed in (1, 2):
        heights = synthesise(power_law(8.0, hurst), 256, side, seed)
        theory = Persson(realised_spectrum(heights, side))
        solved = list(load_path(heights, side, loads, tol=1e-5))
        energies = [np.mean(s.pressure * (s.gap + heights - s.shift)) / 2 for s in solved]
        rising = np.exp(np.linspace(np.log(1e-9), np.log(loads), 2001))
        by_areas = np.trapezoid(theory.mean_gap(rising), rising, axis=0)
        by_areas -= loads * theory.mean_gap(loads)
        kinds = [energies / known - 1 for known in (theory.elastic_energy(loads), by_areas)]
        assert np.all(np.abs(kinds[0]) < theory.elastic_energy_error(loads))
        errors.append(kinds)
    best, areas = np.abs(np.mean(errors, axis=0)).max(axis=1)
    assert best < 0.07 < 0.12 < areas


@pytest.mark.parametrize("places", [[7.0], [7.0, 60.0]])
def test_kinks_of_a_table_do_not_spoil_the_sums(places):
    """Plateaus and steep falls between few points, against four times the nodes."""
    q = np.array([1.0, *places, 100.0])
    table = Tabulated(q, np.array([1.0, 1.0, 1e-5, 1e-9])[: q.size])
    load = 0.05 * table.rms_slope
    coarse, fine = Persson(table), Persson(table, nodes=4)
    assert coarse.mean_gap(load) == pytest.approx(fine.mean_gap(load), rel=1e-9)
