"""Repulsive contact: conditions of contact, closed forms, invariances, extremes."""

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest
from helpers.rough import on_any_grid as rough
from hypothesis import given, settings
from hypothesis import strategies as st
from references import contact as reference
from references.contact import assert_contact_conditions, displacement, solve_directly

from stickiness import repulsive, spectrum, surface
from stickiness.measured.periodic import periodise
from stickiness.repulsive import half_space, subpixel
from stickiness.repulsive.solver import ConvergenceError
from stickiness.solids import Layer


def assert_solves(contact, heights, sides=(1.0, 1.0)):
    """Check the conditions of contact with plain transforms."""
    image = displacement(contact.pressure, sides)
    assert_contact_conditions(contact, heights, image, heights.std())


@pytest.mark.parametrize("hurst", [0.5, 0.8])
@pytest.mark.parametrize("scaled_pressure", [1e-3, 0.01, 0.065, 0.3, 1.0, 2.0])
def test_rough_surface_meets_the_contact_conditions(hurst, scaled_pressure):
    heights = rough(128, hurst, seed=1)
    contact = repulsive.solve(heights, 1.0, scaled_pressure * 2 * np.pi)
    assert_solves(contact, heights)


@pytest.mark.parametrize("shape", [(65, 63), (101, 101), (127, 64), (2, 2), (1, 64), (3, 128)])
def test_any_grid(shape):
    heights = np.random.default_rng(0).standard_normal(shape)
    sides = (1.0, shape[1] / shape[0])
    for pressure in (0.01, 1.0):
        contact = repulsive.solve(heights, 1.0, pressure)
        assert_solves(contact, heights, sides)


@pytest.mark.parametrize("shape", [(1, 10_000), (3, 1000), (5, 1000), (8, 1000), (1000, 5)])
def test_narrow_strips(shape):
    """Where releasing and admitting points at once goes round in circles."""
    heights = np.random.default_rng(0).standard_normal(shape)
    sides = (float(shape[0]), float(shape[1]))
    contact = repulsive.solve(heights, sides, 0.05, max_iterations=150)
    assert_solves(contact, heights, sides)


@pytest.mark.parametrize("shape", [(64, 64), (65, 48), (256, 256)])
@pytest.mark.parametrize("scaled_pressure", [1e-4, 0.01, 0.3, 3.0])
def test_a_mirrored_surface_is_solved_on_a_quarter_of_its_period(shape, scaled_pressure):
    heights = np.random.default_rng(0).standard_normal(shape)
    heights = half_space.half_space(shape, (1.0, 1.0), mirrored=True).compliance(heights)
    slope = half_space.measure_slope(heights, (1.0, 1.0), mirrored=True)
    contact = repulsive.solve(heights, (1.0, 1.0), scaled_pressure * slope, mirrored=True)
    period = periodise(heights, "mirror")
    assert half_space.measure_slope(period, (2.0, 2.0)) == pytest.approx(slope)
    fields = {name: periodise(getattr(contact, name), "mirror") for name in ("pressure", "gap")}
    assert_solves(replace(contact, **fields), period, sides=(2.0, 2.0))


def test_solution_is_that_of_a_direct_method():
    """Against the stationary point found by exhaustion of active sets, with dense algebra."""
    heights = rough(16, magnification=4, seed=3)
    n = heights.size
    columns = [displacement(row.reshape(16, 16), (1.0, 1.0)).ravel() for row in np.eye(n)]
    compliance = np.array(columns).T
    load = 1.0
    pressure, active, shift = solve_directly(compliance, heights, load)
    contact = repulsive.solve(heights, 1.0, load, tol=1e-11)
    np.testing.assert_array_equal(contact.pressure.ravel() > 0, active)
    # the largest stiffness, pi n, times the tolerance bounds the error of the pressure
    np.testing.assert_allclose(contact.pressure.ravel(), pressure, atol=1e-9)
    assert contact.shift == pytest.approx(shift, abs=1e-10)


@pytest.mark.parametrize("axis", [0, 1])
def test_westergaard_converges(axis):
    """Errors of the profile are of the order of one pixel at the edge, where p has a root."""
    wave = reference.Westergaard(amplitude=0.01, wavelength=1.0, pressure=0.012)
    errors = []
    for n in (64, 1024):
        x = (np.arange(n) + 0.5) / n
        profile = 0.01 * np.cos(2 * np.pi * x)
        heights = np.repeat(profile[:, None], 4, axis=1)
        sides = (1.0, 4 / n)
        heights, sides = (heights.T, sides[::-1]) if axis else (heights, sides)
        contact = repulsive.solve(heights, sides, 0.012)
        distance = np.minimum(x, 1 - x)
        pressure = contact.pressure[0] if axis else contact.pressure[:, 0]
        gap = contact.gap[0] if axis else contact.gap[:, 0]
        assert abs(contact.area_fraction - wave.area_fraction) < 2 / n
        assert contact.mean_gap == pytest.approx(wave.gap(x).mean(), rel=0.05 * 64 / n)
        np.testing.assert_allclose(gap, wave.gap(distance), atol=0.01 * 0.05 * 64 / n)
        expected = wave.contact_pressure(distance)
        errors.append(np.sqrt(np.mean((pressure - expected) ** 2)) / expected.max())
    # 16 times the points: the error falls at least like 1/sqrt(n), the root at the edge
    assert errors[1] < errors[0] / 4
    assert errors[1] < 1e-3


