"""Quick descent of laws that only soften, against the general one."""

import numpy as np

from stickiness import adhesive, repulsive, spectrum, surface
from stickiness.adhesive.descent import descend
from stickiness.adhesive.softening_descent import quick_descent
from stickiness.adhesive.solver import Control, Scaled


def test_agrees_with_the_general_descent_at_a_mean_gap():
    length = 2 * np.pi
    band = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=16.0, h_rms=1.0)
    heights = surface.synthesise(band, n=128, length=length, seed=3)
    law = adhesive.Exponential(adhesion_length=0.01, range=0.1)
    contact = repulsive.solve(heights, length, 0.065, tol=1e-8)
    scaled = Scaled.of(heights, (length, length), law)
    problem = scaled.problem(Control(mean_gap=contact.mean_gap))
    gap = scaled.first_gap(contact, contact.mean_gap)
    slow = descend(problem, gap, 1e-8, 300)
    before = scaled.surface.pairs
    quick, finished = quick_descent(problem, gap, 1e-8, 300)
    assert finished
    assert quick.residual <= 1e-8
    pairs = scaled.surface.pairs - before
    assert pairs <= 28  # 24.75 when this was written
    np.testing.assert_array_equal(quick.gap > 0, slow.gap > 0)
    np.testing.assert_allclose(quick.gap, slow.gap, atol=1e-7)
