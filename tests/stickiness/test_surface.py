"""Synthesised surfaces against lattice sums, analytic heights and each other."""

import numpy as np
import pytest
from scipy import stats

from stickiness import surface
from stickiness.remaining.prediction import predict
from stickiness.remaining.roughness import find_anisotropy_error_factor
from stickiness.repulsive import solve
from stickiness.spectrum import SelfAffine, Shells, combine

L = 2 * np.pi  # so that wave numbers are lattice indices


def power_law(q1=16.0, q0=1.0, **kwargs):
    size = kwargs or {"h_rms": 1.0}
    return SelfAffine(hurst=0.8, q0=q0, q1=q1, **size)


@pytest.mark.parametrize("length", [L, 3.7])
def test_lattice_spectrum_is_the_sum_over_wave_vectors(length):
    dq = 2 * np.pi / length
    s = SelfAffine(hurst=0.6, q0=1.5 * dq, q1=9.3 * dq, C0=2.0, q_rolloff=4 * dq)
    sums = dict.fromkeys((0, 2, 4), 0.0)
    for i in range(-12, 13):
        for j in range(-12, 13):
            q = dq * np.hypot(i, j)
            if 1.5 * dq <= q <= 9.3 * dq:
                C = 2.0 * max(q, 4 * dq) ** -3.2
                for power in sums:
                    sums[power] += C * dq**2 * q**power
    window = surface.lattice_spectrum(s, length)
    for power, want in sums.items():
        assert window.variance_below(window.q1, power) == pytest.approx(want, rel=1e-12)
    assert window.q0 == pytest.approx(2 * dq)
    assert window.q1 == pytest.approx(dq * np.sqrt(85))  # 85 = 9^2 + 2^2, 86 is no sum of squares


@pytest.mark.parametrize("size", [{"h_rms": 0.3}, {"C0": 0.05}])
def test_fixed_amplitudes_have_the_lattice_moments_exactly(size):
    s = power_law(12.0, **size)
    window = surface.lattice_spectrum(s, L)
    m = surface.moments(surface.synthesise(s, 32, L, seed=5, amplitudes="fixed"), L)
    assert m.m00 == pytest.approx(window.moment(0), rel=1e-12)
    assert (m.m20 + m.m02) / 2 == pytest.approx(window.moment(2), rel=1e-12)
    for name in ("h_rms", "rms_slope", "rms_curvature", "nayak"):
        assert getattr(m, name) == pytest.approx(getattr(window, name), rel=1e-12)


def test_moments_of_one_wave():
    n, length, a = 24, 3.0, 0.7
    x = np.arange(n) * length / n
    k = 2 * np.pi / length
    h = a * np.cos(2 * k * x)[:, None] * np.ones(n) + 11.0
    m = surface.moments(h, length)
    assert m.m00 == pytest.approx(a**2 / 2)  # the mean does not count
    assert m.m20 == pytest.approx((2 * k * a) ** 2 / 2)
    assert m.m40 == pytest.approx((2 * k) ** 4 * a**2 / 2)
    np.testing.assert_allclose([m.m02, m.m22, m.m04], 0, atol=1e-12 * m.m40)
    product = a * np.cos(2 * k * x)[:, None] * np.sin(k * x)
    assert surface.moments(product, length).m22 == pytest.approx(4 * k**4 * a**2 / 4)


@pytest.mark.parametrize("skewness", [0.0, -2.0])
@pytest.mark.parametrize("amplitudes", ["gaussian", "fixed"])
def test_grids_sample_one_surface(amplitudes, skewness):
    s = power_law(10.0)
    coarse, fine, odd = (surface.synthesise(s, n, L, 3, amplitudes, skewness) for n in (24, 96, 72))
    np.testing.assert_allclose(fine[::4, ::4], coarse, atol=1e-13)
    np.testing.assert_allclose(odd[::3, ::3], coarse, atol=1e-13)


def test_a_larger_band_adds_modes_to_those_there():
    low, high = (surface.synthesise(power_law(q1, C0=0.1), 64, L, 11) for q1 in (8.0, 20.0))
    k = np.fft.fftfreq(64, 1 / 64)
    inside = np.hypot(*np.meshgrid(k, k)) <= 8 + 1e-9
    difference = np.fft.fft2(high - low) / 64**2
    assert np.abs(difference[inside]).max() < 1e-15
    assert np.abs(difference[~inside]).max() > 1e-6


@pytest.mark.parametrize(("q0", "q1"), [(1.0, 16.0), (2.0, 5.0), (np.sqrt(2), np.sqrt(50))])
def test_band_limits_are_exact(q0, q1):
    h = surface.synthesise(power_law(q1, q0), 64, L, 0)
    k = np.fft.fftfreq(64, 1 / 64)
    q = np.hypot(*np.meshgrid(k, k))
    power = np.abs(np.fft.fft2(h) / 64**2) ** 2
    band = (q > q0 - 1e-9) & (q < q1 + 1e-9)
    assert power[~band].sum() < 1e-28
    assert np.all(power[band] > 0)
    realised = surface.realised_spectrum(h, L)
    assert (realised.q0, realised.q1) == pytest.approx((q[band].min(), q[band].max()), rel=1e-12)
    assert realised.h_rms == pytest.approx(1.0, rel=1e-12)


