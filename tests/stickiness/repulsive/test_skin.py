"""Contact without adhesion on a stiff skin, where active sets alone do not converge."""

import numpy as np

from stickiness import repulsive, surface
from stickiness.repulsive import active_set, projected_gradients
from stickiness.solids import Skin
from stickiness.spectrum import SelfAffine

ROUGH = SelfAffine(hurst=0.8, q0=1.0, q1=8.0, h_rms=0.01)
LENGTH = 8 * np.pi


def test_stiff_skin_meets_the_contact_conditions():
    heights = surface.synthesise(ROUGH, 64, LENGTH, seed=3)
    skin = Skin(0.1, 300.0, 0.35, 0.3)
    contact = repulsive.solve(heights, LENGTH, 0.01, solid=skin, tol=1e-6)
    assert 0.02 < contact.area_fraction < 0.9
    # By waves: what the pressure displaces, less the heights, is the gap.
    q = 2 * np.pi / LENGTH * np.hypot(*np.meshgrid(*2 * [np.fft.fftfreq(64, 1 / 64)]))
    q[0, 0] = 1.0
    waves = np.fft.fft2(contact.pressure) * skin.compliance(q)
    waves[0, 0] = 0
    gap = np.fft.ifft2(waves).real - heights + contact.shift
    touches = contact.pressure > 0
    limit = 2e-6 * ROUGH.h_rms
    assert np.abs(gap[touches]).max() < limit
    assert gap.min() > -limit
    assert abs(contact.pressure.mean() - 0.01) < 1e-12


def test_conjugate_gradients_in_the_gap_and_in_the_pressure_agree():
    heights = surface.synthesise(ROUGH, 64, LENGTH, seed=5) / ROUGH.h_rms
    skin = Skin(0.1, 3.0, 0.35, 0.5)
    problem = active_set.Problem(heights, (LENGTH, LENGTH), load=0.5, solid=skin)
    in_gap = projected_gradients.relax_gap(problem, heights.max() - heights, 1e-9, 1000)
    in_pressure = projected_gradients.relax(problem, np.full((64, 64), 0.5), 1e-9, 1000)
    assert max(in_gap.residual, in_pressure.residual) < 1e-8
    np.testing.assert_allclose(in_gap.pressure, in_pressure.pressure, atol=1e-5)
