"""All that a surface may be: rows between its ends, and draws of a measured one."""

from dataclasses import replace

import numpy as np
import pytest

from stickiness import Material
from stickiness.criteria.pair import Pair
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.solids.moduli import Prony
from stickiness.verdicts.judgement import describe_draws
from stickiness.verdicts.limits import QUANTILES, find_limits
from stickiness.verdicts.scenarios import Scenarios

pytestmark = pytest.mark.usefixtures("coarse_simulation")

MATERIAL = Material(
    youngs_modulus_prony=Prony(1e6, ((1e9, 1e-3),)), work_of_adhesion=0.07, range=3e-10
)
ROUGH = Roughness(h_rms=1e-6, q0=1e5, elastic_energy=1e-7)
SAME = np.ones(4000)
EQUAL_DRAWS = Scenarios.of_draws(Roughness(1e-6 * SAME, 1e5 * SAME, 1e-7 * SAME))


def meet(material, scenarios):
    """`Pair` of a material with all that a surface may be."""
    return Pair(
        rough=replace(scenarios.roughness, instant_ratio=material.instant_ratio),
        modulus=material.plane_strain_modulus,
        work_of_adhesion=material.work_of_adhesion,
        range=material.range,
        deviation=scenarios.deviation,
        pressed=material.pressed,
    )


def find_margins(pair):
    return pair.adhesion_length / pair.remaining_threshold


def place_above_threshold(factor):
    """The material with a work of adhesion that is this factor above its threshold on `ROUGH`."""
    work = factor * float(ROUGH.threshold(MATERIAL.range)) * MATERIAL.plane_strain_modulus
    return MATERIAL.replace(work_of_adhesion=work)


def find_adhesion_length(material):
    return material.work_of_adhesion / material.plane_strain_modulus


@pytest.mark.slow
def test_errors_of_the_spectrum_pass_to_the_margin():
    # Tough: the threshold is in proportion to the elastic energy, if the mean wave number is the
    # same over q0.
    rng = np.random.default_rng(0)
    energy = 1e-7 * np.exp(0.2 * rng.normal(size=4000))
    h_rms = 1e-6 * np.sqrt(energy / 1e-7)
    draws = Scenarios.of_draws(Roughness(h_rms, 1e5 * SAME, energy))
    judged = describe_draws(draws, meet(MATERIAL, draws))
    assert judged["error_of_spectrum"] == pytest.approx(0.2, rel=0.05)
    h_rms = 1e-6 * np.exp(0.1 * rng.normal(size=4000))
    q0 = 1e5 * (1e-6 / h_rms) ** 2
    draws = Scenarios.of_draws(Roughness(h_rms, q0, 1e-7 * SAME))
    judged = describe_draws(draws, meet(MATERIAL, draws))
    assert judged["error_of_spectrum"] < 1e-3


def test_draws_know_preload_and_fast_separation():
    """Medians over draws of one surface, whose errors are the model's alone, are the values."""
    material = place_above_threshold(1.5)
    same = np.ones(500)
    draws = Scenarios.of_draws(
        Roughness(1e-6 * same, 1e5 * same, 1e-7 * same, rms_slope=0.3 * same)
    )
    one = Roughness(1e-6, 1e5, 1e-7, rms_slope=0.3)
    _, median, most = find_limits(meet(material, draws).pull_off, draws.weights)
    tension = one.tension(find_adhesion_length(material), material.range)
    assert median == pytest.approx(tension * material.plane_strain_modulus, rel=0.05)
    strength = material.work_of_adhesion / material.range
    pressed = material.replace(pressed=material.plane_strain_modulus)
    _, _, most_pressed = find_limits(meet(pressed, draws).pull_off, draws.weights)
    assert most < 0.01 * strength < most_pressed
    rested = material.replace(dwell=10.0)
    ratio = rested.instant_ratio
    assert ratio > 100
    # Half of the draws err to the low side, where separation is slow.
    low, median, high = find_limits(meet(rested, draws).remaining, draws.weights)
    length = find_adhesion_length(rested)
    limits = [one.share(length, rested.range, sign) for sign in (-1, 0, 1)]
    assert low == pytest.approx(limits[0], rel=0.05)
    assert median == pytest.approx(limits[1], rel=0.2)
    assert high == pytest.approx(ratio * limits[2], rel=0.5)


