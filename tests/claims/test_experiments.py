"""The claim that is held against published experiments."""

import json

import numpy as np
import pytest
from helpers import claim_files

from claims.experiment_claims import stickiness_of_experiments
from claims.ledger import NOT, OPEN, QUALIFIED, REPRODUCED
from experiments.judgements import COMPATIBLE, MISSED, SILENT, SOME

READ, RECALLED, ASSUMED = range(1, 4)


def find(**changes):
    return stickiness_of_experiments({"experiments": claim_files.experiments(**changes)})


@pytest.mark.parametrize(
    ("outcomes", "verdict"),
    [
        ((COMPATIBLE, COMPATIBLE, COMPATIBLE), REPRODUCED),
        ((COMPATIBLE, SILENT, COMPATIBLE), REPRODUCED),
        ((COMPATIBLE, SOME, COMPATIBLE), QUALIFIED),
        ((SOME, SILENT, SILENT), QUALIFIED),
        ((MISSED, SOME, COMPATIBLE), NOT),
        ((COMPATIBLE, COMPATIBLE, MISSED), NOT),
        ((SILENT, SILENT, SILENT), OPEN),
    ],
)
def test_verdict_is_the_worst_of_the_outcomes(outcomes, verdict):
    assert find(outcomes=outcomes).verdict == verdict


@pytest.mark.parametrize("grade", [RECALLED, ASSUMED])
def test_only_observations_that_were_read_count(grade):
    outcomes = (COMPATIBLE, MISSED, SOME)
    assert find(outcomes=outcomes).verdict == NOT
    assert find(outcomes=outcomes, grades=(READ, grade, READ)).verdict == QUALIFIED
    assert find(outcomes=outcomes, grades=(READ, grade, grade)).verdict == REPRODUCED
    assert find(outcomes=outcomes, grades=(grade,) * 3).verdict == OPEN


def test_relations_and_what_is_not_published_do_not_count():
    found = find(outcomes=(COMPATIBLE, MISSED, SOME), tests=(1, 0, 1))
    assert found.verdict == QUALIFIED
    assert "contradicts none whatever" in found.remark


def test_value_is_the_roughness_limit_of_the_rubber_in_micrometres():
    found = find(limit=37e-6)
    assert found.value == pytest.approx(37.0)
    assert found.quantity.endswith("[um]")
    assert np.isnan(found.claimed)  # the paper gives none


def test_the_error_of_the_model_is_not_known():
    found = find()
    assert list(found.errors) == ["model"]
    assert np.isnan(found.uncertainty)
    assert "not known" in found.comment


def test_the_remark_has_what_the_theory_says_of_the_rubber():
    assert find().remark.startswith(
        "At an rms height of 1 µm such rubber was seen to lose its adhesion, or almost. The "
        "adhesion that remains there is 20 % of the smooth pull-off (5 % to 60 %). "
    )


def test_observations_are_named_by_what_the_criterion_makes_of_them():
    remark = find(outcomes=(MISSED, SOME, MISSED)).remark
    assert (
        "contradicts Rubber 1975 (rubber of 1 MPa); hard plate (steel on steel) whatever the "
        "unknown inputs, agrees with Ball 1999 (lost) for some of them, and with none for all."
    ) in remark


def test_labels_are_those_of_the_file():
    dataset = claim_files.experiments(outcomes=(COMPATIBLE, COMPATIBLE, MISSED))
    entries = json.loads(dataset.attrs["parameters"])
    entries["experiments"]["plate"]["label"] = "renamed"
    dataset.attrs["parameters"] = json.dumps(entries)
    remark = stickiness_of_experiments({"experiments": dataset}).remark
    assert "contradicts renamed (steel on steel) whatever" in remark
