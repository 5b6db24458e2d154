"""Where the DMT sum is taken: the table of its error, and the choice by it."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from helpers.entries import model_surface

from adhesion import solve_adhesive
from common.model_surfaces import cell_size, model_spectrum
from stickiness import surface
from stickiness.accuracy import model_choice

pytestmark = pytest.mark.processors

ROOT = Path(__file__).parents[3]
SURFACE = model_surface()
HEAD = ",".join(model_choice.COLUMNS)
ASKED = {
    "q0_h_rms": 0.1,
    "pressures": [0.01, 0.1],
    "range_over_h_rms": [0.1, 1.0],
    "adhesion_length_over_range": [1e-3, 1e-2],
    "law": "exponential",
    "model": "auto",
    "accuracy": 0.2,
}


def row(pressure, reach, strength, ratio, error, zeta=32, law="exponential"):
    return f"{law},0.8,{zeta},{pressure},{reach},{strength},{ratio},{error}"


@pytest.fixture
def table(tmp_path):
    """Good at the larger range, bad at the smaller one; the strongest corner is missing."""
    rows = [
        row(p, reach, strength, ratio, 0.01)
        for p in (0.01, 0.1)
        for reach, ratio in ((0.1, 2.0), (1.0, 1.1))
        for strength in (0.01, 0.1, 1.0)
        if not (strength == 1 and reach == 0.1)
    ]
    path = tmp_path / "table.csv"
    path.write_text("\n".join([HEAD, *rows]))
    return model_choice.read_table(path)


def error_at(table, zeta=32, pressure=0.1, reach=1.0, strength=0.1, law="exponential", hurst=0.8):
    return model_choice.relative_error(table, law, hurst, zeta, pressure, reach, strength)


def test_error_of_dmt_is_that_of_dmt_over_full(table):
    assert error_at(table) == pytest.approx(1 - np.exp(-np.log(1.1) - 0.01 / 1.1))


def test_between_its_points_the_table_is_linear_in_logarithms(table):
    # half way in ln(range): the geometric mean of 2 and 1.1, errors in the mean
    spread = (0.01 / 2 + 0.01 / 1.1) / 2
    expected = 1 - 1 / np.sqrt(2 * 1.1) * np.exp(-spread)
    assert error_at(table, reach=np.sqrt(0.1)) == pytest.approx(expected)
    assert error_at(table, pressure=0.05) == pytest.approx(error_at(table))


@pytest.mark.parametrize(
    "beyond",
    [
        {"zeta": 64},
        {"reach": 0.05},
        {"strength": 2.0},
        {"strength": 0.3, "reach": 0.5},  # next to the corner that was not measured
        {"law": "maugis"},
    ],
)
def test_nothing_is_said_outside_the_table(table, beyond):
    assert np.isnan(error_at(table, **beyond))


def test_dmt_is_taken_where_it_is_accurate_enough(table):
    choice = model_choice.choose(ASKED, SURFACE, table)
    assert choice.full[..., 0].all()  # range 0.1: a factor of 2
    assert not choice.full[..., 1].any()
    for other, full in (
        ({"accuracy": 0.05}, True),
        ({"model": "dmt"}, False),
        ({"model": "full"}, True),
    ):
        assert (model_choice.choose(ASKED | other, SURFACE, table).full == full).all()


@pytest.mark.parametrize(
    "other", [{"window": 4}, {"amplitudes": "fixed"}, {"magnification": 64}, {"anisotropy": 4}]
)
def test_other_surfaces_than_those_measured_are_solved_in_full(table, other):
    assert model_choice.choose(ASKED, SURFACE | other, table).full.all()


def test_dmt_needs_the_jtb_condition_whatever_the_table_says(tmp_path):
    path = tmp_path / "table.csv"
    path.write_text("\n".join([HEAD, row(0.1, 1, 10, 1.0, 0.01), row(0.1, 1, 30, 1.0, 0.01)]))
    asked = ASKED | {"pressures": [0.1], "range_over_h_rms": [1.0]}
    # h_rms/range > (4/75) (l_a/range)/(range q0) is a strength below 18.75
    asked["adhesion_length_over_range"] = [1.87, 1.88]
    choice = model_choice.choose(asked, SURFACE, model_choice.read_table(path))
    assert choice.jtb.ravel().tolist() == [True, False]
    assert choice.full.ravel().tolist() == [False, True]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("law,ratio\n", ["columns", "strength"]),
        (f"{HEAD}\n{row(0.1, 1, 0.1, 'x', 0.1)}\n", ["line 2", "'exponential,0.8"]),
        (f"{HEAD}\n{row(0.1, -1, 0.1, 1, 0.1)}\n", ["line 2", "positive"]),
        (f"{HEAD}\n{row(0.1, 1, 0.1, 1, 'nan')}\n", ["line 2", "positive"]),
        (f"{HEAD}\nexponential,0.8\n", ["line 2", "positive"]),
    ],
)
def test_a_bad_table_is_named(tmp_path, text, words):
    path = tmp_path / "table.csv"
    with pytest.raises(ValueError, match="no such file"):
        model_choice.read_table(path)
    path.write_text(text)
    with pytest.raises(ValueError, match="table.csv") as caught:
        model_choice.read_table(path)
    for word in words:
        assert word in str(caught.value)


@pytest.fixture(scope="module")
def committed():
    return model_choice.read_table(ROOT / "config/dmt_error.csv")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("pressure", "reach", "strength"), [(0.065, 1.0, 0.1), (0.065, 0.3, 0.3), (0.03, 2.0, 0.02)]
)
def test_a_fresh_measurement_agrees_with_the_committed_table(committed, pressure, reach, strength):
    """Other seeds on a coarser grid, at points of the table and between them."""
    asked = ASKED | {"pressures": [pressure], "range_over_h_rms": [reach]}
    asked["adhesion_length_over_range"] = [0.1 * strength]
    length, chosen = cell_size(SURFACE), np.ones((1, 1, 1), bool)
    ratios = []
    for seed in range(501, 507):
        heights = surface.synthesise(model_spectrum(SURFACE), 128, length, seed)
        (states,) = solve_adhesive.states([heights], length, asked, chosen, 1e-6)
        states = states.squeeze()
        held = states.external_pressure / states.repulsive_area
        full = (1 - held / (states.pressure / states.area_alone)) / 2
        ratios.append([float(full), float(states.attraction_dmt / states.pressure / 2)])
    full, dmt = np.transpose(ratios)
    best = full.mean() / dmt.mean()
    scatter = np.std(full - best * dmt, ddof=1) / np.sqrt(len(full)) / dmt.mean()
    lattice = committed["exponential", 0.8]
    ratio, error = interpolated(lattice, 32, pressure, reach, strength)
    # three standard errors; 4 points per wavelength add a few per cent
    assert abs(best - ratio) < 3 * np.hypot(scatter, error) + 0.02 * ratio


def interpolated(lattice, *point):
    """Ratio and error by xarray's interpolation, NaN beyond the table."""
    axes, ratio, error = lattice
    data = xr.Dataset(
        {"ratio": (model_choice.AXES, ratio), "error": (model_choice.AXES, error)},
        coords=dict(zip(model_choice.AXES, axes, strict=True)),
    )
    data = data.sel(magnification=np.log(point[0]), method="nearest")
    at = data.interp(dict(zip(model_choice.AXES[1:], np.log(point[1:]), strict=True)))
    value = float(np.exp(at.ratio))
    return value, value * float(at.error)
