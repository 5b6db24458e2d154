"""Controlled means against brute force, exact laws and independent solutions."""

import numpy as np
import pytest

from stickiness import dmt, repulsive, surface
from stickiness.accuracy import multilevel
from stickiness.spectrum import SelfAffine

L = 2 * np.pi


def power_law(q1=16.0, hurst=0.8, **kwargs):
    return SelfAffine(hurst=hurst, q0=1.0, q1=q1, **(kwargs or {"h_rms": 1.0}))


def correlated(seed, n, k=2):
    """Skewed samples (n, 3) that depend on k skewed controls, not only linearly."""
    rng = np.random.default_rng(seed)
    x = rng.exponential(size=(n, k))
    y = x @ np.arange(1.0, 3 * k + 1).reshape(k, 3) + 0.3 * x[:, :1] ** 2
    return y + 0.5 * rng.standard_normal((n, 3)), x


def corrected(fine, coarse, many):
    """Multilevel mean by controls that do not scatter: the coarse level has its plain mean."""
    constant = np.ones((len(many), 1)), np.ones((2, 1))
    return multilevel.multilevel_mean(fine, coarse, many, *constant)


def test_coefficients_leave_their_own_sample_out():
    y, x = correlated(1, 20)
    _, elsewhere = correlated(2, 50)
    got = multilevel.controlled_mean(y, x, elsewhere)
    terms, slopes = [], []
    for a in range(20):
        others = np.arange(20) != a
        design = np.column_stack([np.ones(19), x[others]])
        slope = np.linalg.lstsq(design, y[others], rcond=None)[0][1:]
        terms.append(y[a] - (x[a] - elsewhere.mean(0)) @ slope)
        slopes.append(slope)
    terms = np.array(terms)
    # the closed form of the twenty fits differs from them by rounding
    np.testing.assert_allclose(got.mean, terms.mean(0), rtol=1e-10)
    np.testing.assert_allclose(got.coefficient, np.mean(slopes, 0), rtol=1e-10)
    error = np.hypot(
        terms.std(0, ddof=1) / np.sqrt(20),
        (elsewhere @ np.mean(slopes, 0)).std(0, ddof=1) / np.sqrt(50),
    )
    np.testing.assert_allclose(got.standard_error, error, rtol=1e-10)


def test_fine_coefficient_leaves_its_own_sample_out():
    rng = np.random.default_rng(3)
    coarse, many = rng.exponential(size=(16, 2)), rng.exponential(size=(40, 2))
    fine = coarse**1.5 + 0.1 * rng.standard_normal((16, 2))
    got = corrected(fine, coarse, many)
    for column in range(2):
        f, c, m = fine[:, column], coarse[:, column], many[:, column]
        slopes = [np.polyfit(np.delete(c, a), np.delete(f, a), 1)[0] for a in range(16)]
        terms = f - np.array(slopes) * (c - m.mean())
        assert got.mean[column] == pytest.approx(terms.mean(), rel=1e-10)
        assert got.coefficient[column] == pytest.approx(np.mean(slopes), rel=1e-10)
        error = np.hypot(terms.std(ddof=1) / 4, np.mean(slopes) * m.std(ddof=1) / np.sqrt(40))
        assert got.standard_error[column] == pytest.approx(error, rel=1e-10)


@pytest.mark.slow
@pytest.mark.parametrize("few", [8, 16])
def test_two_levels_without_bias_and_with_an_honest_error(few):
    found = []
    for r in range(800):
        rng = np.random.default_rng([7, r])
        x, z = rng.exponential(size=(56, 1)), rng.standard_normal((56, 2))
        coarse = 2 * x + 0.5 * z[:, :1]
        fine = 1 + 0.8 * coarse + 0.05 * coarse**2 + 0.1 * z[:, 1:]
        elsewhere = rng.exponential(size=(300, 1))
        found.append(
            multilevel.multilevel_mean(fine[:few], coarse[:few], coarse[few:], x[few:], elsewhere)
        )
    means = np.array([f.mean for f in found])
    # E c = 2, E c^2 = 4 * 2 + 0.25
    exact = 1 + 1.6 + 0.05 * 8.25
    assert abs(means.mean() - exact) < 4 * means.std() / np.sqrt(800)
    stated = np.mean([f.standard_error**2 for f in found])
    assert stated / means.var() == pytest.approx(1, abs=0.25)


