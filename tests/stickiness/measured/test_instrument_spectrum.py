"""Instruments' limits, stitching of measurements, and moments drawn with all errors."""

from dataclasses import replace

import numpy as np
import pytest
from scipy import ndimage

from stickiness import surface
from stickiness.measured import instrument_spectrum, psd, stitching
from stickiness.measured.instrument_spectrum import TrustedWaves, find_bend, tip_cutoff
from stickiness.measured.topography import Profile, Topography
from stickiness.spectrum import SelfAffine

pytestmark = pytest.mark.processors

# Where an instrument stops seeing


def patch(hurst=0.8, seed=1, n=512, q1=250.0):
    """A quarter of a periodic surface, so not periodic itself; step of its lattice 2."""
    s = SelfAffine(hurst=hurst, q0=1.0, q1=q1, h_rms=1.0)
    h = surface.synthesise(s, n=n, length=2 * np.pi, seed=seed)[: n // 2, : n // 2]
    return s, h, 2 * np.pi / n


def bend(h, dx):
    plane = psd.power_spectrum(h - h.mean(), dx, taper="hann")
    rings = psd.radial_average(plane, bins_per_decade=200)
    return find_bend(rings, 4 * plane.steps[0], plane.q_nyquist)


@pytest.mark.parametrize("hurst", [0.5, 0.8, 0.95])
@pytest.mark.parametrize("seed", [1, 2])
def test_a_surface_without_instrument_has_no_bend_below_its_own_end(hurst, seed):
    _, h, dx = patch(hurst, seed)
    found = bend(h, dx)
    assert found is None or found.q > 0.7 * 250


def test_noise_and_blur_are_found_where_they_meet_the_spectrum():
    s, h, dx = patch()
    for level in (0.05, 0.15):
        # White noise has C = level^2 dx^2/(4 pi^2); it meets C0 q^-3.6 at
        meeting = (s.C0 / (level * dx / (2 * np.pi)) ** 2) ** (1 / 3.6)
        found = bend(h + level * np.random.default_rng(0).normal(size=h.shape), dx)
        assert found.reason.startswith("noise of the instrument")
        # There the local exponent is 1.8; 1.5 is reached 12 % higher, and rings are 12 % apart.
        assert found.q == pytest.approx(meeting, rel=0.3)
    found = bend(ndimage.gaussian_filter(h, 2), dx)
    # C ~ q^-3.6 exp(-(width q)^2) has the local exponent 3.6 + 2 (width q)^2, 5 at
    assert found.reason.startswith("blur of the instrument")
    assert found.q == pytest.approx(np.sqrt(0.7) / (2 * dx), rel=0.35)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_end_of_the_waves_is_no_rolloff(seed):
    """Half a decade above the first wave fitted, where no bend is looked for."""
    _, h, dx = patch(seed=seed, n=256, q1=32.0)
    measured = instrument_spectrum.analyse(Topography(h, dx, dx, "here").detrended())
    assert measured.fit.q_rolloff is None
    assert 0.4 < measured.fit.hurst < 1.2
    assert measured.cutoff.detected
    assert measured.cutoff.q < 32
    assert measured.cutoff.reason.startswith("blur of the instrument")


def test_rings_of_few_modes_do_not_bend_a_spectrum():
    # Every fourth ring has one mode, which may be a hundred times off; all others have many.
    q = np.geomspace(1.0, 1e3, 61) * 1.001
    dof = np.where(np.arange(61) % 4 == 0, 1.0, 1e4)
    law = q**-3.6
    off = np.where(np.arange(61) % 8 == 4, 100.0, 1.0) * np.where(np.arange(61) % 8 == 0, 0.01, 1.0)
    assert find_bend(psd.RadialPSD(q, law * off, dof), 1.0, 1e3) is None
    many = psd.RadialPSD(q, law * off, np.full(61, 1e4))
    assert find_bend(many, 1.0, 1e3) is not None


def test_tip_cutoff_of_a_wave_is_known():
    k, radius = 2.0, 0.5
    x = np.arange(0, 40, 0.02)
    heights = 1.5 * np.cos(k * x)  # curvature 6 at the peaks, limit 1/(2R) = 1
    # Second difference over d: 2 a (1 - cos k d)/d^2 = 1/(2R), solved for d; the stencil is 2 d.
    d = np.linspace(0.5, 2.5, 100001)
    expected = 2 * d[np.argmin(np.abs(3 * (1 - np.cos(k * d)) / d**2 - 1 / (2 * radius)))]
    found = tip_cutoff(heights, (0.02,), radius)
    assert found == pytest.approx(expected, rel=0.05)
    assert tip_cutoff(heights, (0.02,), radius=0.05) is None  # 10 > 6: sharp enough


@pytest.mark.slow
@pytest.mark.parametrize(
    ("limits", "reason", "wavelength"),
    [
        (TrustedWaves(), "half the Nyquist", None),
        (TrustedWaves(resolution=0.2), "resolution of the instrument", 0.2),
        (TrustedWaves(fit_to=0.1, resolution=0.2), "as given", 0.1),
        (TrustedWaves(resolution=0.001), "half the Nyquist", None),
    ],
)
def test_lowest_limit_is_the_cutoff_and_says_why(limits, reason, wavelength):
    _, h, dx = patch()
    found = instrument_spectrum.analyse(
        Topography(h, dx, dx, "here").detrended(), instrument=limits
    )
    assert reason in found.cutoff.reason
    if wavelength:
        # The highest ring within: the lattice is fine there.
        assert found.cutoff.q == pytest.approx(2 * np.pi / wavelength, rel=0.03)
    assert found.fit.q_max == found.cutoff.q


def test_limits_that_leave_nothing_are_named():
    _, h, dx = patch()
    with pytest.raises(ValueError, match="resolution of the instrument ends the spectrum at"):
        instrument_spectrum.analyse(
            Topography(h, dx, dx, "here"), instrument=TrustedWaves(resolution=2.0)
        )
    with pytest.raises(ValueError, match="shape of the tip ends the spectrum everywhere"):
        instrument_spectrum.analyse(
            Topography(h, dx, dx, "here"), instrument=TrustedWaves(tip_radius=1e6)
        )


@pytest.mark.slow
def test_uneven_profile_is_trusted_to_its_largest_gap():
    _, h, dx = patch(n=1024, q1=500.0)
    even = instrument_spectrum.analyse(Profile(h[:, 7], dx, "here").detrended())
    torn = instrument_spectrum.analyse(Profile(h[:, 7], dx, "here", largest_gap=3 * dx).detrended())
    assert even.cutoff.q == pytest.approx(3 * torn.cutoff.q, rel=0.05)
    assert np.isnan(torn.anisotropy)


def test_rings_of_a_profile_meet_at_geometric_means():
    # Waves 1, 2, 4 and 8: the first ring begins half a step of the lattice below it.
    areas = instrument_spectrum.ring_areas(np.array([1.0, 2.0, 4.0, 8.0]), lowest=1.0)
    np.testing.assert_allclose(areas, np.pi * np.array([2 - 1 / 4, 6, 24, 96]), rtol=1e-12)
    wide = instrument_spectrum.ring_areas(np.array([1.0, 2.0, 4.0, 8.0]), lowest=3.0)
    np.testing.assert_allclose(wide, np.pi * np.array([2, 6, 24, 96]), rtol=1e-12)


# Stitching


@pytest.fixture(scope="module")
def scans():
    """Twelve pairs of a large and a small scan of one surface, each off in height by 10 %."""
    truth = SelfAffine(hurst=0.8, q0=1.0, q1=1e3, h_rms=1.0, q_rolloff=5.0)
    pairs = []
    for trial in range(12):
        pair = []
        for k, (length, q0, q1) in enumerate([(8 * np.pi, 1.0, 30.0), (np.pi, 2.0, 250.0)]):
            s = SelfAffine(hurst=0.8, q0=q0, q1=q1, C0=truth.C0, q_rolloff=5.0)
            h = surface.synthesise(s, n=256, length=length, seed=100 * trial + k)
            h = h * np.exp(0.1 * np.random.default_rng(10 * trial + k).normal())
            step = length / 256
            pair.append(instrument_spectrum.analyse(Topography(h, step, step, f"scan {k}"), "none"))
        pairs.append(pair)
    return truth, pairs


@pytest.mark.slow
def test_stitched_spectrum_covers_its_truth(scans):
    truth, pairs = scans
    fits = [stitching.stitch(pair).fit for pair in pairs]
    hurst = np.array([(fit.hurst - 0.8) / fit.hurst_se for fit in fits])
    c0 = np.array([np.log(fit.c0 / truth.C0) * fit.c0 / fit.c0_se for fit in fits])
    # Twelve values of unit variance have a standard deviation of 1 ± 0.2; offsets are judged from
    # one pair each and never below their own error, which makes the errors rather large.
    for z in (hurst, c0):
        assert 0.4 < np.sqrt(np.mean(z**2)) < 1.5


@pytest.mark.slow
def test_an_offset_is_seen_and_widens_the_errors(scans):
    _, pairs = scans
    large, small = pairs[2]
    scaled = replace(small, narrow=replace(small.narrow, psd=4 * small.narrow.psd))
    plain, off = stitching.stitch([large, small]), stitching.stitch([large, scaled])
    # ln 4 between two, the standard deviation of a difference is sqrt(2) that of each.
    assert off.scatter == pytest.approx(np.log(4) / np.sqrt(2), abs=2 * plain.scatter + 0.1)
    assert off.fit.hurst_se > 2 * plain.fit.hurst_se


@pytest.mark.slow
def test_measurements_that_do_not_overlap_say_nothing_of_their_offset(scans):
    _, pairs = scans
    large, small = pairs[0]
    apart = replace(small, fit=replace(small.fit, q_min=1.3 * large.cutoff.q))
    found = stitching.stitch([large, apart])
    assert np.isnan(found.scatter)
    assert stitching.stitch([large]) is large


def test_a_map_and_a_profile_can_be_stitched():
    s, h, dx = patch(n=1024, q1=400.0)
    plane = instrument_spectrum.analyse(Topography(h[::4, ::4], 4 * dx, 4 * dx, "map").detrended())
    line = instrument_spectrum.analyse(Profile(h[:, 100], dx, "line").detrended())
    whole = stitching.stitch([plane, line])
    assert whole.cutoff.q == pytest.approx(line.cutoff.q, rel=0.1)
    fit = whole.fit
    assert abs(fit.hurst - 0.8) < 3 * fit.hurst_se
    # Both see the same spectrum, the profile by some tens of modes.
    assert whole.scatter < 0.5


# Moments and their errors


def test_draws_scatter_about_the_moments_of_the_surface():
    s = SelfAffine(hurst=0.8, q0=1.0, q1=60.0, h_rms=1.0, q_rolloff=4.0)
    length, n = 4 * np.pi, 512
    h = surface.synthesise(s, n=n, length=length, seed=4)
    found = instrument_spectrum.analyse(Topography(h, length / n, length / n, "here"), "none")
    drawn = stitching.draw(found, 400, seed=1)
    variance = drawn.family.variance()
    # A periodic surface keeps its variance whatever the spectrum estimated from it.
    assert np.mean(variance) == pytest.approx(np.var(h), rel=0.02)
    inside = s.truncated(found.cutoff.q)
    rms_slope = np.sqrt(drawn.family.variance(2))
    assert np.mean(rms_slope) == pytest.approx(inside.rms_slope, rel=0.05)
    assert np.mean(drawn.family.energy()) == pytest.approx(inside.elastic_energy(), rel=0.1)
    # The relative error of the variance is that of its rings, 1/dof each.
    share = found.rings.psd * found.area
    expected = np.sqrt(np.sum(share**2 / found.rings.dof)) / share.sum()
    assert np.std(variance) / np.mean(variance) == pytest.approx(expected, rel=0.15)
    # The end of the plateau is drawn with the error of its fit.
    fit = found.fit
    assert np.std(np.log(drawn.q0)) == pytest.approx(fit.q_rolloff_se / fit.q_rolloff, rel=0.15)


def test_law_carried_on_adds_its_waves_and_their_uncertainty():
    _, h, dx = patch()
    found = instrument_spectrum.analyse(Topography(h, dx, dx, "here").detrended())
    end = 100 * found.cutoff.q
    plain = stitching.draw(found, 400, seed=1).family
    drawn = stitching.draw(found, 400, seed=1, extend_to=end)
    more = drawn.family
    energy = drawn.continuation.integrate(end, 1) / 4
    np.testing.assert_allclose(more.energy() - plain.energy(), energy, rtol=1e-9)
    law = SelfAffine(hurst=found.fit.hurst, q0=found.cutoff.q, q1=end, C0=found.fit.c0)
    added = np.median(more.variance(2)) - np.median(plain.variance(2))
    assert added == pytest.approx(law.rms_slope**2, rel=0.15)
    assert np.median(more.variance()) == pytest.approx(np.median(plain.variance()), rel=0.04)
    errors = [np.std(np.log(family.variance(4))) for family in (more, plain)]
    assert errors[0] > 2 * errors[1]
    with pytest.raises(ValueError, match="extend_to must be below the shortest wavelength"):
        stitching.draw(found, 5, seed=1, extend_to=0.5 * found.cutoff.q)


@pytest.mark.parametrize("hurst", [45.0, 1.4, -0.1, -5.8])
def test_law_carried_on_has_the_energy_of_the_last_octave_and_a_bounded_exponent(hurst):
    _, h, dx = patch()
    found = instrument_spectrum.analyse(Topography(h, dx, dx, "here").detrended())
    odd = replace(found, fit=replace(found.fit, hurst=hurst))
    beyond = stitching.draw(odd, 50, seed=1, continue_to=1000 * found.cutoff.q).continuation
    low, high = stitching.HURST_BEYOND
    assert np.all((beyond.hurst >= low) & (beyond.hurst <= high))
    # One octave further stores between 2^(1 - 2 H) of what the last one stores, for both bounds.
    last = (found.rings.q > found.cutoff.q / 2) & (found.rings.q <= found.cutoff.q * (1 + 1e-9))
    stored = np.sum((found.area * found.rings.q * found.rings.psd)[last])
    ratio = beyond.integrate(2 * found.cutoff.q, 1) / stored
    assert np.all(ratio > 0.5 * 0.7)
    assert np.all(ratio < 2**0.4 * 1.3)


@pytest.mark.parametrize("hurst", [0.3, 0.4, 0.6, 0.8])
def test_limits_contain_the_energy_of_waves_that_the_instrument_does_not_resolve(hurst):
    length, n, atoms = 1e-5, 128, 2 * np.pi / 0.3e-9
    inside = {"with": [], "without": []}
    for seed in range(6):
        # Law that ends at 10 nm or 1 nm; a map of steps of 78 nm shows waves above 310 nm.
        end = 2 * np.pi / (1e-8, 1e-9)[seed % 2]
        roughness = {"q0": 2 * np.pi / length, "h_rms": 1e-8, "q_rolloff": 8 * np.pi / length}
        s = SelfAffine(hurst=hurst, q1=end, **roughness)
        h = surface.synthesise(s.truncated(np.pi * n / length), n=n, length=length, seed=seed)
        found = instrument_spectrum.analyse(Topography(h, length / n, length / n, "a").detrended())
        for name, to in (("with", atoms), ("without", None)):
            drawn = stitching.draw(found, 400, seed=1, continue_to=to)
            low, high = np.quantile(drawn.family.energy(), (0.05, 0.95))
            inside[name].append(low < s.elastic_energy() < high)
    assert sum(inside["with"]) >= 5
    assert sum(inside["without"]) <= (0 if hurst < 0.5 else 4)


def test_unresolved_energy_is_that_of_the_law_and_ends_with_what_is_configured():
    _, h, dx = patch()
    found = instrument_spectrum.analyse(Topography(h, dx, dx, "here").detrended())
    end = 30 * found.cutoff.q
    plain = stitching.draw(found, 400, seed=1)
    drawn = stitching.draw(found, 400, seed=1, continue_to=end)
    law = SelfAffine(hurst=found.fit.hurst, q0=found.cutoff.q, q1=end, C0=found.fit.c0)
    share = law.elastic_energy() / np.median(plain.family.energy())
    assert np.median(drawn.unresolved) == pytest.approx(share, rel=0.1)
    more = drawn.family.energy() / plain.family.energy() - 1
    assert np.all((more > -1e-12) & (more <= drawn.unresolved * (1 + 1e-9)))
    assert np.mean(more < 1e-12) == pytest.approx(1 / 7, abs=0.04)
    for order in (0, 2, 4):
        resolved = drawn.family.up_to(found.cutoff.q).variance(order)
        np.testing.assert_allclose(resolved, plain.family.variance(order), rtol=1e-12)
    told = stitching.draw(found, 9, seed=1, extend_to=end, continue_to=100 * end)
    only = stitching.draw(found, 9, seed=1, extend_to=end)
    np.testing.assert_array_equal(told.family.psd, only.family.psd)
    assert not told.unresolved.any()
