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
    share = 1 - area(0.8, 256.0, 0.01) / area(0.8, 64.0, 0.01)
    left = cut.left_to_simulation(laws(0.03 / share), *asked)
    assert left == pytest.approx(math.sqrt(0.05**2 - (accuracy.SAFETY * 0.03) ** 2))
    assert cut.left_to_simulation(laws(0.06 / share), *asked) == 0


def area(hurst, magnification, pressure):
    return cut._values(hurst, magnification, pressure)["area"]


@pytest.mark.parametrize("hurst", [0.5, 0.8])
@pytest.mark.parametrize("wanted", [["area"], ["mean_gap", "a_v"], list(accuracy.QUANTITIES)])
def test_what_is_carried_is_as_accurate_as_asked_if_the_simulation_is(hurst, wanted):
    part, whole, loads = accuracy.Surface(hurst, 64.0), 256.0, (0.0065, 0.065, 0.3)
    table = laws(0.01)
    left = cut.left_to_simulation(table, 0.05, part, whole, loads, wanted)
    settings = accuracy.Settings(8, 1e-4, 8, 64)
    where = [(p, c) for p in loads for name in wanted for c in accuracy.QUANTITIES[name]]
    own = np.array([accuracy.predicted_error(table, settings, part, p, c) for p, c in where])
    own *= left / accuracy.joint_error(own)
    values = [[cut._values(hurst, zeta, p)[c] for p, c in where] for zeta in (64.0, whole)]
    size = [1 - area(hurst, whole, p) / area(hurst, 64.0, p) for p, _ in where]
    carrying = [
        accuracy.carrying_error(table, part, whole, change, c, p)
        for change, (p, c) in zip(size, where, strict=True)
    ]
    carried = np.divide(*values) * np.hypot(own, carrying)
    assert accuracy.joint_error(carried) <= 0.05 * (1 + 1e-9)


def test_finer_waves_take_attractive_area_away_at_small_hurst_exponents():
    asked = accuracy.Surface(0.5, 64.0), 512.0, (0.0065,), ["attractive_area"]
    kept = cut.left_to_simulation(laws(1e-12), 0.05, *asked)
    assert kept == pytest.approx(0.05 / 1.35, rel=0.01)


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
    areas = [area(0.8, z, 0.05) for z in (16.0, 64.0, 256.0)]
    assert np.all(np.diff(areas) < 0)