def test_wave_in_two_directions_against_both_limits():
    n = 256
    x = np.arange(n) / n
    heights = 0.01 * np.cos(2 * np.pi * x)[:, None] * np.cos(2 * np.pi * x)[None, :]
    full = reference.wave_full_contact_pressure(0.01, 1.0)
    small = repulsive.solve(heights, 1.0, 0.005 * full).area_fraction
    # 750 pixels in each spot: 2 %; interaction of the spots: the first correction is of order
    # (a / wavelength)**3, here below 1 %
    assert small == pytest.approx(reference.wave_area(0.005)[0], rel=0.04)
    holes = 1 - repulsive.solve(heights, 1.0, 0.98 * full).area_fraction
    # the holes are 610 pixels, their rim a tenth of it
    assert holes == pytest.approx(1 - reference.wave_area(0.98)[1], rel=0.05)
    assert repulsive.solve(heights, 1.0, 0.999 * full).area_fraction < 1
    assert repulsive.solve(heights, 1.0, 1.001 * full).area_fraction == 1


def test_full_contact_of_a_rough_surface():
    heights = rough(96, seed=4)
    exact = reference.elastic_pressure(heights, (1.0, 1.0))
    threshold = -exact.min()
    contact = repulsive.solve(heights, 1.0, 1.001 * threshold)
    np.testing.assert_allclose(contact.pressure, exact + 1.001 * threshold, atol=1e-11)
    assert contact.area_fraction == 1
    assert contact.mean_gap == 0
    assert contact.shift == pytest.approx(heights.mean(), abs=1e-12)
    almost = repulsive.solve(heights, 1.0, 0.98 * threshold)
    assert 0.95 < almost.area_fraction < 1
    assert_solves(almost, heights)


@pytest.mark.slow
def test_work_of_the_load_is_the_elastic_energy():
    """Energy balance: the load working against the mean gap stores the elastic energy."""
    heights = rough(64, seed=6)
    pressures = 2 * np.pi * np.geomspace(1e-6, 0.3, 400)
    path = list(repulsive.load_path(heights, 1.0, pressures, tol=1e-7))
    for contact in path[::50]:
        image = displacement(contact.pressure, (1.0, 1.0))
        assert_contact_conditions(contact, heights, image, heights.std(), tol=1e-7)
    gap = [contact.mean_gap for contact in path]
    energy = 0.5 * np.mean(path[-1].pressure * displacement(path[-1].pressure, (1.0, 1.0)))
    # the trapezoid rule over steps of 3 % in load: relative error of some 1e-4
    assert -np.trapezoid(pressures, gap) == pytest.approx(energy, rel=1e-3)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:(heights of|pressure =)")
@settings(max_examples=15, deadline=None, derandomize=True)
@given(
    seed=st.integers(0, 10_000),
    n0=st.integers(1, 24),
    n1=st.integers(1, 24),
    exponent=st.floats(-12, 6),
    levels=st.integers(1, 4),
)
def test_random_terraces(seed, n0, n1, exponent, levels):
    """Plateaus (ties of height) on any small grid, at any load."""
    heights = np.random.default_rng(seed).integers(0, levels + 1, (n0, n1)) * 0.5
    contact = repulsive.solve(heights, 1.0, 10**exponent)
    if heights.std() > 0:
        image = displacement(contact.pressure, (1.0, n1 / n0))
        # Rounding is that of the load, where it is large against the heights.
        assert_contact_conditions(contact, heights, image, heights.std() + 10**exponent)
    else:
        assert contact.area_fraction == 1


def test_no_load_and_flat_surfaces():
    heights = rough(32, seed=10)
    contact = repulsive.solve(heights, 1.0, 0.0)
    assert contact.pressure.max() == contact.area_fraction == contact.gap.min() == 0
    assert contact.mean_gap == pytest.approx(heights.max() - heights.mean())
    light = repulsive.solve(heights, 1.0, 1e-12)
    assert light.mean_gap == pytest.approx(contact.mean_gap, abs=1e-10)
    for level in (0.0, -3.5, 1e30):
        flat = repulsive.solve(np.full((12, 7), level), 1.0, 0.2)
        assert np.all(flat.pressure == 0.2)
        assert flat.gap.max() == flat.residual == 0
        assert flat.area_fraction == 1


