"""Theories beside the one in use: limits and what they are taken from."""

import numpy as np
import pytest

from stickiness.criteria import equivalent_sphere
from stickiness.criteria.formulas import pastewka_robbins_a_v
from stickiness.remaining.theories import dmt_share, full_contact_share, local_threshold
from stickiness.spectrum import SelfAffine
from stickiness.surface import lattice_spectrum


def rough(magnification):
    return SelfAffine(hurst=0.8, q0=1.0, q1=magnification, h_rms=1.0)


def test_the_local_criterion_is_the_tough_limit_of_the_edges():
    surface = rough(1e4)
    numbers = surface.h_rms, surface.q0, surface.rms_slope
    a_v = pastewka_robbins_a_v(1.0, 1.0, surface.rms_slope, surface.rms_curvature)
    of_edges = equivalent_sphere.adhesion_length_threshold(
        numbers[0], numbers[1], numbers[2], 1e-12, a_v
    )
    *_, finest = local_threshold(surface)
    assert finest == pytest.approx(of_edges, rel=0.1)


def test_the_local_criterion_is_strictest_at_long_waves():
    largest, cut, finest = local_threshold(rough(1e4))
    assert largest == pytest.approx(0.35, rel=0.05)
    assert 3 < cut < 8
    assert finest < largest / 4


def test_full_contact():
    assert full_contact_share(np.array([0.5, 1.0, 4.0])) == pytest.approx([0, 0, 0.75])


@pytest.mark.slow
def test_dmt_form_at_long_range_and_at_full_contact():
    surface = rough(32.0)
    assert dmt_share(surface, 0.01, 100.0) == pytest.approx(1, abs=0.1)
    length = 50 * surface.elastic_energy()
    assert dmt_share(surface, length, 1e-3) == pytest.approx(1 - 1 / 50, abs=0.03)
    assert dmt_share(surface, 1e-3, 1e-3) < 1e-3


@pytest.mark.slow
def test_theories_take_the_average_over_directions():
    turned = SelfAffine(hurst=0.8, q0=1.0, q1=16.0, h_rms=1.0, anisotropy=4.0, angle=0.3)
    mean = turned.averaged()
    assert local_threshold(turned) == local_threshold(mean)
    assert dmt_share(turned, 1.0, 0.3) == pytest.approx(dmt_share(mean, 1.0, 0.3), rel=1e-7)


@pytest.mark.slow
def test_dmt_form_of_many_shells_is_that_of_the_spectrum():
    surface = rough(32.0)
    shells = lattice_spectrum(surface, 16 * np.pi)
    assert len(shells.q) > 1000
    assert dmt_share(shells, 1.0, 0.3) == pytest.approx(dmt_share(surface, 1.0, 0.3), rel=0.03)
