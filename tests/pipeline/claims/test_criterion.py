"""Claims on the criterion, real surfaces and moments, on made-up files."""

import re

import numpy as np
import pytest
from helpers.claim_files import generated, real_surface, stickiness_map, verdicts

from pipeline.claims import criterion
from pipeline.claims.ledger import NOT, OPEN, QUALIFIED, REPRODUCED
from stickiness import criteria
from stickiness.adhesion import equivalent_sphere


@pytest.mark.parametrize("a_v", [1.5, 3.0])
def test_largest_dmt_is_where_threshold_and_jtb_line_cross(a_v):
    h = criterion.largest_dmt(a_v)
    c = 1.5 * a_v
    assert h == pytest.approx(4 / 75 * (c**0.6 * 18.75) ** 2.5)
    length = 0.05
    q0 = length * (c / h ** (5 / 3))  # threshold at h, solved for q0
    assert criteria.h_rms_limit(q0, length, 1.0, a_v) == pytest.approx(h)
    assert criteria.jtb_limit(q0, length, 1.0) == pytest.approx(h)
    # A longer adhesion length raises the JTB line above the threshold.
    assert criteria.jtb_limit(q0, 2 * length, 1.0) > criteria.h_rms_limit(q0, 2 * length, 1.0, a_v)


def test_formula_against_itself_is_qualified_and_wrong_angles_are_not(files):
    assert criterion.slope_angle(files).verdict == QUALIFIED
    m = files["map"]
    files["map"] = m.assign_coords(h_rms_over_range=1.1 * m.h_rms_over_range)
    assert criterion.slope_angle(files).verdict == NOT


def test_limits_count_those_outside_the_dmt_range(files):
    assert "6 of the 6 limits" in criterion.sticky_roughness(files).remark
    # With a_V = 8 the limit at range q0 = 1e-6 passes the JTB limit, 2667.
    files["map"] = stickiness_map(a_v=(8.0, 7.0, 9.0))
    assert "5 of the 6 limits" in criterion.sticky_roughness(files).remark


def test_arithmetic_and_physics_of_the_limits_are_graded_apart(files, monkeypatch):
    arithmetic = criterion.roughness_limits(files)
    assert arithmetic.verdict == QUALIFIED  # the third of the printed limits does not follow
    assert "1.07e+03, 6.77e+04, 4.27e+06" in arithmetic.remark
    assert criterion.sticky_roughness(files).verdict == NOT
    # The made-up map has 2 q0^(-1/2) l_a/range, and half or 1.5 times that as its ends.
    monkeypatch.setattr(criterion, "PRINTED_LIMITS", 0.1 * np.array([1e3, 10**4.5, 1e6]))
    assert criterion.sticky_roughness(files).verdict == QUALIFIED
    assert criterion.roughness_limits(files).verdict == NOT


def test_limits_by_the_edges_are_read_off_the_map(files):
    # limits are q0^(-1/2) l_a/range times 2, 1 and 3
    found = criterion.sticky_roughness(files)
    expected = "100, 3.16e+03, 1e+05 (50, 1.58e+03, 5e+04 to 150, 4.74e+03, 1.5e+05)"
    assert expected in found.remark
    assert found.value == pytest.approx(0.1 * 10**4.5)
    assert found.uncertainty == pytest.approx(0.05 * 10**4.5)
    assert "0% of the map's thresholds have weak edges" in criterion.slope_angle(files).remark


@pytest.mark.parametrize(
    ("margins", "verdict"),
    [
        ({"crystal": 24.0, "gel": 0.001}, NOT),
        ({"crystal": 24.0, "glass": 15.0}, QUALIFIED),  # 2 pi h_rms/L is 0.063, not 0.1
    ],
)
def test_dmt_condition_is_to_hold_for_every_material(files, margins, verdict):
    files["verdicts"] = verdicts(**margins)
    found = criterion.polished_steel(files)
    assert found.verdict == verdict
    assert found.value == min(margins.values())
    assert "holds for crystal (24)" in found.remark
    missed = "gel (0.001)" if verdict == NOT else "none"
    assert f"does not hold for {missed}" in found.remark


def test_tough_edges_do_not_ask_for_more_adhesion_on_finer_surfaces():
    """JKR with the edges of Pastewka and Robbins: zeta^(1 - 2H), from h'^3/h''."""
    for hurst in (0.5, 0.8):
        assert criterion.fractal_exponent(hurst, criterion.threshold_by_moments) == pytest.approx(
            1 - 2 * hurst, abs=1e-3
        )


def test_asphalt_by_its_edges_does_not_know_the_range(files, monkeypatch):
    files["asphalt"] = real_surface("asphalt", h_rms=1e-3)
    found = []
    for reach in (1e-10, 2e-10):
        monkeypatch.setattr(criterion, "RANGE", reach)
        found.append(criterion.asphalt_by_edges(files))
    assert all("tough" in one.text for one in found)
    assert len({one.text.split(" µm and")[0] for one in found}) == 1
    assert len({one.text.split("lies between ")[1] for one in found}) == 1
    assert found[0].value == pytest.approx(found[1].value, rel=1e-2)


