"""Moduli that depend on the rate."""

import numpy as np
import pytest
from scipy import integrate
from scipy.special import gamma

from stickiness.solids.moduli import Prony, Table

SERIES = Prony(1e4, ((3e4, 1.0), (2e5, 1e-3)))


@pytest.mark.parametrize("frequency", [1e-3, 0.2, 30.0])
def test_storage_modulus_is_the_sine_transform_of_relaxation(frequency):
    # E' = E_inf + omega * integral of (E(t) - E_inf) sin(omega t) dt, by quadrature.
    omega, total = 2 * np.pi * frequency, 0.0
    for modulus, tau in SERIES.terms:
        alone = Prony(1.0, ((modulus, tau),))
        ends = {"a": 1e-12, "b": np.inf, "weight": "sin", "wvar": omega}
        total += integrate.quad(lambda t, one=alone: one.relaxation(t) - 1, **ends)[0]
    assert SERIES.storage(frequency) == pytest.approx(1e4 + omega * total, rel=1e-6)
    assert SERIES.relaxation([1e-30, 1e30]) == pytest.approx([2.4e5, 1e4], rel=1e-15)


@pytest.mark.parametrize("ratio", [2.0, 100.0, 1e6])
@pytest.mark.parametrize("dwell", [0.3, 3.0, 1e9])
def test_largest_modulus_is_that_of_a_fast_edge(ratio, dwell):
    """Work of a steady edge by Persson and Brener, in closed form: compliance has one time."""
    tau = 3.0
    solid = Prony(1.0, ((ratio - 1, tau),))
    relaxed = solid.relaxation(dwell)
    most = solid.largest / relaxed
    frequencies = 10.0 ** np.arange(-9, 13, 1.7)
    b = 2 * np.pi * frequencies * tau * most
    work = 1 / (1 - (1 - 1 / most) * b / (1 + np.sqrt(1 + b**2)))
    assert np.all((work >= 1) & (work <= most * (1 + 1e-9)))
    assert work[-1] == pytest.approx(most, rel=1e-4)


@pytest.mark.parametrize("power", [0.1, 0.3, 0.5, 0.7, 0.9])
def test_a_table_of_a_power_law_knows_relaxation(power):
    dwell = 60.0
    frequencies = np.geomspace(1.6e-3, 1e4, 40)
    moduli = np.pi / np.sin(np.pi * power) * np.cos(np.pi * power / 2)
    table = Table(tuple(frequencies), tuple(moduli * (2 * np.pi * frequencies) ** power))
    assert table.relaxation(dwell) == pytest.approx(gamma(power) * dwell**-power, rel=0.013)


def test_a_table_of_one_relaxation_is_off_by_a_tenth_of_the_step():
    frequencies, times = np.geomspace(1e-4, 1e4, 2000), np.geomspace(1e-2, 10, 300)
    step = Prony(1.0, ((9.0, 1.0),))
    table = Table(tuple(frequencies), tuple(step.storage(frequencies)))
    assert abs(table.relaxation(times) - step.relaxation(times)).max() < 0.1 * 9
    assert table.largest == pytest.approx(step.largest, rel=1e-6)


def test_a_table_says_nothing_of_dwells_beyond_it():
    table = Table((0.1, 10.0), (1e4, 1e6))
    assert np.isnan(table.relaxation([0.001, 10.0])).all()


def test_a_storage_modulus_neither_falls_nor_rises_faster_than_one_relaxation():
    frequencies = np.geomspace(1e-4, 1e4, 33)
    single = Prony(1e-6, ((1e6, 1.0),)).storage(frequencies)
    Table(tuple(frequencies), tuple(single))
    with pytest.raises(ValueError, match=r"moduli\[1\] = 1e\+06 .* square of the frequency"):
        Table((1.0, 10.0), (9e3, 1e6))
    with pytest.raises(ValueError, match=r"moduli\[1\] = 94 Pa at 10 Hz .* does not fall"):
        Table((1.0, 10.0), (100.0, 94.0))


def test_limits_of_a_prony_series():
    extremes = SERIES.storage([1e-300, 1e160, 1e300])
    np.testing.assert_allclose(extremes, [1e4, 2.4e5, 2.4e5], rtol=1e-15)
    assert np.all(np.diff(SERIES.storage(np.geomspace(1e-3, 1e5, 50))) > 0)


def test_table_is_interpolated_in_logarithms_and_says_nothing_beyond():
    table = Table((0.1, 10.0), (1e4, 1e6))
    assert table.storage(1.0) == pytest.approx(1e5)
    assert np.isnan(table.storage([0.01, 100.0])).all()
