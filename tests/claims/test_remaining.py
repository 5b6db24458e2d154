"""Claims held against the adhesion that remains."""

import numpy as np
import pytest
from helpers import claim_files

from claims import criterion_claims as claims
from claims.criterion_claims import sticky_asphalt, sticky_roughness, truncation
from claims.ledger import NOT, OPEN, QUALIFIED, REPRODUCED
from common.experiment_outcomes import COMPATIBLE, MISSED, SILENT, SOME


@pytest.mark.parametrize(("growth", "verdict"), [(0.0, REPRODUCED), (0.3, QUALIFIED)])
def test_verdict_follows_from_the_energy_gained(growth, verdict):
    found = truncation({"remaining": claim_files.remaining(growth)})
    assert found.verdict == verdict
    assert found.value == pytest.approx(1 / (1 + growth))


def test_what_converges_decides_the_grade(monkeypatch):
    monkeypatch.setattr(claims, "extend", lambda hurst: 0.5)
    found = truncation({"remaining": claim_files.remaining(0.3)})
    assert found.verdict == NOT


def test_finer_waves_matter_less_the_smoother_the_surface():
    smooth, rough = claims.extend(0.8), claims.extend(0.5)
    assert rough < smooth < 1


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
