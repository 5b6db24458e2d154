"""Simulated works of approach and separation against closed forms and the balance of energy."""

import warnings

import numpy as np
import pytest
from references.gradient_flow import follow

from stickiness import adhesive, repulsive, surface
from stickiness.plausibility import PlausibilityWarning
from stickiness.remaining import measure
from stickiness.solids import HalfSpace, Layer
from stickiness.spectrum import SelfAffine

LENGTH = 4 * np.pi


def random_heights(n=64, magnification=4.0):
    spectrum = SelfAffine(hurst=0.8, q0=1.0, q1=magnification, h_rms=1.0)
    return surface.synthesise(spectrum, n=n, length=LENGTH, seed=3)


def test_flat_surfaces_part_at_the_full_work():
    for size in (16, 64):
        law = adhesive.Exponential(1e-3, 0.1)
        found = measure(np.full((size, size), 3.0), 1.0, law, squeeze=0.01)
        assert (found.approach, found.bound, found.separation) == (1, 1, 1)
        assert found.pull_off == law.strength
        assert found.separation_limits == (1, 1)


@pytest.mark.slow
@pytest.mark.parametrize("solid", [HalfSpace(), Layer(0.3, 0.5)])
def test_full_contact_of_a_wave_costs_its_energy(solid):
    x = np.arange(64) / 64
    heights = 0.05 * np.cos(2 * np.pi * x)[:, None] * np.ones(64)
    energy = 0.05**2 / 4 * solid.stiffness(2 * np.pi)
    law = adhesive.Exponential(4 * energy, 0.021)
    found = measure(heights, 1.0, law, squeeze=1.0, half_grid=False, solid=solid)
    assert found.bound == pytest.approx(1 - 1 / 4, abs=0.02)
    assert found.area_at_zero_load == pytest.approx(1, abs=0.02)


@pytest.mark.slow
def test_without_jumps_all_works_are_the_energy_gained():
    found = measure(random_heights(), LENGTH, adhesive.Exponential(0.3, 0.5), squeeze=0.1)
    assert found.jumps == 0
    assert found.approach == pytest.approx(found.bound, rel=0.03)
    assert found.separation == pytest.approx(found.bound, rel=0.03)
    assert found.pixels_in_zone > 2
    assert [point.state.mean_gap for point in found.points] == list(found.gap)
    assert found.points[0].state.gap.shape == (64, 64)


def find_weak_limit(heights, law):
    """Largest gain of energy over the work of adhesion if attraction leaves the contact as it is.

    Over contacts without adhesion, from the first touch on: attraction less elastic energy.
    """
    lattice = 2 * np.pi / LENGTH * np.fft.fftfreq(len(heights), 1 / len(heights))
    q = np.hypot(lattice[:, None], lattice)
    q[0, 0] = np.inf
    gains = [-np.mean(law.potential(heights.max() - heights))]
    for pressure in np.geomspace(1e-9, 0.1, 20):
        contact = repulsive.solve(heights, LENGTH, pressure, tol=1e-9)
        waves = np.fft.fft2(contact.pressure, norm="forward")
        stored = np.sum(np.abs(waves) ** 2 / q)
        gains.append(-np.mean(law.potential(contact.gap)) - stored)
    return max(gains) / law.adhesion_length


