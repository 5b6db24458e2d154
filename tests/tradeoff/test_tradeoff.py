"""The trade-off from measurements whose errors are known: points, fits, tables and presets."""

import itertools
import math
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
import yaml

from common import tradeoff_table as summary
from common.config.models import ModelSurface
from stickiness import adhesive, repulsive, spectrum, surface
from stickiness.accuracy import plan
from stickiness.accuracy.error_models import (
    ErrorModel,
    Settings,
    Surface,
    read_models,
    single_error,
)
from stickiness.accuracy.settings import Problem, UnreachableError
from tradeoff import contact_table, fit_models
from tradeoff.adhesion_table import find_threshold, measure_scatter
from tradeoff.presets import (
    ADHESIVE_QUANTITIES,
    adhesive_error,
    cheapest_adhesive,
    preset_by_rule,
)

ROOT = Path(__file__).parents[2]
LAWS = ROOT / "config/accuracy.csv"
ADHESIVE_COLUMNS = list(itertools.chain(*ADHESIVE_QUANTITIES.values()))


def fit(part, *points):
    """Fit one model to (surface, value, noise, sizes)."""
    records = fit_models.Records()
    for rough, value, noise, sizes in points:
        records.start("contact", "some", rough)
        records.add_point(part, "area", value, noise, **sizes)
    return fit_models.fit_models(records.points)[part, "area"]


@pytest.mark.parametrize("noise", [1e-6, 3e-3])
def test_noise_is_not_taken_for_error(noise):
    """Errors 0.3/pixels^2; on 16 pixels a noise of 3e-3 is two and a half times the error."""
    rng, points = np.random.default_rng(1), []
    for k, pixels in itertools.product(range(24), (4.0, 8.0, 16.0)):
        value = rng.normal(scale=np.hypot(0.3 / pixels**2, noise))
        points.append((Surface(0.5 + k / 60, 16.0 + 2 * k), value, noise, {"pixels": pixels}))
    model = fit("discretisation", *points)
    assert model.pixels == pytest.approx(-2, abs=0.5)
    for pixels in (4.0, 8.0, 16.0):
        found = model(Surface(0.7, 32.0), pixels=pixels)
        assert found == pytest.approx(0.3 / pixels**2, rel=0.5), pixels
    assert model.spread == pytest.approx(1.645, rel=0.2)


def test_spread_is_that_of_surfaces_left_out():
    """Surfaces that differ by more than they share cannot be predicted: the spread must show it."""
    rng, points = np.random.default_rng(2), []
    for k in range(8):
        for value in np.exp(rng.normal(scale=1.0)) * rng.normal(size=6):
            points.append((Surface(0.5 + 0.05 * k, 32.0), value, 1e-3, {}))
    assert fit("theory", *points).spread > 1.8


def test_powers_are_found_from_exact_values():
    points = [
        (Surface(h, zeta), np.exp(0.5 * h) * zeta**-0.2 * load**0.1, 0.0, {"pressure": load})
        for h, zeta, load in itertools.product((0.5, 0.7, 0.9), (16.0, 64.0), (0.01, 0.3))
    ]
    model = fit("scatter", *points)
    assert (model.hurst, model.magnification, model.pressure) == pytest.approx((0.5, -0.2, 0.1))
    assert (model.window, model.pixels, model.tolerance) == (0, 0, 0)
    assert model.spread == pytest.approx(1)


def test_control_variates_of_a_pool_reduce_the_error():
    """Two quantities at two loads, linear in one long wave, with more scatter on the fine grid."""
    rng = np.random.default_rng(4)
    x, more, elsewhere = rng.normal(size=64), rng.normal(size=512), rng.normal(size=4096)
    mean = np.array([1.0, 2.0, 3.0, 4.0])

    def solved(wave):
        return mean * (1 + 0.1 * wave[:, None] + 0.05 * rng.normal(size=(len(wave), 4)))

    coarse, others = solved(x), solved(more)
    fine = {2: coarse, 4: 1.02 * coarse + mean * 0.01 * rng.normal(size=(64, 4))}
    controls, described = (
        np.stack([one] * 7, axis=1) * np.arange(1, 8) for one in (more, elsewhere)
    )
    pool = contact_table.SeedPool(
        *(fine, others, controls, described),
        entries=[(name, load) for name in ("area", "mean_gap") for load in (0.01, 0.1)],
        costs={},
    )
    plain, multilevel = (
        np.sqrt(np.mean(pool.draw(Settings(4, 1e-8, 4, n))["area", 0.01] ** 2)) for n in (0, 256)
    )
    assert plain == pytest.approx(math.hypot(0.1, 0.05) / 2, rel=0.3)
    assert multilevel < 0.3 * plain


