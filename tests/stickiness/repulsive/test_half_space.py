"""Operators of the half-space against plain transforms, their preconditioner, its work."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from references.contact import displacement

from stickiness import repulsive, spectrum, surface
from stickiness.measured.periodic import periodise
from stickiness.repulsive import half_space
from stickiness.repulsive.active_set import Problem, _Grid
from stickiness.repulsive.preconditioner import Preconditioner
from stickiness.solids import HALF_SPACE, Layer

pytestmark = pytest.mark.processors

Q0 = 2 * np.pi


def rough(n, seed=1):
    s = spectrum.SelfAffine(hurst=0.8, q0=Q0, q1=Q0 * n / 8, h_rms=1.0)
    return surface.synthesise(s, n=n, length=1.0, seed=seed)


@pytest.mark.parametrize("shape", [(16, 16), (17, 13), (1, 8), (5, 1), (64, 48), (31, 128)])
@pytest.mark.parametrize(
    "solid", [HALF_SPACE, Layer(0.3, 0.5), Layer(0.3, 0.2), Layer(2.0, 0.5, "slip")], ids=str
)
def test_operators_equal_plain_transforms(shape, solid):
    sides = (0.7, 1.9)
    operator = half_space.half_space(shape, sides, solid=solid)
    pressure = np.random.default_rng(3).standard_normal(shape)
    expected = displacement(pressure, sides, solid)
    np.testing.assert_allclose(operator.compliance(pressure), expected, rtol=1e-10, atol=1e-14)
    back = operator.stiffness(expected)
    np.testing.assert_allclose(back, pressure - pressure.mean(), atol=1e-10)
    unit = np.zeros(shape)
    unit[0, 0] = 1
    # the diagonal of the stiffness matrix is what a single lifted pixel feels
    assert operator.stiffness(unit)[0, 0] == pytest.approx(operator.mean_stiffness)
    for rows in (np.array([0]), np.arange(shape[0] // 3, shape[0] // 2 + 1)):
        some = np.zeros(shape)
        some[rows] = pressure[rows]
        result = operator.compliance(some, rows_in=rows, rows_out=rows)
        expected = displacement(some, sides, solid)
        np.testing.assert_allclose(result[rows], expected[rows], rtol=1e-10, atol=1e-14)


@pytest.mark.parametrize("shape", [(16, 16), (17, 13), (1, 8), (5, 1), (64, 48), (30, 129)])
@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("solid", [HALF_SPACE, Layer(0.3, 0.2)], ids=str)
def test_a_mirrored_cell_is_a_quarter_of_its_period(shape, dtype, solid):
    sides = (0.7, 1.9)
    accuracy = 1e-10 if dtype == np.float64 else 2e-5
    operator = half_space.half_space(shape, sides, dtype, solid, mirrored=True)
    pressure = np.random.default_rng(3).standard_normal(shape).astype(dtype)
    period = periodise(pressure.astype(float), "mirror")
    expected = displacement(period, (1.4, 3.8), solid)[: shape[0], : shape[1]]
    scale = np.abs(expected).max()
    np.testing.assert_allclose(operator.compliance(pressure), expected, atol=accuracy * scale)
    back = operator.stiffness(expected.astype(dtype))
    np.testing.assert_allclose(back, pressure - pressure.mean(), atol=20 * accuracy)
    if min(shape) > 8:
        # A pixel lifted alone hardly feels that the shortest wave of the period is no cosine.
        periodic = half_space.half_space(period.shape, (1.4, 3.8), solid=solid)
        assert operator.mean_stiffness == pytest.approx(periodic.mean_stiffness, rel=0.15)


def test_operators_are_kept_for_a_thread_and_can_be_freed():
    one = half_space.half_space((8, 8), (1.0, 1.0))
    assert half_space.half_space((8, 8), (1.0, 1.0)) is one
    with ThreadPoolExecutor(1) as other:
        assert other.submit(half_space.half_space, (8, 8), (1.0, 1.0)).result() is not one
    half_space.clear_caches()
    assert half_space.half_space((8, 8), (1.0, 1.0)) is not one


@pytest.mark.parametrize(
    ("most", "kind"), [(24, {}), (12, {"periodic": False}), (12, {"solid": Layer(0.1, 0.5)})]
)
def test_the_last_operators_of_a_kind_are_kept(most, kind):
    first, *rest = (half_space.half_space((8, 8), (1.0 + n, 1.0), **kind) for n in range(most))
    assert half_space.half_space((8, 8), (1.0, 1.0), **kind) is first
    half_space.half_space((8, 8), (1.0 + most, 1.0), **kind)  # drops that of the second length
    assert half_space.half_space((8, 8), (2.0, 1.0), **kind) is not rest[0]


def preconditioned(shape, touching, solid):
    """Product of preconditioner and compliance on a set of points, without the mean."""
    problem = Problem(np.zeros(shape), (1.0, shape[1] / shape[0]), 1.0, solid)
    grid = _Grid(problem, approximate=True)
    apply = Preconditioner(grid, np.flatnonzero(touching))
    project = np.eye(touching.sum()) - 1 / touching.sum()
    unit = np.eye(touching.sum(), dtype=np.float32)
    stiffness = np.array([apply(column) for column in unit])
    compliance = np.array([apply.compliance(column) for column in unit])
    np.testing.assert_allclose(stiffness, stiffness.T, atol=1e-4 * np.abs(stiffness).max())
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


@pytest.mark.slow
@pytest.mark.parametrize(("load", "most"), [(0.0005, 8), (0.003, 8), (0.065, 32), (0.3, 32)])
def test_convolutions_of_a_solution(load, most):
    assert repulsive.solve(rough(512), 1.0, load * Q0).fft_pairs < most


@pytest.mark.parametrize("shape", [(80, 60), (79, 59), (78, 61)])
def test_interpolation_is_of_fourth_order(shape):
    """Of a wave, to grids that are or are not twice as fine."""

    def wave(shape):
        x, y = (2 * np.pi * np.arange(n) / n for n in shape)
        return np.cos(x + 0.3)[:, None] * np.sin(2 * y)

    coarse = tuple(half_space.coarsen(n) for n in shape)
    error = half_space.interpolate(wave(coarse), shape) - wave(shape)
    # 3/128 h^4 times the fourth derivative, in the middle between four points
    steps = 2 * np.pi / np.array(coarse)
    assert np.abs(error).max() < 1.1 * 3 / 128 * np.sum(steps**4 * [1, 16])