def test_gaussian_modes_have_the_spectrum_on_average():
    s = power_law(4.0, C0=1.0)
    window = surface.lattice_spectrum(s, L)
    seeds = 400
    power = np.zeros((seeds, len(window.q)))
    for seed in range(seeds):
        realised = surface.realised_spectrum(surface.synthesise(s, 10, L, seed), L)
        power[seed] = realised.variance
    # each shell is a sum of count/2 exponential variables of equal mean
    i, j = np.meshgrid(np.arange(-5, 6), np.arange(-5, 6))
    count = np.array([np.sum(np.isclose(i**2 + j**2, q**2)) for q in window.q])
    error = window.variance * np.sqrt(2 / count / seeds)
    assert np.all(np.abs(power.mean(axis=0) - window.variance) < 4 * error)
    # the standard error of a sample variance of 400 exponentials is 14 %
    np.testing.assert_allclose(power.var(axis=0), window.variance**2 * 2 / count, rtol=4 * 0.14)


@pytest.mark.parametrize("hurst", [0.3, 0.8])
@pytest.mark.parametrize(("ratio", "angle"), [(2.0, 0.0), (4.0, 0.4)])
def test_realised_spectrum_keeps_the_ratio_of_correlation_lengths(hurst, ratio, angle):
    ground = SelfAffine(hurst=hurst, q0=4.0, q1=32.0, h_rms=1.0, anisotropy=ratio, angle=angle)
    ratios = []
    for seed in range(10):
        realised = surface.realised_spectrum(surface.synthesise(ground, 140, L, seed), L)
        ratios.append(realised.anisotropy)
    np.testing.assert_allclose(ratios, ratio, rtol=0.15)
    assert np.mean(ratios) == pytest.approx(ratio, rel=0.03)
    assert surface.lattice_spectrum(ground, L).anisotropy == ratio
    both = combine(realised, Shells([5.0], [0.1]))
    assert 1 < both.truncated(20.0).anisotropy < realised.anisotropy
    factor = predict(realised, 0.1, 0.1).anisotropy_error_factor
    assert factor == pytest.approx(find_anisotropy_error_factor(ratios[-1]))


@pytest.mark.parametrize("q1", [2.0, 4.0, 8.0])
def test_few_isotropic_waves_have_no_direction_by_chance(q1):
    ratios = []
    for seed in range(300):
        heights = surface.synthesise(power_law(q1), 18, L, seed)
        ratios.append(surface.realised_spectrum(heights, L).anisotropy)
    assert np.count_nonzero(np.array(ratios) != 1) <= 1  # one in a thousand, of 300
    one_wave = np.cos(np.arange(16) * 2 * np.pi / 16)[:, None] * np.ones(16)
    assert surface.realised_spectrum(one_wave, L).anisotropy == 1


@pytest.mark.parametrize("n", [33, 40, 64])
def test_resampling_is_exact_for_a_band_limited_surface(n):
    s = power_law(12.0)
    h = surface.synthesise(s, 32, L, 9)
    np.testing.assert_allclose(surface.resample(h, n), surface.synthesise(s, n, L, 9), atol=1e-12)
    np.testing.assert_allclose(surface.resample(surface.resample(h, n), 32), h, atol=1e-12)
    np.testing.assert_array_equal(surface.resample(h, 32), h)
    with pytest.raises(ValueError, match="n = 20"):
        surface.resample(h, 20)


@pytest.mark.parametrize("amplitudes", ["gaussian", "fixed"])
def test_surface_of_shells(amplitudes):
    s = power_law(9.0, C0=1.0)
    window = surface.lattice_spectrum(s, L)
    # the shells of a window are on its lattice: same modes, same variances, same surface
    np.testing.assert_allclose(
        surface.synthesise(window, 24, L, 6, amplitudes),
        surface.synthesise(s, 24, L, 6, amplitudes),
        atol=1e-12,
    )
    again = surface.lattice_spectrum(window, L)
    np.testing.assert_allclose(again.variance, window.variance, rtol=1e-12)
    with pytest.raises(ValueError, match=r"shell at q = 2\.5"):
        surface.synthesise(Shells([1.0, 2.5], [1.0, 1.0]), 24, L, 6)


def wide(seed, skewness, hurst=0.8, magnification=8.0):
    """Heights of 4 by 4 longest waves, on four points per shortest wave."""
    s = SelfAffine(hurst=hurst, q0=4.0, q1=4 * magnification, h_rms=0.3)
    return surface.synthesise(s, int(16 * magnification), L, seed, skewness=skewness)


