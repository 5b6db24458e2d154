"""Spectra are cut where theory carries the tail within the accuracy, and only there."""

import math
from dataclasses import replace

import numpy as np
import pytest
from test_accuracy import made_up
from test_plan import config

from stickiness import accuracy, cut, plan

BROAD = accuracy.Surface(0.8, 256.0)
LOADS = (0.01, 0.1)


def laws(share):
    """Made-up laws in which theory's difference errs by this share of what it takes of the area."""
    carrying = {
        key: replace(law, constant=math.log(share), spread=1.0)
        for key, law in made_up().items()
        if key[0] == "carrying"
    }
    return made_up() | carrying


def test_perfect_theory_leaves_everything_to_simulation_but_its_weight():
    part = accuracy.Surface(0.8, 64.0)
    kept = cut.left_to_simulation(laws(1e-12), 0.05, part, 256.0, LOADS, ["mean_gap"])
    assert kept == pytest.approx(0.05)
    # Small areas go with the inverse rms slope, its square with magnification^(2 - 2H) - 1.
    grown = math.sqrt((256.0**0.4 - 1) / (64.0**0.4 - 1))
    area = cut.left_to_simulation(laws(1e-12), 0.05, part, 256.0, (1e-4,), ["area"])
    assert area == pytest.approx(0.05 / grown, rel=0.02)


def test_errors_add_in_quadrature_and_run_out():
    part = accuracy.Surface(0.8, 64.0)
    asked = 0.05, part, 256.0, (0.01,), ["mean_gap"]
    share = 1 - cut._area(0.8, 256.0, 0.01) / cut._area(0.8, 64.0, 0.01)
    left = cut.left_to_simulation(laws(0.03 / share), *asked)
    assert left == pytest.approx(0.04)
    assert cut.left_to_simulation(laws(0.06 / share), *asked) == 0


def test_cut_where_that_is_cheaper_and_not_where_theory_errs():
    good = cut.cheapest(laws(0.01), 0.1, BROAD, LOADS, ["mean_gap"])
    poor = cut.cheapest(laws(3.0), 0.1, BROAD, LOADS, ["mean_gap"])
    assert good[0] in (32.0, 64.0)
    assert poor == (256.0, accuracy.cheapest(laws(3.0), 0.1, BROAD, LOADS, ["mean_gap"]))
    costs = [
        accuracy.predicted_cost(laws(0.01), settings, replace(BROAD, magnification=part), LOADS)
        for part, settings in (good, poor)
    ]
    assert costs[0] < 0.8 * costs[1]


def test_never_below_what_was_measured_nor_beyond_what_theory_was_measured_to():
    assert min(cut._parts(100.0)) == 25
    assert cut._parts(30.0) == [30.0]
    assert cut._parts(2 * accuracy.CARRIED_TO) == [2 * accuracy.CARRIED_TO]


def test_out_of_reach_speaks_of_the_whole():
    with pytest.raises(accuracy.UnreachableError, match="the best that"):
        cut.cheapest(laws(0.01), 1e-5, BROAD, LOADS, ["mean_gap"])


@pytest.mark.parametrize(
    ("asked", "to"),
    [
        ({"accuracy": 0.1, "quantities": ["mean_gap"]}, 64),
        ({"quantities": ["mean_gap"]}, None),
        ({"accuracy": 0.1}, None),  # figures show every quantity of the surface as it is named
        ({"accuracy": 0.1, "quantities": ["mean_gap"], "maps": [0.1]}, None),
        ({"accuracy": 0.1, "quantities": ["mean_gap"], "carry_to": 512}, None),
    ],
)
def test_cases_of_the_configuration(asked, to):
    given = config(a={"surface": "broad", **asked})
    given["model_surfaces"]["broad"] = {"hurst": 0.8, "magnification": 256}
    after = plan.with_cuts(given, laws(0.01))
    if to is None:
        assert after == given
        return
    case = after["cases"]["a"]
    assert after["model_surfaces"][case["surface"]] == {"hurst": 0.8, "magnification": to}
    assert case["carry_to"] == 256
    assert given["cases"]["a"]["surface"] == "broad"
    assert plan.plans_of(after, laws(0.01))["a"].asked.accuracy < 0.1


def test_a_surface_of_ones_own_is_not_cut_over():
    wanted = {"surface": "broad", "accuracy": 0.1, "quantities": ["mean_gap"]}
    given = config(a=wanted, b=wanted)
    given["model_surfaces"]["broad"] = {"hurst": 0.8, "magnification": 256}
    assert plan.with_cuts(given, laws(0.01))["cases"]["b"]["surface"] == "broad_to64"
    given["model_surfaces"]["broad_to64"] = {"hurst": 0.5, "magnification": 20}
    with pytest.raises(ValueError, match=r"model_surfaces\.broad_to64: cases\.a needs this name"):
        plan.with_cuts(given, laws(0.01))


def test_what_carrying_leaves_is_named():
    given = config(a={"accuracy": 0.05, "quantities": ["area"], "carry_to": 128})
    with pytest.raises(
        accuracy.UnreachableError, match=r"carries to magnification 128 errs by more"
    ):
        plan.plans_of(given, laws(3.0))


def test_area_by_theory_falls_with_finer_waves():
    areas = [cut._area(0.8, z, 0.05) for z in (16.0, 64.0, 256.0)]
    assert np.all(np.diff(areas) < 0)
