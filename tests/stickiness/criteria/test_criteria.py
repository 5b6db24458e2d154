"""Stickiness criteria against independent derivations and against each other's limits."""

from pathlib import Path

import numpy as np
import pytest
import yaml
from scipy.stats import norm

from stickiness import adhesive, criteria, dmt, spectrum, units

# A point far from all thresholds and with no two numbers alike, in arbitrary units.
POINT = {"h_rms": 2.0, "q0": 0.03, "adhesion_length": 0.011, "range": 0.3}
MATERIALS = Path(__file__).parents[3] / "config" / "materials.yaml"


def test_traction_ratio_from_gaps_that_obey_the_law():
    # Gaps with the density P(u) = a_V p/(q0 h h) (u/h)^(-1/3), drawn as quantiles, and the general
    # DMT integral must give the closed form.
    a_v, p = 2.5, 1e-3
    h, q0, length, eps = POINT.values()
    top = 1.1 * eps
    share = 1.5 * a_v * p / (q0 * h) * (top / h) ** (2 / 3)
    n = 200_000
    gaps = top * ((np.arange(n) + 0.5) / n) ** 1.5
    pressure = dmt.adhesive_pressure(gaps, adhesive.Maugis(length, eps)) * share
    # Quantiles resolve the area to one in n.
    assert pressure / p == pytest.approx(criteria.traction_ratio(**POINT, a_v=a_v), rel=3e-5)


def test_inequality_forms_agree_on_a_map():
    h = np.geomspace(0.1, 1e4, 40)[:, None]
    length = np.geomspace(1e-3, 1e3, 30)[None, :]
    eps, q0, a_v = 1.0, 1e-3, 2.8
    verdict = criteria.violano(h, q0, length, eps, a_v)
    assert verdict.name == "violano"
    assert verdict.sticky.shape == verdict.margin.shape == (40, 30)
    assert verdict.sticky.any()
    assert not verdict.sticky.all()
    # The first of the two printed forms, (eps/l_a)(h/eps)^(2/3) < (3/2) a_V/(q0 h).
    np.testing.assert_array_equal(
        verdict.sticky, eps / length * (h / eps) ** (2 / 3) < 1.5 * a_v / (q0 * h)
    )
    inverse = criteria.inverse_kappa(criteria.inverse_kappa_ad(h, q0, length, eps, a_v))
    np.testing.assert_array_equal(verdict.sticky, inverse < 0)
    np.testing.assert_array_equal(verdict.sticky, criteria.slope_angle(inverse) > np.pi / 2)
    ratio = criteria.traction_ratio(h, q0, length, eps, a_v)
    np.testing.assert_allclose(verdict.margin, ratio**0.6, rtol=1e-13)
    printed = criteria.violano_printed(h, q0, length, eps).margin
    np.testing.assert_allclose(printed, (9 / 4 * length / (eps * q0)) ** 0.6 / h, rtol=1e-13)
    valid = criteria.dmt_validity(h, q0, length, eps).valid
    np.testing.assert_array_equal(valid, h / eps > 4 / 75 * (length / eps) / (eps * q0))


def test_kappa_from_the_slope_of_area_against_external_pressure():
    # A_rep = kappa_rep p_rep/h' and p_ext = p_rep (1 - ratio): the slope of one on the other.
    slope, kappa_rep = 0.2, 2.1
    ratio = criteria.traction_ratio(**POINT, a_v=2.8)
    p_rep = np.array([1e-3, 2e-3])
    area, external = kappa_rep * p_rep / slope, p_rep * (1 - ratio)
    inverse_ad = criteria.inverse_kappa_ad(**POINT, a_v=2.8, kappa_rep=kappa_rep)
    assert 1 / criteria.inverse_kappa(inverse_ad, kappa_rep) == pytest.approx(
        slope * np.diff(area).item() / np.diff(external).item(), rel=1e-10
    )


def test_slope_angle_turns_continuously_from_arctan_2_to_pi():
    inverse = np.linspace(0.5, -50, 2001)
    angle = criteria.slope_angle(inverse)
    assert angle[0] == pytest.approx(np.arctan(2), rel=1e-14)
    assert np.all(np.diff(angle) > 0)
    assert angle[-1] < np.pi
    np.testing.assert_allclose(np.tan(angle), 1 / inverse, rtol=1e-9)


def test_limits_sit_on_the_threshold():
    h, q0, length, eps = POINT.values()
    limit = criteria.h_rms_threshold(q0, length, eps, 2.8)
    assert criteria.traction_ratio(limit, q0, length, eps, 2.8) == pytest.approx(1, rel=1e-13)
    # The modulus at which l_a = work of adhesion/E* puts the same surface on the threshold.
    modulus = criteria.modulus_threshold(h, q0, 0.05, eps, 2.8)
    assert criteria.violano(h, q0, 0.05 / modulus, eps, 2.8).margin == pytest.approx(1, rel=1e-13)
    assert criteria.violano(h, q0, 0.05 / (0.99 * modulus), eps, 2.8).sticky is True


def test_pastewka_robbins_as_printed():
    slope, curvature, length, eps = 0.3, 2.0, 0.05, 1.1
    delta = eps * np.sqrt(24 * length / eps)
    diameter = 4 * slope / curvature
    left = slope * delta / (2 * length) * (slope * diameter / (4 * delta)) ** (2 / 3)
    verdict = criteria.pastewka_robbins(slope, curvature, length, eps)
    assert verdict.margin == pytest.approx(np.pi * (3 / 16) ** (2 / 3) / left, rel=1e-13)
    assert pytest.approx(1.03, abs=0.005) == criteria.PR_CONSTANT


