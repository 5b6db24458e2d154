"""Error budgets: sources, total and the largest of them, and what is not known."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from helpers.entries import model_surface

from cases import answer_case
from common import error_budgets
from stickiness import datasets
from stickiness import error_budget as budget
from stickiness.accuracy.error_models import Surface, read_models, single_error
from stickiness.accuracy.settings import Problem

LAWS = read_models(Path(__file__).parents[2] / "config/accuracy.csv")
NONE = budget.not_applicable("made up")


def quoted(values, **parts):
    """Dataset of one variable `q` with a budget."""
    dataset = xr.Dataset({"q": ("x", np.array(values, float))}, {"x": np.arange(len(values))})
    datasets.annotate(dataset, q=("m", "height"), x=("1", "place"))
    return budget.with_budget(dataset, "q", **{**dict.fromkeys(budget.SOURCES, NONE), **parts})


def test_errors_add_in_quadrature_and_the_largest_is_named():
    grid = budget.ErrorComponent(xr.DataArray([3.0, -1.0], dims="x"), "of the grid")
    found = quoted(
        [10.0, 20.0], discretisation=grid, model=budget.ErrorComponent(4.0, "of the model")
    )
    np.testing.assert_allclose(found.q_total_error, [5.0, np.sqrt(17)])
    assert budget.dominant(found.isel(x=0), "q") == "model"
    np.testing.assert_allclose(budget.part(found, "q", "discretisation"), [3.0, 1.0])
    assert found.q.attrs["ancillary_variables"] == "q_error q_total_error q_dominant"
    assert found.q_error.attrs["units"] == found.q_total_error.attrs["units"] == "m"
    for text in ("discretisation: of the grid", "solver: none, made up"):
        assert text in found.q_error.attrs["comment"]


def test_errors_that_are_not_known_and_values_that_are_not_there():
    found = quoted(
        [1.0], sampling=budget.unknown_error("a single seed"), model=budget.ErrorComponent(9.0, "m")
    )
    assert np.isnan(found.q_total_error).all()
    assert budget.dominant(found.isel(x=0), "q") == "sampling"  # it counts as the largest
    assert "a single seed" in found.q_total_error.attrs["nan_means"]
    found = quoted(
        [1.0, np.nan], model=budget.ErrorComponent(xr.DataArray([0.0, 1.0], dims="x"), "m")
    )
    assert [budget.dominant(found.isel(x=i), "q") for i in (0, 1)] == ["none", "none"]
    assert np.isnan(found.q_error.isel(x=1)).all()


def ensemble_of(seeds, **more):
    made = model_surface() | {"pixels_per_wavelength": 8, "tolerance": 1e-6}
    return error_budgets.Simulation(LAWS, {**made, "seeds": list(range(seeds)), **more})


@pytest.mark.parametrize(("seeds", "factor"), [(2, 6.314), (8, 1.895)])
def test_sampling_covers_90_per_cent_by_students_t(seeds, factor):
    value = xr.DataArray([0.05], dims="pressure", coords={"pressure": [0.065]})
    parts = ensemble_of(seeds).parts("area_fraction", value, 0.01 * value, 0.002 * value)
    assert float(parts["sampling"].error[0]) == pytest.approx(factor * 5e-4, rel=1e-3)
    surface = Surface(0.8, 32)
    solver = single_error(LAWS, "solver", "area", surface, 0.065, tolerance=1e-6)
    assert float(parts["solver"].error[0]) == pytest.approx(solver * 0.05)


@pytest.mark.parametrize(
    ("name", "along"),
    [("attractive_area", {"range": [1e-3, 0.03, 1.0]}), ("gap_density", {"gap": [1e-3, 0.1, 3.0]})],
)
def test_what_was_measured_is_not_widened_outside_the_laws(name, along):
    shape = {"pressure": [0.065], **along}
    value = xr.DataArray(np.ones((1, 3)), dims=list(shape), coords=shape)
    parts = ensemble_of(8).parts(name, value, 0.01 * value, 0.002 * value)
    np.testing.assert_allclose(parts["sampling"].error, 0.01895, rtol=1e-3)
    solver = parts["solver"].error.values.ravel()
    assert solver[0] >= 1.9 * single_error(
        LAWS, "solver", "gap_distribution" if name == "gap_density" else "attractive_area_0.01",
        Surface(0.8, 32), 0.065, tolerance=1e-6,
    )  # fmt: skip


def test_an_accuracy_of_which_nothing_is_known_is_missed():
    at = {"column": ["area", "a_v"], "pressure": [0.01, 0.1]}
    known = xr.DataArray([[0.01, 0.01], [0.01, np.nan]], dims=list(at), coords=at)
    answer = xr.Dataset({"value": xr.ones_like(known), "value_total_error": known})
    problem = Problem(LAWS, Surface(0.8, 32), at["pressure"], at["column"])
    text = answer_case.describe_miss(answer, problem, None, {"accuracy": 0.05}, "mine")
    assert text == "error of a_v at pressure 0.1 not known"


def test_errors_between_the_measured_ranges_follow_a_power_law():
    ranges = xr.DataArray([0.001, 0.01, np.sqrt(1e-3), 0.1, 1.0], dims="range")
    found = error_budgets.interpolate_ranges(
        {0.01: xr.DataArray(0.04), 0.1: xr.DataArray(0.01)}, ranges
    )
    np.testing.assert_allclose(found, [0.08, 0.04, 0.02, 0.01, 0.02])


def test_theory_errs_as_measured_and_elsewhere_by_more():
    axes = {"variant": ["afferrante2018", "almqvist2011"], "pressure": [0.01, 0.065]}
    like = xr.DataArray(np.ones((2, 2)), axes, tuple(axes))
    made = model_surface()
    found = error_budgets.theory_error(LAWS, "mean_gap", like, made)
    surface = Surface(0.8, 32)
    wanted = [single_error(LAWS, "theory", "mean_gap", surface, p) for p in (0.01, 0.065)]
    np.testing.assert_allclose(found.sel(variant="afferrante2018"), wanted)
    assert np.isnan(found.sel(variant="almqvist2011")).all()  # which nobody has measured
    for other in ({"rolloff": 3.0}, {"amplitudes": "fixed"}):
        wider = error_budgets.theory_error(LAWS, "mean_gap", like, made | other)
        np.testing.assert_allclose(wider, 2 * found)
