"""From pairs to words, and what every pair's numbers are."""

import numpy as np
import pytest
from helpers.analysed import fix_a_v

from stickiness import Material, Surface, judge, verdict
from stickiness.criteria import equivalent_sphere
from stickiness.criteria.a_v_table import SurfaceAv
from stickiness.criteria.pair import REGIMES, WORDS, decide
from stickiness.criteria.registry import EDGES
from stickiness.remaining import predict
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.spectrum import SelfAffine
from stickiness.statistics import COVERS
from stickiness.surface import synthesise
from stickiness.verdicts.wording import tell_widest

pytestmark = pytest.mark.usefixtures("coarse_simulation")


@pytest.mark.parametrize(
    ("low", "high", "grows", "expected"),
    [
        (0.8, 1.0, True, "sticks fully"),
        (0.79, 1.0, False, "sticks"),  # the onset does not matter here
        (0.1, 0.2, False, "sticks"),
        (0.09, 1.0, True, "depends"),
        (0.0, 0.1, False, "depends"),
        (0.0, 0.09, True, "adheres locally, does not hold"),
        (0.0, 0.09, False, "does not stick"),
    ],
)
def test_word_follows_from_the_limits_of_the_share(low, high, grows, expected):
    assert WORDS[int(decide(low, high, grows, DEFAULT_SHARE))] == expected


SPECTRUM = SelfAffine(hurst=0.8, q0=1e5, q1=1e8, h_rms=1e-6)


def make_surface(h_rms=1e-6):
    spectrum = SelfAffine(hurst=0.8, q0=1e5, q1=1e8, h_rms=h_rms)
    a_v = SurfaceAv(np.array([1e-9, 1.0]), np.full((2, 2), 4.0), 0.0)
    return fix_a_v(Surface.from_spectrum(spectrum), a_v)


def judge_one(modulus, reach, h_rms=1e-6):
    """Verdict on a material of a modulus and a range on one surface."""
    material = Material(youngs_modulus=modulus, work_of_adhesion=0.05, range=reach)
    dataset = judge([material], [make_surface(h_rms)], frequencies=(1.0, 1e3), thresholds=False)
    return dataset.isel(end=0, surface=0, material=0)


@pytest.mark.parametrize(
    ("modulus", "reach", "regime"),
    [(1e11, 1e-9, 0), (1e5, 1e-10, 2), (1e5, 1e-9, 2), (1e3, 1e-6, 3)],
)
def test_edges_are_classified_by_strength_and_zone(modulus, reach, regime):
    cell = judge_one(modulus, reach)
    assert int(cell.regime) == regime
    zone = float(cell.attractive_over_contact)
    tabor = float(cell.edge_strength)
    dmt = float(cell.margin_by_criterion.sel(criterion="violano")) ** (5 / 3)
    effect = float(cell.margin_by_criterion.sel(criterion=EDGES)) / dmt
    assert effect == pytest.approx(float(cell.over_dmt), rel=1e-9)
    limit = equivalent_sphere.tough_effect(zone, tabor)
    within = 0.1
    if REGIMES[regime] == "DMT-like":
        limit = equivalent_sphere.weak_effect(zone)
        within = 0.02
    assert (effect == pytest.approx(limit, rel=within)) == (REGIMES[regime] != REGIMES[-1])


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::stickiness.plausibility.PlausibilityWarning")
@pytest.mark.parametrize(("modulus", "reach"), [(5e3, 1e-9), (1e4, 3e-8), (1e5, 1e-6)])
def test_verdict_is_the_prediction_of_what_remains(modulus, reach):
    properties = {"plane_strain_modulus": modulus, "work_of_adhesion": 0.05, "range": reach}
    answer = verdict(make_surface(), **properties)
    expected = predict(SPECTRUM, 0.05 / modulus, reach)
    assert answer.remaining == pytest.approx(expected.separation, rel=1e-9)
    assert answer.remaining_limits[0] == pytest.approx(expected.separation_limits[0], rel=1e-9)
    pull_off = np.array([answer.pull_off, *answer.pull_off_limits])
    stresses = (expected.pull_off, *expected.pull_off_limits)
    assert pull_off / modulus == pytest.approx(stresses, rel=1e-9)
    assert answer.energy_ratio == pytest.approx(expected.energy_ratio, rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("h_rms", [0.1e-6, 1e-5])
def test_steel_does_not_stick(h_rms):
    """Nor does its contact grow by itself, from polished to coarse."""
    assert WORDS[int(judge_one(230e9, 3e-10, h_rms).verdict)] == "does not stick"


@pytest.mark.parametrize(
    ("known", "widest", "remedy"),
    [
        ({}, "spectrum", "a finer map"),
        ({"extend_to": 0.25e-6}, "map", "a larger map"),  # there are no shorter waves
    ],
)
def test_errors_of_a_map_add_up_and_the_widest_is_named(known, widest, remedy):
    side = 4e-6
    waves = SelfAffine(hurst=0.8, q0=2 * np.pi / side, q1=32 * np.pi / side, h_rms=5e-9)
    heights = synthesise(waves, 128, side, seed=3)
    rough = Surface.from_heights(heights, length=side, detrend="mean", window="none", **known)
    cell = verdict(rough, youngs_modulus=1e8, work_of_adhesion=0.05, range=3e-10).cell
    errors = {name: float(cell[f"error_of_{name}"]) for name in ("spectrum", "map", "model")}
    assert max(errors, key=errors.get) == widest
    assert remedy in tell_widest(cell)
    # In quadrature they are the error of the margin, whose limits cover 90 %.
    low, _, high = np.log(cell.margin.values)
    total = np.hypot.reduce(list(errors.values()))
    assert total == pytest.approx((high - low) / 2 / COVERS, rel=0.25)
