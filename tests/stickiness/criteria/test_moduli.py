"""Moduli that depend on the rate, and verdicts at other rates."""

import dataclasses

import numpy as np
import pytest
import xarray as xr
from scipy import integrate

from pipeline.verdicts import materials
from pipeline.verdicts.probabilities import draw_margins
from pipeline.verdicts.words import decide_pairs
from stickiness.adhesion import equivalent_sphere
from stickiness.criteria.a_v_table import SurfaceAv
from stickiness.criteria.moduli import Constant, Prony, Table, crossings
from stickiness.criteria.pair import WORDS
from stickiness.criteria.registry import FULL_CONTACT

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


def drawn(h, q0, slope=1.0):
    parts = {"h_rms": h, "q0": q0, "rms_slope": np.full_like(h, slope)}
    return xr.Dataset({f"{name}_draws": ("draw", part) for name, part in parts.items()})


def constant_a_v(low, high):
    theory = np.array([[low, low], [high, high]])
    return SurfaceAv(np.array([1e-9, 1.0]), theory, quoted=0, ratio=1.0, relative_error=0.0)


# Edges so tough that the ratio is t^(3/4) times what h and q0 do not enter: h^(-5/4) q0^(-3/4).
SLOPE = 1.0


def test_errors_of_the_spectrum_pass_to_the_margin():
    rng = np.random.default_rng(0)
    h = 1e-6 * np.exp(0.1 * rng.normal(size=4000))
    q0 = 1e5 * np.exp(0.2 * rng.normal(size=4000))
    found = draw_margins(MATERIAL, drawn(h, q0), constant_a_v(2.0, 2.0))
    assert found.from_spectrum == pytest.approx(np.hypot(1.25 * 0.1, 0.75 * 0.2), rel=0.05)
    # beyond what was simulated the model errs by up to a factor of two, evenly in logarithms
    assert found.from_model == pytest.approx(2 * np.log(2) / np.sqrt(12), rel=0.05)


def test_errors_of_a_v_pass_to_the_margin():
    h, q0 = np.full(4000, 1e-6), np.full(4000, 1e5)
    found = draw_margins(MATERIAL, drawn(h, q0), constant_a_v(1.0, np.e))
    # ln a_V is uniform over 1, tough edges have margin ~ a_V^(3/4); the model's error adds
    model = 2 * np.log(2) / np.sqrt(12)
    assert found.from_model == pytest.approx(np.hypot(0.75 / np.sqrt(12), model), rel=0.05)
    assert found.from_spectrum == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize(
    ("modulus", "reach", "error"),
    [
        (1e11, 1e-7, equivalent_sphere.ERROR_WEAK),
        (1e6, 1e-7, equivalent_sphere.ERROR_STRONG),
        (1e6, 1e-10, equivalent_sphere.ERROR_BEYOND),
    ],
)
def test_draws_spread_over_the_error_of_the_model(modulus, reach, error):
    """One spectrum and one a_V: what is left is even in logarithms from 1/error to error."""
    h, q0, slope, a_v = 1e-6, 1e5, 0.8, 4.0
    solid = materials.read_material(
        ENTRY | {"plane_strain_modulus": f"{modulus} Pa", "range": f"{reach} m"}
    )
    many = drawn(np.full(4000, h), np.full(4000, q0), slope)
    found = draw_margins(solid, many, constant_a_v(a_v, a_v))
    length = solid.work_of_adhesion / modulus
    ratio = equivalent_sphere.attraction(h, q0, slope, length, reach, a_v).ratio
    exponents = np.log(found.quantiles / ratio) / np.log(error)
    # at 5, 50 and 95 %; standard errors of 4000 draws are below 0.016
    np.testing.assert_allclose(exponents, [-0.9, 0, 0.9], atol=0.06)
    assert found.margins.min() > ratio / error
    assert found.margins.max() < ratio * error


def test_probability_is_the_share_of_the_margin_above_one():
    """Half of them at the threshold, all or none of them well beyond the model's error."""
    h, q0 = 1e-6, 1e5
    reach, a_v = MATERIAL.range, 2.0
    threshold = equivalent_sphere.adhesion_length_threshold(h, q0, SLOPE, reach, a_v)
    many = drawn(np.full(4000, h), np.full(4000, q0), SLOPE)
    for factor, expected in ((1.0, 0.5), (10.0, 1.0), (0.1, 0.0)):
        solid = dataclasses.replace(
            MATERIAL, work_of_adhesion=factor * threshold * MATERIAL.modulus
        )
        found = draw_margins(solid, many, constant_a_v(a_v, a_v))
        # Binomial error of 4000 draws: below 0.008. The model's error is up to a factor of two.
        assert found.probability == pytest.approx(expected, abs=0.025)


@pytest.mark.parametrize(
    ("probability", "full", "expected"),
    [
        (1.0, 0.1, "sticky"),
        (0.96, 2.0, "sticky"),
        (0.9, 0.1, "depends"),
        (0.1, 2.0, "depends"),
        (0.04, 0.1, "not sticky"),
        (0.0, 2.0, "undecided"),
        (np.nan, 0.1, "depends"),  # not measured: the ends decide
    ],
)
def test_verdict_on_a_measured_surface_is_that_of_its_draws(probability, full, expected):
    data = {
        "margin_low": ("end", [0.5, 0.5]),
        "margin_high": ("end", [2.0, 2.0]),
        "margin": (("end", "criterion"), [[full], [full]]),
        "probability": probability,
    }
    dataset = xr.Dataset(data, coords={"criterion": [FULL_CONTACT]})
    assert WORDS[int(decide_pairs(dataset))] == expected
