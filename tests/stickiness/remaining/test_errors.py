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
LAWS += [*errors.CELLS.values(), *errors.SOLIDS]
HALF_SPACE = Roughness(h_rms=1.0, q0=1.0, elastic_energy=0.6)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: f"{law.kind} {law.quantity}")
def test_every_law_is_a_row_of_the_table(law):
    assert law.spread == find_spread(law.kind, law.quantity)
    assert law.source.removesuffix(".csv") in CAMPAIGNS


@pytest.mark.parametrize(("waves", "kind"), [(1, "one wave"), (2, "two waves"), (4, "spectrum")])
def test_the_error_of_a_half_space_is_that_of_its_cell(waves, kind):
    expected = find_spread(kind, "ln_work").high
    found = errors.find_theory_error(replace(HALF_SPACE, waves=float(waves)), 0.0)
    assert found == pytest.approx(expected)
    many = errors.find_theory_error(HALF_SPACE, 0.0)
    assert many == pytest.approx(find_spread("spectrum", "ln_work").high)


def test_errors_of_a_cell_lie_between_those_of_the_next():
    one, between, two = (
        errors.find_theory_error(replace(HALF_SPACE, waves=waves), 0.0)
        for waves in (1.0, np.sqrt(2), 2.0)
    )
    assert between == pytest.approx((one + two) / 2)


@pytest.mark.parametrize(
    ("solid", "columns", "part"),
    [
        ("half-space", {"relative_compliance": 0.2}, 0.0),
        ("film", {"relative_compliance": 0.9}, 1.0),
        ("thin", {"solid": "layer", "relative_compliance": 0.4, "flow": 0.25}, 0.25),
        ("skin", {"relative_compliance": 0.4}, 0.6),
        ("skin", {"relative_compliance": 1.4}, 0.0),
    ],
)
def test_errors_of_a_solid_grow_by_how_far_it_is_from_a_half_space(solid, columns, part):
    rough = replace(HALF_SPACE, **{"solid": solid} | columns)
    of_many = find_spread("spectrum", "ln_work").high
    of_solid = part * find_spread(solid, "ln_work").high if part else 0.0
    of_layer = find_spread("layer", "ln_work").high * 0.6 * 0.75 * (solid == "thin")
    expected = np.hypot.reduce([of_many, of_solid, of_layer])
    assert errors.find_theory_error(rough, 0.0) == pytest.approx(expected)
    # A direction multiplies, beyond simulations and the shape add in quadrature.
    rough = replace(rough, anisotropy_error_factor=2.0, shape_error=0.3)
    expected = np.hypot(2 * np.hypot(expected, 0.4), 0.3)
    assert errors.find_theory_error(rough, 0.4) == pytest.approx(expected)


def test_what_is_simulated_is_compared_in_the_units_of_the_library():
    solids = read("solids")
    stiffer = np.maximum(1 - solids.relative_compliance, 0)
    units = {"layer": stiffer * (1 - solids.flow), "film": 1, "thin": solids.flow, "skin": stiffer}
    compared = set()
    for comparison in comparisons.of_solids(solids):
        kind = comparison.law.kind
        expected = solids.assign(unit=units[kind]).unit[comparison.rows.index]
        np.testing.assert_allclose(comparison.unit, expected)
        compared.add(kind)
    assert compared == units.keys()


def test_an_absolute_error_of_a_share_is_needed_where_it_is_missed():
    share = np.array([0.5, 0.01, 1e-4])
    error = errors.find_states_error(share)
    assert np.all(error < share)
    needed = errors.find_needed_error(share, error)
    assert needed == pytest.approx(np.full(3, errors.STATES.spread.high))
    assert errors.find_needed_error(share, 2 * share).tolist() == [np.inf] * 3
    assert errors.find_needed_error(share, 0 * share).tolist() == [0.0] * 3
