"""Compliance of skins against the boundary value problem, solved on its own, and its limits."""

import mpmath
import numpy as np
import pytest
from scipy.optimize import nnls

from stickiness import repulsive
from stickiness.solids import Layer, Skin

RATIOS = [1e-3, 0.3, 1.0, 30.0, 1e6]
POISSON = [(0.0, 0.0), (0.0, 0.5), (0.5, 0.0), (0.35, 0.49), (0.5, 0.5)]
WAVES = np.array([1e-6, 1e-3, 0.03, 0.3, 0.74, 0.76, 3.0, 50.0])


def find_displacement(k, ratio, skin_poisson, poisson):
    """S by the constants of Airy's stress function, ``(A + B z) exp(-kz) + (C + D z) exp(kz)``.

    The skin is one thick, and its pressure wave has a unit amplitude.
    """

    def list_states(depth, modulus, nu, terms):
        """Columns of stress zz and xz and of displacement x and z, for every term."""
        columns = []
        for power, sign in terms:
            growth = sign * k
            exponential = mpmath.exp(growth * depth)
            # The n-th derivative of z^power exp(growth z).
            phi = [
                exponential * (growth**n * depth**power + power * n * growth ** max(n - 1, 0))
                for n in range(4)
            ]
            softness = (1 + nu) / modulus
            along = softness * ((1 - nu) * phi[2] + nu * k**2 * phi[0]) / k
            slope = softness * ((1 - nu) * phi[3] + nu * k**2 * phi[1]) / k
            columns.append((-(k**2) * phi[0], k * phi[1], along, slope / k - 2 * softness * phi[1]))
        return mpmath.matrix(columns).T

    with mpmath.workdps(80):
        k, ratio, skin_poisson, poisson = map(mpmath.mpf, (k, ratio, skin_poisson, poisson))
        both = [(0, -1), (1, -1), (0, 1), (1, 1)]
        surface = list_states(mpmath.mpf(0), ratio, skin_poisson, both)
        above = list_states(mpmath.mpf(1), ratio, skin_poisson, both)
        below = list_states(mpmath.mpf(1), mpmath.mpf(1), poisson, both[:2])
        # No shear at the surface; all four are continuous below the skin.
        system = mpmath.zeros(6, 6)
        system[:2, :4] = surface[:2, :]
        system[2:, :4] = above
        system[2:, 4:] = -below
        constants = mpmath.lu_solve(system, mpmath.matrix([-1, 0, 0, 0, 0, 0]))
        displacement = (surface[3, :] * constants[:4])[0]
        return float(displacement * k / (2 * (1 - poisson**2)))


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize(("skin_poisson", "poisson"), POISSON)
def test_factor_solves_the_boundary_value_problem(ratio, skin_poisson, poisson):
    expected = [find_displacement(k, ratio, skin_poisson, poisson) for k in WAVES]
    # a thickness of two: k = q t
    factor = Skin(2.0, ratio, skin_poisson, poisson).factor(WAVES / 2)
    np.testing.assert_allclose(factor, expected, rtol=1e-13)


@pytest.mark.parametrize(("skin_poisson", "poisson"), POISSON)
def test_limits(skin_poisson, poisson):
    waves = np.geomspace(1e-3, 1e3, 30)
    same = Skin(1.0, 1.0, poisson, poisson)
    np.testing.assert_allclose(same.factor(waves), 1.0, rtol=1e-14)
    thin = Skin(1e-300, 1e6, skin_poisson, poisson)
    np.testing.assert_allclose(thin.factor(waves), 1.0, rtol=1e-14)
    thick = Skin(1e3, 1e6, skin_poisson, poisson)
    ratio = 1e-6 * (1 - skin_poisson**2) / (1 - poisson**2)
    np.testing.assert_allclose(thick.factor(waves * 1e3), ratio, rtol=1e-13)
    for extreme in (1e-200, 1e200):
        factor = Skin(1.0, extreme, skin_poisson, poisson).factor([0.0, 1e-300, 1.0, 1e300])
        assert np.isfinite(factor).all()
        np.testing.assert_allclose(factor[:2], 1.0)


