"""Claims on the criterion, real surfaces and moments, on made-up files."""

import numpy as np
import pytest
from helpers.claim_files import generated, real_surface, verdicts

from claims import criterion_claims as criterion
from claims.ledger import NOT, OPEN, QUALIFIED, REPRODUCED
from stickiness import criteria


@pytest.mark.parametrize("a_v", [1.5, 3.0])
def test_largest_dmt_is_where_threshold_and_jtb_line_cross(a_v):
    h = criterion.largest_dmt(a_v)
    c = 1.5 * a_v
    assert h == pytest.approx(4 / 75 * (c**0.6 * 18.75) ** 2.5)
    length = 0.05
    q0 = length * (c / h ** (5 / 3))  # threshold at h, solved for q0
    assert criteria.h_rms_threshold(q0, length, 1.0, a_v) == pytest.approx(h)
    assert criteria.jtb_limit(q0, length, 1.0) == pytest.approx(h)
    # A longer adhesion length raises the JTB line above the threshold.
    assert criteria.jtb_limit(q0, 2 * length, 1.0) > criteria.h_rms_threshold(
        q0, 2 * length, 1.0, a_v
    )


def test_formula_against_itself_is_qualified_and_wrong_angles_are_not(files):
    assert criterion.slope_angle(files).verdict == QUALIFIED
    m = files["map"]
    files["map"] = m.assign_coords(h_rms_over_range=1.1 * m.h_rms_over_range)
    assert criterion.slope_angle(files).verdict == NOT


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
    assert ("crystal", 24.0) in found.facts["within"]
    assert found.facts["outside"] == ([("gel", 0.001)] if verdict == NOT else [])


def test_tough_edges_do_not_ask_for_more_adhesion_on_finer_surfaces():
    """JKR with the edges of Pastewka and Robbins: zeta^(1 - 2H), from h'^3/h''."""
    for hurst in (0.5, 0.8):
        assert criterion.fractal_exponent(hurst, criterion.threshold_by_moments) == pytest.approx(
            1 - 2 * hurst, abs=1e-3
        )


def test_measured_surfaces_test_the_line(files):
    found = criterion.real_surfaces(files)
    assert (found.verdict, found.facts["line"]) == (REPRODUCED, NOT)
    assert found.facts["measured"] == [("rough terrain", pytest.approx(70))]
    files["measured_surfaces"] = [real_surface("steel", kind="measured", c0=1e-4)]
    assert criterion.real_surfaces(files).facts["line"] == REPRODUCED
    files["measured_surfaces"] = []
    found = criterion.real_surfaces(files)
    assert (found.facts["measured"], found.facts["line"]) == ([], OPEN)


def test_arithmetic_is_exact_or_wrong(files, monkeypatch):
    monkeypatch.setattr(criterion, "PRINTED_MODULUS", 0.3)
    assert criterion.real_surfaces(files).verdict == NOT


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
        criterion.moment_ratios(surface.height.values[0], 2 * np.pi)[0]
        for surface in files["seeds"]
    ]
    assert claim.value == pytest.approx(np.mean(ratios))
    scatter = np.var(ratios, axis=0, ddof=1).mean()  # x and y each about their own mean
    assert claim.uncertainty == pytest.approx(2.92 * np.sqrt(scatter / 6), rel=1e-3)  # t, 2 dof
    assert claim.verdict != NOT
    files["seeds"] = [generated(seed, stretch=2.0) for seed in (1, 2, 3)]
    assert criterion.spectral_moments(files).verdict == NOT
