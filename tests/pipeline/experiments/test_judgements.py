"""Whether a prediction holds, and which criterion survives, on made-up observations."""

import numpy as np
import pytest
from helpers.experiments import known, observe, seen

from pipeline.experiments import judgements, predictions
from pipeline.experiments.judgements import MISSED, SILENT, SOME, WITHIN
from pipeline.experiments.predictions import Predicted
from stickiness.criteria.registry import CRITERIA
from stickiness.spectrum import SelfAffine

HURST = {"hurst": known([0.5, 0.8]), "h_rms": known("1 um")}  # three combinations
LENGTH = 0.05 / 1e6


def predict(low, value=None, high=None, tenth=1e-6):
    """A prediction of these limits for every combination, of whatever is observed."""
    high = low if high is None else high
    rows = np.array([low, low if value is None else value, high], dtype=float)
    names = ("remaining", "relative_pull_off", "work_of_approach", "work_of_separation")
    none = np.full(rows.shape[1], np.nan)
    curve = np.full((*rows.shape, 2), np.nan)
    tenth = np.full_like(rows, tenth)
    return Predicted(dict.fromkeys(names, rows), curve, tenth, none, none)


@pytest.mark.parametrize(
    ("low", "high", "outcome"),
    [
        ([0.025, 0.03, 0.045], [0.031, 0.05, 0.05], SOME),  # the last begins above 40 mJ/m^2
        ([0.02, 0.02, 0.039], [0.03, 0.05, 0.05], WITHIN),
        ([0.01, 0.01, 0.041], [0.029, 0.02, 0.05], MISSED),
    ],
)
@pytest.mark.parametrize("quantity", ["work_of_approach", "work_of_separation"])
def test_limits_that_reach_each_other_hold(quantity, low, high, outcome):
    observation = observe(seen(quantity, ["30 mJ/m^2", "40 mJ/m^2"]), **HURST)
    assert judgements.judge_prediction(observation, predict(low, high=high)) == outcome


@pytest.mark.parametrize(
    ("sticks", "low", "high", "outcome"),
    [
        (True, [0.0, 0.0, 0.0], [0.1, 0.2, 0.9], WITHIN),  # the high limit may stick
        (True, [0.0, 0.0, 0.0], [0.09, 0.2, 0.05], SOME),
        (True, [0.0, 0.0, 0.0], [0.09, 0.01, 0.05], MISSED),
        (False, [0.0, 0.09, 0.0], [1.0, 1.0, 1.0], WITHIN),  # the low limit may not
        (False, [0.1, 0.09, 0.1], [1.0, 1.0, 1.0], SOME),
        (False, [0.1, 0.2, 0.1], [1.0, 1.0, 1.0], MISSED),
    ],
)
def test_a_pair_sticks_if_a_tenth_may_remain(sticks, low, high, outcome):
    observation = observe(seen("sticks", sticks), **HURST)
    assert judgements.judge_prediction(observation, predict(low, high=high)) == outcome


@pytest.mark.parametrize(
    ("tenth", "outcome"), [(1.5e-6, WITHIN), (0.9e-6, MISSED), (2.1e-6, MISSED)]
)
def test_a_limiting_roughness_is_held_against_that_of_a_tenth(tenth, outcome):
    observation = observe(seen("roughness_at_a_tenth", ["1 um", "2 um"]))
    assert judgements.judge_prediction(observation, predict([0.0], tenth=tenth)) == outcome


@pytest.mark.parametrize(
    ("modulus", "if_it_sticks", "if_not"),
    [
        (known("0.5 MPa"), WITHIN, MISSED),
        (known("2 MPa"), MISSED, WITHIN),
        (known(["0.5 MPa", "2 MPa"]), SOME, SOME),
    ],
)
def test_dahlquist_is_right_on_what_sticks_below_a_megapascal(modulus, if_it_sticks, if_not):
    for sticks, outcome in ((True, if_it_sticks), (False, if_not)):
        observation = observe(
            seen("sticks", sticks), plane_strain_modulus=modulus, h_rms=known("1 um")
        )
        predicted = predictions.predict_observation(observation)
        found = judgements.judge_criteria(observation, predicted)
        assert list(found) == list(CRITERIA)
        assert found["dahlquist"] == outcome


