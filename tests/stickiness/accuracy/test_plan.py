"""What cases are solved with, and which of them share solutions."""

import pytest
from helpers.laws import made_up

from stickiness.accuracy import error_laws, plan, sequential

PRESET = {"pixels_per_wavelength": 8, "tolerance": 1e-8, "seeds": 5, "coarse_seeds": 40}


def config(**cases):
    surfaces = {"one": {"hurst": 0.8, "magnification": 32}}
    cases = {
        name: {"surface": "one", "pressures": [0.1, 0.01]} | case for name, case in cases.items()
    }
    return {
        "fidelity": "some",
        "fidelities": {"some": PRESET},
        "sampling": {"method": "multilevel", "descriptor_seeds": 2048},
        "model_surfaces": surfaces | {"other": surfaces["one"]},
        "cases": cases,
    }


def test_preset_unless_the_case_says_otherwise():
    plans = plan.plans_of(config(a={}, b={"seeds": 3, "sampling": "plain"}), made_up())
    assert plans["a"].settings == error_laws.Settings(8, 1e-8, 5, 40)
    assert plans["b"].settings == error_laws.Settings(8, 1e-8, 3, 0)
    assert plans["a"].pressures == (0.01, 0.1)
    assert plans["a"].complete
    given = config(a={}) | {"seeds": 7}
    assert plan.plans_of(given, made_up())["a"].settings.seeds == 7


def test_accuracy_begins_from_the_cheapest():
    asked = {"accuracy": 0.05, "quantities": ["area", "mean_gap"]}
    plans = plan.plans_of(config(a=asked), made_up())
    where = error_laws.Surface(0.8, 32.0)
    asked = sequential.Asked(0.05, where, (0.01, 0.1), ("area", "mean_gap"))
    chosen = error_laws.cheapest(made_up(), 0.05, where, asked.pressures, asked.quantities)
    assert plans["a"].asked == asked
    assert plans["a"].settings == sequential.first(made_up(), asked, chosen)
    assert not plans["a"].gaps
    assert not plans["a"].complete


def test_cap_of_a_case_is_above_that_of_all():
    asked = {"accuracy": 0.05}
    given = config(a=asked, b=asked | {"at_most": 5}, c={})
    given["sampling"]["at_most"] = 3
    plans = plan.plans_of(given, made_up())
    assert (plans["a"].asked.at_most, plans["b"].asked.at_most) == (3, 5)
    assert plans["a"].settings.seeds <= 3
    assert plans["c"].asked is None


def test_files_of_coarse_seeds_end_at_the_same_numbers_whatever_the_rounds():
    assert plan.rungs(0) == []
    assert plan.rungs(32) == [32]
    assert plan.rungs(96) == [n for n in error_laws.COARSE_SEEDS if 0 < n <= 96]


def test_accuracy_out_of_reach_names_the_case():
    with pytest.raises(
        error_laws.UnreachableError, match=r"cases\.a\.accuracy = 0\.0001 is out of reach: the best"
    ):
        plan.plans_of(config(a={"accuracy": 1e-4}), made_up())


@pytest.mark.parametrize(
    ("later", "shares"),
    [
        ({"pressures": [0.1]}, True),
        ({"quantities": ["area"]}, True),
        ({"seeds": 9}, True),  # other realisations of the same solutions
        ({"pressures": [0.1, 0.2]}, False),
        ({"surface": "other"}, False),
        ({"accuracy": 0.3}, False),  # another grid
        ({"model": "theory"}, False),
    ],
)
def test_sharing(later, shares):
    plans = plan.plans_of(config(first={}, later=later), made_up())
    assert plans["later"].owner == ("first" if shares else "later")


def test_what_holds_no_gaps_is_not_shared_with_what_needs_them():
    plans = plan.plans_of(config(first={"quantities": ["area"]}, later={}), made_up())
    assert plans["later"].owner == "later"
