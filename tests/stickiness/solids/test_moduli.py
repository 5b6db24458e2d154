"""Moduli that depend on the rate, and verdicts at other rates."""

import dataclasses

import numpy as np
import pytest
import xarray as xr
from scipy import integrate

from criteria import materials
from criteria.classification import decide_pairs
from criteria.judging import judge_samples
from stickiness.criteria.pair import WORDS
from stickiness.criteria.registry import EDGES
from stickiness.remaining.prediction import DEFAULT_SHARE, Roughness
from stickiness.solids.moduli import Constant, Prony, Table, crossings

SERIES = Prony(1e4, ((3e4, 1.0), (2e5, 1e-3)))
ENTRY = {"label": "a", "work_of_adhesion": "70 mJ/m^2", "range": "0.3 nm", "source": "b"}


@pytest.mark.parametrize("frequency", [1e-3, 0.2, 30.0])
def test_storage_modulus_is_the_sine_transform_of_relaxation(frequency):
    # E' = E_inf + omega * integral of (E(t) - E_inf) sin(omega t) dt, by quadrature.
    omega = 2 * np.pi * frequency
    parts = [
        modulus
        * integrate.quad(lambda t, tau=tau: np.exp(-t / tau), 0, np.inf, weight="sin", wvar=omega)[
            0
        ]
        for modulus, tau in SERIES.terms
    ]
    assert SERIES.storage(frequency) == pytest.approx(1e4 + omega * sum(parts), rel=1e-6)


def test_limits_of_a_prony_series():
    assert SERIES.storage(1e-9) == pytest.approx(1e4)
    assert SERIES.storage(1e9) == pytest.approx(2.4e5)
    assert np.all(np.diff(SERIES.storage(np.geomspace(1e-3, 1e5, 50))) > 0)


def test_table_is_interpolated_in_logarithms_and_says_nothing_beyond():
    table = Table((0.1, 10.0), (1e4, 1e6))
    assert table.storage(1.0) == pytest.approx(1e5)
    assert np.isnan(table.storage([0.01, 100.0])).all()


@pytest.mark.parametrize("frequency", [1e-300, 1e160, 1e300])
def test_extreme_frequencies_have_the_limits(frequency):
    assert SERIES.storage(frequency) == pytest.approx(1e4 if frequency < 1 else 2.4e5, rel=1e-15)


def test_crossings_between_the_end_of_a_table_and_the_next_frequency_count():
    """The grid has one point in the table, and none of the peak between."""
    table = Table((0.1, 1.0, 10.0), (1e3, 1e5, 1e3))
    found = crossings(table, 1e4, [0.01, 5.0, 100.0])
    assert found == [(pytest.approx(10**-0.5), True), (pytest.approx(10**0.5), False)]


def test_crossings_of_a_table_are_exact_and_know_their_direction():
    table = Table((0.01, 1.0, 100.0), (1e4, 1e6, 1e4))  # slopes +1 and -1
    grid = np.geomspace(1e-3, 1e3, 25)
    (first, up), (second, up_again) = crossings(table, 1e5, grid)
    assert (first, second) == pytest.approx((0.1, 10.0))
    assert (up, up_again) == (True, False)
    assert crossings(Constant(1e5), 1e6, grid) == []


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Constant(-1.0), "modulus must be positive"),
        (lambda: Prony(0.0, ((1.0, 1.0),)), "equilibrium must be positive"),
        (lambda: Prony(1.0, ()), "must not be empty"),
        (lambda: Table((1.0,), (1.0,)), "two pairs"),
        (lambda: Table((2.0, 1.0), (1.0, 1.0)), "must increase"),
        (lambda: SERIES.storage(0.0), "frequency must be positive"),
    ],
)
def test_wrong_moduli(make, message):
    with pytest.raises(ValueError, match=message):
        make()


# Materials of the configuration


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
    assert "10 mHz" in materials.describe_modulus(
        ENTRY | {"youngs_modulus_table": pairs, "poisson_ratio": 0}
    )


# Verdicts

MATERIAL = materials.read_material(
    ENTRY
    | {
        "youngs_modulus_prony": {"equilibrium": "1 MPa", "terms": [["1 GPa", "1 ms"]]},
        "poisson_ratio": 0.5,
    }
)


