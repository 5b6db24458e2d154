"""Contact of a surface that does not repeat: closed forms, dense algebra."""

import numpy as np
import pytest
from helpers.rough import periodic
from references import contact as reference
from references.contact import solve_directly
from scipy import integrate

from stickiness import repulsive
from stickiness.repulsive import (
    active_set,
    free_edges,
    half_space,
    projected_gradients,
    solver,
)

pytestmark = pytest.mark.processors

PATCH = (12, 10)
SIDES = (1.0, 1.5)


def rough(shape, modes=12, seed=0):
    """Self-affine heights of unit rms; cut from a periodic surface, so that edges do not match."""
    n = 2 * max(shape)
    heights = periodic((n, n), modes, seed=seed)[: shape[0], : shape[1]]
    return heights / heights.std()


def paraboloid(n, center=(0.5, 0.5), side=1.0):
    """Heights of a paraboloid of radius one, at the middle of pixels."""
    x = (np.arange(n) + 0.5) * side / n
    return -((x[:, None] - center[0]) ** 2 + (x[None, :] - center[1]) ** 2) / 2


def solve(heights, length, pressure, **options):
    return repulsive.solve(heights, length, pressure, periodic=False, **options)


def compliance_matrix(shape, sides):
    """Displacement of every pixel under unit pressure on every other, one by one."""
    pixel = [a / n for a, n in zip(sides, shape, strict=True)]
    kernel = half_space.displace_by_pixel(shape, pixel)
    i, j = (index.ravel() for index in np.indices(shape))
    return kernel[np.abs(i[:, None] - i), np.abs(j[:, None] - j)]


def test_kernel_is_the_integral_of_one_over_r():
    pixel = (0.1, 0.25)
    kernel = half_space.displace_by_pixel((4, 4), pixel)
    for i, j in [(1, 0), (0, 1), (2, 3), (3, 1)]:
        integral, _ = integrate.dblquad(
            lambda y, x: 1 / np.hypot(x, y),
            *((i - 0.5) * pixel[0], (i + 0.5) * pixel[0]),
            *((j - 0.5) * pixel[1], (j + 0.5) * pixel[1]),
            epsrel=1e-11,
        )
        assert kernel[i, j] == pytest.approx(integral / np.pi, rel=1e-9)
    # middle of a square of side s: 4 s ln(1 + sqrt 2) / pi (Johnson 1985, section 3.3)
    square = half_space.displace_by_pixel((1, 1), (0.3, 0.3))
    assert square[0, 0] == pytest.approx(4 * 0.3 * np.log(1 + np.sqrt(2)) / np.pi, rel=1e-14)


@pytest.mark.parametrize(("dtype", "accuracy"), [(np.float64, 1e-14), (np.float32, 1e-6)])
@pytest.mark.parametrize("shape", [(12, 10), (7, 11), (1, 1)])
def test_convolution_is_the_direct_sum(shape, dtype, accuracy):
    operator = half_space.half_space(shape, SIDES, dtype, periodic=False)
    pressure = np.random.default_rng(0).random(shape)
    expected = compliance_matrix(shape, SIDES) @ pressure.ravel()
    found = operator.compliance(pressure.astype(dtype)).ravel()
    np.testing.assert_allclose(found, expected, rtol=accuracy)
    # Some rows only: the others of the output stay as they are.
    rows_in, rows_out = (np.unique(np.minimum(r, shape[0] - 1)) for r in ([0, 2], [0, 6]))
    pressure[np.setdiff1d(np.arange(shape[0]), rows_in)] = 0
    expected = operator.compliance(pressure.astype(dtype))
    out = np.full(shape, 7, dtype)
    operator.compliance(pressure.astype(dtype), out, rows_in, rows_out)
    np.testing.assert_allclose(out[rows_out], expected[rows_out], rtol=accuracy)
    assert np.all(np.delete(out, rows_out, axis=0) == 7)


