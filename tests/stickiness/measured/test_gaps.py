"""Measurements of one surface whose bands do not meet, or that cannot stand alone."""

from dataclasses import replace

import numpy as np
import pytest
from helpers.profiles import synthesise_profile
from scipy import optimize

from stickiness import surface
from stickiness.measured import instrument_spectrum, stitching
from stickiness.measured.instrument_spectrum import TrustedWaves
from stickiness.measured.stitching import Gap
from stickiness.measured.topography import Profile, Topography, from_array
from stickiness.spectrum import SelfAffine

pytestmark = pytest.mark.usefixtures("coarse_simulation")

NM = 1e-9


def measure(psd, length, points, seed, alone=True, **limits):
    """Spectrum of a profile across an isotropic surface."""
    heights = synthesise_profile(psd, length, points, seed)
    profile = Profile(heights, length / points, "here").detrended()
    return instrument_spectrum.analyse(profile, instrument=TrustedWaves(**limits), alone=alone)


def roll_off(wavelength, hurst, h_rms=20 * NM):
    """Surface of waves from 300 um to 1 nm with a plateau above a wavelength."""
    waves = {"q0": 2 * np.pi / 300e-6, "q1": 2 * np.pi / NM, "q_rolloff": 2 * np.pi / wavelength}
    return SelfAffine(hurst=hurst, h_rms=h_rms, **waves)