@pytest.mark.parametrize("ratio", [1.0, np.sqrt(1.2), 3.0])
def test_equivalent_a_v_reproduces_the_verdict(ratio):
    # For Delta_r = ratio * range the inequality and violano's agree everywhere once a_V of the
    # area is divided by the ratio, for the stress l_a/Delta_r falls as the area grows.
    rng = np.random.default_rng(0)
    h, q0, slope, curvature, length, eps = 10 ** rng.uniform(-2, 1, (6, 500))
    a_v = criteria.pastewka_robbins_a_v(q0, h, slope, curvature, ratio) / ratio
    ours = criteria.violano(h, q0, length, eps, a_v)
    theirs = criteria.pastewka_robbins(slope, curvature, length, eps, ratio * eps)
    # Margins are x^(3/5) of the balance of tractions and x itself.
    np.testing.assert_allclose(ours.margin ** (5 / 3), theirs.margin, rtol=1e-11)
    assert 50 < np.count_nonzero(ours.sticky) < 450


@pytest.mark.parametrize("hurst", [0.5, 0.6, 0.8, 0.9])
def test_power_law_a_v_is_the_limit_of_a_broad_spectrum(hurst):
    magnification = 1e7
    s = spectrum.SelfAffine(hurst=hurst, q0=2.0, q1=2.0 * magnification, h_rms=0.1)
    a_v = criteria.pastewka_robbins_a_v(s.q0, s.h_rms, s.rms_slope, s.rms_curvature)
    # The slowest correction is that of the slope, zeta^(2H-2), 4 % for H = 0.9 times 7/6.
    rel = 2 * magnification ** max(2 * hurst - 2, -2 * hurst)
    assert a_v == pytest.approx(
        criteria.pastewka_robbins_a_v_power_law(hurst, magnification), rel=max(rel, 1e-6)
    )


def test_fuller_tabor():
    h, radius, length = 0.5, 3.0, 0.01
    theta = float(h**1.5 / (np.sqrt(radius) * length))
    verdict = criteria.fuller_tabor(h, 2 / radius, length)
    assert verdict.margin == pytest.approx(10 / theta, rel=1e-13)
    assert verdict.sticky is (theta < 10)
    given = criteria.fuller_tabor(h, 99.0, length, radius=radius)
    assert given.margin == pytest.approx(10 / theta, rel=1e-13)


@pytest.mark.slow
@pytest.mark.parametrize("eps", [1e-7, 1e-3, 0.1, 0.49, 0.51, 1.0, 5.0, 40.0])
def test_bearing_area_margin_by_brute_force(eps):
    # Grid search with scipy's normal distribution; its tail difference loses digits below
    # eps = 1e-6, where the density at the middle is exact to eps^2.
    x = np.linspace(0.01, eps + 6, 400_001)
    tail = norm.logsf(x - eps) + np.log(-np.expm1(norm.logsf(x) - norm.logsf(x - eps)))
    if eps < 1e-5:
        tail = norm.logpdf(x - eps / 2) + np.log(eps)
    # Bearing area between u - eps and u for u > eps/2 is the difference of survival functions.
    expected = np.exp(np.max(2 * x + tail)) * 0.2 / (eps * 0.5)
    margin = criteria.bearing_area(1.0, 0.5, 0.2, eps).margin
    # Grid step squared times the second derivative (about 1) is 1e-8.
    assert margin == pytest.approx(expected, rel=1e-6)


def test_bearing_area_limits():
    h, q0, length = 2.0, 0.3, 0.7
    margin = criteria.bearing_area(h, q0, length, 1e-6 * h).margin
    # Corrections are of first order in range/h: the middle of the window is half of it away.
    assert margin == pytest.approx(np.e**2 / np.sqrt(2 * np.pi) * length / (q0 * h**2), rel=1e-5)
    assert criteria.bearing_area([1.0, 1e-4], 0.5, 0.2, 1.0).margin[1] == np.inf


def test_persson_tosatti_of_a_power_law():
    hurst, q0, h = 0.8, 0.3, 0.2
    s = spectrum.SelfAffine(hurst=hurst, q0=q0, q1=q0 * 1e9, h_rms=h)
    # (pi/2) int q^2 C dq with C0 = H h^2 q0^(2H)/pi over a broad band.
    energy = hurst * h**2 * q0 / (2 * (2 * hurst - 1))
    verdict = criteria.persson_tosatti(s, 0.01)
    # The band's end carries zeta^(1-2H) = 4e-6 of it.
    assert verdict.margin == pytest.approx(0.01 / energy, rel=1e-5)
    assert criteria.persson_tosatti(energy, 1.001 * energy).sticky is True
    assert criteria.persson_tosatti(energy, 0.999 * energy).sticky is False


def test_the_crystal_has_the_papers_adhesion_length():
    crystal = yaml.safe_load(MATERIALS.read_text())["materials"]["crystal"]
    modulus = units.si(crystal["plane_strain_modulus"], "Pa")
    length = units.si(crystal["work_of_adhesion"], "J/m^2") / modulus
    assert length == pytest.approx(0.05 * units.si(crystal["range"], "m"), rel=1e-12)