@pytest.mark.parametrize(
    ("dtype", "split", "accuracy"),
    [
        (np.float32, free_edges.COARSE, 3e-3),
        (np.float32, free_edges.SINGLE, 2e-5),
        (np.float64, free_edges.DOUBLE, 5e-10),
    ],
)
@pytest.mark.parametrize(
    ("shape", "sides"), [((256, 256), (1, 1)), ((131, 262), (1, 2)), ((255, 133), (2, 0.8))]
)
def test_split_is_the_convolution(shape, sides, dtype, split, accuracy):
    rng, pixel = np.random.default_rng(0), tuple(a / n for a, n in zip(sides, shape, strict=True))
    size, width = shape[0] * shape[1], shape[1]
    points = np.union1d([0, size - 1], rng.integers(size, size=300))
    rims = np.r_[:width, size - width : size]
    for some, factor in ((points[:1], 1), (points, 1), (rims, 2)):
        field, out = np.zeros(shape), np.empty(shape, dtype)
        field.flat[some] = values = rng.random(some.size)
        expected = half_space.half_space(shape, sides, periodic=False).compliance(field)
        free_edges.Split(shape, pixel, dtype, split).displace(some, values, out)
        np.testing.assert_allclose(out, expected, rtol=0, atol=factor * accuracy * expected.max())


@pytest.mark.parametrize(("radius", "n"), [(0.05, 256), (0.1, 128), (0.3, 64)])
def test_hertz_without_images(radius, n):
    """Also the approach, which a periodic surface does not have."""
    hertz = reference.Hertz(1.0, 4 / 3 * radius**3)
    contact = solve(paraboloid(n), 1.0, hertz.load)
    pixel = 1 / (n * radius)
    assert contact.pressure.sum() / n**2 == pytest.approx(hertz.load, rel=1e-12)
    assert np.sqrt(contact.area_fraction / np.pi) == pytest.approx(radius, rel=0.2 * pixel)
    # the summit, at height zero, lies between pixels
    assert -contact.shift == pytest.approx(hertz.indentation, rel=0.1 * pixel**2)
    assert contact.pressure.max() == pytest.approx(hertz.largest_pressure, rel=0.3 * pixel**2)
    x = (np.arange(n) + 0.5) / n - 0.5
    r = np.hypot(x[:, None], x[None, :])
    outside = r > 1.3 * radius
    np.testing.assert_allclose(
        contact.gap[outside], hertz.gap(r)[outside], rtol=0, atol=0.3 * pixel**2 * radius**2
    )


def test_elliptic_paraboloid():
    ellipse = reference.HertzEllipse((0.5, 2.0), 4 / 3 * 0.1**3)
    x = (np.arange(256) + 0.5) / 256 - 0.5
    contact = solve(-(0.5 * x[:, None] ** 2 + 2.0 * x[None, :] ** 2) / 2, 1.0, ellipse.load)
    # 29 by 11 pixels from the middle
    assert -contact.shift == pytest.approx(ellipse.indentation, rel=1e-3)
    assert contact.pressure.max() == pytest.approx(ellipse.largest_pressure, rel=1e-3)
    assert contact.area_fraction == pytest.approx(ellipse.area, rel=0.02)


def test_flat_square_punch():
    """Force over approach is that of charge over potential of a square plate.

    The capacitance of a square of side s is 0.36679 s times 4 pi eps0 (Hwang and Mascagni, J. Appl.
    Phys. 95:3798, 2004): F = 0.36679 pi E* s approach. Pixels are as soft as s/n is small.
    """
    forces = []
    for n in (64, 128, 256):
        contact = solve(np.full((n, n), 3.0), 2.0, 0.01)
        assert contact.area_fraction == 1
        assert contact.mean_gap == contact.rms_height == 0
        forces.append(0.01 * 2.0**2 / (2.0 * contact.approach))
    assert forces[0] < forces[1] < forces[2]
    order = np.log2((forces[1] - forces[0]) / (forces[2] - forces[1]))
    assert order == pytest.approx(1, abs=0.05)
    assert 2 * forces[2] - forces[1] == pytest.approx(0.36679 * np.pi, rel=1e-4)


