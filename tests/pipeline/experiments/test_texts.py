"""What pages say of experiments, from a made-up dataset."""

import numpy as np
import pytest
from helpers.experiments import EXPERIMENTS, make_dataset

from pipeline.experiments import texts
from pipeline.experiments.judgements import MISSED, SILENT, SOME, WITHIN

LIMIT = {
    "quantity": "limiting_roughness",
    "observed": (1e-6, 4e-6),
    "predicted": (3e-6, 1.5e-6, 6e-6),
    "observed_known": 1,
    "most_effective_input": "longest_wavelength",
    "effect_of_input": 1.414,
    "criteria": {"violano": MISSED, "persson_tosatti": WITHIN},
    "limits": {"violano": 40e-6, "persson_tosatti": 2e-6},
}
WORK = {
    "quantity": "work_of_separation",
    "observed": (0.03, 0.03),
    "predicted": (0.02, 0.0, 0.025),
    "outcome": MISSED,
    "criteria": {"violano": WITHIN, "persson_tosatti": SOME},
}
STEEL = {
    "quantity": "sticks",
    "observed": (0.0, 0.0),
    "predicted": (0.05, 1e-9, 0.12),
    "known": 1,
    "outcome": SOME,
    "effect_of_input": 1.05,
    "most_effective_input": "hurst",
}
ROWS = {"ball/limit": LIMIT, "ball/work": WORK, "plate/steel": STEEL}


@pytest.fixture
def dataset():
    return make_dataset(ROWS)


def test_a_case_in_words(dataset):
    limit, work, steel = texts.describe(dataset)["cases"]
    assert limit == {
        "experiment": "soft ball",
        "case": "lost",
        "quantity": "rms height at a tenth",
        "observed": "1 … 4 µm",
        "known": "recalled",
        "least_known": "assumed",
        "predicted": "3 µm (1.5 … 6 µm)",
        "outcome": "within",
        "tone": "yes",
        "depends": "longest wave (factor 1.4)",
        "marks": limit["marks"],
    }
    assert (work["observed"], work["known"]) == ("30 mJ/m²", "read")
    assert work["predicted"] == "20 mJ/m² (0 … 25 mJ/m²)"
    assert (work["outcome"], work["tone"]) == ("missed", "no")
    assert work["depends"] == "on none of the unknown inputs"
    assert steel["observed"] == "does not stick"
    assert steel["predicted"] == "5 % (1 × 10⁻⁷ % to 12 %) remains"
    assert (steel["outcome"], steel["tone"]) == ("within for some inputs", "partly")
    assert steel["least_known"] == "recalled"
    assert steel["depends"] == "on none of the unknown inputs"  # 5 % is not named


def test_marks_of_criteria(dataset):
    limit, work, steel = (case["marks"] for case in texts.describe(dataset)["cases"])
    assert limit["violano"] == {"mark": "✗", "tone": "no"}
    assert limit["persson_tosatti"] == {"mark": "✓", "tone": "yes"}
    assert work["persson_tosatti"] == {"mark": "≈", "tone": "partly"}
    assert {entry["mark"] for entry in steel.values()} == {"–"}


def test_a_pair_that_sticks_is_said_to(dataset):
    rows = {"plate/steel": STEEL | {"observed": (1.0, 1.0)}}
    assert texts.describe(make_dataset(rows))["cases"][0]["observed"] == "sticks"


def test_next_to_nothing_is_written_as_none():
    rows = {"ball/work": WORK | {"predicted": (0.04e-6, 1e-12, 1e-3)}}
    found = texts.describe(make_dataset(rows))["cases"][0]["predicted"]
    assert found == "0 J/m² (0 … 1 mJ/m²)"  # below a millionth of 50 mJ/m^2


def test_outcomes_are_counted(dataset):
    assert texts.count_outcomes(dataset) == (
        "Of 3 cases, 1 lie within the limits whatever the unknown inputs, 1 for some of them, "
        "and 1 are missed."
    )


def test_only_misses_are_explained(dataset):
    assert texts.explain_misses(dataset, EXPERIMENTS) == {"soft ball": "the ball was wet"}
    missed = make_dataset({"plate/steel": STEEL | {"outcome": MISSED}})
    assert texts.explain_misses(missed, EXPERIMENTS) == {"hard plate": "no reason was found"}
    assert texts.explain_misses(make_dataset({"ball/limit": LIMIT}), EXPERIMENTS) == {}


def test_a_criterion_survives_an_experiment_if_it_does_every_case(dataset):
    found = texts.survivals(dataset)
    assert list(found) == ["ball", "plate"]
    assert found["ball"]["violano"] == MISSED  # wrong on one, right on the other
    assert found["ball"]["persson_tosatti"] == SOME
    assert found["ball"]["dahlquist"] == SILENT
    assert set(found["plate"].values()) == {SILENT}


def test_silence_does_not_hide_an_outcome(dataset):
    rows = {"ball/limit": LIMIT, "ball/work": WORK | {"criteria": {}}}
    found = texts.survivals(make_dataset(rows))["ball"]
    assert found["persson_tosatti"] == WITHIN


def test_roughness_is_compared_where_it_was_observed(dataset):
    # Observed is 2 um, the geometric mean of 1 and 4.
    np.testing.assert_allclose(texts.compare_roughness(dataset, "violano"), [20.0])
    np.testing.assert_allclose(texts.compare_roughness(dataset, "persson_tosatti"), [1.0])


def test_sources_are_all_listed(dataset):
    assert [entry["citation"] for entry in texts.describe(dataset)["sources"]] == [
        "Ball, J. Made Up 1, 2 (1999)",
        "no source",
    ]
