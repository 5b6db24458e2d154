"""Two independent rough solids against one with the sum of their spectra."""

import numpy as np
import pytest

from stickiness import adhesive, remaining, repulsive, surface
from stickiness.persson import Persson
from stickiness.spectrum import SelfAffine, combine

LENGTH = 4 * np.pi  # two by two longest waves


def rough(h_rms):
    return SelfAffine(hurst=0.8, q0=1.0, q1=8.0, h_rms=h_rms)


def pile(seed, n):
    """Heights of two surfaces of h_rms 1 on each other."""
    return sum(surface.synthesise(rough(1.0), n, LENGTH, 1000 * seed + k) for k in (1, 2))


def single(seed, n):
    return surface.synthesise(rough(np.sqrt(2)), n, LENGTH, seed)


def over_theory(heights, share):
    """Area and mean gap over theory on the surface's own spectrum, which hardly scatter."""
    known = surface.realised_spectrum(heights, LENGTH)
    load, theory = share * known.rms_slope, Persson(known)
    found = repulsive.solve(heights, LENGTH, load, tol=1e-5)
    return found.area_fraction / theory.area_fraction(load), found.mean_gap / theory.mean_gap(load)


def remaining_over_prediction(heights):
    known = surface.realised_spectrum(heights, LENGTH)
    w = 1.2 * known.elastic_energy()
    law = adhesive.Exponential(w, 0.6)
    squeeze = known.rms_slope
    found = remaining.measure(heights, LENGTH, law, squeeze, tol=1e-3, half_grid=False)
    return found.bound / remaining.predict(known, w, 0.6).separation


def check_equal(one, other, slack):
    """Means of samples are equal within three standard errors and some `slack`."""
    one, other = np.array(one), np.array(other)
    error = np.hypot(*(x.std(0, ddof=1) / np.sqrt(len(x)) for x in (one, other)))
    assert np.all(np.abs(one.mean(0) - other.mean(0)) < 3 * error + slack)
    return error


def test_spectra_of_both_are_one():
    both, one = combine(rough(1.0), rough(1.0)), rough(np.sqrt(2))
    got, want = (surface.lattice_spectrum(s, LENGTH) for s in (both, one))
    np.testing.assert_allclose(got.variance, want.variance, rtol=1e-12)
    power = np.mean([pile(seed, 40).var() for seed in range(60)])
    assert power == pytest.approx(2.0, rel=0.15)  # the cross term scatters


@pytest.mark.slow
@pytest.mark.parametrize("share", [0.05, 0.3])
def test_contact_of_both_is_that_of_one(share):
    both = [over_theory(pile(seed, 128), share) for seed in range(8)]
    one = [over_theory(single(seed, 128), share) for seed in range(8)]
    error = check_equal(both, one, slack=0.005)
    assert np.all(error < 0.03)


@pytest.mark.slow
def test_adhesion_that_remains_of_both_is_that_of_one():
    both = [remaining_over_prediction(pile(seed, 80)) for seed in range(3)]
    one = [remaining_over_prediction(single(seed, 80)) for seed in range(3)]
    assert check_equal(both, one, slack=0.01) < 0.1