def test_few_fine_seeds_take_the_ratio_of_means_without_their_own_sample():
    rng = np.random.default_rng(20)
    coarse, many = rng.exponential(size=(3, 2)), rng.exponential(size=(40, 2))
    fine = 0.3 * coarse + 0.01 * rng.standard_normal((3, 2))
    got = corrected(fine, coarse, many)
    for column in range(2):
        f, c, m = fine[:, column], coarse[:, column], many[:, column]
        ratios = [np.delete(f, a).sum() / np.delete(c, a).sum() for a in range(3)]
        terms = f - np.array(ratios) * (c - m.mean())
        assert got.mean[column] == pytest.approx(terms.mean(), rel=1e-12)
        assert got.coefficient[column] == pytest.approx(np.mean(ratios), rel=1e-12)
    changing_sign = corrected(fine, coarse, many - many.mean(0))
    np.testing.assert_array_equal(changing_sign.coefficient, 1)
    none = corrected(fine, np.zeros((3, 2)), many)
    np.testing.assert_array_equal(none.coefficient, 1)


def test_controls_without_scatter_are_left_out():
    y, x = correlated(11, 30)
    _, elsewhere = correlated(12, 40)
    want = multilevel.controlled_mean(y, x, elsewhere)
    constant = np.full((30, 1), 0.1), np.full((40, 1), 0.1)
    twice = (
        np.hstack([x, x[:, :1], constant[0]]),
        np.hstack([elsewhere, elsewhere[:, :1], constant[1]]),
    )
    got = multilevel.controlled_mean(y, *twice)
    np.testing.assert_allclose(got.mean, want.mean, rtol=1e-9)
    np.testing.assert_array_equal(got.coefficient[3], 0)
    none = multilevel.controlled_mean(y, np.ones((30, 1)), np.ones((40, 1)))
    np.testing.assert_allclose(none.mean, y.mean(0), rtol=1e-14)
    # areas at ranges beyond all gaps are the same for every seed of the coarse grid
    fine = np.random.default_rng(13).normal(size=9)
    still = corrected(fine, np.ones(9), np.ones(20))
    assert still.mean == pytest.approx(fine.mean(), rel=1e-14)


@pytest.mark.parametrize("cutoff", [16.0, 50.0])
def test_descriptors_of_a_surface_without_shorter_waves_are_its_own(cutoff):
    s = power_law(16.0, h_rms=0.3)
    rows = multilevel.descriptors(s, L, [3, 9], cutoff=cutoff)
    for row, seed in zip(rows, (3, 9), strict=True):
        named = dict(zip(multilevel.DESCRIPTORS, row, strict=True))
        heights = surface.synthesise(s, 64, L, seed)
        shells = surface.realised_spectrum(heights, L)
        assert named["full_contact_energy"] == pytest.approx(shells.q @ shells.variance, rel=1e-10)
        slope = surface.moments(heights, L).rms_slope
        assert named["rms_slope"] == pytest.approx(slope, rel=1e-10)
        assert named["mean_square_slope"] == pytest.approx(slope**2, rel=1e-10)
        for share in (0.01, 0.03, 0.1, 0.3):
            top = np.sort(heights, axis=None)[-round(share * 64**2) :].mean()
            assert named[f"summit_{share:g}"] == pytest.approx(top, rel=1e-10)


