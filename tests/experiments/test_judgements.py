"""Whether a prediction holds, and which criterion survives, on made-up observations."""

import numpy as np
import pytest
from helpers.experiments import known, observe, seen

from experiments import judgements, predictions
from experiments.judgements import COMPATIBLE, MISSED, SILENT, SOME
from experiments.predictions import Predicted
from stickiness.criteria.registry import CRITERIA
from stickiness.spectrum.kinds import SelfAffine

# Five combinations: middle, low and high end, and both as corners.
HURST = {"hurst": known([0.5, 0.8]), "h_rms": known("1 um")}
SOFT = {"plane_strain_modulus": known("0.5 MPa"), "h_rms": known("1 um")}
LENGTH = 0.05 / 1e6


def predict(low, value=None, high=None, limit=1e-6):
    """A prediction of these limits for every combination, of whatever is observed."""
    high = low if high is None else high
    rows = np.array([low, low if value is None else value, high], dtype=float)
    names = ("remaining", "relative_pull_off", "work_of_approach", "work_of_separation")
    none = np.full(rows.shape[1], np.nan)
    curve = np.full((*rows.shape, 2), np.nan)
    return Predicted(dict.fromkeys(names, rows), curve, np.full_like(rows, limit), none, none)


def spread(middle, low, high):
    """Values of the combinations of `HURST`."""
    return [middle, low, high, low, high]


@pytest.mark.parametrize(
    ("low", "high", "outcome"),
    [
        (spread(0.03, 0.025, 0.045), spread(0.05, 0.031, 0.05), SOME),  # one is above 40 mJ/m^2
        (spread(0.02, 0.02, 0.039), spread(0.05, 0.03, 0.05), COMPATIBLE),
        (spread(0.01, 0.01, 0.041), spread(0.02, 0.029, 0.05), MISSED),
    ],
)
@pytest.mark.parametrize("quantity", ["work_of_approach", "work_of_separation"])
def test_limits_that_reach_each_other_are_compatible(quantity, low, high, outcome):
    observation = observe(seen(quantity, ["30 mJ/m^2", "40 mJ/m^2"]), **HURST)
    assert judgements.judge_prediction(observation, predict(low, high=high)) == outcome


@pytest.mark.parametrize(
    ("sticks", "low", "high", "outcome"),
    [
        (True, [0.0] * 5, spread(0.2, 0.1, 0.9), COMPATIBLE),  # the high limit may stick
        (True, [0.0] * 5, spread(0.2, 0.09, 0.05), SOME),
        (True, [0.0] * 5, spread(0.01, 0.09, 0.05), MISSED),
        (False, spread(0.09, 0.0, 0.0), [1.0] * 5, COMPATIBLE),  # the low limit may not
        (False, spread(0.09, 0.1, 0.1), [1.0] * 5, SOME),
        (False, spread(0.2, 0.1, 0.1), [1.0] * 5, MISSED),
    ],
)
def test_a_pair_sticks_if_a_tenth_may_remain(sticks, low, high, outcome):
    observation = observe(seen("sticks", sticks), **HURST)
    assert judgements.judge_prediction(observation, predict(low, high=high)) == outcome


@pytest.mark.parametrize(
    ("limit", "outcome"), [(1.5e-6, COMPATIBLE), (0.9e-6, MISSED), (2.1e-6, MISSED)]
)
def test_a_limiting_roughness_is_held_against_that_predicted(limit, outcome):
    observation = observe(seen("limiting_roughness", ["1 um", "2 um"]))
    predicted = predict([0.0] * 2, limit=limit)
    assert judgements.judge_prediction(observation, predicted) == outcome
    assert judgements.is_value_inside(observation, predicted) == (outcome == COMPATIBLE)


@pytest.mark.parametrize(
    ("value", "inside"), [(0.029, False), (0.03, True), (0.04, True), (0.041, False)]
)
def test_the_value_is_inside_if_that_of_the_middle_is(value, inside):
    observation = observe(seen("work_of_approach", ["30 mJ/m^2", "40 mJ/m^2"]), **HURST)
    for elsewhere in (0.035, 1.0):  # at the ends, and within the limits of the model
        predicted = predict([0.0] * 5, spread(value, elsewhere, elsewhere), [1.0] * 5)
        assert judgements.is_value_inside(observation, predicted) is inside


@pytest.mark.parametrize(("sticks", "of_a_tenth"), [(True, True), (False, False)])
def test_the_value_says_whether_a_pair_sticks_from_a_tenth_on(sticks, of_a_tenth):
    observation = observe(seen("sticks", sticks), **HURST)
    for value, says in ((0.1, of_a_tenth), (0.0999, not of_a_tenth)):
        predicted = predict([0.0] * 5, spread(value, 0.0, 1.0), [1.0] * 5)
        assert judgements.is_value_inside(observation, predicted) is says


