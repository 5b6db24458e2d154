"""Verdicts on draws of a measured surface."""

from dataclasses import replace

import numpy as np
import pytest

from stickiness import Material
from stickiness.criteria.pair import make_pair
from stickiness.remaining.prediction import DEFAULT_SHARE, Roughness
from stickiness.solids.moduli import Prony
from stickiness.verdicts.draws import QUANTILES, draw_model_errors, judge_draws

pytestmark = pytest.mark.usefixtures("coarse_simulation")

MATERIAL = Material(
    modulus=Prony(1e6, ((1e9, 1e-3),)), poisson=0.5, work_of_adhesion=0.07, range=3e-10
)
ROUGH = Roughness(h_rms=1e-6, q0=1e5, elastic_energy=1e-7)
SAME = np.ones(4000)


def meet(material, rough):
    """`Pair` of a material with draws."""
    return make_pair(
        rough,
        modulus=material.plane_strain_modulus,
        work_of_adhesion=material.work_of_adhesion,
        range=material.range,
        pressed=material.pressed,
        instant_ratio=material.instant_ratio,
    )


def place_above_threshold(factor):
    """The material with a work of adhesion that is this factor above its threshold on `ROUGH`."""
    work = factor * float(ROUGH.threshold(MATERIAL.range)) * MATERIAL.plane_strain_modulus
    return replace(MATERIAL, work_of_adhesion=work)


def find_adhesion_length(material):
    return material.work_of_adhesion / material.plane_strain_modulus


def draw(pair):
    """Margins and shares of every draw, with the errors of the model."""
    errors = draw_model_errors(pair)
    length = pair.adhesion_length
    margins = length / pair.threshold(pair.range, sign=errors, adhesion_length=length)
    return margins, pair.share(pair.adhesion_length, pair.range, errors)


@pytest.mark.slow
def test_errors_of_the_spectrum_pass_to_the_margin():
    # Tough: the threshold is in proportion to the elastic energy, if the mean wave number is the
    # same over q0.
    rng = np.random.default_rng(0)
    energy = 1e-7 * np.exp(0.2 * rng.normal(size=4000))
    h_rms = 1e-6 * np.sqrt(energy / 1e-7)
    judged = judge_draws(meet(MATERIAL, Roughness(h_rms, 1e5 * SAME, energy)))
    assert judged["error_of_spectrum"] == pytest.approx(0.2, rel=0.05)
    h_rms = 1e-6 * np.exp(0.1 * rng.normal(size=4000))
    q0 = 1e5 * (1e-6 / h_rms) ** 2
    judged = judge_draws(meet(MATERIAL, Roughness(h_rms, q0, 1e-7 * SAME)))
    assert judged["error_of_spectrum"] < 1e-3


def test_draws_know_preload_and_fast_separation():
    """Medians over draws of one surface, whose errors are the model's alone, are the values."""
    material = place_above_threshold(1.5)
    same = np.ones(500)
    draws = Roughness(1e-6 * same, 1e5 * same, 1e-7 * same, rms_slope=0.3 * same)
    one = Roughness(1e-6, 1e5, 1e-7, rms_slope=0.3)
    _, median, most = judge_draws(meet(material, draws))["pull_off_quantile"]
    tension = one.tension(find_adhesion_length(material), material.range)
    assert median == pytest.approx(tension * material.plane_strain_modulus, rel=0.05)
    strength = material.work_of_adhesion / material.range
    pressed = replace(material, pressed=material.plane_strain_modulus)
    most_pressed = judge_draws(meet(pressed, draws))["pull_off_quantile"][-1]
    assert most < 0.01 * strength < most_pressed
    rested = replace(material, dwell=10.0, broken_at=1.0)
    ratio = rested.instant_ratio
    assert ratio > 100
    # Half of the draws err to the low side, where separation is slow.
    low, median, high = judge_draws(meet(rested, draws))["remaining_quantile"]
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
    pair = meet(material, Roughness(1e-6 * SAME, 1e5 * SAME, 1e-7 * SAME))
    judged = judge_draws(pair)
    assert judged["error_of_spectrum"] == pytest.approx(0, abs=1e-12)
    # What sticks is what keeps the wanted share.
    _, shares = draw(pair)
    assert np.mean(shares > DEFAULT_SHARE) == judged["probability"]
    if expected is not None:  # the binomial error of 4000 draws is below 0.008
        assert judged["probability"] == pytest.approx(expected, abs=0.025)
        return
    length = find_adhesion_length(material)
    limits = [length / ROUGH.threshold(material.range, sign=sign) for sign in (-1, 0, 1)]
    # Standard errors of quantiles of 4000 draws are below 0.5 % of these.
    np.testing.assert_allclose(judged["margin_quantile"], limits, rtol=0.01)
    limits = [ROUGH.share(length, material.range, sign) for sign in (-1, 0, 1)]
    np.testing.assert_allclose(judged["remaining_quantile"], limits, rtol=0.03)


def test_quantiles_are_values_of_draws():
    """So that a limit of the share and that of the margin are on the same side of the threshold."""
    material = place_above_threshold(1.3)
    pair = meet(material, Roughness(1e-6 * SAME, 1e5 * SAME, 1e-7 * SAME))
    judged = judge_draws(pair)
    margins, shares = draw(pair)
    assert np.isin(judged["margin_quantile"], margins).all()
    assert np.isin(judged["remaining_quantile"], shares).all()
    assert np.mean(margins <= judged["margin_quantile"][0]) == pytest.approx(QUANTILES[0])
