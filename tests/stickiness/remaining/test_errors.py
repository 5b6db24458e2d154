"""Errors of predictions are rows of the table of limits, times the units they were divided by."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from helpers.campaigns import CAMPAIGNS, read

from limits import comparisons
from stickiness.remaining import Roughness, errors
from stickiness.remaining.calibration import find_spread

CONFIG = Path(__file__).parents[3] / "config"
LAWS = [law for law in vars(errors).values() if isinstance(law, errors.ErrorLaw)]
HALF_SPACE = Roughness(h_rms=1.0, q0=1.0, elastic_energy=0.6)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: f"{law.kind} {law.quantity}")
def test_every_law_is_a_row_of_the_table(law):
    assert law.spread == find_spread(law.kind, law.quantity)
    assert law.source.removesuffix(".csv") in CAMPAIGNS


@pytest.mark.parametrize(("waves", "part"), [(1, 1.0), (2, 0.5), (4, 0.25), (9, 0.25)])
def test_theory_errs_by_a_share_that_falls_with_the_waves_up_to_four(waves, part):
    size = find_spread("spectrum", "share").high
    assert errors.SHARE.half_width(0.99, waves) == pytest.approx(0.99 * size * part)
    # It fades where next to nothing remains.
    assert errors.SHARE.half_width(0.01, waves) == pytest.approx(size * part / 2)
    assert errors.SHARE.half_width(0.0, waves) == 0


def test_limits_of_a_share_are_those_of_the_theory_and_of_the_first_touch():
    rough = replace(HALF_SPACE, waves=2.0, q1=16.0)
    value, low, high = rough.limit_share(0.5, 0.01)
    # The range is so short that the first touch does not matter.
    error = errors.SHARE.half_width(value, 2.0)
    assert (value - low, high - value) == pytest.approx((error, error), rel=1e-3)
    # Where attraction reaches across the roughness, the highest summits decide on hard solids.
    hard = [rough.limit_share(1e-4, range_) for range_ in (0.5, 1.0)]
    assert [high / value for value, _, high in hard] == sorted(
        (high / value for value, _, high in hard), reverse=True
    )
    assert hard[0].high > 2 * hard[0].value


@pytest.mark.parametrize(
    ("solid", "columns", "part"),
    [
        ("half-space", {"relative_compliance": 0.2}, 0.0),
        ("layer", {"relative_compliance": 0.4}, 0.0),
        ("thin", {"solid": "layer", "flow": 0.25}, 0.25),
        ("film", {"rigid_base_energy": 1.2}, np.log(2)),
        ("film", {"rigid_base_energy": 0.6}, 0.0),
        ("skin", {"relative_compliance": 1.4}, 1.0),
    ],
)
def test_errors_of_the_work_come_from_flow_films_that_bend_and_skins(solid, columns, part):
    rough = replace(HALF_SPACE, **{"solid": solid} | columns)
    expected = part * find_spread(solid, "ln_work").high if part else 0.0
    assert errors.find_work_error(rough, 0.0) == pytest.approx(expected)
    # A direction multiplies, beyond simulations and the shape add in quadrature.
    rough = replace(rough, anisotropy_error_factor=2.0, shape_error=0.3)
    expected = np.hypot(2 * np.hypot(expected, 0.4), 0.3)
    assert errors.find_work_error(rough, 0.4) == pytest.approx(expected)


def test_what_is_simulated_is_compared_in_the_units_of_the_library():
    solids = read("solids")
    bending = np.log(solids.rigid_base_energy / solids.full_contact_energy)
    units = {"thin": solids.flow, "film": bending, "skin": 1.0}
    compared = set()
    for comparison in comparisons.of_solids(solids):
        kind = comparison.law.kind
        expected = solids.assign(unit=units[kind]).unit[comparison.rows.index]
        np.testing.assert_allclose(comparison.unit, expected)
        compared.add(kind)
    assert compared == units.keys()
    assert bending[solids.kind != "film"].abs().max() < 1e-5


def test_a_map_tells_less_of_its_surface_where_its_quarters_differ_and_less_is_wanted():
    errors_of_maps = errors.PATCH.half_width(
        np.array([0.3, 0.6, 0.3, 0.3]),  # distance of the quarters
        np.array([100.0, 100.0, 4.0, 100.0]),  # independent heights
        np.array([0.1, 0.1, 0.1, 0.03]),  # share wanted
    )
    size = find_spread("patch", "ln_work").high
    of_first = size * np.hypot(0.3, 0.1) * 0.1**-0.35
    assert errors_of_maps[0] == pytest.approx(of_first)
    ratios = errors_of_maps / of_first
    expected = [1, np.hypot(0.6, 0.1) / np.hypot(0.3, 0.1), np.hypot(0.3, 0.5) / np.hypot(0.3, 0.1)]
    np.testing.assert_allclose(ratios, [*expected, (0.1 / 0.03) ** 0.35])


def test_an_absolute_error_of_a_share_is_needed_where_it_is_missed():
    share = np.array([0.5, 0.01, 1e-4])
    error = errors.find_states_error(share)
    assert np.all(error < share)
    needed = errors.find_needed_error(share, error)
    assert needed == pytest.approx(np.full(3, errors.STATES.spread.high))
    assert errors.find_needed_error(share, 2 * share).tolist() == [np.inf] * 3
    assert errors.find_needed_error(share, 0 * share).tolist() == [0.0] * 3
