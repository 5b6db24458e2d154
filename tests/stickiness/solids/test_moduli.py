"""Moduli that depend on the rate."""

import numpy as np
import pytest
from scipy import integrate
from scipy.special import gamma

from stickiness.solids.moduli import Prony, Table, choose_factor

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
def test_separation_factor_of_one_relaxation_time(ratio, dwell):
    """Closed form: compliance has one time, tau E_instant/E_relaxed, and the integral is known."""
    tau, solid = 3.0, Prony(1.0, ((ratio - 1, 3.0),))
    relaxed = 1 + (ratio - 1) * np.exp(-dwell / tau)
    for frequency in 10.0 ** np.arange(-9, 9, 1.7):
        b = 2 * np.pi * frequency * tau * ratio / relaxed
        lost = (1 - relaxed / ratio) * b / (1 + np.sqrt(1 + b**2))
        value, low, high = solid.separation_factor(dwell, frequency)
        assert value == pytest.approx(1 / (1 - lost), rel=1e-9)
        assert (low, high) == (1.0, pytest.approx(ratio / relaxed))


def test_separation_factor_goes_from_1_to_the_ratio_of_moduli():
    assert SERIES.separation_factor(1e9, 1e-12)[0] == pytest.approx(1, abs=1e-9)
    assert SERIES.separation_factor(1e9, 1e12)[0] == pytest.approx(24)
    assert SERIES.separation_factor(1e-9, 1.0)[0] == pytest.approx(1, abs=1e-5)  # nothing relaxed
    rates = [SERIES.separation_factor(60.0, f)[0] for f in np.geomspace(1e-4, 1e6, 30)]
    assert np.all(np.diff(rates) > 0)


@pytest.mark.parametrize(
    ("dwell", "frequency"), [(0.1, 1.0), (1.0, 100.0), (60.0, 0.01), (60, 1e5)]
)
def test_separation_factor_is_the_integral_of_persson_and_brener(dwell, frequency):
    moduli, times = np.array(SERIES.terms).T
    relaxed = moduli * (1 - np.exp(-dwell / times))
    rest = SERIES.relaxation(dwell)

    def integrand(log_ratio):
        x = 2j * np.pi * frequency * np.exp(log_ratio) * times
        compliance = 1 / (rest + np.sum(relaxed * x / (1 + x)))
        return -np.sqrt(-np.expm1(2 * log_ratio)) * compliance.imag

    points = np.arange(-50.0, 0.0)
    total = integrate.quad(integrand, -60, 0, points=points, limit=2000, epsabs=0, epsrel=1e-10)[0]
    expected = 1 / (1 - 2 / np.pi * rest * total)
    assert SERIES.separation_factor(dwell, frequency)[0] == pytest.approx(expected, rel=1e-8)


def find_factor_of_power_law(power, dwell, frequency):
    """Factor of E(t) ~ t^-power by nested quadrature, and E' of that solid over E(dwell).

    Its terms of rates s are s^power d(ln s), and those that have not relaxed carry exp(-s dwell).
    """
    relaxed = gamma(power) * dwell**-power
    scale = np.pi / np.sin(np.pi * power)

    def integrate_parts(integrand, low, high, points):
        points = [point for point in points if low < point < high]
        settings = {"points": points, "limit": 400, "epsrel": 1e-8}
        real = integrate.quad(lambda x: integrand(x).real, low, high, **settings)[0]
        imaginary = integrate.quad(lambda x: integrand(x).imag, low, high, **settings)[0]
        return real + 1j * imaginary

    def find_modulus(omega):
        def integrand(log_rate):
            rate = np.exp(log_rate)
            return rate ** (power + 1) * np.exp(-dwell * rate) / (rate + 1j * omega)

        slowest = np.log(min(omega, 1 / dwell)) - 40
        unrelaxed = integrate_parts(integrand, slowest, np.log(60 / dwell), [np.log(omega)])
        return scale * (1j * omega) ** power + unrelaxed

    def find_loss(log_ratio):
        compliance = 1 / find_modulus(2 * np.pi * frequency * np.exp(log_ratio))
        return -np.sqrt(-np.expm1(2 * log_ratio)) * compliance

    slowest = -35 - max(0.0, np.log(frequency * dwell))
    lost = integrate_parts(find_loss, slowest, 0.0, [-np.log(frequency * dwell)]).imag
    storage = scale * np.cos(np.pi * power / 2) * (2 * np.pi * frequency) ** power
    return 1 / (1 - 2 / np.pi * relaxed * lost), storage / relaxed


