"""The table of a_V: what it interpolates, its errors and its limits."""

import numpy as np
import pytest
import xarray as xr

from fits import tabulate_a_v
from persson import persson_table
from stickiness.criteria.a_v_table import PARTED, AvTable, edge_range, local_a_v
from stickiness.persson import Persson
from stickiness.spectrum import SelfAffine
from stickiness.statistics import COVERS

GAMMA = 0.45
AXES = {
    "hurst": np.array([0.7, 0.75, 0.8, 0.9]),
    "magnification": np.array([1e2, 1e3, 1e4, 1e5]),
    "pressure": np.array([0.01, 0.03, 0.1, 0.3]),
}
RANGES = np.geomspace(1e-8, 1, 33)
RATIO, RATIO_ERROR = 1.1, 0.05


@pytest.fixture(scope="module")
def table():
    theory = persson_table.tabulate(AXES, RANGES, GAMMA)
    theory["quadrature_error"] = persson_table.quadrature_error(AXES, RANGES, GAMMA)
    dataset = theory.isel(variant=0).merge(tabulate_a_v.reach(theory))
    return dataset.merge(tabulate_a_v.simulated([comparison(RATIO), comparison(RATIO)]))


def comparison(ratio, error=RATIO_ERROR, zeta=32, loads=(0.01, 0.1)):
    """Theory against a simulation that is `ratio` times it at every load and range."""
    loads, ranges = list(loads), np.geomspace(1e-3, 2, 40)
    full = np.full((2, len(loads), len(ranges)), 1 / ratio - 1)
    return xr.Dataset(
        {
            "attractive_area_difference": (("variant", "pressure", "range"), full),
            "attractive_area_difference_total_error": (
                ("variant", "pressure", "range"),
                np.full(full.shape, COVERS * error / ratio),
            ),
            "window_holds": ("pressure", [1] * len(loads)),
        },
        coords={"variant": ["a", "b"], "pressure": loads, "range": ranges},
        attrs={"parameters": f'{{"magnification": {zeta}}}'},
    )


def direct(hurst, magnification, pressure, ranges, contact=False, variant="afferrante2018"):
    """a_V by theory itself."""
    spectrum = SelfAffine(hurst=hurst, q0=1.0, q1=magnification, h_rms=1.0)
    theory = Persson(spectrum, variant, GAMMA)
    area = theory.gap_cumulative(ranges, pressure)
    if contact:
        area = area + theory.area_fraction(pressure)
    return local_a_v(area, pressure, ranges)


@pytest.mark.slow
def test_between_its_points_the_table_is_theory(table):
    known = AvTable(table)
    ranges = np.array([1e-3, 0.012, 0.2, 0.9])
    found = known.a_v_at(0.83, 0.05, ranges, 2.2e4)
    np.testing.assert_allclose(found.value / RATIO, direct(0.83, 2.2e4, 0.05, ranges), rtol=0.02)
    assert not found.edge.any()


@pytest.mark.slow
def test_limit_of_infinite_magnification_is_approached(table):
    found = AvTable(table).a_v_at(0.8, 0.05, RANGES[8:]).value / RATIO
    # The area within 1e-6 of contact, contact included, has converged to 1 % at zeta = 1e12.
    np.testing.assert_allclose(found, direct(0.8, 1e12, 0.05, RANGES[8:], contact=True), rtol=0.02)


@pytest.mark.slow
def test_below_the_edge_range_a_v_is_constant(table):
    known = AvTable(table)
    found = known.a_v_at(0.8, 0.05, [1e-8, 1e-6, 1e-5], 1e3)
    assert found.edge.all()
    np.testing.assert_allclose(found.value, found.value[0], rtol=1e-12)
    ranges = np.geomspace(1e-8, 1, 65)
    pair = [direct(0.8, 1e3, 0.05, ranges, variant=v) for v in ("afferrante2018", "almqvist2011")]
    edge = edge_range(ranges, *pair)
    want = direct(0.8, 1e3, 0.05, np.array([edge]))[0]
    assert found.value[0] / RATIO == pytest.approx(want, rel=0.03)


@pytest.mark.slow
def test_errors_hold_the_simulations_own(table):
    found = AvTable(table).a_v_at(0.8, 0.05, 0.05, 1e4)
    # two cases that agree: their own error, which is not taken to average out
    assert found.simulation == pytest.approx(RATIO_ERROR, rel=1e-6)
    for limit, reach in ((found.low, found.theory_below), (found.high, found.theory_above)):
        # 90 % of a normal error, and extremes as they are
        want = np.sqrt(reach**2 + (1.6449 * RATIO_ERROR) ** 2)
        assert abs(np.log(limit / found.value)) == pytest.approx(want, rel=1e-4)
    assert table.quadrature_error < 1e-5