def test_threshold_between_adhesion_lengths():
    """A pressure that falls by 0.1 for every factor e vanishes at e^2 times the first length."""
    lengths = 0.01 * np.exp([9.0, 1.0, 0.0, 3.0, 4.0])
    coords = {"range_over_h_rms": ("point", [1.0, 0.1, 0.1, 0.1, 0.1])}
    coords |= {"adhesion_length_over_range": ("point", lengths)}
    external = xr.DataArray(0.2 - 0.1 * np.log(lengths / 0.01), coords, "point")
    closed = external.where(lengths < 0.01 * math.exp(3.5))  # windows that close, beyond
    for one in (external, closed):
        assert float(find_threshold(one)) == pytest.approx(0.01 * math.exp(2))
    assert np.isnan(float(find_threshold(external + 1)))


def test_what_a_control_leaves():
    twin, noise = np.random.default_rng(3).standard_normal((2, 4000))
    full = xr.DataArray(10 + 4 * twin + 3 * noise, dims="seed")
    scatter, share = measure_scatter(full, xr.DataArray(twin, dims="seed"))
    assert float(scatter) == pytest.approx(0.5, rel=0.05)
    assert float(share) == pytest.approx(0.6, rel=0.05)


def test_committed_table_survives_writing(tmp_path):
    medians = summary.read(ROOT / "config/tradeoff.csv")
    summary.write(tmp_path / "again.csv", medians)
    assert summary.read(tmp_path / "again.csv").equals(medians)
    with pytest.raises(ValueError, match="no such file"):
        summary.read(tmp_path / "nowhere.csv")
    summary.write(tmp_path / "again.csv", medians.drop(columns="cost"))
    with pytest.raises(ValueError, match=r"again.csv: lacks the columns cost"):
        summary.read(tmp_path / "again.csv")


def made_up():
    """Error 1/pixels^2 of the grid, scatter 0.3; controls leave a third."""
    shares = {"scatter": 0.3, "fine_share": 0.3, "coarse_share": 0.5}
    laws = {
        (part, column): ErrorModel(math.log(share))
        for part, share in shares.items()
        for column in ADHESIVE_COLUMNS
    }
    for column in ADHESIVE_COLUMNS:
        laws["discretisation", column] = ErrorModel(0.0, pixels=-2.0)
        laws["solver", column] = ErrorModel(0.0, tolerance=1.0)
    laws["adhesive_cost", ""] = ErrorModel(0.0, pixels=2.0)
    return laws | {("coarse_cost", ""): ErrorModel(math.log(4.0))}


def problem(laws):
    return Problem(laws, Surface(hurst=0.8, magnification=32.0), [0.02, 0.2], ADHESIVE_COLUMNS)


def test_errors_of_full_adhesion_by_hand():
    """Few seeds have no control; a pull-off is of one surface, so that only its grid counts."""

    def found(column, *settings):
        return adhesive_error(problem(made_up()), Settings(*settings), 0.1, column)

    assert found("threshold", 16, 1e-8, 4, 64) == pytest.approx(found("threshold", 16, 1e-8, 4, 0))
    assert found("threshold", 16, 1e-8, 8, 64) < 0.6 * found("threshold", 16, 1e-8, 8, 0)
    assert found("pull_off", 4, 1e-3, 2, 0) == pytest.approx(1 / 16)


def test_out_of_reach_names_the_quantity():
    laws = made_up() | {("discretisation", "threshold"): ErrorModel(0.0)}
    with pytest.raises(UnreachableError, match="for threshold at pressure"):
        cheapest_adhesive(problem(laws), 0.1)


@pytest.mark.slow
def test_presets_are_what_the_rule_gives():
    config, trade = (
        yaml.safe_load((ROOT / "config" / name).read_text(encoding="utf-8"))
        for name in ("config.yaml", "campaigns/tradeoff.yaml")
    )
    asked, seeds = trade["presets"], config["sampling"]["descriptor_seeds"]
    case = config["cases"][config["roles"][asked["surface"]]]
    entry = config["model_surfaces"][case["surface"]]
    rough = Surface.of(ModelSurface(**entry).model_dump())
    ours = Problem(read_models(LAWS), rough, asked["pressures"], (), seeds)
    for name in asked["accuracy"]:
        chosen = preset_by_rule(ours, asked, name)
        assert plan.preset(config["fidelities"][name]) == chosen, name


@pytest.mark.slow
def test_grid_errors_of_fresh_surfaces_are_within_their_law():
    """Mean change of 1/kappa_ad from 4 to 16 points, of surfaces that no law was fitted to."""
    laws, rough = read_models(LAWS), Surface(hurst=0.7, magnification=16.0)
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
