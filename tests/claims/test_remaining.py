"""Claims held against the adhesion that remains."""

import numpy as np
import pytest
from helpers import claim_files

from claims import criterion_claims as claims
from claims.criterion_claims import sticky_asphalt, sticky_roughness, truncation
from claims.ledger import NOT, OPEN, QUALIFIED, REPRODUCED
from common.experiment_outcomes import COMPATIBLE, MISSED, SILENT, SOME
from stickiness.remaining import Roughness


@pytest.mark.parametrize(
    ("growth", "late", "verdict"),
    [(0.0, 0.0, REPRODUCED), (0.3, 0.05, OPEN), (0.3, 0.3, OPEN), (0.0, 0.3, OPEN)],
)
def test_truncation_is_graded_by_simulated_energies(growth, late, verdict):
    found = truncation({"remaining": claim_files.remaining(growth, late)})
    assert found.verdict == verdict
    assert found.value == pytest.approx(1 / (1 + growth))  # share in proportion to w/U_full
    assert (found.facts["coarse"], found.facts["fine"]) == (4, 32)
    assert found.uncertainty == pytest.approx(0, abs=1e-12)  # both surfaces are alike
    late = (1 + growth) / (1 + growth + late) - 1
    assert found.facts["late"] == pytest.approx(late)  # over a factor of ten
    assert found.facts["equal"] == [(zeta, pytest.approx(0.25)) for zeta in (4, 32, 320)]


def test_surfaces_scatter_and_shares_fall_at_equal_energy():
    table = claim_files.remaining()
    table.loc[(table.seed == 2) & (table.magnification == 32), "bound"] *= 0.8
    table.loc[(table.seed == 1) & (table.magnification == 320), "bound"] *= 0.9
    found = truncation({"remaining": table})
    assert found.value == pytest.approx(0.9)
    assert found.uncertainty == pytest.approx(6.3138 * 0.2 / 2, rel=1e-4)  # t of 1 dof, s/sqrt(2)
    shares = [share for _, share in found.facts["equal"]]
    assert shares == pytest.approx([0.25, 0.25, 0.225])


def test_the_wanted_share_is_quoted_beside_any_tension(files):
    found = sticky_roughness(files)
    (value, low, high), (some, some_low, some_high) = found.facts["limits"]
    assert np.all((low < value) & (value < high) & (high < some_high))
    assert np.all((value < some) & (some_low < some))
    # The square of h_rms, and E*, go as 1/x, with x of a tenth and of a hundredth.
    rough = Roughness(h_rms=1e4, q0=1e-9, elastic_energy=2 / 3 * 0.1)
    x = [rough.threshold(1.0, share) for share in (0.1, 0.01)]
    np.testing.assert_allclose(some[1] / value[1], np.sqrt(x[0] / x[1]), rtol=0.02)
    found = sticky_asphalt(files)
    assert found.facts["some"] / found.value == pytest.approx(x[0] / x[1], rel=0.02)


def test_a_limit_that_holds_for_any_tension_alone_is_qualified(files, monkeypatch):
    (_, _, high), (some, _, _) = sticky_roughness(files).facts["limits"]
    assert np.all(high < some)
    monkeypatch.setattr(claims, "PRINTED_LIMITS", some)
    assert sticky_roughness(files).verdict == QUALIFIED
    smooth, some = sticky_asphalt(files).facts["smooth"]
    monkeypatch.setattr(claims, "PRINTED_MODULUS", some)
    assert some > smooth
    assert sticky_asphalt(files).verdict == OPEN


def test_sticky_roughness_is_that_of_the_energy_of_full_contact(files):
    found = sticky_roughness(files)
    assert found.verdict == NOT
    # l_a = x U_full with U_full = 2/3 q0 h_rms^2 at H = 0.8, x = 0.75 where a tenth remains.
    assert found.value == pytest.approx((0.05 / (0.75 * 2 / 3 * 1e-9)) ** 0.5, rel=0.03)
    assert found.uncertainty > 0


def test_modulus_within_the_limits_is_not_decided(files, monkeypatch):
    found = sticky_asphalt(files)
    for printed, verdict in ((found.value, OPEN), (1e4 * found.value, NOT)):
        monkeypatch.setattr(claims, "PRINTED_MODULUS", printed)
        assert sticky_asphalt(files).verdict == verdict


READ, RECALLED, ASSUMED = range(1, 4)


def compare_experiments(**changes):
    return claims.stickiness_of_experiments({"experiments": claim_files.experiments(**changes)})


@pytest.mark.parametrize(
    ("outcomes", "verdict"),
    [
        ((COMPATIBLE, SILENT, COMPATIBLE), REPRODUCED),
        ((COMPATIBLE, SOME, COMPATIBLE), QUALIFIED),
        ((MISSED, SOME, COMPATIBLE), NOT),
        ((SILENT, SILENT, SILENT), OPEN),
    ],
)
def test_verdict_is_the_worst_of_the_outcomes(outcomes, verdict):
    assert compare_experiments(outcomes=outcomes).verdict == verdict


@pytest.mark.parametrize("grade", [RECALLED, ASSUMED])
def test_only_observations_that_were_read_count(grade):
    outcomes = (COMPATIBLE, MISSED, SOME)
    assert compare_experiments(outcomes=outcomes).verdict == NOT
    found = compare_experiments(outcomes=outcomes, grades=(READ, grade, READ))
    assert found.verdict == QUALIFIED
    assert compare_experiments(outcomes=outcomes, tests=(1, 0, 1)).verdict == QUALIFIED
    assert compare_experiments(outcomes=outcomes, grades=(grade,) * 3).verdict == OPEN


def test_value_is_the_limit_of_the_rubber_and_observations_are_named_by_outcome():
    found = compare_experiments(outcomes=(MISSED, SOME, MISSED), limit=37e-6)
    assert found.value == pytest.approx(37.0)  # in micrometres
    assert np.isnan(found.claimed)  # the paper gives none
    assert np.isnan(found.uncertainty)
    names = ["Rubber 1975 (rubber of 1 MPa)", "hard plate (steel on steel)"]
    assert (found.facts["missed"], found.facts["some"]) == (names, ["Ball 1999 (lost)"])
    assert found.facts["compatible"] == []
