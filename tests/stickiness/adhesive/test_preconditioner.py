"""Preconditioner of the adhesive descents."""

import numpy as np
import pytest

from stickiness.adhesive.preconditioner import LONGEST, Smoother
from stickiness.solids import HALF_SPACE


@pytest.mark.parametrize("shape", [(64, 48), (63, 48), (2, 64)])
def test_long_waves_are_divided_by_their_stiffness(shape):
    smoother = Smoother(shape, (1.0, shape[1] / shape[0]), HALF_SPACE)
    wave = np.cos(2 * np.pi * np.arange(shape[1]) / shape[1]).astype(np.float32)
    field = np.tile(wave, (shape[0], 1))
    stiffness = np.pi * shape[0] / shape[1] + LONGEST
    np.testing.assert_allclose(smoother.apply(field), field / stiffness, atol=0.01 / stiffness)
    assert smoother.pairs == (0.25 if shape == (64, 48) else 1)


def test_is_symmetric_and_positive():
    smoother = Smoother((32, 32), (1.0, 1.0), HALF_SPACE)
    a, b = np.random.default_rng(0).standard_normal((2, 32, 32)).astype(np.float32)
    assert np.vdot(a, smoother.apply(b)) == pytest.approx(np.vdot(b, smoother.apply(a)), rel=1e-4)
    assert np.vdot(a, smoother.apply(a)) > 0
    checks = np.indices((32, 32)).sum(0).astype(np.float32) % 2 - np.float32(0.5)
    assert np.vdot(checks, smoother.apply(checks)) > 0
