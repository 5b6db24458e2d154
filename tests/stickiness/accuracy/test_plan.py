"""What cases are solved with."""

import math
from dataclasses import replace

import pytest
from helpers.entries import complete, model_surface
from helpers.laws import made_up, problem

from common.config import simulations
from stickiness.accuracy import plan
from stickiness.accuracy.error_models import Settings
from stickiness.accuracy.settings import (
    UnreachableError,
    cheapest,
    covering_factor,
    error_parts,
    joint_error,
)

pytestmark = pytest.mark.processors

PRESET = {"pixels_per_wavelength": 8, "tolerance": 1e-8, "seeds": 5, "coarse_seeds": 40}


def stated_error(of_case, settings):
    """Error that an answer is expected to state: Student's t of the standard error."""
    errors = []
    for at in of_case.points:
        parts = error_parts(of_case, settings, *at)
        factor = covering_factor(of_case, settings, *at) / 1.645
        fixed = math.hypot(parts["discretisation"], parts["solver"])
        errors.append(math.hypot(fixed, factor * parts["sampling"]))
    return joint_error(errors)


def config(**cases):
    usual = {"surface": "one", "pressures": [0.1, 0.01]}
    sampling = complete(simulations.Sampling, method="multilevel", descriptor_seeds=2048)
    return {
        "fidelity": "some",
        "fidelities": {"some": PRESET},
        "seeds": None,
        "sampling": sampling,
        "model_surfaces": {"one": model_surface(), "other": model_surface()},
        "cases": {name: complete(simulations.Case, **usual | case) for name, case in cases.items()},
    }


def test_preset_unless_the_case_says_otherwise():
    plans = plan.plans_of(config(a={}, b={"seeds": 3, "sampling": "plain"}), made_up())
    assert plans["a"].settings == Settings(8, 1e-8, 5, 40)
    assert plans["b"].settings == Settings(8, 1e-8, 3, 0)
    assert plans["a"].pressures == (0.01, 0.1)
    assert plans["a"].complete
    given = config(a={}) | {"seeds": 7}
    assert plan.plans_of(given, made_up())["a"].settings.seeds == 7


def test_accuracy_has_the_cheapest_settings_and_seeds_enough_to_show_it():
    asked = {"accuracy": 0.05, "quantities": ["area", "mean_gap"]}
    plans = plan.plans_of(config(a=asked), made_up())
    of_case = problem("area", "mean_gap", pressures=(0.01, 0.1))
    chosen, settings = cheapest(of_case, 0.05), plans["a"].settings
    same = ("pixels_per_wavelength", "tolerance", "coarse_seeds")
    assert [getattr(settings, key) for key in same] == [getattr(chosen, key) for key in same]
    # With Student's t of its seeds the case is within the accuracy, and was not with fewer.
    assert stated_error(of_case, settings) <= 0.05
    if settings.seeds > chosen.seeds:
        assert stated_error(of_case, replace(settings, seeds=settings.seeds - 1)) > 0.05
    assert not plans["a"].complete


def test_seeds_of_a_case_stand_above_its_accuracy_and_a_cap_holds_for_what_is_chosen():
    asked = {"accuracy": 0.05, "sampling": "plain"}
    cases = {"a": asked, "b": asked | {"at_most": 5}, "c": asked | {"seeds": 100}}
    given = config(**cases)
    given["sampling"]["at_most"] = 3
    plans = plan.plans_of(given, made_up())
    assert [plans[name].settings.seeds for name in cases] == [3, 5, 100]


@pytest.mark.parametrize(
    ("case", "message"),
    [
        ({"accuracy": 0.1}, r"cases\.a\.quantities: the errors of contact_slope were not measured"),
        ({"model": "theory"}, r"cases\.a\.quantities: theory does not give contact_slope"),
    ],
)
def test_quantities_that_nothing_knows_are_refused_at_start(case, message):
    with pytest.raises(ValueError, match=message):
        plan.plans_of(config(a={"quantities": ["contact_slope"], **case}), made_up())


def test_accuracy_out_of_reach_names_the_case():
    with pytest.raises(
        UnreachableError, match=r"cases\.a\.accuracy = 0\.0001 is out of reach: the best"
    ):
        plan.plans_of(config(a={"accuracy": 1e-4}), made_up())