@pytest.mark.parametrize("load", [0.03, 3.0, 300.0])
def test_solution_is_that_of_a_direct_method(load):
    heights = rough(PATCH, modes=5, seed=3)
    pressure, active, shift = solve_directly(compliance_matrix(PATCH, SIDES), heights, load)
    contact = solve(heights, SIDES, load, tol=1e-11)
    np.testing.assert_array_equal(contact.pressure.ravel() > 0, active)
    # the largest stiffness, about pi n / 2, times the tolerance bounds the error of the pressure
    np.testing.assert_allclose(contact.pressure.ravel(), pressure, atol=1e-9)
    assert contact.shift == pytest.approx(shift, abs=1e-10 * max(load, 1))


@pytest.mark.slow
@pytest.mark.parametrize("scaled_pressure", [1e-3, 0.065, 0.3, 2.0])
def test_two_methods_one_solution(scaled_pressure):
    """From coarser grids by active sets, and by projected gradients from a uniform pressure."""
    heights, load = rough((130, 128), seed=1), scaled_pressure * 2 * np.pi
    sides = (1.0, 128 / 130)
    contact = solve(heights, sides, load, tol=1e-9)
    assert contact.residual <= 1e-9
    rms = contact.rms_height
    problem = active_set.Problem(
        (heights - heights.mean()) / rms, sides, load / rms, periodic=False
    )
    uniform = np.ones_like(heights)
    state = projected_gradients.relax(problem, uniform, tol=1e-9, max_iterations=300)
    assert state.residual <= 1e-9
    np.testing.assert_allclose(state.pressure * rms, contact.pressure, atol=1e-9 * 10 * np.pi * 130)
    # single points at zero pressure and zero gap may fall on either side
    assert state.area_fraction == pytest.approx(contact.area_fraction, abs=3 / heights.size)
    assert contact.mean_gap == pytest.approx(float(state.gap.mean()) * rms, rel=1e-7)


def test_images_in_a_periodic_cell():
    """Beside the periodic solution of a small contact, whose images are known.

    The unit charges of a square lattice of constant D and a uniform background that neutralises
    them displace a point of the lattice by -3.900265/D (Bonsall and Maradudin, Phys. Rev. B
    15:1959, 1977; twice the energy); the curvature of that goes as D**-3.
    """
    n, force = 64, 4 / 3 * 0.3**3
    heights = paraboloid(n)
    alone = solve(heights, 1.0, force)
    for cells in (2, 4):
        wide = np.full((cells * n, cells * n), -5.0)
        wide[:n, :n] = heights
        contact = repulsive.solve(wide, float(cells), force / cells**2)
        assert not contact.pressure[n:].any()
        moved = 3.900265 / np.pi * force / cells
        assert contact.shift - alone.shift == pytest.approx(moved, rel=(0.3 / cells) ** 2)
        inside = heights > -((0.8 * 0.3) ** 2) / 2
        # 19 pixels to the radius: the kernels of the two differ between neighbours
        np.testing.assert_allclose(
            contact.pressure[:n, :n][inside], alone.pressure[inside], rtol=0.02 / cells**3 + 2e-3
        )


def test_no_load():
    heights = rough(PATCH)
    contact = solve(heights, SIDES, 0.0)
    assert contact.approach == contact.area_fraction == 0
    assert contact.shift == heights.max()
    np.testing.assert_array_equal(contact.gap, heights.max() - heights)
    assert np.isnan(repulsive.solve(heights, SIDES, 0.1).approach)  # periodic


def test_coarser_grids_guess_for_any_rectangle(monkeypatch):
    """Odd and unequal numbers of points, against the contact without a guess."""
    heights = rough((37, 21))
    alone = solve(heights, SIDES, 0.5)
    monkeypatch.setattr(solver, "_MIN_COARSE_POINTS", 8)
    guessed = solve(heights, SIDES, 0.5)
    assert guessed.fft_pairs != alone.fft_pairs
    np.testing.assert_allclose(guessed.pressure, alone.pressure, atol=1e-5)
    assert guessed.shift == pytest.approx(alone.shift, abs=1e-6)