@pytest.mark.parametrize(
    ("observed", "outcome"),
    [
        (["1 mJ/m^2", "4.9 mJ/m^2"], MISSED),  # less than a tenth of 50 mJ/m^2, yet soft
        (["5.1 mJ/m^2", "10 mJ/m^2"], WITHIN),
        (["4.9 mJ/m^2", "10 mJ/m^2"], SILENT),
    ],
)
def test_works_about_a_tenth_decide_nothing(observed, outcome):
    observation = observe(
        seen("work_of_approach", observed),
        plane_strain_modulus=known("0.5 MPa"),
        h_rms=known("1 um"),
    )
    found = judgements.judge_criteria(observation, predict([0.0]))
    assert found["dahlquist"] == outcome
    assert (set(found.values()) == {SILENT}) == (outcome == SILENT)


def test_a_pull_off_is_held_against_a_tenth_of_that_of_smooth_surfaces():
    for value, outcome in ((0.2, WITHIN), (0.05, MISSED)):
        observation = observe(
            seen("relative_pull_off", value),
            plane_strain_modulus=known("0.5 MPa"),
            h_rms=known("1 um"),
        )
        assert judgements.judge_criteria(observation, predict([0.0]))["dahlquist"] == outcome


@pytest.mark.parametrize(
    ("factors", "outcome"),
    [
        ((1.9, 3.0), WITHIN),
        ((0.2, 0.51), WITHIN),
        ((2.1, 3.0), MISSED),
        ((0.2, 0.49), MISSED),
    ],
)
def test_a_criterion_is_right_within_a_factor_of_two_of_the_roughness(factors, outcome):
    s = SelfAffine(hurst=0.8, q0=2 * np.pi / 1e-4, q1=2 * np.pi / 1e-6, h_rms=1.0)
    limit = np.sqrt(LENGTH / s.elastic_energy())  # of Persson and Tosatti
    observed = [f"{factor * limit} m" for factor in factors]
    found = judgements.judge_criteria(
        observe(seen("roughness_at_a_tenth", observed)), predict([0.0])
    )
    assert found["persson_tosatti"] == outcome
    assert found["dahlquist"] == SILENT  # looks at no roughness


@pytest.mark.parametrize(
    ("right", "outcome"), [([1, 1, 1], WITHIN), ([1, 0, 1], SOME), ([0, 0, 0], MISSED)]
)
def test_outcome_is_what_holds_for_all_some_or_none(right, outcome):
    assert judgements.summarise(np.array(right, dtype=bool)) == outcome


def test_effects_are_along_one_input_with_the_others_in_the_middle():
    observation = observe(
        seen("work_of_separation", "1 mJ/m^2"),
        h_rms=known("1 um"),
        hurst=known([0.5, 0.8]),
        work_of_adhesion=known(["10 mJ/m^2", "40 mJ/m^2"]),
    )
    inputs = observation.inputs
    # The work of adhesion itself is no effect; its share goes with the Hurst exponent squared.
    values = inputs["work_of_adhesion"] * inputs["hurst"] ** 2
    found = judgements.find_effects(observation, predict(values, value=values))
    assert found == pytest.approx({"hurst": (0.8 / 0.5) ** 2, "work_of_adhesion": 1.0})


def test_effects_on_next_to_nothing_are_not_counted():
    observation = observe(seen("sticks", False), **HURST)
    found = judgements.find_effects(observation, predict([1e-30, 1e-10, 2e-3]))
    assert found == pytest.approx({"hurst": 2.0})  # a thousandth counts as none
