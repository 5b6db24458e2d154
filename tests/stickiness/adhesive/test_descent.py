"""Descents: their preconditioner, states that are not numbers, the quick one beside the general."""

import numpy as np
import pytest

from stickiness import adhesive, repulsive, solids, spectrum, surface
from stickiness.adhesive import equilibrium
from stickiness.adhesive.descent import descend
from stickiness.adhesive.preconditioner import LONGEST, Smoother
from stickiness.adhesive.problem import Problem
from stickiness.adhesive.softening_descent import quick_descent
from stickiness.adhesive.solver import Scaled
from stickiness.solids import HALF_SPACE

pytestmark = pytest.mark.processors

SOLIDS = (
    HALF_SPACE,
    solids.Layer(thickness=0.1, poisson=0.45),
    solids.Layer(0.01, 0.5, solids.Film(10.0, 0.3, 0.02)),
    solids.Skin(0.01, 1e-3, 0.5, 0.5),
)


@pytest.mark.parametrize("shape", [(64, 48), (63, 48), (2, 64)])
def test_the_preconditioner_nearly_inverts_the_stiffness(shape):
    smoother = Smoother(shape, (1.0, shape[1] / shape[0]), HALF_SPACE)
    wave = np.cos(2 * np.pi * np.arange(shape[1]) / shape[1]).astype(np.float32)
    field = np.tile(wave, (shape[0], 1))
    stiffness = np.pi * shape[0] / shape[1] + LONGEST
    np.testing.assert_allclose(smoother.apply(field), field / stiffness, atol=0.01 / stiffness)
    # It is symmetric, and positive for short waves, too.
    a, b = np.random.default_rng(0).standard_normal((2, *shape)).astype(np.float32)
    work = float(np.vdot(a, smoother.apply(a)))
    assert np.vdot(a, smoother.apply(b)) == pytest.approx(
        np.vdot(b, smoother.apply(a)), abs=1e-4 * work
    )
    checks = np.indices(shape).sum(0).astype(np.float32) % 2 - np.float32(0.5)
    assert np.vdot(checks, smoother.apply(checks)) > 0


@pytest.mark.parametrize("shape", [(12, 12), (24, 6), (6, 24), (9, 12)])
@pytest.mark.parametrize("solid", SOLIDS)
def test_what_counts_as_surely_stable_is_stable(shape, solid):
    """Against the eigenvalues of the energy's curvature, from weak adhesion to strong."""
    random = np.random.default_rng(4)
    sides = (1.0, shape[1] / shape[0])
    judged = []
    softest = Smoother(shape, sides, solid).shift
    for strength in softest * np.geomspace(0.03, 100, 150):
        law = adhesive.Exponential(adhesion_length=strength, range=1.0)
        problem = Problem(np.zeros(shape), sides, law, 1.0, solid=solid, mean_gap=1.0)
        # A random part touches; or half of the cell, along its longer side, is near, or a pixel.
        pixel = np.full(shape, 4.0)
        pixel[1, 1] = 0.1
        place = np.indices(shape)[np.argmax(shape)]
        gaps = (
            np.maximum(random.normal(0.5, 1.0, shape), 0.0),
            np.where(place < max(shape) / 2, 0.1, 4.0),
            pixel,
        )
        state = problem.state(gaps[random.integers(3)])
        # Curvature of the energy for changes of open gaps that keep their mean.
        points = np.eye(state.gap.size).reshape(-1, *shape)
        curvature = np.array([problem.exact.stiffness(point).ravel() for point in points])
        curvature += np.diag(state.slope.ravel())
        is_open = state.gap.ravel() > 0
        change = np.eye(is_open.sum()) - 1 / is_open.sum()
        modes = np.linalg.eigvalsh(change @ curvature[np.ix_(is_open, is_open)] @ change)
        stable = modes[0] > -1e-12
        surely = equilibrium._surely_stable(problem, state)
        assert stable or not surely
        judged.append((surely, stable))
    # At least a quarter of the stable states are known to be.
    assert sum(stable for _, stable in judged) <= 4 * sum(surely for surely, _ in judged)
    assert not all(stable for _, stable in judged)


