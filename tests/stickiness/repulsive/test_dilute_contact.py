"""Corrections among few points: the solution is that of corrections on the whole grid."""

import numpy as np
import pytest
from references.contact import wavenumbers

from stickiness import repulsive
from stickiness.repulsive import dilute_contact, half_space
from stickiness.repulsive.active_set import Problem, _Grid
from stickiness.solids import HALF_SPACE, Layer

SPREAD = -1.8  # exponent of the amplitudes: a Hurst exponent of 0.8
ROW = (0.5, 1.0)  # rectangle with square pixels if it has twice as many columns


def rough(shape, seed, sides=(1.0, 1.0), shortest=8):
    """Self-affine heights of unit rms slope, of some pixels per shortest wave."""
    rng = np.random.default_rng(seed)
    q = wavenumbers(shape, sides)[:, : shape[1] // 2 + 1] / (2 * np.pi)
    inside = (q > 0) & (q <= shape[0] / sides[0] / shortest)
    amplitude = np.where(inside, np.where(inside, q, 1.0) ** SPREAD, 0.0)
    heights = np.fft.irfft2(np.fft.rfft2(rng.standard_normal(shape)) * amplitude, shape)
    slope = np.hypot(*(np.std(np.diff(heights, axis=i)) * shape[i] / sides[i] for i in (0, 1)))
    return heights / slope


def assert_same(monkeypatch, heights, sides, pressure, tol=1e-8, **options):
    """Compare with the solution on the whole grid; returns that among few points."""
    contact = repulsive.solve(heights, sides, pressure, tol=tol, **options)
    with monkeypatch.context() as patch:
        patch.setattr(dilute_contact, "is_worthwhile", lambda *arguments: False)
        expected = repulsive.solve(heights, sides, pressure, tol=tol, **options)
    assert contact.residual <= tol
    np.testing.assert_array_equal(contact.pressure > 0, expected.pressure > 0)
    np.testing.assert_allclose(contact.gap, expected.gap, atol=4 * tol * contact.rms_height)
    assert contact.pressure.mean() == pytest.approx(pressure, rel=1e-12)
    assert np.all(contact.pressure >= 0)
    assert contact.fft_pairs < expected.fft_pairs
    return contact


@pytest.mark.parametrize(
    ("seed", "pressure", "options"),
    [
        (0, 1e-4, {}),
        (1, 5e-4, {}),
        (2, 2e-3, {}),
        (1, 5e-4, {"solid": Layer(0.02, 0.5)}),
        (1, 5e-4, {"solid": Layer(0.3, 0.3)}),
        (0, 1e-4, {"periodic": False}),
        (2, 2e-3, {"periodic": False}),
    ],
)
def test_same_solution_as_on_the_grid(monkeypatch, seed, pressure, options):
    assert_same(monkeypatch, rough((256, 256), seed), 1.0, pressure, **options)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("shape", "sides", "periodic"),
    [
        ((255, 255), (1, 1), True),
        ((131, 262), ROW, True),
        ((200, 144), (1, 0.8), True),
        ((128, 257), ROW, True),
        ((257, 259), (1, 1), False),
        ((261, 523), ROW, False),
        ((300, 256), (1, 1), False),
    ],
)
@pytest.mark.parametrize("tol", [1e-4, 1e-10])
def test_any_grid(monkeypatch, shape, sides, tol, periodic):
    heights = rough(shape, 5, sides)
    contact = assert_same(monkeypatch, heights, sides, 5e-4, tol, periodic=periodic)
    again = repulsive.solve(heights, sides, 5e-4, tol=tol, periodic=periodic)
    np.testing.assert_array_equal(again.pressure, contact.pressure)


def test_contact_across_the_boundary_moves_with_the_surface(monkeypatch):
    heights = rough((256, 256), 3)
    summit = np.unravel_index(np.argmax(heights), heights.shape)
    corner = np.roll(heights, [-i for i in summit], (0, 1))
    contact = assert_same(monkeypatch, corner, 1.0, 5e-4)
    moved = np.roll(contact.gap, summit, (0, 1))
    expected = repulsive.solve(heights, 1.0, 5e-4)
    np.testing.assert_allclose(moved, expected.gap, atol=4e-8 * contact.rms_height)