def test_descriptors_depend_on_the_seed_alone_and_scale_with_the_surface():
    s = power_law(20.0)
    rows = multilevel.descriptors(s, L, [5, 6, 7])
    np.testing.assert_array_equal(rows[1], multilevel.descriptors(s, L, [6])[0])
    assert len(np.unique(rows[:, 3])) == 3
    # heights three times as large on a window half as wide: slopes six times as large
    half = SelfAffine(hurst=0.8, q0=2.0, q1=40.0, h_rms=3.0)
    scale = np.array([18, 6, 36, 3, 3, 3, 3])
    np.testing.assert_allclose(
        multilevel.descriptors(half, L / 2, [5, 6, 7]), scale * rows, rtol=1e-12
    )
    # by its C0 the surface keeps the height it came with, as in synthesis
    s = power_law(8.0, C0=1.0)
    heights = surface.synthesise(s, 32, L, 4)
    assert multilevel.descriptors(s, L, [4])[0, 1] == pytest.approx(
        surface.moments(heights, L).rms_slope, rel=1e-10
    )
    fixed = multilevel.descriptors(s, L, [4, 5], "fixed")
    assert fixed[0, 1] == pytest.approx(fixed[1, 1], rel=1e-12)
    assert fixed[0, 3] != pytest.approx(fixed[1, 3], rel=1e-3)


def contact(seed, s, pixels):
    n = int(s.q1) * pixels
    solved = repulsive.solve(surface.synthesise(s, n, L, seed), L, 0.065, tol=1e-4)
    ranges = np.geomspace(0.01, 0.1, 9)
    area = dmt.attractive_area(solved.gap, ranges, subpixel=True)
    strip = dmt.boundary_strip(solved.gap == 0)
    a_v = dmt.fit_a_v(ranges, area, 0.065).value
    return [solved.area_fraction - strip, solved.mean_gap, a_v]


@pytest.mark.slow
def test_rough_contacts():
    """Six experiments of 8 fine and 32 coarse seeds against plain means of 144 other seeds."""
    s = power_law(16.0)
    fine = np.array([contact(k, s, 8) for k in range(1, 193)])
    coarse = np.array([contact(k, s, 2) for k in range(1, 49)])
    many = np.array([contact(k, s, 2) for k in range(1001, 1193)])
    x = multilevel.descriptors(s, L, range(1001, 1193))
    found = []
    for r in range(6):
        few, pool = slice(8 * r, 8 * r + 8), slice(32 * r, 32 * r + 32)
        elsewhere = multilevel.descriptors(s, L, range(5000 + 500 * r, 5500 + 500 * r))
        found.append(
            multilevel.multilevel_mean(fine[few], coarse[few], many[pool], x[pool], elsewhere)
        )
    means = np.array([f.mean for f in found])
    reference = fine[48:]
    error = np.hypot(reference.std(0, ddof=1) / 12, means.std(0, ddof=1) / np.sqrt(6))
    assert np.all(np.abs(means.mean(0) - reference.mean(0)) < 3.5 * error)
    stated = np.sqrt(np.mean([f.standard_error**2 for f in found], axis=0))
    plain = fine.std(0, ddof=1) / np.sqrt(8)
    # the goal was 2.2; at magnification 64, 5 to 7 are measured
    assert np.all(stated < plain / 2.2)
    # with six repetitions the ratio of variances follows F(5, 6 * 7): 0.1 to 4.5 at 1e-3 each side
    assert np.all(means.std(0, ddof=1) / stated < 2.2)


@pytest.mark.parametrize("unit", [1e-9, -1.0, 1e9])
def test_the_slope_of_the_coarse_solution_does_not_depend_on_the_unit(unit):
    rng = np.random.default_rng(31)
    coarse, many = (1 + 1e-3 * rng.standard_normal(n) for n in (16, 40))
    fine = 3 * coarse + 1e-5 * rng.standard_normal(16)
    want, got = corrected(fine, coarse, many), corrected(unit * fine, unit * coarse, unit * many)
    assert want.coefficient == pytest.approx(3, rel=0.02)
    assert got.coefficient == pytest.approx(want.coefficient, rel=1e-6)
    assert got.mean == pytest.approx(unit * want.mean, rel=1e-12)
    # Without scatter there is no slope, whatever the sign.
    still = corrected(unit * fine, np.full(16, 0.1 * unit), np.full(40, 0.1 * unit))
    assert still.coefficient == 1
    assert still.mean == pytest.approx(unit * fine.mean(), rel=1e-12)
