"""Moduli that depend on the rate, and verdicts at other rates."""

import numpy as np
import pytest
import xarray as xr
from scipy import integrate

import _materials
import _uncertain
import judge
from _criteria import SurfaceAv
from stickiness import criteria
from stickiness.viscoelastic import Constant, Prony, Table, crossings

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
    plain = _materials.material(ENTRY | {"plane_strain_modulus": "2 MPa"})
    assert (plain.modulus, plain.depends_on_rate) == (2e6, False)
    rubber = _materials.material(ENTRY | {"youngs_modulus": "3 MPa", "poisson_ratio": 0.5})
    assert rubber.modulus == pytest.approx(4e6)
    series = {"equilibrium": "10 kPa", "terms": [["30 kPa", "1 s"], ["0.2 MPa", "1 ms"]]}
    prony = _materials.material(ENTRY | {"youngs_modulus_prony": series, "poisson_ratio": 0.5})
    assert prony.depends_on_rate
    assert prony.modulus == pytest.approx(SERIES.storage(1.0) / 0.75)
    pairs = [["10 mHz", "50 kPa"], ["0.1 kHz", "0.5 MPa"]]
    table = _materials.material(ENTRY | {"youngs_modulus_table": pairs, "poisson_ratio": 0})
    assert table.modulus == pytest.approx(np.sqrt(50e3 * 0.5e6))
    assert "10 mHz" in _materials.modulus_text(
        ENTRY | {"youngs_modulus_table": pairs, "poisson_ratio": 0}
    )


# Verdicts

MATERIAL = _materials.material(
    ENTRY
    | {
        "youngs_modulus_prony": {"equilibrium": "1 MPa", "terms": [["1 GPa", "1 ms"]]},
        "poisson_ratio": 0.5,
    }
)


def drawn(h, q0):
    return xr.Dataset({"h_rms_draws": ("draw", h), "q0_draws": ("draw", q0)})


def constant_a_v(low, high):
    theory = np.array([[low, low], [high, high]])
    return SurfaceAv(np.array([1e-9, 1.0]), theory, quoted=0, ratio=1.0, relative_error=0.0)


def test_margin_at_another_rate_is_that_of_its_modulus():
    frequencies = np.array([1e-2, 1.0, 1e3])
    h, q0, a_v = 1e-6, 1e5, 2.0
    found = _uncertain.at_frequencies(
        MATERIAL,
        criteria.violano(h, q0, MATERIAL.work_of_adhesion / MATERIAL.modulus, 0.3e-9, a_v).margin,
        frequencies,
    )
    for frequency, margin in zip(frequencies, found, strict=True):
        length = MATERIAL.work_of_adhesion / MATERIAL.plane_strain.storage(frequency)
        assert margin == pytest.approx(criteria.violano(h, q0, length, 0.3e-9, a_v).margin)


def test_errors_of_the_spectrum_pass_to_the_margin():
    rng = np.random.default_rng(0)
    h = 1e-6 * np.exp(0.1 * rng.normal(size=4000))
    q0 = 1e5 * np.exp(0.2 * rng.normal(size=4000))
    found = _uncertain.uncertain(MATERIAL, drawn(h, q0), constant_a_v(2.0, 2.0))
    # margin ~ q0^(-3/5)/h
    assert found.from_spectrum == pytest.approx(np.hypot(0.1, 0.6 * 0.2), rel=0.05)
    assert found.from_a_v == 0


def test_errors_of_a_v_pass_to_the_margin():
    h, q0 = np.full(4000, 1e-6), np.full(4000, 1e5)
    found = _uncertain.uncertain(MATERIAL, drawn(h, q0), constant_a_v(1.0, np.e))
    # ln a_V is uniform over 1, margin ~ a_V^(3/5)
    assert found.from_a_v == pytest.approx(0.6 / np.sqrt(12), rel=0.05)
    assert found.from_spectrum == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("shift", [-0.5, 0.0, 1.0])
def test_probability_is_the_share_of_the_margin_above_one(shift):
    rng = np.random.default_rng(1)
    limit = criteria.h_rms_limit(
        1e5, MATERIAL.work_of_adhesion / MATERIAL.modulus, MATERIAL.range, 2.0
    )
    h = limit * np.exp(-0.1 * shift + 0.1 * rng.normal(size=4000))
    found = _uncertain.uncertain(MATERIAL, drawn(h, np.full(4000, 1e5)), constant_a_v(2.0, 2.0))
    from scipy.stats import norm

    # Binomial error of 4000 draws: below 0.008.
    assert found.probability == pytest.approx(norm.cdf(shift), abs=0.025)


@pytest.mark.parametrize(
    ("probability", "valid", "expected"),
    [
        (1.0, 1, "sticky"),
        (0.96, 0, "sticky"),
        (0.9, 1, "depends"),
        (0.1, 0, "depends"),
        (0.04, 1, "not sticky"),
        (0.0, 0, "undecided"),
        (np.nan, 1, "depends"),  # not measured: the ends decide
    ],
)
def test_verdict_on_a_measured_surface_is_that_of_its_draws(probability, valid, expected):
    ends = {"margin_low": ("end", [0.5, 0.5]), "margin_high": ("end", [2.0, 2.0])}
    data = xr.Dataset(ends | {"dmt_valid": ("end", [valid, valid]), "probability": probability})
    assert judge.VERDICTS[int(judge.verdict(data))] == expected