@pytest.mark.parametrize("k", [1e-2, 1e-3])
def test_long_waves_bend_a_plate(k):
    # As stiff as the half-space at 1/k^3; an incompressible half-space does not pull on the plate.
    skin_poisson = 0.35
    ratio = 6 * (1 - skin_poisson**2) / 0.75 / k**3
    skin = Skin(1.0, ratio, skin_poisson, 0.5)
    bending = ratio / (12 * (1 - skin_poisson**2))  # over Young's modulus of the half-space
    expected = k / 2 + bending * k**4 * 0.75
    # The next terms are of the second order: 0.025 k^2.
    assert skin.stiffness(k) == pytest.approx(expected, rel=0.03 * k**2)


def test_compressible_half_spaces_are_held_by_the_skin():
    # The skin does not stretch: a half-space of such a surface is stiffer by this factor.
    k = 1e-5
    for poisson in (0.0, 0.3):
        skin = Skin(1.0, 1e-6 / k**3, 0.3, poisson)
        inextensible = 4 * (1 - poisson) ** 2 / (3 - 4 * poisson)
        assert skin.factor(k) == pytest.approx(1 / inextensible, rel=1e-4)


@pytest.mark.parametrize("skin_poisson", [0.0, 0.3, 0.5])
def test_rigid_half_space(skin_poisson):
    layer = Layer(1.0, skin_poisson)
    waves = np.geomspace(0.05, 20, 20)
    ratio = 1e-9
    skin = Skin(1.0, ratio, skin_poisson, 0.3)
    # Displacements by pressures over E* of the skin.
    in_unit = ratio * (1 - 0.3**2) / (1 - skin_poisson**2)
    np.testing.assert_allclose(skin.compliance(waves) * in_unit, layer.compliance(waves), rtol=1e-4)


def test_a_factor_on_the_modulus_keeps_the_skin():
    skin = Skin(0.1, 100.0, 0.3, 0.5)
    # Short waves see the skin alone: half the E*, half the S.
    short, long = skin.factor([1e4, 1e-6], modulus=0.5)
    assert short == pytest.approx(skin.factor(1e4) / 2, rel=1e-12)
    assert long == pytest.approx(1.0)
    waves = np.geomspace(0.01, 1e3, 7)
    moduli = np.array([[0.5], [1.0], [3.0]])
    expected = [Skin(0.1, 100.0 / m, 0.3, 0.5).factor(waves) for m in moduli[:, 0]]
    np.testing.assert_allclose(skin.factor(waves, moduli), expected, rtol=1e-13)
    assert skin.in_unit(2.0).factor(3.0) == skin.factor(1.5)


def test_contact_without_adhesion_by_a_dense_solution():
    # One wave on a line of points: p >= 0 and C p - h >= 0, not both positive.
    n = 32
    skin = Skin(0.1, 50.0, 0.35, 0.5)
    x = np.arange(n) / n
    heights = 0.01 * np.cos(2 * np.pi * x)
    compliance = np.full((n, n), 0.05 / n)  # of the mean; any does, it only shifts the heights
    for m in range(1, n // 2 + 1):
        q = 2 * np.pi * m
        factor = find_displacement(q * 0.1, 50.0, 0.35, 0.5)
        both_signs = 1 if m == n // 2 else 2
        compliance += both_signs * 2 * factor / q * np.cos(q * (x[:, None] - x)) / n
    half = np.linalg.cholesky(compliance)
    pressure = nnls(half.T, np.linalg.solve(half, heights))[0]
    assert 0.1 < np.mean(pressure > 0) < 0.9

    rough = np.repeat(heights[:, None], 4, axis=1)
    contact = repulsive.solve(rough, (1.0, 4 / n), pressure.mean(), solid=skin, tol=1e-10)
    expected = np.repeat(pressure[:, None], 4, axis=1)
    np.testing.assert_allclose(contact.pressure, expected, atol=1e-7 * pressure.max())