def drawn(h, q0, energy=None):
    """Spectra of these rms heights and wave numbers; by default of energies as h^2 q0."""
    return Roughness(h, q0, h**2 * q0 if energy is None else energy)


def material_at(factor, rough):
    """The material with a work of adhesion that is this factor above its threshold."""
    work = factor * float(rough.threshold(MATERIAL.range)) * MATERIAL.modulus
    return dataclasses.replace(MATERIAL, work_of_adhesion=work)


ROUGH = Roughness(h_rms=1e-6, q0=1e5, elastic_energy=1e-7)


@pytest.mark.slow
def test_errors_of_the_spectrum_pass_to_the_margin():
    # Tough: the threshold is in proportion to the elastic energy, whatever h_rms and q0.
    rng = np.random.default_rng(0)
    energy = 1e-7 * np.exp(0.2 * rng.normal(size=4000))
    found = judge_samples(MATERIAL, drawn(np.full(4000, 1e-6), np.full(4000, 1e5), energy))
    assert found["error_of_spectrum"] == pytest.approx(0.2, rel=0.05)
    h = 1e-6 * np.exp(0.1 * rng.normal(size=4000))
    q0 = 1e5 * np.exp(0.2 * rng.normal(size=4000))
    found = judge_samples(MATERIAL, drawn(h, q0, np.full(4000, 1e-7)))
    assert found["error_of_spectrum"] < 1e-3


@pytest.mark.slow
def test_draws_spread_over_the_error_of_the_model():
    """One spectrum: what is left are the model's errors, of which the limits cover 90 %."""
    many = drawn(np.full(4000, 1e-6), np.full(4000, 1e5), np.full(4000, 1e-7))
    solid = material_at(1.3, ROUGH)
    found = judge_samples(solid, many)
    assert found["error_of_spectrum"] == pytest.approx(0, abs=1e-12)
    assert found["share_error_of_spectrum"] == pytest.approx(0, abs=1e-12)
    length = solid.work_of_adhesion / solid.modulus
    limits = [length / ROUGH.threshold(solid.range, sign=sign) for sign in (-1, 0, 1)]
    # Standard errors of quantiles of 4000 draws are below 0.5 % of these.
    np.testing.assert_allclose(np.quantile(found["margin"], (0.05, 0.5, 0.95)), limits, rtol=0.01)
    shares = [ROUGH.share(length, solid.range, sign) for sign in (-1, 0, 1)]
    np.testing.assert_allclose(
        np.quantile(found["remaining"], (0.05, 0.5, 0.95)), shares, rtol=0.03
    )


@pytest.mark.slow
def test_probability_is_the_share_of_the_margin_above_one():
    """Half of them at the threshold, all or none of them well beyond the model's error."""
    many = drawn(np.full(4000, 1e-6), np.full(4000, 1e5), np.full(4000, 1e-7))
    for factor, expected in ((1.0, 0.5), (2.0, 1.0), (0.5, 0.0)):
        found = judge_samples(material_at(factor, ROUGH), many)
        # Binomial error of 4000 draws: below 0.008.
        assert found["probability"] == pytest.approx(expected, abs=0.025)
        # What sticks is what keeps the wanted share.
        assert np.mean(found["remaining"] > DEFAULT_SHARE) == found["probability"]


@pytest.mark.parametrize(
    ("quantiles", "grows", "expected"),
    [
        ((0.85, 0.9, 1.0), 2.0, "sticks fully"),
        ((0.15, 0.3, 0.5), 2.0, "sticks"),
        ((0.05, 0.3, 0.5), 2.0, "depends"),
        ((0.0, 0.0, 0.08), 2.0, "adheres locally, does not hold"),
        ((0.0, 0.0, 0.08), 0.5, "does not stick"),
        ((np.nan,) * 3, 2.0, "depends"),  # not measured: the ends decide
    ],
)
def test_verdict_on_a_measured_surface_is_that_of_its_draws(quantiles, grows, expected):
    data = {
        "remaining_low": ("end", [0.0, 0.0]),
        "remaining_high": ("end", [1.0, 1.0]),
        "margin": (("end", "criterion"), [[grows], [grows]]),
        "remaining_quantile": ("quantile", list(quantiles)),
    }
    dataset = xr.Dataset(data, coords={"criterion": [EDGES]})
    assert WORDS[int(decide_pairs(dataset))] == expected