@pytest.mark.parametrize(("ratio", "seed"), [(3e-6, 1), (1e-4, 3)])
def test_far_below_the_onset_the_weak_limit_remains(ratio, seed):
    spectrum = SelfAffine(hurst=0.8, q0=1.0, q1=6.0, h_rms=1.0)
    heights = surface.synthesise(spectrum, n=32, length=LENGTH, seed=seed)
    energy = surface.realised_spectrum(heights, LENGTH).elastic_energy()
    law = adhesive.Exponential(adhesion_length=ratio * energy, range=0.5)
    remaining = measure(heights, LENGTH, law, squeeze=0.1, half_grid=False)
    limit = find_weak_limit(heights, law)
    assert remaining.separation == pytest.approx(limit, rel=0.01)
    assert remaining.bound == pytest.approx(limit, rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize(("ratio", "seed"), [(0.7, 1), (1.0, 3)])
def test_paths_with_jumps_against_a_gradient_flow(ratio, seed):
    """Four pixels in the cohesive zone and default steps, on a profile of eight waves."""
    n, q = 128, np.arange(1, 9)
    x, phases = np.arange(n) * 2 * np.pi / n, np.random.default_rng(seed).uniform(0, 2 * np.pi, 8)
    profile = np.sum(q[:, None] ** -1.3 * np.cos(q[:, None] * x + phases[:, None]), axis=0)
    profile = (profile - profile.mean()) / profile.std()
    work = ratio * np.sum(q * np.abs(np.fft.rfft(profile)[1:9] / n) ** 2) / 2
    reach = np.sqrt(4 * 2 * np.pi / n * work)
    heights, sides = np.tile(profile[:, None], (1, 4)), (2 * np.pi, 8 * np.pi / n)
    law = adhesive.Exponential(work, reach)
    found = measure(heights, sides, law, squeeze=0.1, half_grid=False)
    gaps = np.linspace(found.gap[0], found.gap[~found.separating].min(), 200)
    one, pressure, last = follow(profile, work, reach, gaps, np.full(n, gaps[0]))
    other, back, _ = follow(profile, work, reach, gaps[::-1], last)
    approach = np.trapezoid(np.maximum(-pressure, 0), -gaps) - one[0]
    separation = np.trapezoid(np.maximum(-back, 0), gaps[::-1]) - other[-1]
    assert found.jumps > 0
    assert found.separation > 1.05 * found.approach
    assert found.bound * work == pytest.approx(-min(one.min(), other.min()), rel=2e-3)
    assert found.approach * work == pytest.approx(approach, rel=0.01)
    assert found.separation * work == pytest.approx(separation, rel=0.01)
    assert found.pull_off == pytest.approx(-back.min(), rel=0.025)


def test_without_jumps_a_long_range_gains_on_approach_what_it_binds():
    """Two per cent of the work are done beyond the start of the path."""
    spectrum = SelfAffine(hurst=0.8, q0=1.0, q1=6.0, h_rms=1.0)
    heights = surface.synthesise(spectrum, n=32, length=LENGTH, seed=1)
    energy = surface.realised_spectrum(heights, LENGTH).elastic_energy()
    law = adhesive.Exponential(adhesion_length=0.3 * energy, range=8.0)
    remaining = measure(heights, LENGTH, law, squeeze=0.1, half_grid=False)
    assert remaining.jumps == 0
    assert remaining.approach == pytest.approx(remaining.bound, rel=0.005)


@pytest.mark.parametrize(("pixels", "warned"), [(1.9, True), (2.1, False)])
def test_two_pixels_in_the_zone_are_enough(pixels, warned):
    heights = random_heights(16)
    reach = np.sqrt(0.3 * pixels * LENGTH / 16)
    law = adhesive.Exponential(0.3, reach)
    with warnings.catch_warnings(record=True) as raised:
        warnings.simplefilter("always")
        found = measure(heights, LENGTH, law, 0.1, half_grid=False, steps=10)
    assert found.pixels_in_zone == pytest.approx(pixels, rel=1e-9)
    assert any(warning.category is PlausibilityWarning for warning in raised) == warned


def test_limits_lie_on_both_sides_of_every_value():
    law = adhesive.Exponential(0.3, 1.0)
    found = measure(random_heights(16), LENGTH, law, squeeze=0.1, tol=1e-3, steps=5)
    for name in ("approach", "separation", "bound", "pull_off"):
        value = getattr(found, name)
        low, high = getattr(found, f"{name}_limits")
        assert 0 <= low < value < high < 3 * value
        assert high - value == pytest.approx(value - low) or low == 0
