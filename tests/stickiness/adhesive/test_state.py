"""What follows from a gap point by point."""

import numpy as np
import pytest

from stickiness.adhesive import softening_descent
from stickiness.adhesive.laws import Exponential
from stickiness.adhesive.problem import Problem, State, Surface, evaluate


@pytest.fixture
def surface():
    return Surface(np.random.default_rng(1).standard_normal((16, 16)), (1.0, 1.0))


@pytest.mark.parametrize("control", [{"pressure": 0.1}, {"mean_gap": 2.0}])
@pytest.mark.parametrize("field", ["gap", "elastic"])
@pytest.mark.parametrize("touching", [0.0, 1.0])
def test_what_is_not_a_number_is_no_equilibrium(surface, control, field, touching):
    problem = Problem(surface, Exponential(adhesion_length=1e-3, range=0.1), 1.0, **control)
    state = State.empty((16, 16))
    state.gap[...] = touching
    state.elastic[...] = 0.0
    assert np.isfinite(evaluate(problem, state).residual)
    getattr(state, field)[3, 5] = np.nan
    assert np.isnan(evaluate(problem, state).residual)


def test_descent_from_what_is_not_a_number_ends_without_one(surface):
    problem = Problem(surface, Exponential(adhesion_length=1e-3, range=0.1), 1.0, pressure=0.1)
    gap = np.ones((16, 16))
    gap[0, 0] = np.nan
    state, _ = softening_descent.quick_descent(problem, gap, 1e-8, 100)
    assert not state.residual <= 1e-8
