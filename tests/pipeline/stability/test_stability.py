"""The map of validity: what counts as right, refused or failed, and that errors are detected."""

import warnings

import numpy as np
import pytest

from pipeline.stability import components
from pipeline.stability import contact as probes_contact
from pipeline.stability.components import (
    FAILED,
    REFUSED,
    RIGHT,
    UNCONVERGED,
    Check,
    Component,
    probe_point,
)
from stability.probe_stability import COMPONENTS
from stickiness import spectrum
from stickiness.accuracy import prediction
from stickiness.adhesion import dmt, equivalent_sphere, model_choice
from stickiness.contact import solver
from stickiness.criteria import a_v_table, moduli


def outcome(probe, **point):
    return probe_point(Component(probe, ()), point).outcome


def returning(*errors):
    return lambda: [Check("a check", error, 1.0) for error in errors]


@pytest.mark.parametrize(
    ("errors", "expected"),
    [((0.0, 1.0), RIGHT), ((0.0, 1.1), FAILED), ((0.0, np.nan), FAILED), ((np.inf, 0.0), FAILED)],
)
def test_what_is_wrong_or_not_finite_has_failed(errors, expected):
    assert outcome(returning(*errors)) == expected


def test_refusals_are_the_library_s_own_and_name_an_argument():
    assert outcome(lambda: spectrum.SelfAffine(hurst=2, q0=1, q1=2, h_rms=1)) == REFUSED

    def foreign():
        np.ones(3) + np.ones(4)

    def unnamed():
        raise ValueError("hurst")  # not from within the library

    for probe in (foreign, unnamed, lambda: 1 / 0, lambda: [][0]):
        assert outcome(probe) == FAILED


def test_a_warning_is_a_failure():
    assert outcome(lambda: warnings.warn("overflow", RuntimeWarning, stacklevel=1)) == FAILED


def test_giving_up_is_not_failing():
    def gives_up():
        heights = np.random.default_rng(1).normal(size=(32, 32))
        solver.solve(heights, 1.0, 0.1, max_iterations=1)

    assert outcome(gives_up) == UNCONVERGED


def test_what_takes_too_long_has_failed(monkeypatch):
    monkeypatch.setattr(components, "TIME_LIMIT", 0.05)

    def endless():
        while True:
            pass

    assert outcome(endless) == FAILED


def test_points_move_pairs_of_axes_and_each_comes_once():
    component = Component(
        returning(0.0),
        ("hurst", "unit", "grid"),
        pairs=(("hurst", "unit"),),
        variants=("a", "b"),
        further=({"grid": 1024},),
    )
    points = component.points()
    size = {name: len(component.values_of(name)) for name in component.axes}
    assert len(points) == 2 * (size["hurst"] * size["unit"] + size["grid"] - 1 + 1)
    assert len({tuple(point.items()) for point in points}) == len(points)


@pytest.mark.parametrize("name", COMPONENTS)
def test_the_middle_of_every_map_is_right(name):
    component = COMPONENTS[name]
    found = probe_point(component, component.middle())
    assert found.outcome == RIGHT, found


@pytest.mark.parametrize(
    ("field", "factor"), [("pressure", 1.001), ("gap", 1.001), ("area_fraction", 1.01)]
)
def test_a_wrong_solver_is_detected(monkeypatch, field, factor):
    right = solver.solve

    def wrong(*arguments, **options):
        contact = right(*arguments, **options)
        object.__setattr__(contact, field, getattr(contact, field) * factor)
        return contact

    monkeypatch.setattr(solver, "solve", wrong)
    probes_contact.solve_contact.cache_clear()
    try:
        component = COMPONENTS["repulsive"]
        found = probe_point(component, component.middle())
        assert found.outcome == FAILED
    finally:
        probes_contact.solve_contact.cache_clear()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("component", "place", "name"),
    [
        ("edge-adhesion", equivalent_sphere, "effect"),
        ("dmt-limit", dmt, "attraction_of_areas"),
        ("accuracy", prediction, "mean_variance"),
        ("moduli", moduli.Prony, "storage"),
        ("a_v-table", a_v_table.AvTable, "_drift"),
        ("model-choice", model_choice.ErrorTable, "relative_error"),
    ],
)
def test_a_wrong_model_is_detected(monkeypatch, component, place, name):
    right = getattr(place, name)
    monkeypatch.setattr(place, name, lambda *a, **options: 1.01 * right(*a, **options) + 1e-3)
    component = COMPONENTS[component]
    found = [probe_point(component, point).outcome for point in component.points()[:12]]
    assert FAILED in found