@pytest.mark.slow
@pytest.mark.parametrize(("factor", "expected"), [(1.0, 0.5), (1.3, None), (2.0, 1.0), (0.5, 0.0)])
def test_draws_spread_over_the_error_of_the_model(factor, expected):
    """One spectrum: what is left are the model's errors, of which the limits cover 90 %.

    Half of the draws stick at the threshold, all or none of them well beyond the model's error.
    """
    material = place_above_threshold(factor)
    pair = meet(material, EQUAL_DRAWS)
    weights = EQUAL_DRAWS.weights
    judged = describe_draws(EQUAL_DRAWS, pair)
    assert judged["error_of_spectrum"] == pytest.approx(0, abs=1e-12)
    # What sticks is what keeps the wanted share.
    keeps = pair.remaining > DEFAULT_SHARE
    assert np.average(keeps, weights=weights) == pytest.approx(judged["probability"])
    if expected is not None:  # the binomial error of 4000 draws is below 0.008
        assert judged["probability"] == pytest.approx(expected, abs=0.025)
        return
    length = find_adhesion_length(material)
    limits = [length / ROUGH.threshold(material.range, deviation=limit) for limit in (-1, 0, 1)]
    # Standard errors of quantiles of 4000 draws are below 0.5 % of these.
    np.testing.assert_allclose(find_limits(find_margins(pair), weights), limits, rtol=0.01)
    limits = [ROUGH.share(length, material.range, sign) for sign in (-1, 0, 1)]
    np.testing.assert_allclose(find_limits(pair.remaining, weights), limits, rtol=0.03)


def test_limits_are_values_of_rows():
    """So that a limit of the share and that of the margin are on the same side of the threshold."""
    pair = meet(place_above_threshold(1.3), EQUAL_DRAWS)
    weights = EQUAL_DRAWS.weights
    margins = find_margins(pair)
    limits = find_limits(margins, weights)
    assert np.isin(limits, margins).all()
    assert np.isin(find_limits(pair.remaining, weights), pair.remaining).all()
    assert np.mean(margins[2:] <= limits[0]) == pytest.approx(QUANTILES[0], abs=3e-4)


def test_quantiles_of_draws_are_those_of_numpy():
    rng = np.random.default_rng(0)
    for count in (3, 20, 60, 199, 200):
        values = rng.normal(size=(5, count))
        expected = np.quantile(values, QUANTILES, axis=-1, method="inverted_cdf").T
        np.testing.assert_array_equal(find_limits(values, np.ones(count)), expected)


@pytest.mark.parametrize("smooth", [[0.5, 0.3, 0.7], [0.9, 0.8, 1.0], [0.2, 0.1, 0.25]])
def test_between_ends_limits_are_the_farthest_and_the_value_that_of_the_rough_end(smooth):
    """Wherever the smooth end lies beside the rough one."""
    rough = [0.6, 0.4, 0.8]
    rows = Scenarios.between_ends(Roughness(np.ones(2), 1.0, 1.0))
    values = np.ravel(np.transpose([smooth, rough]))
    low, value, high = find_limits(values, rows.weights)
    assert (low, value, high) == (min(smooth[1], rough[1]), rough[0], max(smooth[2], rough[2]))


def test_nothing_may_remain_on_a_layer_that_cannot_take_the_heights():
    weights = np.ones(20)
    values = np.linspace(1.0, 2.0, 20)
    strained = values > 1.95
    low, value, high = find_limits(values, weights, withstands=~strained)
    assert (low, value, high) == (0.0, *find_limits(values, weights)[1:])
    # Infinite moduli make no low limit that is not a number.
    assert find_limits(np.full(20, np.inf), weights, withstands=~strained)[0] == 0


def test_draws_meet_draws_in_another_order_unless_they_are_the_same():
    heights = np.arange(1.0, 13.0)
    first = Scenarios.of_draws(Roughness(heights, 1.0, heights))
    second = Scenarios.of_draws(Roughness(heights[:7], 1.0, heights[:7]))
    _, same = first.align(first, is_same=True)
    np.testing.assert_array_equal(same.h_rms, heights)
    kept, met = first.align(second, is_same=False)
    assert kept is first
    np.testing.assert_array_equal(met.h_rms[:2], heights[:2])
    assert sorted(met.h_rms[2:]) == [3, 3, 4, 4, 5, 5, 6, 6, 7, 7]
    assert (np.diff(met.h_rms[2:]) < 0).sum() > 2
    # An exactly known surface meets every draw; of one between two ends, ends meet ends.
    exact = Scenarios.between_ends(Roughness(np.ones(2), 1.0, np.ones(2)))
    kept, met = first.align(exact, is_same=False)
    assert kept is first
    assert (met.h_rms == 1).all()
    vague = Scenarios.between_ends(Roughness(np.array([1.0, 2.0]), 1.0, np.ones(2)))
    kept, met = first.align(vague, is_same=False)
    assert not kept.is_drawn
    np.testing.assert_array_equal(kept.roughness.h_rms, [1, 2, 1, 2, 1, 2])
    np.testing.assert_array_equal(met.h_rms, [1, 2, 1, 2, 1, 2])