@pytest.mark.parametrize("summit", [(0, 0), (255, 255), (0, 100)])
def test_contact_at_a_free_rim(monkeypatch, summit):
    heights = rough((256, 256), 3)
    highest = np.unravel_index(np.argmax(heights), heights.shape)
    shift = np.subtract(summit, highest)
    contact = assert_same(monkeypatch, np.roll(heights, shift, (0, 1)), 1.0, 5e-4, periodic=False)
    assert contact.pressure[summit] > 0


def test_candidates_grow(monkeypatch):
    # Candidates are first what touches or penetrates at a poor guess: others have to join.
    monkeypatch.setattr(dilute_contact, "_CANDIDATE_GAP", 0.0)
    monkeypatch.setattr("stickiness.repulsive.active_set.PREDICTION", 3.0)
    assert_same(monkeypatch, rough((256, 256), 1), 1.0, 2e-3)


@pytest.mark.parametrize("periodic", [True, False])
def test_one_and_two_points(periodic):
    heights = rough((256, 256), 2)
    first, second = (0, 20), (110, 255)
    # far too stiff a peak for others to touch
    heights[first] = heights.max() + 1.0
    contact = repulsive.solve(heights, 1.0, 1e-6, periodic=periodic)
    assert np.argwhere(contact.pressure).tolist() == [list(first)]
    assert contact.residual <= 1e-8
    heights[second] = heights[first]
    contact = repulsive.solve(heights, 1.0, 1e-6, periodic=periodic)
    assert np.argwhere(contact.pressure).tolist() == [list(first), list(second)]
    assert contact.pressure[first] == pytest.approx(contact.pressure[second])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("shape", "sides"), [((256, 256), (1.0, 1.0)), ((255, 131), (1.0, 131 / 255))]
)
@pytest.mark.parametrize(
    ("solid", "periodic"),
    [(HALF_SPACE, True), (Layer(thickness=0.05, poisson=0.4), True), (HALF_SPACE, False)],
)
def test_compliance_is_right_to_a_hundredth(shape, sides, solid, periodic):
    rng = np.random.default_rng(0)
    points = np.flatnonzero(rng.random(shape[0] * shape[1]) < 0.005)
    grid = _Grid(Problem(np.zeros(shape), sides, 1.0, solid, periodic), True)
    state = points, points[:0], np.zeros(shape).ravel(), 0.0
    candidates = dilute_contact.select_candidates(grid, None, *state)
    np.testing.assert_array_equal(candidates.points, points)
    pressure = rng.random(points.size).astype(np.float32)
    field = np.zeros(shape)
    field.flat[points] = pressure
    operator = half_space.half_space(shape, sides, solid=solid, periodic=periodic)
    expected = operator.compliance(field).flat[points]
    error = candidates.compliance(pressure) - expected
    assert np.abs(error).max() < 0.01 * np.ptp(expected)


@pytest.mark.parametrize(("shape", "sides"), [((128, 192), (1.0, 1.5)), ((192, 128), (1.5, 1.0))])
def test_compliance_on_a_small_grid_is_right_across_its_boundary(shape, sides):
    points = np.flatnonzero(np.random.default_rng(0).random(shape[0] * shape[1]) < 0.004)
    grid = _Grid(Problem(np.zeros(shape), sides, 1.0), True)
    state = points, points[:0], np.zeros(shape).ravel(), 0.0
    candidates = dilute_contact.select_candidates(grid, None, *state)
    field = np.zeros(shape)
    field.flat[points] = 1.0
    expected = half_space.half_space(shape, sides).compliance(field).flat[points]
    error = candidates.compliance(np.ones(points.size, np.float32)) - expected
    assert np.abs(error).max() < 0.02 * np.ptp(expected)
