"""The claim that is held against published experiments."""

import json

import numpy as np
import pytest
from helpers import claim_files

from pipeline.claims.experiments import stickiness_of_experiments
from pipeline.claims.ledger import NOT, QUALIFIED, REPRODUCED
from pipeline.experiments.judgements import MISSED, SILENT, SOME, WITHIN


def find(**changes):
    return stickiness_of_experiments({"experiments": claim_files.experiments(**changes)})


@pytest.mark.parametrize(
    ("outcomes", "verdict"),
    [
        ((WITHIN, WITHIN, WITHIN), REPRODUCED),
        ((WITHIN, SILENT, WITHIN), REPRODUCED),
        ((WITHIN, SOME, WITHIN), QUALIFIED),
        ((MISSED, SOME, WITHIN), NOT),
        ((WITHIN, WITHIN, MISSED), NOT),
    ],
)
def test_verdict_is_the_worst_of_the_outcomes(outcomes, verdict):
    assert find(outcomes=outcomes).verdict == verdict


def test_value_is_the_geometric_mean_of_the_ratios():
    # Observed roughness 2 um, the geometric mean of 1 and 4, in two cases.
    found = find(limits=(4e-6, 16e-6))
    assert found.value == pytest.approx(4.0)  # of 2 and 8
    assert found.claimed == 1
    assert "ratio is 2 … 8; that of the adhesion that remains is 1." in found.remark


def test_error_is_students_t_of_two_logarithms():
    # t at 90 % with one degree of freedom is 6.314; the logarithms are ln 4 -+ ln 2.
    found = find(limits=(4e-6, 16e-6))
    spread = 6.314 * np.sqrt(2) * np.log(2) / np.sqrt(2)
    assert found.uncertainty == pytest.approx(4.0 * (np.exp(spread) - 1), rel=1e-3)
    assert find(limits=(6e-6, 6e-6)).uncertainty == pytest.approx(0, abs=1e-9)


def test_experiments_that_contradict_are_named_and_counted():
    found = find(outcomes=(WITHIN, MISSED, SOME))
    assert "contradicts 1 of 2 experiments: soft ball." in found.remark
    assert "contradicts 0 of 2 experiments: none." in find(outcomes=(SOME,) * 3).remark


def test_labels_are_those_of_the_file():
    dataset = claim_files.experiments(outcomes=(WITHIN, WITHIN, MISSED))
    entries = json.loads(dataset.attrs["parameters"])
    entries["experiments"]["plate"]["label"] = "renamed"
    dataset.attrs["parameters"] = json.dumps(entries)
    assert "experiments: renamed." in stickiness_of_experiments({"experiments": dataset}).remark
