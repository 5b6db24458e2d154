"""Compiled loops do what their Python source says."""

import numpy as np
import pytest

from stickiness.adhesive import preconditioner as smoother
from stickiness.adhesive import problem, softening_descent, solver
from stickiness.compiled import compiled
from stickiness.repulsive import convolution, preconditioner

SIZE = 60
_RNG = np.random.default_rng(1)


def single(*shape):
    return _RNG.standard_normal(shape or SIZE).astype(np.float32)


def double():
    return _RNG.standard_normal(SIZE)


def points():
    return _RNG.random(SIZE) < 0.7


def real(value):
    return np.float32(value)


def interpolation():
    return preconditioner._interpolation(12, 3), preconditioner._interpolation(5, 2)


LOOPS = {
    softening_descent._move_gap: lambda: (double(), double(), single(), 0.7, points()),
    softening_descent._sum_work_between: lambda: (double(), double(), double(), double(), 0.3),
    softening_descent._dot: lambda: (single(), single()),
    softening_descent._sum_over_free: lambda: (single(), points(), single(), single()),
    softening_descent._turn_direction: lambda: (
        single(),
        real(0.6),
        single(),
        real(0.1),
        points(),
        points(),
    ),
    softening_descent._lower: lambda: (single(), real(0.1), points()),
    softening_descent._settle_direction: lambda: (
        single(),
        real(0.1),
        points(),
        single(),
        single(),
    ),
    softening_descent._count_deeper: lambda: (real(-0.2), single(), real(0.5), single(), single()),
    softening_descent._cut_at_wall: lambda: (
        *(single(), single(), real(0.5)),
        *(single(), single(), points()),
    ),
    softening_descent._find_gaps: lambda: (
        *(single(), real(0.5), single(), single()),
        *(real(0.7), single()),
    ),
    softening_descent._sum_work: lambda: (single(), real(0.5), single(), single(), single()),
    softening_descent._apply_step: lambda: (
        *(single(), real(0.5), single(), single(), single()),
        *(points(), (single(), single()), real(0.7)),
    ),
    softening_descent._apply_step_linearly: lambda: (
        *(single(), real(0.5), single(), single(), single()),
        *(points(), single()),
    ),
    softening_descent._end_at_wall: lambda: (single(), single(), single(), points(), points()),
    softening_descent._release_points: lambda: (
        *(single(), real(0.1), single(), single()),
        *(points(), points(), single(), single()),
    ),
    problem._unloaded: lambda: (double(), double(), double(), True),
    problem._react: lambda: (double(), double(), double(), 0.3, 0.7, True, points(), single()),
    solver._sum_up: lambda: (
        *(double(), double(), double(), double(), double()),
        *(0.3, True, 0.5),
    ),
    smoother._add_around: lambda: (single(6, 10), single(3, 5), single(10)),
    smoother._spread: lambda: (single(3, 5), real(0.3), single(6, 10), single(6, 10), single(6)),
    convolution._combine: lambda: (
        *(single(4, 5), single(4, 5), single(4, 10)),
        *(single(4, 10), single(10)),
    ),
    preconditioner._add_to_coarse: lambda: (
        *(single(12, 5), single(12, 5), *interpolation()),
        *(single(3, 5), single(3, 2)),
    ),
    preconditioner._interpolate: lambda: (
        *(single(3, 2), *interpolation(), single(3, 5)),
        *(single(12, 5), single(12, 5)),
    ),
    preconditioner._interpolate_at: lambda: (
        *(np.array([0, 7, 59]), single(3, 2), *interpolation()),
        single(3),
    ),
}


@pytest.mark.parametrize("loop", LOOPS, ids=lambda loop: loop.__name__)
def test_loop_does_what_its_source_says(loop):
    arguments = LOOPS[loop]()
    fields = [one for one in arguments if isinstance(one, np.ndarray)]
    before = [one.copy() for one in fields]
    result = loop(*arguments)
    after = [one.copy() for one in fields]
    for one, value in zip(fields, before, strict=True):
        one[...] = value
    with np.errstate(all="ignore"):
        expected = loop.__wrapped__(*arguments)
    np.testing.assert_allclose(result or 0, expected or 0, rtol=1e-5, atol=1e-5)
    for one, value in zip(fields, after, strict=True):
        np.testing.assert_allclose(value, one, rtol=1e-5, atol=1e-5)


def test_a_source_without_a_folder_for_its_cache_is_compiled_all_the_same():
    names = {}
    exec("def double(x):\n    return x + x\n", names)
    assert compiled(names["double"])(1.5) == 3.0