@pytest.mark.parametrize(
    ("options", "worst"), [({"max_iterations": 2}, 1.0), ({"tol": 1e-18}, 1e-13)]
)
def test_failure_carries_the_best_iterate(options, worst):
    with pytest.raises(repulsive.ConvergenceError, match="max_iterations") as failure:
        repulsive.solve(rough(128, seed=16), 1.0, 0.4, **options)
    best = failure.value.contact
    assert options.get("tol", 1e-8) < failure.value.residual == best.residual < worst
    assert best.pressure.mean() == pytest.approx(0.4)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_rough_surface_at_vanishing_load_touches_at_its_summit(seed):
    band = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=4.0, h_rms=0.1)
    length = 2 * np.pi
    heights = surface.synthesise(band, n=512, length=length, seed=seed)
    summit = reference.highest_summit(heights, length)
    departures = []
    for pressure in (1e-4, 1e-5):
        contact = repulsive.solve(heights, length, pressure)
        ellipse = reference.HertzEllipse(summit.curvatures, pressure * length**2)
        touching = contact.pressure > 0
        area = contact.area_fraction - subpixel.boundary_strip(touching)
        departures.append(
            np.abs(
                [
                    area * length**2 / ellipse.area - 1,
                    contact.pressure.max() / ellipse.largest_pressure - 1,
                    (summit.height - contact.shift) / ellipse.indentation - 1,
                ]
            )
        )
    # The spot is 7 to 20 points across and 1/10 of the shortest wavelength at the lighter load,
    # where the summit departs from a paraboloid by some per cent; that departure and the field
    # of the neighbouring cells grow with the size of the spot, as the cube root of the load.
    assert np.all(departures[1] < [0.05, 0.012, 0.06])
    assert departures[1][2] < 0.6 * departures[0][2]


@pytest.mark.parametrize(
    "options",
    [{}, {"solid": Layer(0.1, 0.3)}, {"periodic": False}],
    ids=["half-space", "layer", "free edges"],
)
@pytest.mark.parametrize("scaled_pressure", [0.002, 0.1])
def test_threads_do_not_change_a_bit(scaled_pressure, options):
    heights = rough(384, seed=1)
    alone, *shared = (
        repulsive.solve(heights, 1.0, scaled_pressure * 2 * np.pi, threads=n, **options)
        for n in (1, 2, 3)
    )
    for contact in shared:
        np.testing.assert_array_equal(contact.pressure, alone.pressure)
        np.testing.assert_array_equal(contact.gap, alone.gap)
        assert (contact.shift, contact.residual) == (alone.shift, alone.residual)


@pytest.mark.parametrize(("pressure", "arrays"), [(0.02, 7.0), (2.0, 9.0)])
def test_memory_in_arrays_of_the_grid(pressure, arrays):
    """Beside the heights; kept operators of coarser grids and small buffers are one of them."""
    heights = rough(512, 0.8, seed=1)
    repulsive.solve(heights[:256, :256], 1.0, 1e-3, tol=1e-3)  # compiles loops
    half_space.clear_caches()
    tracemalloc.start()
    repulsive.solve(heights, 1.0, pressure, tol=1e-6)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < arrays * heights.nbytes


@pytest.mark.parametrize(
    ("scaled_pressure", "tol", "most"), [(0.02, 1e-4, 21), (0.065, 1e-4, 26), (1.5, 1e-9, 47)]
)
def test_convolutions_of_a_rough_contact(scaled_pressure, tol, most):
    """17.9, 21.1 and 37.8 when this was written."""
    band = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=16.0, h_rms=1.0)
    heights = surface.synthesise(band, n=128, length=2 * np.pi, seed=3)
    contact = repulsive.solve(heights, 2 * np.pi, scaled_pressure, tol=tol)
    assert contact.residual <= tol
    assert contact.fft_pairs < most


def test_convolutions_of_a_contact_on_a_thin_layer():
    """62.2 when this was written; 83 if every set is solved to one iteration alone."""
    band = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=16.0, h_rms=1.0)
    heights = surface.synthesise(band, n=128, length=2 * np.pi, seed=3)
    contact = repulsive.solve(heights, 2 * np.pi, 2.0, tol=1e-8, solid=Layer(0.3, 0.5))
    assert contact.residual <= 1e-8
    assert contact.fft_pairs < 74


def test_an_error_without_an_iterate_has_no_residual():
    error = ConvergenceError("no state converged", None)
    assert error.contact is None
    assert np.isnan(error.residual)
