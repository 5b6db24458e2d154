"""The map of validity: what counts as right, refused or failed, and that errors are detected."""

import warnings
from itertools import product
from types import SimpleNamespace

import matplotlib.image
import numpy as np
import pytest
from helpers.jobs import make_job

from stability import plot_stability, probe_stability
from stability.components import COMPONENTS, check
from stability.probe_stability import FAILED, REFUSED, RIGHT, UNCONVERGED, probe_point
from stickiness import datasets, spectrum
from stickiness.adhesive import Exponential
from stickiness.criteria import equivalent_sphere
from stickiness.persson.theory import Persson
from stickiness.remaining import prediction as remaining
from stickiness.repulsive import solver
from stickiness.solids import layers
from stickiness.spectrum.kinds import SelfAffine


def outcome(probe, **point):
    return probe_point(probe, **point)[0]


def points_of(component):
    """Its probe, and every combination of its values."""
    probe, values = COMPONENTS[component]
    return probe, [dict(zip(values, each, strict=True)) for each in product(*values.values())]


@pytest.mark.parametrize(
    ("errors", "expected"),
    [((0.0, 1.0), RIGHT), ((0.0, 1.1), FAILED), ((0.0, np.nan), FAILED), ((np.inf, 0.0), FAILED)],
)
def test_what_is_wrong_or_not_finite_has_failed(errors, expected):
    assert outcome(lambda: [check("a check", error, 1.0) for error in errors]) == expected


def test_only_the_library_refuses():
    assert outcome(lambda: spectrum.SelfAffine(hurst=2, q0=1, q1=2, h_rms=1)) == REFUSED

    def foreign():
        np.ones(3) + np.ones(4)

    def warns():
        warnings.warn("overflow", RuntimeWarning, stacklevel=1)

    for probe in (foreign, warns, lambda: 1 / 0, lambda: [][0]):
        assert outcome(probe) == FAILED


def test_giving_up_is_not_failing():
    heights = np.random.default_rng(1).normal(size=(32, 32))
    assert outcome(lambda: solver.solve(heights, 1.0, 0.1, max_iterations=1)) == UNCONVERGED


def test_what_takes_too_long_has_failed(monkeypatch):
    monkeypatch.setattr(probe_stability, "TIME_LIMIT", 0.05)

    def endless():
        while True:
            pass

    assert outcome(endless) == FAILED


@pytest.mark.parametrize("name", COMPONENTS)
def test_the_middle_of_every_map_is_right(name):
    probe, values = COMPONENTS[name]
    found = probe_point(probe, **{key: each[len(each) // 2] for key, each in values.items()})
    assert found[0] == RIGHT, found


@pytest.mark.parametrize(
    ("component", "place", "name"),
    [
        ("surface", SelfAffine, "elastic_energy"),
        ("theory", Persson, "area_fraction"),
        ("criteria", equivalent_sphere, "effect"),
        ("criteria", remaining.Roughness, "share"),
        ("layer", layers.Layer, "factor"),
        pytest.param("adhesion", Exponential, "traction", marks=pytest.mark.slow),
    ],
)
def test_a_wrong_model_is_detected(monkeypatch, component, place, name):
    right = getattr(place, name)
    monkeypatch.setattr(place, name, lambda *a, **options: 1.01 * right(*a, **options) + 1e-3)
    probe, points = points_of(component)
    step = max(1, len(points) // 8)
    spread = [*points[::step], *points[1::step]]
    assert any(outcome(probe, **point) == FAILED for point in spread)


@pytest.mark.parametrize(("field", "factor"), [("area_fraction", 1.2), ("pressure", 1.001)])
def test_a_wrong_solver_is_detected(monkeypatch, field, factor):
    right = solver.solve

    def wrong(*arguments, **options):
        contact = right(*arguments, **options)
        object.__setattr__(contact, field, getattr(contact, field) * factor)
        return contact

    monkeypatch.setattr(solver, "solve", wrong)
    probe, points = points_of("contact")
    assert outcome(probe, **points[len(points) // 2]) == FAILED


def test_map_is_stored_and_drawn(tmp_path, monkeypatch):
    files = []
    for name, axes in (("made", ("hurst", "grid")), ("up", ("hurst", "pressure"))):
        values = dict.fromkeys(axes, (0.2, 0.5, 0.8))
        component = lambda hurst, **_: [check("a check", hurst, 0.5)], values  # noqa: E731
        monkeypatch.setitem(COMPONENTS, name, component)
        job = make_job(tmp_path / f"{name}.nc", wildcards={"component": name})
        probe_stability.main(job)
        files += job.output
        data = datasets.read(files[-1])
        assert ((data.outcome == RIGHT) == (data.hurst <= 0.5)).all()
    outputs = [str(tmp_path / f"map.{suffix}") for suffix in ("png", "pdf")]
    plot_stability.main(SimpleNamespace(input=SimpleNamespace(components=files), output=outputs))
    assert matplotlib.image.imread(outputs[0])[..., :3].std() > 0.05
