"""Operators of the half-space against plain transforms, their preconditioner, its work."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from references.contact import displacement

from stickiness import repulsive, spectrum, surface
from stickiness.repulsive import half_space
from stickiness.repulsive.active_set import Problem, _Grid, _highest
from stickiness.repulsive.preconditioner import Preconditioner, _Mean
from stickiness.solids import HALF_SPACE, Layer

Q0 = 2 * np.pi


def rough(n, seed=1):
    s = spectrum.SelfAffine(hurst=0.8, q0=Q0, q1=Q0 * n / 8, h_rms=1.0)
    return surface.synthesise(s, n=n, length=1.0, seed=seed)


@pytest.mark.parametrize("shape", [(16, 16), (17, 13), (1, 8), (5, 1), (64, 48), (31, 128)])
def test_half_space_equals_plain_transforms(shape):
    rng = np.random.default_rng(3)
    sides = (0.7, 1.9)
    operator = half_space.HalfSpace(shape, sides)
    pressure = rng.standard_normal(shape)
    expected = displacement(pressure, sides)
    np.testing.assert_allclose(operator.compliance(pressure), expected, atol=1e-14)
    back = operator.stiffness(expected)
    np.testing.assert_allclose(back, pressure - pressure.mean(), atol=1e-13)
    unit = np.zeros(shape)
    unit[0, 0] = 1
    # the diagonal of the stiffness matrix is what a single lifted pixel feels
    assert operator.stiffness(unit)[0, 0] == pytest.approx(operator.mean_stiffness)


def test_half_space_with_some_rows_only():
    rng = np.random.default_rng(4)
    operator = half_space.HalfSpace((37, 24), (1.0, 1.0))
    for chosen in ([0, 3, 4, 36], [5], list(range(10, 30))):
        rows = np.array(chosen)
        pressure = np.zeros((37, 24))
        pressure[rows] = rng.standard_normal((rows.size, 24))
        expected = displacement(pressure, (1.0, 1.0))
        result = operator.compliance(pressure, rows_in=rows, rows_out=rows)
        np.testing.assert_allclose(result[rows], expected[rows], atol=1e-14)
        np.testing.assert_allclose(operator.compliance(pressure), expected, atol=1e-14)


def test_operators_are_kept_for_a_thread_and_can_be_freed():
    one = half_space.half_space((8, 8), (1.0, 1.0))
    assert half_space.half_space((8, 8), (1.0, 1.0)) is one
    with ThreadPoolExecutor(1) as other:
        assert other.submit(half_space.half_space, (8, 8), (1.0, 1.0)).result() is not one
    half_space.clear_caches()
    assert half_space.half_space((8, 8), (1.0, 1.0)) is not one


@pytest.mark.parametrize("shape", [(32, 32), (31, 45), (6, 50)])
def test_the_mean_is_symmetric(shape):
    rng = np.random.default_rng(1)
    a, b, weights = rng.random((3, *shape)).astype(np.float32)
    mean = _Mean(shape, (1.0, shape[1] / shape[0]))

    def apply(field):
        out = np.empty(shape, np.float32)
        mean.gather(field, weights)
        mean.spread(weights, out)
        return out

    assert np.sum(a * apply(b)) == pytest.approx(np.sum(b * apply(a)), rel=1e-4)


def test_the_mean_at_points_is_that_of_the_grid():
    shape = (12, 21)
    field = np.random.default_rng(1).random(shape).astype(np.float32)
    mean, out = _Mean(shape, (1.0, 1.75)), np.empty(shape, np.float32)
    mean.gather(field)
    mean.spread(np.ones(shape, np.float32), out)
    np.testing.assert_allclose(mean.at(np.arange(field.size)), out.ravel(), rtol=1e-5)
    # far from a single point the sums fall off with the inverse square of the distance
    point = np.zeros((256, 256), np.float32)
    point[128, 128] = 1
    mean = _Mean(point.shape, (1.0, 1.0))
    mean.gather(point)
    near, far = mean.at(128 * 256 + 128 + np.array([16, 32]))
    assert near / far == pytest.approx(4, rel=0.1)


def preconditioned(shape, touching, solid):
    """Product of preconditioner and compliance on a set of points, without the mean."""
    heights = np.zeros(shape)
    problem = Problem(heights, (1.0, shape[1] / shape[0]), 1.0, solid)
    grid = _Grid(problem, rough=True)
    apply = Preconditioner(grid, np.flatnonzero(touching))
    project = np.eye(touching.sum()) - 1 / touching.sum()
    unit = np.eye(touching.sum(), dtype=np.float32)
    stiffness = np.array([apply(column) for column in unit])
    compliance = np.array([apply.compliance(column) for column in unit])
    np.testing.assert_allclose(stiffness, stiffness.T, atol=1e-4 * np.abs(stiffness).max())
    assert not grid.quick.field.any()
    return project @ stiffness @ project @ compliance @ project


@pytest.mark.parametrize("shape", [(32, 32), (31, 33)])
@pytest.mark.parametrize("solid", [HALF_SPACE, Layer(thickness=0.1, poisson=0.3)])
def test_it_nearly_inverts_the_compliance(shape, solid):
    y, x = np.indices(shape)
    touching = np.hypot(y - 10, x - 12) < 6
    touching |= np.hypot(y - 22, x - 25) < 4
    values = np.sort(np.linalg.eigvals(preconditioned(shape, touching, solid)).real)[1:]
    assert values[0] > 0
    assert values[-1] / values[0] < 3.5


@pytest.mark.parametrize(("load", "most"), [(0.0005, 8), (0.003, 8), (0.065, 32), (0.3, 32)])
def test_convolutions_of_a_solution(load, most):
    assert repulsive.solve(rough(512), 1.0, load * Q0).fft_pairs < most


def test_the_first_guess_is_about_twice_the_contact():
    heights = rough(128)
    contact = repulsive.solve(heights, 1.0, 0.02 * Q0)
    points = _highest(Problem(heights / heights.std(), (1.0, 1.0), 0.02 * Q0 / heights.std()))
    assert 1 < points.size / (contact.area_fraction * heights.size) < 4
    assert heights.ravel()[points].min() >= np.sort(heights.ravel())[-points.size]
