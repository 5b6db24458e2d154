"""Materials in every form, and verdicts on draws of a measured surface."""

import dataclasses

import numpy as np
import pytest

from common import materials
from criteria.pair_roughness import meet
from criteria.verdicts import judge_draws
from stickiness.remaining.prediction import DEFAULT_SHARE, Roughness
from stickiness.solids.moduli import Prony

SERIES = Prony(1e4, ((3e4, 1.0), (2e5, 1e-3)))
ENTRY = {"label": "a", "work_of_adhesion": "70 mJ/m^2", "range": "0.3 nm", "source": "b"}


def test_materials_in_every_form():
    plain = materials.read_material(ENTRY | {"plane_strain_modulus": "2 MPa"})
    assert (plain.modulus, plain.depends_on_rate) == (2e6, False)
    rubber = materials.read_material(ENTRY | {"youngs_modulus": "3 MPa", "poisson_ratio": 0.5})
    assert rubber.modulus == pytest.approx(4e6)
    series = {"equilibrium": "10 kPa", "terms": [["30 kPa", "1 s"], ["0.2 MPa", "1 ms"]]}
    prony = materials.read_material(ENTRY | {"youngs_modulus_prony": series, "poisson_ratio": 0.5})
    assert prony.depends_on_rate
    assert prony.modulus == pytest.approx(SERIES.storage(1.0) / 0.75)
    pairs = [["10 mHz", "50 kPa"], ["0.1 kHz", "0.5 MPa"]]
    table = materials.read_material(ENTRY | {"youngs_modulus_table": pairs, "poisson_ratio": 0})
    assert table.modulus == pytest.approx(np.sqrt(50e3 * 0.5e6))


FORM = {"youngs_modulus_prony": {"equilibrium": "1 MPa", "terms": [["1 GPa", "1 ms"]]}}
MATERIAL = materials.read_material(ENTRY | FORM | {"poisson_ratio": 0.5})
ROUGH = Roughness(h_rms=1e-6, q0=1e5, elastic_energy=1e-7)
SAME = np.ones(4000)


def material_at(factor):
    """The material with a work of adhesion that is this factor above its threshold on `ROUGH`."""
    work = factor * float(ROUGH.threshold(MATERIAL.range)) * MATERIAL.modulus
    return dataclasses.replace(MATERIAL, work_of_adhesion=work)


@pytest.mark.slow
def test_errors_of_the_spectrum_pass_to_the_margin():
    # Tough: the threshold is in proportion to the elastic energy, whatever h_rms and q0.
    rng = np.random.default_rng(0)
    energy = 1e-7 * np.exp(0.2 * rng.normal(size=4000))
    found = judge_draws(meet(MATERIAL, Roughness(1e-6 * SAME, 1e5 * SAME, energy)))
    assert found["error_of_spectrum"] == pytest.approx(0.2, rel=0.05)
    h, q0 = 1e-6 * np.exp(0.1 * rng.normal(size=4000)), 1e5 * np.exp(0.2 * rng.normal(size=4000))
    found = judge_draws(meet(MATERIAL, Roughness(h, q0, 1e-7 * SAME)))
    assert found["error_of_spectrum"] < 1e-3


def test_draws_know_preload_and_dissipation():
    """Medians over draws of one surface, whose errors are the model's alone, are the values."""
    solid, same = material_at(1.5), np.ones(500)
    length, slope = solid.work_of_adhesion / solid.modulus, 0.3
    draws = Roughness(1e-6 * same, 1e5 * same, 1e-7 * same, rms_slope=slope * same)
    one = Roughness(1e-6, 1e5, 1e-7, rms_slope=slope)
    touched = judge_draws(meet(solid, draws))
    value = one.tension(length, solid.range) * solid.modulus
    assert np.median(touched["pull_off"]) == pytest.approx(value, rel=0.05)
    strength = solid.work_of_adhesion / solid.range
    pressed = judge_draws(meet(dataclasses.replace(solid, pressed=solid.modulus), draws))
    assert touched["pull_off"].max() < 0.01 * strength < pressed["pull_off"].max()
    rested = dataclasses.replace(solid, dwell=10.0, broken_at=1.0)
    factor, length = rested.separation_factor[0], rested.work_of_adhesion / rested.modulus
    assert factor > 1.5
    found = np.median(judge_draws(meet(rested, draws))["remaining"])
    # Its limits span three decades, so that the median of a few hundred draws errs.
    assert found == pytest.approx(factor * one.share(length, rested.range), rel=0.2)


@pytest.mark.slow
@pytest.mark.parametrize(("factor", "expected"), [(1.0, 0.5), (1.3, None), (2.0, 1.0), (0.5, 0.0)])
def test_draws_spread_over_the_error_of_the_model(factor, expected):
    """One spectrum: what is left are the model's errors, of which the limits cover 90 %.

    Half of the draws stick at the threshold, all or none of them well beyond the model's error.
    """
    solid = material_at(factor)
    found = judge_draws(meet(solid, Roughness(1e-6 * SAME, 1e5 * SAME, 1e-7 * SAME)))
    assert found["error_of_spectrum"] == pytest.approx(0, abs=1e-12)
    assert found["share_error_of_spectrum"] == pytest.approx(0, abs=1e-12)
    # What sticks is what keeps the wanted share.
    assert np.mean(found["remaining"] > DEFAULT_SHARE) == found["probability"]
    if expected is not None:  # the binomial error of 4000 draws is below 0.008
        assert found["probability"] == pytest.approx(expected, abs=0.025)
        return
    length = solid.work_of_adhesion / solid.modulus
    limits = [length / ROUGH.threshold(solid.range, sign=sign) for sign in (-1, 0, 1)]
    quantiles = (0.05, 0.5, 0.95)
    # Standard errors of quantiles of 4000 draws are below 0.5 % of these.
    np.testing.assert_allclose(np.quantile(found["margin"], quantiles), limits, rtol=0.01)
    shares = [ROUGH.share(length, solid.range, sign) for sign in (-1, 0, 1)]
    np.testing.assert_allclose(np.quantile(found["remaining"], quantiles), shares, rtol=0.03)
