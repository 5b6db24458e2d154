"""Settings for full adhesion from laws whose answers are known, and how such laws are measured."""

import itertools
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
import yaml

from adhesion import solve_adhesive
from common import ensemble_means
from stickiness import adhesive, repulsive, spectrum, surface
from stickiness.accuracy import adhesion, plan
from stickiness.accuracy.choice import COARSE_SEEDS, PIXELS, SEEDS, TOLERANCES, UnreachableError
from stickiness.accuracy.error_models import (
    ErrorModel,
    Settings,
    Surface,
    read_models,
    single_error,
)
from stickiness.accuracy.prediction import Problem
from tradeoff.adhesion_rows import scattered, threshold, varied

ROOT = Path(__file__).parents[3]
TABLE = ROOT / "config/accuracy.csv"
SMOOTH, LOADS = Surface(hurst=0.8, magnification=32.0), [0.02, 0.2]


def made_up():
    """Error 1/pixels^2 of the grid, scatter 0.3; controls leave a third."""
    laws = {}
    for column in adhesion.COLUMNS:
        laws |= {
            ("discretisation", column): ErrorModel(0.0, pixels=-2.0),
            ("solver", column): ErrorModel(0.0, tolerance=1.0),
            ("scatter", column): ErrorModel(math.log(0.3)),
            ("fine_share", column): ErrorModel(math.log(0.3)),
            ("coarse_share", column): ErrorModel(math.log(0.5)),
        }
    laws["adhesive_cost", ""] = ErrorModel(0.0, pixels=2.0)
    laws["coarse_cost", ""] = ErrorModel(math.log(4.0))
    return laws


def problem(models=None):
    return Problem(models or made_up(), SMOOTH, LOADS, adhesion.COLUMNS)


def test_constants_are_those_of_the_stages():
    assert adhesion.TOLERANCE == solve_adhesive.TOLERANCE
    assert adhesion.FEWEST == ensemble_means.FEWEST


def test_few_seeds_have_no_control():
    def found(seeds, coarse):
        settings = Settings(16, 1e-8, seeds, coarse)
        return adhesion.predicted_error(problem(), settings, 0.1, "threshold")

    assert found(4, 64) == pytest.approx(found(4, 0))
    assert found(8, 64) < 0.6 * found(8, 0)


def test_pull_off_is_of_one_surface():
    settings = Settings(4, 1e-3, 2, 0)
    found = adhesion.predicted_error(problem(), settings, 0.1, "pull_off")
    assert found == pytest.approx(1 / 16)


@pytest.mark.slow
@pytest.mark.parametrize("asked", [0.3, 0.12, 0.06])
def test_chosen_is_the_cheapest_of_all(asked):
    wanted = problem()
    chosen = adhesion.cheapest(wanted, asked)
    assert adhesion.worst_error(wanted, chosen)[0] <= asked
    every = itertools.product(PIXELS, TOLERANCES[:1], SEEDS, COARSE_SEEDS)
    costs = [
        adhesion.predicted_cost(wanted, settings)
        for settings in itertools.starmap(Settings, every)
        if adhesion.worst_error(wanted, settings)[0] <= asked
    ]
    assert adhesion.predicted_cost(wanted, chosen) == pytest.approx(min(costs))


def test_out_of_reach_names_the_quantity():
    laws = made_up()
    laws["discretisation", "threshold"] = ErrorModel(0.0)
    with pytest.raises(UnreachableError, match="for threshold at pressure"):
        adhesion.cheapest(problem(laws), 0.1)


# --- how the laws are measured ----------------------------------------------------------------


def test_threshold_between_adhesion_lengths():
    """A pressure that falls by 0.1 for every factor e vanishes at e^2 times the first length."""
    reach = np.array([1.0, 0.1, 0.1, 0.1, 0.1])
    lengths = 0.01 * np.exp([9.0, 1.0, 0.0, 3.0, 4.0])
    external = xr.DataArray(
        0.2 - 0.1 * np.log(lengths / 0.01),
        dims="point",
        coords={
            "range_over_h_rms": ("point", reach),
            "adhesion_length_over_range": ("point", lengths),
        },
    )
    assert float(threshold(external)) == pytest.approx(0.01 * math.exp(2))
    closed = external.where(lengths < 0.01 * math.exp(3.5))  # windows that close, beyond
    assert float(threshold(closed)) == pytest.approx(0.01 * math.exp(2))
    assert np.isnan(float(threshold(external + 1)))


