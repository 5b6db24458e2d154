"""Moduli that depend on the rate."""

import numpy as np
import pytest
from scipy import integrate

from stickiness.solids.moduli import Constant, Prony, Table, crossings

SERIES = Prony(1e4, ((3e4, 1.0), (2e5, 1e-3)))


@pytest.mark.parametrize("frequency", [1e-3, 0.2, 30.0])
def test_storage_modulus_is_the_sine_transform_of_relaxation(frequency):
    # E' = E_inf + omega * integral of (E(t) - E_inf) sin(omega t) dt, by quadrature.
    omega, total = 2 * np.pi * frequency, 0.0
    for modulus, tau in SERIES.terms:
        ends = {"a": 0, "b": np.inf, "weight": "sin", "wvar": omega}
        total += modulus * integrate.quad(lambda t, tau=tau: np.exp(-t / tau), **ends)[0]
    assert SERIES.storage(frequency) == pytest.approx(1e4 + omega * total, rel=1e-6)


def test_limits_of_a_prony_series():
    extremes = SERIES.storage([1e-300, 1e160, 1e300])
    np.testing.assert_allclose(extremes, [1e4, 2.4e5, 2.4e5], rtol=1e-15)
    assert np.all(np.diff(SERIES.storage(np.geomspace(1e-3, 1e5, 50))) > 0)


def test_table_is_interpolated_in_logarithms_and_says_nothing_beyond():
    table = Table((0.1, 10.0), (1e4, 1e6))
    assert table.storage(1.0) == pytest.approx(1e5)
    assert np.isnan(table.storage([0.01, 100.0])).all()


def test_crossings_between_the_end_of_a_table_and_the_next_frequency_count():
    """The grid has one point in the table, and none of the peak between."""
    table = Table((0.1, 1.0, 10.0), (1e3, 1e5, 1e3))
    found = crossings(table, 1e4, [0.01, 5.0, 100.0])
    assert found == [(pytest.approx(10**-0.5), True), (pytest.approx(10**0.5), False)]


def test_crossings_of_a_table_are_exact_and_know_their_direction():
    table = Table((0.01, 1.0, 100.0), (1e4, 1e6, 1e4))  # slopes +1 and -1
    grid = np.geomspace(1e-3, 1e3, 25)
    found = [(pytest.approx(0.1), True), (pytest.approx(10.0), False)]
    assert crossings(table, 1e5, grid) == found
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
