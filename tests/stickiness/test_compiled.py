"""Compiled loops do what their Python source says."""

import inspect

import numpy as np
import pytest

from stickiness.adhesive import preconditioner as smoother
from stickiness.adhesive import problem, softening_descent, solver
from stickiness.compiled import compiled
from stickiness.repulsive import convolution, half_space, preconditioner, subpixel

SIZE = 60
RNG = np.random.default_rng(1)
MASKS = {"above", "free", "points"}
NUMBERS = {"bound", "factor", "length", "mean", "pressure", "reach", "unit", "weight"}
LOOPS = [
    function
    for module in (
        smoother,
        problem,
        softening_descent,
        solver,
        convolution,
        half_space,
        preconditioner,
        subpixel,
    )
    for function in vars(module).values()
    if inspect.isfunction(function)
    and hasattr(function, "__wrapped__")
    and function.__module__ == module.__name__
]
IN_DOUBLE = (problem._unloaded, problem._react, solver._sum_up)


def single(*shape):
    return RNG.standard_normal(shape or SIZE).astype(np.float32)


def interpolation():
    return preconditioner._interpolation(12, 3), preconditioner._interpolation(5, 2)


def transposed():
    return [
        preconditioner._transpose(*axis, m) for axis, m in zip(interpolation(), (3, 2), strict=True)
    ]


GROUP = np.array([1, 3, 6, 8])
HEIGHTS, LEVELS = RNG.random((6, 10)), np.linspace(0, 1, 8)
# Arguments of loops over grids of more than one dimension.
ON_GRIDS = {
    smoother._add_around: (single(6, 10), single(3, 5), single(10)),
    smoother._spread: (single(3, 5), np.float32(0.3), single(6, 10), single(6, 10), single(6)),
    half_space._double: (1, 3, single(4, 3), single(8, 6)),
    convolution._turn: (single(16, 9), GROUP, single(4, 16), True),
    convolution._combine: (*single(2, 4, 6), *(single(2, 4, 10) + 1j * single(2, 4, 10)), 10),
    preconditioner._add_to_coarse: (1, *single(2, 12, 5), *transposed(), single(2, 2)),
    preconditioner._interpolate: (
        *(6, single(3, 2), *interpolation(), single(12, 5), single(4, 5)),
    ),
    preconditioner._interpolate_at: (
        *(np.array([0, 7, 59]), single(3, 2), *interpolation(), single(3)),
    ),
    subpixel._add_intervals: (
        *(HEIGHTS, RNG.random((6, 10)) < 0.3, np.searchsorted(LEVELS, HEIGHTS)),
        *(1, *np.zeros((3, LEVELS.size + 1))),
    ),
}


def arguments(loop):
    """Arguments of a loop over one index, by their names; masks, numbers and fields."""
    if loop in ON_GRIDS:
        return [np.copy(a) if isinstance(a, np.ndarray) else a for a in ON_GRIDS[loop]]
    made = []
    for name in inspect.signature(loop).parameters:
        if name in MASKS:
            made.append(RNG.random(SIZE) < 0.7)
        elif name == "wall":
            made.append(True)
        elif name in NUMBERS:
            made.append(0.6 if loop in IN_DOUBLE else np.float32(0.6))
        elif name == "tractions":
            made.append((single(), single()))
        else:
            made.append(RNG.standard_normal(SIZE) if loop in IN_DOUBLE else single())
    return made


@pytest.mark.parametrize("loop", LOOPS, ids=lambda loop: loop.__name__)
def test_loop_does_what_its_source_says(loop):
    given = arguments(loop)
    fields = [one for one in given if isinstance(one, np.ndarray)]
    before = [one.copy() for one in fields]
    result = loop(*given)
    after = [one.copy() for one in fields]
    for one, value in zip(fields, before, strict=True):
        one[...] = value
    with np.errstate(all="ignore"):
        expected = loop.__wrapped__(*given)
    np.testing.assert_allclose(result or 0, expected or 0, rtol=1e-5, atol=1e-5)
    for one, value in zip(fields, after, strict=True):
        np.testing.assert_allclose(value, one, rtol=1e-5, atol=1e-5)


def test_a_source_without_a_folder_for_its_cache_is_compiled_all_the_same():
    names = {}
    exec("def double(x):\n    return x + x\n", names)
    assert compiled(names["double"])(1.5) == 3.0