def test_every_knob_has_its_reference():
    names = "knob", "pixels", "tolerance", "balance"
    rows = [
        *(("pixels", pixels, 1e-5, 0.01) for pixels in (4, 8, 16)),
        *(("tolerance", 8, tolerance, 0.01) for tolerance in (1e-3, 1e-7)),
        *(("balance", pixels, 1e-5, 0.1) for pixels in (4, 8)),
    ]
    measured = xr.Dataset(
        {name: ("setting", [row[k] for row in rows]) for k, name in enumerate(names)}
    )
    assert sorted(varied(measured)) == [
        ("balance", "0.1 on 4", 5, 0),
        ("balance", "0.1 on 8", 6, 1),
        ("pixels", "4", 0, 2),
        ("pixels", "8", 1, 2),
        ("tolerance", "0.001", 3, 4),
        ("tolerance", "1e-05", 1, 4),
    ]


def test_what_a_control_leaves():
    rng = np.random.default_rng(3)
    twin, noise = rng.standard_normal((2, 4000))
    full = 10 + 4 * twin + 3 * noise
    scatter, share = scattered(xr.DataArray(full, dims="seed"), xr.DataArray(twin, dims="seed"))
    assert float(scatter) == pytest.approx(0.5, rel=0.05)
    assert float(share) == pytest.approx(0.6, rel=0.05)


# --- the table that is used -------------------------------------------------------------------


def test_presets_reach_their_error_with_full_adhesion():
    config = yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))
    trade = yaml.safe_load((ROOT / "config/campaigns/tradeoff.yaml").read_text(encoding="utf-8"))
    laws, asked = read_models(TABLE), trade["presets"]
    wanted, surface_asked = asked["adhesive"], config["model_surfaces"][asked["surface"]]
    columns = list(itertools.chain(*(adhesion.QUANTITIES[q] for q in wanted["quantities"])))
    given = Problem(laws, Surface.of(surface_asked), asked["pressures"], columns)
    for name, error in wanted["accuracy"].items():
        settings = plan.preset(config["fidelities"][name])
        assert adhesion.worst_error(given, settings)[0] <= error, name
        few = replace(settings, seeds=2, coarse_seeds=0)
        assert adhesion.worst_error(given, few)[0] > error, name


@pytest.mark.slow
def test_grid_errors_of_fresh_surfaces_are_within_their_law():
    """Mean change of 1/kappa_ad from 4 to 16 points, of surfaces that no law was fitted to."""
    laws, rough = read_models(TABLE), Surface(hurst=0.7, magnification=16.0)
    band, load, reach = spectrum.SelfAffine(hurst=0.7, q0=1.0, q1=16.0, h_rms=1.0), 0.065, 0.1
    law = adhesive.Exponential(adhesion_length=1.0 * reach, range=reach)  # l_a = 0.1 range

    def attraction(heights):
        alone = repulsive.solve(heights, 2 * np.pi, load)
        state = adhesive.solve(
            heights, 2 * np.pi, law, mean_gap=alone.mean_gap, start=alone, tol=1e-7
        )
        fall = state.mean_pressure / state.repulsive_area_fraction * alone.area_fraction / load
        return (1 - fall) / 2

    fine = [surface.synthesise(band, 256, 2 * np.pi, seed=seed) for seed in range(7001, 7009)]
    exact = np.array([attraction(heights) for heights in fine])
    coarse = np.array([attraction(heights[::4, ::4]) for heights in fine])
    change = (coarse - exact) / exact.mean()
    known = single_error(laws, "discretisation", "inverse_kappa_ad_0.1", rough, load, pixels=4.0)
    noise = change.std(ddof=1) / math.sqrt(len(fine))
    assert abs(change.mean()) <= known + noise, (change.mean(), known, noise)
    assert known < 0.15
