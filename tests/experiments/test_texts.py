"""What pages say of experiments, from a made-up dataset."""

import copy

import numpy as np
import pytest
from helpers.experiments import EXPERIMENTS, make_dataset

from experiments import texts
from experiments.judgements import COMPATIBLE, MISSED, SILENT, SOME

LIMIT = {
    "quantity": "limiting_roughness",
    "observed": (1e-6, 4e-6),
    "predicted": (3e-6, 1.5e-6, 6e-6),
    "value_inside": 1,
    "observed_known": 2,
    "most_effective_input": "longest_wavelength",
    "effect_of_input": 1.414,
    "waves_in_contact": 4.04,
    "criteria": {"violano": MISSED, "persson_tosatti": COMPATIBLE},
}
WORK = {
    "quantity": "work_of_separation",
    "observed": (0.03, 0.03),
    "predicted": (0.02, 0.0, 0.025),
    "outcome": MISSED,
    "waves_in_contact": 12.04,
    "criteria": {"violano": COMPATIBLE, "persson_tosatti": SOME},
}
STEEL = {
    "quantity": "sticks",
    "observed": (0.0, 0.0),
    "predicted": (0.05, 1e-9, 0.12),
    "known": 2,
    "outcome": SOME,
    "effect_of_input": 1.05,
    "most_effective_input": "hurst",
}
ROWS = {"ball/limit": LIMIT, "ball/work": WORK, "plate/steel": STEEL}


@pytest.fixture
def dataset():
    return make_dataset(ROWS)


def say(row, case="ball/work", experiments=EXPERIMENTS):
    """The only case of a dataset, in words."""
    return texts.describe(make_dataset({case: row}, experiments))["cases"][0]


def test_a_case_in_words(dataset):
    limit, work, steel = texts.describe(dataset)["cases"]
    assert limit == {
        "experiment": "Ball 1999",
        "case": "lost",
        "quantity": "limiting rms height",
        "observed": "1 … 4 µm",
        "known": "recalled",
        "least_known": "assumed",
        "predicted": "3 µm (1.5 … 6.0 µm)",
        "outcome": "compatible, value too",
        "tone": "yes",
        "depends": "longest wave (factor 1.4)",
        "waves": "4, too few",
        "marks": limit["marks"],
    }
    assert (work["observed"], work["known"]) == ("30 mJ/m²", "read")
    assert work["predicted"] == "20 mJ/m² (0 … 25 mJ/m²)"
    assert (work["outcome"], work["tone"]) == ("missed", "no")
    assert work["depends"] == "no unknown input"
    assert steel["experiment"] == "hard plate"  # which has no short name
    assert steel["observed"] == "does not stick"
    assert steel["predicted"] == "5 % (< 0.01 to 12 %)"
    assert (steel["outcome"], steel["tone"]) == ("compatible for some inputs", "partly")
    assert steel["least_known"] == "recalled"
    assert steel["depends"] == "no unknown input"  # 5 % is not named


def test_marks_of_criteria(dataset):
    limit, work, steel = (case["marks"] for case in texts.describe(dataset)["cases"])
    assert limit["violano"] == {"mark": "✗", "tone": "no"}
    assert limit["persson_tosatti"] == {"mark": "✓", "tone": "yes"}
    assert work["persson_tosatti"] == {"mark": "≈", "tone": "partly"}
    assert {entry["mark"] for entry in steel.values()} == {"–"}


def test_a_pair_that_sticks_is_said_to():
    assert say(STEEL | {"observed": (1.0, 1.0)}, "plate/steel")["observed"] == "sticks"


@pytest.mark.parametrize(("row", "text"), [(LIMIT, "1 … 4 µm"), (WORK, "30 mJ/m²")])
def test_a_relation_is_told_from_a_number(row, text):
    assert say(row)["observed"] == text
    assert say(row | {"by_relation": 1})["observed"] == f"{text} (relation)"


def test_a_relation_may_leave_nothing():
    row = WORK | {"observed": (0.0, 0.0), "by_relation": 1}
    assert say(row)["observed"] == "0 J/m² (relation)"


def test_a_pull_off_is_a_percentage():
    row = {"quantity": "relative_pull_off", "observed": (0.0, 0.1), "predicted": (0.2, 0.05, 0.5)}
    found = say(row)
    assert (found["observed"], found["predicted"]) == ("0 to 10 %", "20 % (5 to 50 %)")


def test_next_to_nothing_is_written_as_none():
    found = say(WORK | {"predicted": (0.04e-6, 1e-12, 1e-3)})["predicted"]
    assert found == "0 mJ/m² (0 … 1 mJ/m²)"  # below a millionth of 50 mJ/m^2
    assert say(WORK | {"predicted": (0.06e-6, 1e-12, 1e-3)})["predicted"].startswith("60 nJ/m² (0")


@pytest.mark.parametrize(
    ("waves", "text"),
    [(4.99, "5, too few"), (5.0, "5"), (0.21, "0.21, too few"), (123.4, "120"), (np.nan, "flat")],
)
def test_waves_are_marked_where_they_are_few(waves, text):
    assert say(WORK | {"waves_in_contact": waves})["waves"] == text


@pytest.mark.parametrize(
    ("effect", "text"),
    [
        (1.09, "no unknown input"),
        (1.11, "range of the attraction (factor 1.1)"),
        (999.0, "range of the attraction (factor 1000)"),
        (1001.0, "range of the attraction (from none to some)"),
        (1e9, "range of the attraction (from none to some)"),
        (np.nan, "not resolved: nothing is predicted"),
    ],
)
def test_the_effect_of_an_input_in_words(effect, text):
    row = WORK | {"effect_of_input": effect, "most_effective_input": "range"}
    assert say(row)["depends"] == text


def test_outcomes_are_counted(dataset):
    assert texts.count_outcomes(dataset) == (
        "The limits of the prediction overlap with 1 of 3 published observations whatever the "
        "unknown inputs, with 1 for some of them, and with 1 for none. The value itself agrees "
        "with 1. None is a sharp test, because no spectrum is known."
    )


def test_only_what_tests_the_prediction_is_counted():
    rows = {name: row | {"tests": int(name == "ball/work")} for name, row in ROWS.items()}
    assert texts.count_outcomes(make_dataset(rows)).startswith(
        "The limits of the prediction overlap with 0 of 1 published observations whatever the "
        "unknown inputs, with 0 for some of them, and with 1 for none. The value itself agrees "
        "with 0."
    )


def test_only_misses_are_explained(dataset):
    assert texts.explain_misses(dataset, EXPERIMENTS) == {"Ball 1999": "the ball was wet"}
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


def test_silence_does_not_hide_an_outcome():
    rows = {"ball/limit": LIMIT, "ball/work": WORK | {"criteria": {}}}
    found = texts.survivals(make_dataset(rows))["ball"]
    assert found["persson_tosatti"] == COMPATIBLE
    assert found["violano"] == MISSED


def test_sources_are_all_listed(dataset):
    assert texts.describe(dataset)["sources"] == list(EXPERIMENTS.values())


def test_names_are_those_of_the_file():
    renamed = copy.deepcopy(EXPERIMENTS)
    renamed["ball"]["short"] = "Renamed 2000"
    assert say(WORK, experiments=renamed)["experiment"] == "Renamed 2000"