@pytest.mark.parametrize("control", [{"pressure": 0.1}, {"mean_gap": 2.0}])
@pytest.mark.parametrize("field", ["gap", "elastic"])
def test_what_is_not_a_number_is_no_equilibrium(control, field):
    heights = np.random.default_rng(1).standard_normal((16, 16))
    law = adhesive.Exponential(adhesion_length=1e-3, range=0.1)
    problem = Problem(heights, (1.0, 1.0), law, 1.0, **control)
    fields = {"gap": np.ones((16, 16)), "elastic": np.zeros((16, 16))}
    assert np.isfinite(problem.state(**fields).residual)
    fields[field][3, 5] = np.nan
    assert np.isnan(problem.state(**fields).residual)
    if "pressure" in control and field == "gap":
        after, _ = quick_descent(problem, fields["gap"], 1e-8, 100)
        assert not after.residual <= 1e-8


def test_quick_descent_agrees_with_the_general_one_at_a_mean_gap():
    length = 2 * np.pi
    band = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=16.0, h_rms=1.0)
    heights = surface.synthesise(band, n=128, length=length, seed=3)
    law = adhesive.Exponential(adhesion_length=0.01, range=0.1)
    contact = repulsive.solve(heights, length, 0.065, tol=1e-8)
    scaled = Scaled.of(heights, (length, length), law)
    problem = scaled.problem(mean_gap=contact.mean_gap)
    gap = scaled.first_gap(contact, contact.mean_gap)
    slow = descend(problem, gap, 1e-8, 300)
    quick, finished = quick_descent(problem, gap, 1e-8, 300)
    assert finished
    assert quick.residual <= 1e-8
    assert quick.iterations <= 17  # 15 when this was written
    solved = adhesive.solve(heights, length, law, mean_gap=contact.mean_gap)
    assert solved.fft_pairs <= 41.7  # 39.75, of which 15 for the start
    np.testing.assert_array_equal(quick.gap > 0, slow.gap > 0)
    np.testing.assert_allclose(quick.gap, slow.gap, atol=1e-7)


def test_iterations_of_both_descents_count(monkeypatch):
    def stop_early(*arguments):
        state, _ = quick_descent(*arguments)
        return state, False

    heights = np.random.default_rng(1).standard_normal((16, 16))
    law = adhesive.Exponential(adhesion_length=1e-3, range=0.1)
    quick = adhesive.solve(heights, 1.0, law, mean_gap=2.0)
    monkeypatch.setattr(equilibrium, "quick_descent", stop_early)
    both = adhesive.solve(heights, 1.0, law, mean_gap=2.0)
    assert both.iterations >= quick.iterations > 0


@pytest.mark.parametrize(
    ("law", "control", "most"),
    [
        # 44.2 convolutions when this was written; 717 if the stiffest points give way most
        (adhesive.LennardJones(adhesion_length=0.01, range=0.3), {"mean_gap": 1.5}, 55),
        # 206 to 208; 248 if soft directions leave out the repulsion
        (adhesive.LennardJones(adhesion_length=0.1, range=0.1), {"mean_gap": 1.5}, 225),
        # 41.2; 47.8 without the parabola of shorter steps, 3171 if cut steps keep the mean gap
        (adhesive.Exponential(adhesion_length=0.1, range=0.3), {"pressure": 0.0}, 45),
    ],
)
def test_descents_are_quick(law, control, most):
    length = 2 * np.pi
    band = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=12.0, h_rms=1.0)
    heights = surface.synthesise(band, n=64, length=length, seed=3)
    solved = adhesive.solve(heights, length, law, **control)
    assert solved.fft_pairs <= most
    if "mean_gap" in control:
        assert solved.gap.mean() == pytest.approx(1.5, rel=1e-12)