def test_asphalt_by_its_edges_hinges_on_the_shortest_wavelength(files):
    """Tough edges with Pastewka and Robbins' a_V: E* goes as wavelength^(1 - 2H), here -0.6."""
    found = criterion.cutoff_factors(files["asphalt"].sel(end="rough"), [1e-5, 1e-6, 1e-7])
    # The limit of broad spectra and of tough edges, which these are near.
    np.testing.assert_allclose(found, [10**-0.6, 1, 10**0.6], rtol=0.1)
    files["asphalt"] = real_surface("asphalt", h_rms=1e-3)
    edges = criterion.asphalt_by_edges(files)
    text, value = edges.text, edges.value
    assert "they are tough" in text
    number = r"([-+.\de]+)"
    long, short, finest, smooth, low, high = (
        float(re.search(pattern.replace("#", number), text).group(1))
        for pattern in (
            "Robbins it is # MPa",
            "10 µm, # for",
            "0.1 µm and # for 1 nm",
            "gives # MPa",
            "between # and",
            "and # MPa.$",
        )
    )
    # numbers are quoted with two digits
    assert long / value == pytest.approx(found[0], rel=0.1)
    assert short / value == pytest.approx(found[2], rel=0.1)
    # of tough edges attraction goes as the root of the adhesion length
    assert low == pytest.approx(long / equivalent_sphere.ERROR_BEYOND**2, rel=0.1)
    assert high == pytest.approx(smooth * found[2] * equivalent_sphere.ERROR_BEYOND**2, rel=0.1)
    assert low < long < value < short < min(finest, high)
    assert (edges.low, edges.high) == pytest.approx((low, high), rel=0.1)


def test_modulus_that_the_edges_neither_confirm_nor_exclude_is_not_decided(files, monkeypatch):
    found = criterion.sticky_asphalt(files)
    edges = criterion.asphalt_by_edges(files)
    assert found.value == edges.value
    for printed, verdict in ((0.9 * edges.high, OPEN), (1.1 * edges.high, NOT)):
        monkeypatch.setattr(criterion, "PRINTED_MODULUS", printed)
        assert criterion.sticky_asphalt(files).verdict == verdict


def test_measured_surfaces_test_the_line(files):
    found = criterion.real_surfaces(files)
    assert found.verdict == QUALIFIED
    assert "terrain reaches 70 times the line" in found.remark
    files["measured_surfaces"] = [real_surface("steel", kind="measured", c0=1e-4)]
    assert criterion.real_surfaces(files).verdict == REPRODUCED
    files["measured_surfaces"] = []
    assert "there are none" in criterion.real_surfaces(files).remark


def test_moment_ratios_of_two_crossed_waves():
    """Heights cos x cos 2y have m20 : m02 : m22 : m40 : m04 = 1 : 4 : 4 : 1 : 16."""
    x = np.arange(16) * 2 * np.pi / 16
    heights = np.cos(x)[:, None] * np.cos(2 * x)[None, :]
    expected = [
        [12, 12 / 16],
        [np.sqrt(5 / 2), np.sqrt(5 / 8)],
        [np.sqrt(3 * 25 / 8), np.sqrt(3 * 25 / (8 * 16))],
    ]
    np.testing.assert_allclose(criterion.moment_ratios(heights, 2 * np.pi), expected)


def test_lattice_expectation_is_that_of_its_modes():
    """3 m22/m40 summed over the disc of modes with C = q^-3.6, without a surface."""
    zeta = 16
    i, j = np.meshgrid(np.arange(-zeta, zeta + 1), np.arange(-zeta, zeta + 1))
    square = i**2 + j**2
    inside = (square >= 1) & (square <= zeta**2)
    weight = square[inside] ** -1.8
    expected = 3 * np.sum(weight * (i * j)[inside] ** 2) / np.sum(weight * i[inside] ** 4)
    found = criterion.moment_ratios(*criterion.fixed_amplitudes(generated(1, zeta)))
    np.testing.assert_allclose(found[0], expected)
    assert abs(expected - 1) > 1e-3  # else 1 would do as the reference


def test_moments_of_isotropic_surfaces_agree_and_of_stretched_ones_do_not(files):
    claim = criterion.spectral_moments(files)
    ratios = [
        criterion.moment_ratios(surface.height.values, 2 * np.pi)[0] for surface in files["seeds"]
    ]
    assert claim.value == pytest.approx(np.mean(ratios))
    scatter = np.var(ratios, axis=0, ddof=1).mean()  # x and y each about their own mean
    assert claim.uncertainty == pytest.approx(2.92 * np.sqrt(scatter / 6), rel=1e-3)  # t, 2 dof
    assert claim.verdict != NOT
    files["seeds"] = [generated(seed, stretch=2.0) for seed in (1, 2, 3)]
    assert criterion.spectral_moments(files).verdict == NOT
