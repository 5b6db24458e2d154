"""The map of validity: what counts as right, refused or failed, and that errors are detected."""

import warnings

import numpy as np
import pytest

from stability import components
from stability import contact_components as probes_contact
from stability import direction_components as probes_direction
from stability import layer_contact_components as layer_contact
from stability.components import FAILED, REFUSED, RIGHT, UNCONVERGED, Check, Component, probe_point
from stability.layers_components import THICK, find_response
from stability.probe_stability import COMPONENTS
from stickiness import adhesive, dmt, equivalent_sphere, spectrum
from stickiness.accuracy import model_choice, prediction
from stickiness.criteria import a_v_table
from stickiness.persson import layered_scales
from stickiness.remaining import prediction as remaining
from stickiness.repulsive import solver
from stickiness.solids import layers, moduli
from stickiness.spectrum import direction, sums


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


@pytest.mark.slow
@pytest.mark.parametrize("name", COMPONENTS)
def test_the_middle_of_every_map_is_right(name):
    component = COMPONENTS[name]
    found = probe_point(component, component.middle())
    assert found.outcome == RIGHT, found


@pytest.fixture
def forget_contacts():
    """No contact that was solved before or during the test is used again."""
    caches = probes_contact.solve_contact, layer_contact.press_layer
    for cache in caches:
        cache.cache_clear()
    yield
    for cache in caches:
        cache.cache_clear()


@pytest.mark.parametrize("name", ["repulsive", "layer-contact"])
@pytest.mark.parametrize(
    ("field", "factor"), [("pressure", 1.001), ("gap", 1.001), ("area_fraction", 1.01)]
)
@pytest.mark.usefixtures("forget_contacts")
def test_a_wrong_solver_is_detected(monkeypatch, name, field, factor):
    right = solver.solve

    def wrong(*arguments, **options):
        contact = right(*arguments, **options)
        object.__setattr__(contact, field, getattr(contact, field) * factor)
        return contact

    monkeypatch.setattr(solver, "solve", wrong)
    component = COMPONENTS[name]
    found = probe_point(component, component.middle())
    assert found.outcome == FAILED


def test_a_layer_of_another_thickness_is_detected(monkeypatch):
    right = adhesive.solve

    def wrong(*arguments, solid, **options):
        return right(*arguments, solid=solid.in_unit(1.001), **options)

    monkeypatch.setattr(adhesive, "solve", wrong)
    layer_contact.attach.cache_clear()
    component = COMPONENTS["layer-adhesion"]
    found = probe_point(component, component.middle())
    layer_contact.attach.cache_clear()
    assert found.outcome == FAILED


def test_the_boundary_value_problem_has_the_limits_of_thin_layers():
    """Long waves: k/2 if it slips, k (1 - 2 nu)/(2 (1 - nu)^2) and 2 k^3/3 if it is bonded."""
    k, nu = 1e-7, 0.3
    springs = 0.5 * k * (1 - 2 * nu) / (1 - nu) ** 2
    assert find_response(k, nu, "slip") == pytest.approx(k / 2, rel=1e-12)
    assert find_response(k, nu, "bonded") == pytest.approx(springs, rel=1e-12)
    assert find_response(k, 0.5, "bonded") == pytest.approx(2 / 3 * k**3, rel=1e-12)
    assert find_response(THICK, nu, "bonded") == pytest.approx(1, rel=1e-14)


@pytest.fixture
def no_spectra_kept():
    """Spectra of other tests know the right model, and those of this one the wrong one."""
    probes_direction.point_spectrum.cache_clear()
    yield
    probes_direction.point_spectrum.cache_clear()


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
        ("layers", layers.Layer, "factor"),
        ("backed-layers", layers.Layer, "_bonded"),
        ("layer-theory", layered_scales.LayeredScales, "mean_gap"),
        ("layer-remaining", remaining.Roughness, "threshold"),
        ("direction", direction.Ellipse, "mean_stretch"),
        ("direction", direction.Ellipse, "mean_psd"),
        ("directed-surfaces", direction.Ellipse, "norm"),
        ("sums", sums.Sum, "variance_above"),
    ],
)
def test_a_wrong_model_is_detected(monkeypatch, component, place, name, no_spectra_kept):
    right = getattr(place, name)
    monkeypatch.setattr(place, name, lambda *a, **options: 1.01 * right(*a, **options) + 1e-3)
    component = COMPONENTS[component]
    points = component.points()  # the first ones differ in a single parameter
    spread = points[:: max(1, len(points) // 6)]
    assert any(probe_point(component, point).outcome == FAILED for point in [*points[:12], *spread])
