"""The limit of fine grids: from solutions to means of ensembles and what derives from them."""

import numpy as np
import pytest
import xarray as xr

from common import continuum_values, ensemble_means
from common.contact_curves import load_curve
from common.derived_quantities import average_a_v, fit_intervals, fit_slope, slope_of_area
from contact.ensembles import AVERAGED, add_statistics
from stickiness import spectrum, surface
from stickiness.repulsive import richardson

LOADS = np.array([0.02, 0.2])
RANGES = np.geomspace(1e-3, 10, 33)
MAGNIFICATION, SEEDS = 8, (1, 2, 3)
WINDOWS = [[0.03, 0.3], [0.3, 3]]


def solve(pixels, steps):
    """Solutions of a few surfaces, on a grid and on every second or fourth point of it."""
    wide = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=MAGNIFICATION, h_rms=1.0)
    seeds = []
    for seed in SEEDS:
        heights = surface.synthesise(wide, MAGNIFICATION * pixels, 2 * np.pi, seed)
        curves = [load_curve(heights[::k, ::k], 2 * np.pi, LOADS, RANGES, 1e-8) for k in steps]
        grids = xr.DataArray([pixels / k for k in steps], dims="resolution", name="resolution")
        curve = xr.concat(curves, grids)
        seeds.append(curve.assign(rms_slope=surface.moments(heights, 2 * np.pi).rms_slope))
    return xr.concat(seeds, xr.DataArray(list(SEEDS), dims="seed", name="seed"))


@pytest.fixture(scope="module")
def solved():
    return solve(8, (4, 2, 1))


@pytest.fixture(scope="module")
def ensemble(solved):
    return add_statistics(solved, xr.Dataset())


@pytest.mark.parametrize(
    ("grids", "chosen"),
    [([2, 4], [0, 1]), ([2, 4, 8], [0, 1, 2]), ([2, 8, 16], [1, 2]), ([1, 2, 4, 8], [1, 2, 3])],
)
def test_grids_are_those_of_doubled_resolution(grids, chosen):
    assert (
        continuum_values.find_halved(xr.Dataset(coords={"resolution": np.array(grids, float)}))
        == chosen
    )


@pytest.mark.slow
def test_errors_cover_what_finer_grids_change(solved, ensemble):
    """Against 32 points per wavelength, whose own error is a few times less than at 8."""
    finer = solve(32, (1,)).isel(resolution=0)
    for name, quantity in AVERAGED.items():
        miss = abs(ensemble[f"{name}_mean"] - quantity(finer).mean("seed"))
        error = ensemble[f"{name}_discretisation_error"]
        if name == "gap_density":  # of ever fewer pixels where the largest gaps end
            miss, error = miss.sel(gap=slice(2)), error.sel(gap=slice(2))
        # Meant to cover 90 % of single surfaces; ranges are correlated and the surfaces few.
        assert (miss <= error).mean() > 0.8, name
        # and not by being far too large
        assert np.sqrt((error**2).mean()) < 15 * np.sqrt((miss**2).mean()), name


def test_attractive_areas_alone_are_extrapolated_and_below_the_edge_gap_alone(solved, ensemble):
    for name, quantity in AVERAGED.items():
        shift = ensemble[f"{name}_mean"] - ensemble_means.mean(quantity(solved))
        if name == "attractive_area":
            below = ensemble["range"] < richardson.RULES[name].resolved * ensemble.edge_gap_mean
            np.testing.assert_array_equal(shift != 0, below.transpose(*shift.dims))
            np.testing.assert_allclose(shift, ensemble.attractive_area_extrapolation, atol=1e-15)
        else:
            np.testing.assert_array_equal(shift, 0)


def test_nothing_is_extrapolated_or_uncertain_where_there_is_no_edge(solved):
    closed = solved.copy()
    for name in ("edges", "edge_gap", "attractive_area", "pixel_attractive_area"):
        closed[name] = 0 * closed[name]
    closed["area_fraction"] = closed["pixel_area_fraction"] = 0 * closed.area_fraction + 1
    for name, quantity in AVERAGED.items():
        limit = continuum_values.estimate(name, closed, quantity)
        np.testing.assert_array_equal(limit.shift, 0)
        if name == "area_fraction":
            np.testing.assert_array_equal(limit.error, 0)


def test_slopes_inherit_the_relative_error_of_the_area(ensemble):
    limit = continuum_values.inherit(ensemble, slope_of_area, ["area_fraction"])
    relative = ensemble.area_fraction_discretisation_error / ensemble.area_fraction_mean
    mean = ensemble.area_fraction_mean * ensemble.rms_slope.mean() / ensemble.pressure
    np.testing.assert_allclose(limit.error, mean * relative, rtol=1e-9)
    np.testing.assert_array_equal(limit.shift, 0)
    fit = continuum_values.inherit(ensemble, fit_slope, ["area_fraction"])
    assert limit.error.min() < fit.error < limit.error.max()


def test_a_v_is_that_of_the_extrapolated_areas(ensemble):
    """A fit is linear in the areas: the fit of the mean is the mean of the fits."""
    dataset = average_a_v(fit_intervals(ensemble, WINDOWS), ensemble, WINDOWS)
    for variable, fit in (
        ("attractive_area_mean", "a_v_mean"),
        ("attractive_area_discretisation_error", "a_v_discretisation_error"),
    ):
        area = ensemble[["pressure", variable]].rename({variable: "attractive_area"})
        # Discretisation errors are small differences of fits of order 1, exact to their rounding.
        np.testing.assert_allclose(
            dataset[fit], fit_intervals(area, WINDOWS).a_v, rtol=1e-9, atol=1e-11
        )
    np.testing.assert_allclose(
        dataset.a_v_standard_error, ensemble_means.standard_error(dataset.a_v), rtol=1e-12
    )


def test_errors_of_two_means_add_in_quadrature(ensemble):
    def product(solved):
        return solved.area_fraction * solved.mean_gap

    found = continuum_values.inherit(ensemble, product, ["area_fraction", "mean_gap"])
    relative = [
        ensemble[f"{name}_discretisation_error"] / ensemble[f"{name}_mean"]
        for name in ("area_fraction", "mean_gap")
    ]
    mean = ensemble.area_fraction_mean * ensemble.mean_gap_mean
    np.testing.assert_allclose(found.error, mean * np.hypot(*relative), rtol=1e-6)