@pytest.mark.parametrize(
    ("modulus", "if_it_sticks", "if_not"),
    [
        (known("0.5 MPa"), COMPATIBLE, MISSED),
        (known("2 MPa"), MISSED, COMPATIBLE),
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


def test_criteria_in_whose_terms_it_was_stated_are_silent():
    for observed in (
        seen("sticks", True),
        seen("relative_pull_off", 0.5),
        seen("limiting_roughness", ["1 um", "2 um"]),
    ):
        spoken = judgements.judge_criteria(observe(observed, **SOFT), predict([0.0] * 2))
        silent = {"silent": ["persson_tosatti", "fuller_tabor"]}
        found = judgements.judge_criteria(observe(observed | silent, **SOFT), predict([0.0] * 2))
        assert {spoken["persson_tosatti"], spoken["fuller_tabor"]}.isdisjoint({SILENT})
        assert list(found) == list(CRITERIA)
        assert found == spoken | {"persson_tosatti": SILENT, "fuller_tabor": SILENT}


@pytest.mark.parametrize(
    ("observed", "outcome"),
    [
        (["1 mJ/m^2", "4.9 mJ/m^2"], MISSED),  # less than a tenth of 50 mJ/m^2, yet soft
        (["5.1 mJ/m^2", "10 mJ/m^2"], COMPATIBLE),
        (["4.9 mJ/m^2", "10 mJ/m^2"], SILENT),
    ],
)
def test_works_about_a_tenth_decide_nothing(observed, outcome):
    observation = observe(seen("work_of_approach", observed), **SOFT)
    found = judgements.judge_criteria(observation, predict([0.0] * 2))
    assert found["dahlquist"] == outcome
    assert (set(found.values()) == {SILENT}) == (outcome == SILENT)


def test_combinations_that_decide_nothing_do_not_count():
    # 5 to 6 mJ/m^2 is a tenth or more of 50 mJ/m^2 or less, and about a tenth of more.
    observation = observe(
        seen("work_of_approach", ["5 mJ/m^2", "6 mJ/m^2"]),
        **SOFT | {"work_of_adhesion": known(["40 mJ/m^2", "59 mJ/m^2"])},
    )
    sticks, decided = judgements.find_sticking(observation, *np.full((2, 5), [[0.005], [0.006]]))
    assert decided.tolist() == sticks.tolist() == spread(True, True, False)
    assert judgements.judge_criteria(observation, predict([0.0] * 5))["dahlquist"] == COMPATIBLE


def test_a_pull_off_is_held_against_a_tenth_of_that_of_smooth_surfaces():
    for value, outcome in ((0.2, COMPATIBLE), (0.05, MISSED)):
        observation = observe(seen("relative_pull_off", value), **SOFT)
        assert judgements.judge_criteria(observation, predict([0.0] * 2))["dahlquist"] == outcome


@pytest.mark.parametrize(
    ("factors", "outcome"),
    [
        # The adhesion length asked for goes with the square of the rms height.
        ((1.99, 3.0), COMPATIBLE),
        ((0.2, 0.501), COMPATIBLE),
        ((0.2, 3.0), COMPATIBLE),
        ((2.01, 3.0), MISSED),
        ((0.2, 0.499), MISSED),
    ],
)
def test_a_criterion_is_right_within_a_factor_of_four_of_the_adhesion(factors, outcome):
    s = SelfAffine(hurst=0.8, q0=2 * np.pi / 1e-4, q1=2 * np.pi / 1e-6, h_rms=1.0)
    limit = np.sqrt(LENGTH / s.elastic_energy())  # of Persson and Tosatti
    observed = [f"{factor * limit} m" for factor in factors]
    observation = observe(seen("limiting_roughness", observed))
    found = judgements.judge_criteria(observation, predict([0.0] * 2))
    assert found["persson_tosatti"] == outcome
    assert found["dahlquist"] == SILENT  # knows no adhesion length


def test_a_criterion_may_be_right_for_some_works_of_adhesion():
    s = SelfAffine(hurst=0.8, q0=2 * np.pi / 1e-4, q1=2 * np.pi / 1e-6, h_rms=1.0)
    limit = np.sqrt(LENGTH / s.elastic_energy())
    # At the limit it asks for 50 mJ/m^2: 10 are too few by 5, 20 and 40 are within 4.
    observation = observe(
        seen("limiting_roughness", f"{limit} m"),
        work_of_adhesion=known(["10 mJ/m^2", "40 mJ/m^2"]),
    )
    found = judgements.judge_limits(observation, predict([0.0] * 5))
    assert found["persson_tosatti"] == SOME


@pytest.mark.parametrize(
    ("right", "outcome"), [([1, 1, 1], COMPATIBLE), ([1, 0, 1], SOME), ([0, 0, 0], MISSED)]
)
def test_outcome_is_what_holds_for_all_some_or_none(right, outcome):
    assert judgements.summarise(np.array(right, dtype=bool)) == outcome


def test_outcomes_are_named_from_worst_to_best():
    assert judgements.OUTCOMES[MISSED] == "missed"
    assert judgements.OUTCOMES[SOME] == "compatible for some inputs"
    assert judgements.OUTCOMES[COMPATIBLE] == "compatible"


def test_effects_are_along_one_input_with_the_others_in_the_middle():
    observation = observe(
        seen("work_of_separation", "1 mJ/m^2"),
        h_rms=known("1 um"),
        hurst=known([0.5, 0.8]),
        work_of_adhesion=known(["10 mJ/m^2", "40 mJ/m^2"]),
    )
    inputs = observation.inputs
    # Along the work of adhesion itself, the Hurst exponent is in its middle, and the reverse.
    values = inputs["work_of_adhesion"] * inputs["hurst"] ** 2
    found = judgements.find_effects(observation, predict(values * 0, values, values * 9))
    assert found == pytest.approx({"hurst": (0.8 / 0.5) ** 2, "work_of_adhesion": 4.0})


@pytest.mark.parametrize(
    ("values", "effect"),
    [
        (spread(1e-3, 1e-30, 2e-3), 2e27),
        (spread(1e-3, 0.0, 2e-3), np.inf),  # nothing at one end
        (spread(0.0, 0.0, 0.0), np.nan),  # nothing at all
        (spread(1.0, 1.0, np.nan), np.nan),
    ],
)
def test_effects_are_infinite_or_unknown_where_nothing_is_predicted(values, effect):
    observation = observe(seen("sticks", False), **HURST)
    found = judgements.find_effects(observation, predict(values))
    assert found == pytest.approx({"hurst": effect}, nan_ok=True)
