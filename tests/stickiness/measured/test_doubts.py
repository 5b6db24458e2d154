"""Doubts about measurements: what no surface has is named, and good surfaces raise none."""

import re
from dataclasses import replace

import numpy as np
import pytest
import yaml
from scipy import ndimage

from stickiness import surface
from stickiness.measured import doubts, instrument_spectrum, topography
from stickiness.measured.topography import Topography
from stickiness.spectrum import SelfAffine
from stickiness.statistics import COVERS

pytestmark = [
    pytest.mark.processors,
    pytest.mark.usefixtures("coarse_simulation"),
]


def rough(hurst=0.8, n=128):
    spectrum = SelfAffine(hurst=hurst, q0=1.0, q1=n / 2, h_rms=1.0)
    return surface.synthesise(spectrum, n, 2 * np.pi, 3)


def with_zeros(heights, share):
    heights = heights + 0.0
    chosen = np.random.default_rng(0).random(heights.shape) < share
    heights[chosen] = 0.0
    return heights


@pytest.mark.parametrize(
    ("values", "words"),
    [
        (with_zeros(rough() + 7, 0.004), "give missing_value: 0"),
        (with_zeros(np.round(1000 * rough()), 0.05), "the one value 0"),
        (rough(), None),
        (np.round(10 * rough()), None),  # about eighty levels
        (rough()[0], None),
        (np.where(rough() > 2, np.nan, rough()), None),
        (with_zeros(rough(), 0.0005), None),  # spikes, if they stand out
    ],
)
def test_numbers_that_were_not_measured_are_doubted_and_those_of_surfaces_not(values, words):
    text = " ".join(doubts.doubt_values(values))
    assert words in text if words else text == ""


@pytest.mark.slow
@pytest.mark.parametrize("marker", [1.9558671260099585, -1e-9, 1 / 3e7, -1.5e38, 7.0])
def test_the_marker_that_the_message_names_is_read_as_missing(tmp_path, marker):
    np.save(tmp_path / "a.npy", np.where(rough() > 1.3, marker, rough() + 5))
    given = {"length": "1 mm", "height_unit": "um", "missing": "fill", "max_missing": 0.5}
    doubts = " ".join(topography.read(tmp_path / "a.npy", **given).doubts)
    advice = yaml.safe_load(re.search(r"missing_value: \S+", doubts)[0])
    found = topography.read(tmp_path / "a.npy", **given, **advice)
    assert found.doubts == ()
    assert found.count(topography.FILL) == np.count_nonzero(rough() > 1.3)


def test_sizes_of_scans_and_profiles_are_not_doubted():
    assert not list(doubts.doubt_sizes(1e-6 * rough(), (1e-5, 2e-5)))
    assert not list(doubts.doubt_sizes(1e-10 * rough(), (1e-9, 1e-9)))
    assert not list(doubts.doubt_sizes(1e-5 * rough()[0], (1e-4,)))
    atoms = " ".join(doubts.doubt_sizes(1e-13 * rough(), (1e-12, 1e-12)))
    assert "the side of 1.28e-10 m is shorter than 1e-09 m" in atoms


def test_slopes_and_heights_that_no_instrument_measures_are_doubted():
    noise = np.random.default_rng(0).standard_normal((128, 128))
    per_step = np.sqrt(sum(np.mean(np.diff(noise, axis=axis) ** 2) for axis in (0, 1)))
    for slope, whole, count in ((4.9, False, 0), (5.1, False, 1), (0.9, True, 0), (1.1, True, 1)):
        heights = 1e-6 * slope / per_step * noise
        assert len(list(doubts.doubt_sizes(heights, (1e-6, 1e-6), whole))) == count, slope
    for h_rms, count in ((4e-11, 1), (6e-11, 0)):
        assert len(list(doubts.doubt_sizes(h_rms * rough(), (1e-9, 1e-9)))) == count, h_rms


@pytest.mark.parametrize("wave", [(20.3, 0.0), (12.0, 9.0)])
def test_a_grating_has_a_period_and_random_surfaces_none(wave):
    x = 2 * np.pi * np.arange(128) / 128
    grating = np.sign(np.sin(wave[0] * x[:, None] + wave[1] * x + 0.1)) + 0.1 * rough()
    found = doubts.find_pattern(grating)
    np.testing.assert_allclose(np.abs(found), wave, atol=0.1)
    (text,) = doubts.doubt_pattern("here", grating, sides=(128e-6, 128e-6))
    period = float(re.search(r"period of (\S+) m", text)[1])
    assert period == pytest.approx(128e-6 / np.hypot(*wave), rel=0.01)
    for lowest in (1.0, 6.0):
        spectrum = SelfAffine(hurst=0.8, q0=lowest, q1=64.0, h_rms=1.0)
        for seed in range(10):
            heights = surface.synthesise(spectrum, 128, 2 * np.pi, seed)
            assert doubts.find_pattern(heights) is None


def test_crossed_gratings_have_the_period_of_the_stronger_one():
    x = 2 * np.pi * np.arange(128) / 128
    noise = np.random.default_rng(0).normal(scale=0.5, size=(128, 128))
    crossed = np.sin(20.3 * x[:, None]) + 0.9 * np.sin(31.2 * x) + noise
    np.testing.assert_allclose(np.abs(doubts.find_pattern(crossed)), (20.3, 0.0), atol=0.1)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("hurst", "blur", "count"),
    [(0.1, 0, 2), (0.5, 0, 2), (1.0, 0, 20), (0.9, 0.7, 20), (0.9, 1, 20)],
)
def test_spectra_of_surfaces_seen_through_instruments_are_not_doubted(hurst, blur, count):
    spectrum = SelfAffine(hurst=hurst, q0=1.0, q1=128, h_rms=1e-7)
    for seed in range(count):
        heights = surface.synthesise(spectrum, 256, 2 * np.pi, seed)
        blurred = ndimage.gaussian_filter(heights, blur, mode="wrap")
        map_ = topography.Topography(blurred, 1e-6, 1e-6, "here").detrended()
        assert not list(doubts.doubt_fit(instrument_spectrum.analyse(map_).fit))


@pytest.mark.parametrize(
    ("hurst", "error", "doubted"),
    [(0.9, 0.3, False), (1.2, 0.3, False), (1.6, 0.1, True), (-0.2, 0.3, False), (-0.2, 0.1, True)],
)
def test_an_exponent_is_doubted_if_it_is_outside_by_more_than_its_error(hurst, error, doubted):
    fit = instrument_spectrum.analyse(Topography(rough(), 1e-6, 1e-6, "here"), "none").fit
    covariance = np.diag([1e-4, (error / COVERS) ** 2])
    other = replace(fit, hurst=hurst, log_covariance=covariance, q_rolloff=None, misfit=0.0)
    assert bool(list(doubts.doubt_fit(other))) == doubted