@pytest.mark.parametrize("skewness", [-4.0, -1.0, 1e-3, 0.5, 3.0])
def test_shape_of_the_log_normal_distribution(skewness):
    shape = surface.log_normal_shape(skewness)
    assert np.sign(shape) == np.sign(skewness)
    found = stats.lognorm.stats(abs(shape), moments="s")
    # Far below 1, scipy rounds exp(s^2) - 1.
    assert found == pytest.approx(abs(skewness), rel=1e-8)


@pytest.mark.parametrize(
    ("hurst", "magnification", "skewness", "least", "most", "scatter"),
    [
        (0.5, 8, 1.0, 0.98, 1.0, 0.005),
        (0.8, 8, 1.0, 0.98, 1.0, 0.01),
        (0.8, 8, -1.0, 0.98, 1.0, 0.01),
        (0.8, 8, -2.0, 0.90, 0.97, 0.05),
        (0.8, 8, 3.0, 0.78, 0.88, 0.08),
        (0.8, 8, -4.0, 0.68, 0.80, 0.10),
        pytest.param(0.5, 32, 1.0, 0.995, 1.001, 0.002, marks=pytest.mark.slow),
        pytest.param(0.8, 32, -3.0, 0.84, 0.92, 0.08, marks=pytest.mark.slow),
    ],
)
def test_skewness_is_the_one_asked_for_as_far_as_is_said(
    hurst, magnification, skewness, least, most, scatter
):
    reached = [
        stats.skew(wide(seed, skewness, hurst, magnification), axis=None) / skewness
        for seed in range(8 if magnification < 32 else 4)
    ]
    assert least < np.mean(reached) < most
    assert np.std(reached) < scatter


@pytest.mark.parametrize("sign", [-1, 1])
def test_skewed_heights_are_log_normal(sign):
    shape = abs(surface.log_normal_shape(1.0))
    wanted = stats.lognorm(shape)
    heights = np.sort(sign * wide(2, sign * 1.0).ravel())
    shares = (np.arange(heights.size) + 0.5) / heights.size
    expected = (wanted.ppf(shares) - wanted.mean()) / wanted.std()
    error = heights / 0.3 - expected
    assert np.sqrt(np.mean(error**2)) < 0.01
    gaussian = np.sort(wide(2, 0.0).ravel()) / 0.3
    assert np.sqrt(np.mean((gaussian - expected) ** 2)) > 0.1
    kurtosis = stats.kurtosis(heights, fisher=False)
    assert kurtosis == pytest.approx(3 + wanted.stats(moments="k"), rel=0.03)


@pytest.mark.parametrize("amplitudes", ["gaussian", "fixed"])
@pytest.mark.parametrize("size", [{"h_rms": 0.3}, {"C0": 0.05}])
def test_a_skewed_surface_has_the_spectrum_of_the_gaussian_one(amplitudes, size):
    s = power_law(12.0, 2.0, **size)
    plain, skewed = (
        surface.synthesise(s, 64, L, 5, amplitudes, skewness) for skewness in (0.0, -3.0)
    )
    expected = surface.realised_spectrum(plain, L)
    found = surface.realised_spectrum(skewed, L)
    np.testing.assert_allclose(found.q, expected.q, rtol=1e-14)
    np.testing.assert_allclose(found.variance, expected.variance, rtol=1e-10)
    assert surface.moments(skewed, L).rms_slope == pytest.approx(
        surface.moments(plain, L).rms_slope, rel=1e-12
    )
    assert np.abs(skewed - plain).max() > 0.1 * plain.std()


def make_modes(seed=4):
    i, j, variance = SelfAffine(hurst=0.8, q0=4.0, q1=24.0, h_rms=1.0).modes(L)
    return i, j, surface.sample_modes(variance, seed, "gaussian")


def test_more_rounds_come_closer_to_the_skewness():
    i, j, modes = make_modes()
    off = []
    for rounds in (1, 5, 20):
        skewed = surface.skew_modes(i, j, modes, 1.0, rounds)
        np.testing.assert_allclose(np.abs(skewed), np.abs(modes), rtol=1e-12)
        off.append(1 - stats.skew(surface.sum_modes(i, j, skewed, 96), axis=None))
    assert 0.3 < off[0] < 0.7
    assert off[1] < off[0] / 3
    assert 0 < off[2] < off[1] / 5


def test_rounding_does_not_decide_on_skewed_surfaces():
    i, j, modes = make_modes()
    noise = np.random.default_rng(1).standard_normal(len(modes))
    change = surface.skew_modes(i, j, modes * (1 + 1e-15 * noise), 3.0)
    change -= surface.skew_modes(i, j, modes, 3.0)
    assert np.abs(change).max() < 1e-12


def test_a_plateau_carries_on_more_area_than_peaks():
    area = {
        skewness: solve(wide(1, skewness), L, 0.03 * 4 * 0.3, tol=1e-4).area_fraction
        for skewness in (-1.0, 0.0, 1.0)
    }
    assert area[-1.0] > 1.5 * area[0.0]
    assert area[0.0] > 1.5 * area[1.0]
