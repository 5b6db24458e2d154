"""Compliance of layers against the boundary value problem, solved on its own, and its limits."""

import mpmath
import numpy as np
import pytest

from stickiness.solids import Film, HalfSpace, Layer

POISSON = [0.0, 0.3, 0.4999, 0.5]
WAVES = [1e-6, 1e-3, 0.1, 0.74, 0.76, 3.0, 10.0, 40.0]


def matrix(shear, nu):
    """Growth with depth of (u, w, xz, zz) in a wave (u sin x, w cos x, xz sin x, zz cos x).

    Plane strain: equilibrium and Hooke's law as a system of the first order, regular at nu = 1/2.
    """
    return mpmath.matrix(
        [
            [0, 1, 1 / shear, 0],
            [-nu / (1 - nu), 0, 0, (1 - 2 * nu) / (2 * shear * (1 - nu))],
            [2 * shear / (1 - nu), 0, 0, nu / (1 - nu)],
            [0, 0, -1, 0],
        ]
    )


def boundary_value_problem(k, poisson, backing):
    """S of a layer under a unit pressure wave, and its largest strain over its displacement.

    The surface is free of shear; the conditions are at the far side.
    """
    with mpmath.workdps(150):
        nu, eye = mpmath.mpf(poisson), mpmath.eye(4)
        growth = matrix(mpmath.mpf(1), nu)
        through = mpmath.expm(growth * mpmath.mpf(k))
        rows = {"bonded": (0, 1), "slip": (1, 2)}[backing]
        conditions = mpmath.matrix([[eye[row, j] for j in range(4)] for row in rows])
        conditions = conditions * through
        unknown = mpmath.lu_solve(conditions[:, :2], conditions[:, 3])  # zz = -1
        state, step = mpmath.matrix([*unknown, 0, -1]), mpmath.expm(growth * mpmath.mpf(k) / 20)
        strains = []
        for _ in range(21):  # of normal and of shear strain, times the thickness over k
            strains += [abs((growth * state)[1]), abs(state[2])]
            state = step * state
        strain = max(strains) / abs(unknown[1])
        return float(unknown[1] / (1 - nu)), float(strain)  # w E*/2, E* = 2/(1 - nu)


BACKINGS = pytest.mark.parametrize("backing", ["bonded", "slip"])


@pytest.mark.slow
@BACKINGS
@pytest.mark.parametrize("poisson", POISSON)
def test_factor_solves_the_boundary_value_problem(poisson, backing):
    expected = [boundary_value_problem(k, poisson, backing)[0] for k in WAVES]
    # a thickness of two: k = q d
    factor = Layer(2.0, poisson, backing).factor(np.array(WAVES) / 2)
    np.testing.assert_allclose(factor, expected, rtol=1e-12)


@BACKINGS
@pytest.mark.parametrize("poisson", POISSON)
def test_short_waves_see_a_half_space(poisson, backing):
    layer = Layer(1.0, poisson, backing)
    np.testing.assert_allclose(layer.factor([60.0, 1e3, 1e6, 1e300]), 1.0, rtol=1e-13)
    assert layer.compliance(1e6) == pytest.approx(HalfSpace().compliance(1e6), rel=1e-13)
    deep = Layer(1e300, poisson, backing)
    assert deep.factor(1e9) == 1
    assert deep.strain(h_rms=1.0, q0=1e9) == pytest.approx(1e-300)


@BACKINGS
@pytest.mark.parametrize("poisson", [0.3, 0.5, 0.5 * (1 - 1e-12)])
def test_long_waves(poisson, backing):
    k = np.array([1e-6, 1e-5, 1e-4])
    # Bonded, what the volume and what the shape give add up: k and, if incompressible, k^3.
    bonded = (1 - 2 * poisson) / (2 * (1 - poisson) ** 2) * k + 2 / 3 * k**3
    factor = Layer(1.0, poisson, backing).factor(k)
    np.testing.assert_allclose(factor, bonded if backing == "bonded" else k / 2, rtol=1e-7)


def test_half_space_units_and_inverse():
    solid = HalfSpace()
    assert (solid.compliance(4.0), solid.stiffness(4.0), solid.mean_compliance) == (0.5, 2.0, 0.0)
    assert solid.in_unit(3.0) == solid
    layer, waves = Layer(0.3, 0.45), np.geomspace(1e-3, 1e3, 30)
    np.testing.assert_allclose(layer.stiffness(waves) * layer.compliance(waves), 1, rtol=1e-14)
    small = layer.in_unit(0.01)
    np.testing.assert_allclose(small.compliance(0.01 * waves), layer.compliance(waves) / 0.01)
    assert isinstance(layer.compliance(1.0), float)


@pytest.mark.parametrize("poisson", [0.0, 0.2, 0.4, 0.5])
def test_mean_compression_is_that_of_uniaxial_strain(poisson):
    """Hooke's law with no strain sideways: E (1 - nu)/((1 + nu)(1 - 2 nu)), by its inverse."""
    layer = Layer(0.7, poisson)
    # stress sideways s from 0 = s - nu (s + p); strain = (p - 2 nu s)/E; E* = E/(1 - nu^2)
    sideways = poisson / (1 - poisson)
    strain = (1 - 2 * poisson * sideways) / (1 - poisson**2)
    assert layer.mean_compliance == pytest.approx(0.7 * strain, abs=1e-15)
    # the limit of long waves of a bonded layer, which cannot flow sideways either
    limit = layer.compliance(1e-7)
    assert layer.mean_compliance == pytest.approx(limit, rel=1e-9, abs=1e-13)
    assert Layer(0.7, poisson, "slip").mean_compliance == layer.mean_compliance


@BACKINGS
@pytest.mark.parametrize("poisson", POISSON)
def test_strain_is_the_largest_of_the_boundary_value_problem(poisson, backing):
    for k, within in ((0.01, 1.01), (0.1, 1.2), (2.0, 1.8)):
        strain = k * boundary_value_problem(k, poisson, backing)[1]
        assert 1 / within < Layer(1.0, poisson, backing).strain(1.0, k) / strain < within


@pytest.mark.parametrize("poisson", [0.3, 0.5])
def test_a_film_bends_besides_the_layer_on_a_rigid_base(poisson):
    thickness, modulus, ratio, nu = 0.1, 2.0, 50.0, 0.4
    layer = Layer(0.2, poisson, Film(ratio, nu, thickness))
    rigid = Layer(0.2, poisson)
    q = np.geomspace(1e-3, 10, 9)
    bending = modulus * ratio * thickness**3 / (12 * (1 - nu**2))  # D
    plane_strain = modulus / (1 - poisson**2)
    expected = rigid.compliance(q) / plane_strain + 1 / (bending * q**4)
    np.testing.assert_allclose(layer.compliance(q) / plane_strain, expected, rtol=1e-12)
    assert layer.in_unit(0.1).compliance(0.1 * 2) == pytest.approx(layer.compliance(2.0) / 0.1)


def test_numpy_scalars_are_kept_as_plain_floats():
    layer = Layer(np.array(0.2), np.float64(0.3), Film(np.float32(2), np.array(0.25), 1))
    same = Layer(0.2, 0.3, Film(2.0, 0.25, 1.0))
    assert (hash(layer), repr(layer)) == (hash(same), repr(same))
