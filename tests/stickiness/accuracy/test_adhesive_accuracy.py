"""Settings for full adhesion from error models whose answers are known."""

import itertools
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml

from adhesion import solve_adhesive
from common import ensemble_means
from stickiness import adhesive, repulsive, spectrum, surface
from stickiness.accuracy import plan
from stickiness.accuracy.error_models import (
    ErrorModel,
    Settings,
    Surface,
    read_models,
    single_error,
)
from stickiness.accuracy.prediction import Problem
from stickiness.accuracy.settings import (
    ADHESIVE_COLUMNS,
    ADHESIVE_QUANTITIES,
    ADHESIVE_TOLERANCE,
    COARSE_SEEDS,
    FEWEST,
    PIXELS,
    SEEDS,
    TOLERANCES,
    UnreachableError,
    adhesive_cost,
    adhesive_error,
    cheapest_adhesive,
    worst_adhesive_error,
)

ROOT = Path(__file__).parents[3]
TABLE = ROOT / "config/accuracy.csv"
SMOOTH, LOADS = Surface(hurst=0.8, magnification=32.0), [0.02, 0.2]


def made_up():
    """Error 1/pixels^2 of the grid, scatter 0.3; controls leave a third."""
    laws = {}
    for column in ADHESIVE_COLUMNS:
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
    return Problem(models or made_up(), SMOOTH, LOADS, ADHESIVE_COLUMNS)


def test_constants_are_those_of_the_stages():
    assert ADHESIVE_TOLERANCE == solve_adhesive.TOLERANCE
    assert FEWEST == ensemble_means.FEWEST


def test_few_seeds_have_no_control():
    def found(seeds, coarse):
        settings = Settings(16, 1e-8, seeds, coarse)
        return adhesive_error(problem(), settings, 0.1, "threshold")

    assert found(4, 64) == pytest.approx(found(4, 0))
    assert found(8, 64) < 0.6 * found(8, 0)


def test_pull_off_is_of_one_surface():
    settings = Settings(4, 1e-3, 2, 0)
    found = adhesive_error(problem(), settings, 0.1, "pull_off")
    assert found == pytest.approx(1 / 16)


@pytest.mark.slow
@pytest.mark.parametrize("asked", [0.3, 0.12, 0.06])
def test_chosen_is_the_cheapest_of_all(asked):
    wanted = problem()
    chosen = cheapest_adhesive(wanted, asked)
    assert worst_adhesive_error(wanted, chosen)[0] <= asked
    every = itertools.product(PIXELS, TOLERANCES[:1], SEEDS, COARSE_SEEDS)
    costs = [
        adhesive_cost(wanted, settings)
        for settings in itertools.starmap(Settings, every)
        if worst_adhesive_error(wanted, settings)[0] <= asked
    ]
    assert adhesive_cost(wanted, chosen) == pytest.approx(min(costs))


def test_out_of_reach_names_the_quantity():
    laws = made_up()
    laws["discretisation", "threshold"] = ErrorModel(0.0)
    with pytest.raises(UnreachableError, match="for threshold at pressure"):
        cheapest_adhesive(problem(laws), 0.1)


# --- the table that is used -------------------------------------------------------------------


def test_presets_reach_their_error_with_full_adhesion():
    config = yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))
    trade = yaml.safe_load((ROOT / "config/campaigns/tradeoff.yaml").read_text(encoding="utf-8"))
    laws, asked = read_models(TABLE), trade["presets"]
    wanted, surface_asked = asked["adhesive"], config["model_surfaces"][asked["surface"]]
    columns = list(itertools.chain(*(ADHESIVE_QUANTITIES[q] for q in wanted["quantities"])))
    given = Problem(laws, Surface.of(surface_asked), asked["pressures"], columns)
    for name, error in wanted["accuracy"].items():
        settings = plan.preset(config["fidelities"][name])
        assert worst_adhesive_error(given, settings)[0] <= error, name
        few = replace(settings, seeds=2, coarse_seeds=0)
        assert worst_adhesive_error(given, few)[0] > error, name


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