@pytest.mark.parametrize("exponent", [1.0, 3.0, 4.0, 6.0])
def test_a_gap_is_bridged_from_end_to_end_no_faster_than_the_steepest_law(exponent):
    ends = np.array([1e6, 1e8])
    log_psd = np.array([3.0, 3.0 - exponent * np.log(100)])
    gap = Gap(ends, log_psd, np.zeros(2))
    q = np.geomspace(*ends, 201)
    corners = np.linspace(0, 1, 5)
    curves = gap.bridge(q, corners, np.tile(log_psd, (5, 1)))
    np.testing.assert_allclose(curves[:, [0, -1]], np.tile(log_psd, (5, 1)), atol=1e-9)
    slopes = -np.diff(curves, axis=1) / np.diff(np.log(q))
    assert np.all(slopes > -1e-9)
    # Only a gap that is steeper as a whole exceeds the steepest law.
    assert slopes.max() == pytest.approx(max(4.0, exponent), rel=1e-6)
    # The last corner lies where a law of q^-4 through the upper end meets the level of the lower.
    meets = optimize.brentq(lambda x: 4 * (np.log(1e8) - x) - (3.0 - log_psd[1]), -50, 50)
    level = q < 0.99 * np.exp(meets)
    np.testing.assert_allclose(curves[-1][level], 3.0, atol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(("wavelength", "hurst"), [(1.5e-6, 0.5), (0.7e-6, 0.8), (1e-6, 1.0)])
def test_limits_contain_the_waves_between_two_measurements(wavelength, hurst):
    truth = roll_off(wavelength, hurst)
    inside = dict.fromkeys(("h_rms", "rms_slope", "elastic_energy"), 0)
    trials = 20
    for seed in range(trials):
        wide = measure(truth.psd, 300e-6, 6000, seed, resolution=2e-6)
        close = measure(truth.psd, 230 * NM, 230, 100 + seed, alone=False, resolution=18 * NM)
        whole = stitching.stitch([close, wide])
        drawn = stitching.draw(whole, 200, seed=1).family
        measured = truth.truncated(whole.cutoff.q)
        values = {
            "h_rms": (np.sqrt(drawn.variance()), truth.h_rms),
            "rms_slope": (np.sqrt(drawn.variance(2)), measured.rms_slope),
            "elastic_energy": (drawn.energy(), measured.elastic_energy()),
        }
        for name, (of_draws, value) in values.items():
            low, high = np.quantile(of_draws, (0.05, 0.95))
            inside[name] += low < value < high
    # 90 % of twenty, less three standard deviations.
    assert min(inside.values()) >= trials * 0.9 - 3 * np.sqrt(trials * 0.09), inside


def test_a_profile_that_is_trusted_on_its_plateau_alone_has_the_level_of_its_surface():
    truth = roll_off(1.5e-6, 0.8)
    bands = 2 * np.pi / np.array([[75e-6, 20e-6], [20e-6, 8e-6], [8e-6, 3e-6]])
    ratios = []
    for seed in range(8):
        wide = measure(truth.psd, 300e-6, 6000, seed, resolution=3e-6)
        rings = [wide.rings.between(*band) for band in bands]
        ratios.append(
            [ring.psd @ ring.dof / ring.dof.sum() / truth.psd(bands[0, 0]) for ring in rings]
        )
    # Eight profiles of 5 independent waves and more a band, and 10 % for the law.
    error = 1 / np.sqrt(8 * np.array([ring.dof.sum() for ring in rings]))
    assert np.all(np.abs(np.mean(ratios, axis=0) - 1) < 2 * error + 0.1)


def test_a_short_profile_counts_beside_one_that_stands_alone():
    truth = roll_off(1e-6, 0.8)
    with pytest.raises(ValueError, match="too few modes"):
        measure(truth.psd, 230 * NM, 76, 1)
    short = measure(truth.psd, 230 * NM, 76, 1, alone=False)
    wide = measure(truth.psd, 300e-6, 6000, 2, resolution=2e-6)
    whole = stitching.stitch([short, wide])
    assert whole.cutoff.q == pytest.approx(short.cutoff.q, rel=0.12)  # a ring
    assert whole.shares[0].any()


def test_an_untrusted_measurement_has_an_offset_and_no_weight():
    s = SelfAffine(hurst=0.8, q0=1.0, q1=60.0, h_rms=1.0, q_rolloff=4.0)
    step = 4 * np.pi / 256
    spectra = []
    for seed, factor in ((1, 1.0), (2, 3.0)):
        h = factor * surface.synthesise(s, n=256, length=4 * np.pi, seed=seed)
        spectra.append(instrument_spectrum.analyse(Topography(h, step, step, "here"), "none"))
    good, bad = spectra
    whole = stitching.stitch([good, replace(bad, trusted=False)])
    assert not whole.shares[1].any()
    assert whole.fit.hurst == pytest.approx(good.fit.hurst, abs=good.fit.hurst_se)
    assert whole.offsets[1] == pytest.approx(2 * np.log(3), abs=0.2)
    assert np.isnan(whole.offsets[0])


def test_offsets_of_two_measurements_are_those_of_their_logarithms():
    truth = roll_off(1.5e-6, 0.8)
    first, second = (measure(truth.psd, 100e-6, 400, seed) for seed in (1, 2))
    whole = stitching.stitch([first, replace(second, fit=first.fit, cutoff=first.cutoff)])
    # Weights of equal measurements are equal, so that both are off their mean alike.
    assert whole.offsets.sum() == pytest.approx(0, abs=1e-6)


def test_a_tilt_beyond_the_side_is_no_doubt():
    x = np.arange(64) * NM
    heights = np.random.default_rng(1).normal(size=(64, 64)) * NM + 1.5 * x
    assert from_array(heights, NM).doubts == ()
    assert len(from_array(100 * heights, NM).doubts) == 1


def test_a_ring_without_power_does_not_count():
    """Exact waves leave rings empty: another measurement tells what is there."""
    truth = roll_off(1.5e-6, 0.8)
    first, second = (measure(truth.psd, 100e-6, 400, seed) for seed in (1, 2))
    second = replace(second, fit=first.fit, cutoff=first.cutoff)
    q = second.narrow.q
    empty = (q > 2.5 * first.fit.q_min) & (q < 4.5 * first.fit.q_min)
    holed = replace(
        second, narrow=replace(second.narrow, psd=np.where(empty, 0.0, second.narrow.psd))
    )
    whole = stitching.stitch([first, holed])
    assert np.all(np.isfinite(np.log(whole.rings.psd)))
    inside = whole.rings.between(3 * first.fit.q_min, 4 * first.fit.q_min)
    assert len(inside)
    other = stitching.stitch([first, second])
    assert whole.fit.hurst == pytest.approx(other.fit.hurst, abs=2 * other.fit.hurst_se)