def test_cases_that_differ_make_the_error_larger():
    agree = tabulate_a_v.simulated([comparison(1.1), comparison(1.1)])
    differ = tabulate_a_v.simulated([comparison(0.9), comparison(1.3)])
    scatter = np.log(1.3 / 0.9) / np.sqrt(2) * np.sqrt(1 + 1 / 2)  # of a further case and the mean
    np.testing.assert_allclose(agree.simulation_error, RATIO_ERROR, rtol=1e-6)
    # their own errors are part of the scatter seen
    np.testing.assert_allclose(differ.simulation_error, scatter, rtol=1e-3)


def test_trend_with_magnification_is_no_scatter():
    # 3 % less per doubling, as simulation has it
    zetas = np.array([16, 16, 32, 64, 128, 256])
    cases = [comparison(0.94 * 0.97 ** np.log2(z / 256), zeta=int(z)) for z in zetas]
    found = tabulate_a_v.simulated(cases)
    np.testing.assert_allclose(found.simulation_ratio, 0.94, rtol=1e-6)
    np.testing.assert_allclose(found.simulation_trend, np.log(0.97), rtol=1e-6)
    np.testing.assert_allclose(found.simulation_error, RATIO_ERROR, rtol=1e-6)
    assert (found.smallest_magnification, found.largest_magnification) == (16, 256)


@pytest.mark.slow
def test_trend_holds_between_simulated_magnifications_and_widens_the_error_beyond(table):
    cases = [comparison(1.0, zeta=16), comparison(0.9, zeta=256)]
    simulation = tabulate_a_v.simulated(cases)
    known = AvTable(table.drop_vars(simulation.variables).merge(simulation))
    plain = AvTable(table)
    zeta = np.array([1e2, 256.0, 1e3, 1e4, np.inf])
    ratio = known.a_v_at(0.8, 0.05, 0.1, zeta).value / plain.a_v_at(0.8, 0.05, 0.1, zeta).value
    trend = np.log(0.9) / 4
    want = 0.9 * np.exp([trend * np.log2(100 / 256), 0, 0, 0, 0])
    np.testing.assert_allclose(ratio * RATIO, want, rtol=1e-4)
    errors = known.a_v_at(0.8, 0.05, 0.1, zeta).simulation
    assert errors[1] == pytest.approx(errors[0])
    # beyond: as if the trend went on, over half as many doublings as were simulated at most
    more = np.sqrt(errors**2 - errors[1] ** 2)[2:]
    np.testing.assert_allclose(
        more, np.abs(trend) * np.array([np.log2(1e3 / 256), 2, 2]), rtol=1e-4
    )


def test_loads_of_too_small_windows_are_left_out():
    small = comparison(3.0)
    small["window_holds"] = "pressure", [0, 1]
    found = tabulate_a_v.simulated([comparison(1.1), small])
    np.testing.assert_allclose(found.simulation_ratio.isel(simulated_pressure=0), 1.1, rtol=1e-6)
    assert np.all(found.simulation_ratio.isel(simulated_pressure=1) > 1.5)


@pytest.mark.slow
@pytest.mark.parametrize("magnification", [1e3, np.inf])
def test_error_grows_with_every_decade_below_the_simulated_ranges(table, magnification):
    drift = 0.09
    known = AvTable(table.assign(extrapolation_error=drift))
    found = known.a_v_at(0.8, 0.05, 10.0 ** np.array([-1, -2, -3, -4, -8]), magnification)
    assert found.edge[-1] == np.isfinite(magnification)  # a constant a_V is extrapolated as well
    more = np.sqrt(found.simulation**2 - found.simulation[0] ** 2)
    np.testing.assert_allclose(more, drift * np.sqrt([0, 0, 1, 2, 6]), rtol=1e-4, atol=1e-9)


def test_no_load_at_all_is_an_error():
    small = comparison(1.1)
    small["window_holds"] = "pressure", [0, 0]
    with pytest.raises(ValueError, match="no load of any case"):
        tabulate_a_v.simulated([small, small])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("argument", "value"),
    [("hurst", 0.5), ("pressure", 0.9), ("range_over_h_rms", 1e-9), ("magnification", 10.0)],
)
def test_outside_the_table_is_an_error_that_names_it(table, argument, value):
    asked = {"hurst": 0.8, "pressure": 0.05, "range_over_h_rms": 0.05, "magnification": 1e3}
    name = "range" if argument == "range_over_h_rms" else argument
    with pytest.raises(ValueError, match=rf"{name} must lie between .* got {value:g}"):
        AvTable(table).a_v_at(**asked | {argument: value})


def test_edge_range_of_power_laws():
    ranges = np.geomspace(1e-6, 1, 25)
    ratio = (ranges / 1e-3) ** -0.5  # of the variants: PARTED at 1e-3/PARTED^2
    assert edge_range(ranges, ratio, np.ones(25)) == pytest.approx(1e-3 / PARTED**2, rel=1e-9)
    assert edge_range(ranges, np.ones(25), np.ones(25)) == ranges[0]