@pytest.mark.parametrize(
    ("power", "of_storage"), [(0.1, 1.0), (0.3, 0.95), (0.5, 0.76), (0.7, 0.48), (0.9, 0.16)]
)
def test_a_table_of_a_power_law_knows_relaxation_and_the_separation_factor(power, of_storage):
    dwell = 60.0
    frequencies = np.geomspace(1.6e-3, 1e4, 40)
    moduli = np.pi / np.sin(np.pi * power) * np.cos(np.pi * power / 2)
    table = Table(tuple(frequencies), tuple(moduli * (2 * np.pi * frequencies) ** power))
    assert table.relaxation(dwell) == pytest.approx(gamma(power) * dwell**-power, rel=0.013)
    for frequency in (0.01, 1.0, 9e3):
        value, least, most = table.separation_factor(dwell, frequency)
        exact, storage = find_factor_of_power_law(power, dwell, frequency)
        assert value == pytest.approx(exact, rel=0.015)
        assert least == 1
        assert exact < 1.015 * most
    # The storage modulus alone falls short of it, the more, the steeper it is.
    assert storage / exact == pytest.approx(of_storage, abs=0.02)


@pytest.mark.parametrize("points", [15, 200])
def test_a_table_of_a_series_has_its_separation_factor(points):
    series = Prony(1.0, tuple((10 ** (0.4 * i), 10.0**-i) for i in range(-2, 5)))
    frequencies = np.geomspace(1e-4, 1e5, points)
    table = Table(tuple(frequencies), tuple(series.storage(frequencies)))
    for dwell, frequency in (
        np.array(np.meshgrid([1.0, 100.0], [1e-3, 0.1, 10, 1e3])).reshape(2, -1).T
    ):
        value, _, most = table.separation_factor(dwell, frequency)
        exact, _, fast_edge = series.separation_factor(dwell, frequency)
        assert value == pytest.approx(exact, rel=0.08)
        assert most == pytest.approx(fast_edge, rel=0.04)


def test_a_table_of_one_relaxation_is_off_by_a_tenth_of_the_step():
    frequencies, times = np.geomspace(1e-4, 1e4, 2000), np.geomspace(1e-2, 10, 300)
    step = Prony(1.0, ((9.0, 1.0),))
    table = Table(tuple(frequencies), tuple(step.storage(frequencies)))
    assert abs(table.relaxation(times) - step.relaxation(times)).max() < 0.1 * 9
    for frequency in (1e-3, 0.1, 1.0, 10.0):  # the value is too low, the limits hold
        value, least, most = table.separation_factor(100.0, frequency)
        exact = step.separation_factor(100.0, frequency)[0]
        assert 0.78 * exact < value <= 1.02 * exact
        assert least == 1
        assert exact <= 1.001 * most


def test_a_table_says_nothing_of_dwells_and_rates_beyond_it():
    table = Table((0.1, 10.0), (1e4, 1e6))
    assert np.isnan(table.relaxation([0.001, 10.0])).all()
    assert np.isnan(table.separation_factor(1.0, 20.0)[0])
    assert table.separation_factor(1.0, 20.0)[1:] == (1.0, pytest.approx(1e6 / 1e4 / 1.0132, 1e-3))


def test_a_factor_between_its_limits():
    np.testing.assert_allclose(choose_factor((4, 1, 9), [-2, -1, 0, 1, 2]), [1, 1, 4, 9, 9])
    np.testing.assert_allclose(choose_factor((4, 1, 9), [-0.5, 0.5]), [2, 6])
    # A value that is not known is that of a slow edge.
    np.testing.assert_allclose(choose_factor((np.nan, 1, 9), [-1, 0, 0.5, 1]), [1, 1, 3, 9])


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
