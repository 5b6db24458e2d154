"""Claim that the shortest wavelength does not matter."""

import pytest
from helpers import claim_files

from pipeline import remaining_table
from pipeline.claims import truncation as truncation_claim
from pipeline.claims.ledger import NOT, QUALIFIED, REPRODUCED
from pipeline.claims.truncation import truncation


@pytest.mark.parametrize(("growth", "verdict"), [(0.0, REPRODUCED), (0.3, QUALIFIED)])
def test_verdict_follows_from_the_energy_gained(growth, verdict):
    found = truncation({"remaining": claim_files.remaining(growth)})
    assert found.verdict == verdict
    assert found.value == pytest.approx(1 / (1 + growth))


def test_simulated_works_on_the_committed_table():
    table = remaining_table.read("config/remaining.csv")
    found = truncation({"remaining": table})
    assert found.verdict == QUALIFIED
    assert 0.3 < found.value < 0.7


def test_what_converges_decides_the_grade(monkeypatch):
    monkeypatch.setattr(truncation_claim, "extend", lambda hurst: 0.5)
    found = truncation({"remaining": claim_files.remaining(0.3)})
    assert found.verdict == NOT


def test_finer_waves_matter_less_the_smoother_the_surface():
    smooth, rough = truncation_claim.extend(0.8), truncation_claim.extend(0.5)
    assert rough < smooth < 1
