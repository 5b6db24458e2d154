"""Settings for an accuracy, from laws whose answers are known, and the table that is used."""

import itertools
import math
from pathlib import Path

import numpy as np
import pytest
import yaml
from helpers.entries import model_surface
from helpers.laws import SMOOTH, made_up, problem
from scipy import stats

from stickiness import dmt, repulsive, spectrum, surface
from stickiness.accuracy import settings as settings_module
from stickiness.accuracy.error_models import (
    OUTSIDE,
    ErrorModel,
    Settings,
    Surface,
    extrapolated,
    grid_error,
    read_models,
    single_error,
    write_models,
)
from stickiness.accuracy.settings import (
    COARSE_SEEDS,
    PIXELS,
    SAFETY,
    SEEDS,
    TOLERANCES,
    Problem,
    UnreachableError,
    cheapest,
    covering_factor,
    error_parts,
    joint_error,
    predicted_cost,
    seeds_enough,
    worst_error,
)
from stickiness.statistics import COVERS

ROOT = Path(__file__).parents[3]
TABLE = ROOT / "config/accuracy.csv"
LOADS = [0.02, 0.2]


def test_law_is_a_product_of_powers():
    law = ErrorModel(
        math.log(3), hurst=1.0, magnification=2.0, window=-1.0, pressure=0.5, pixels=-2.0
    )
    value = law(Surface(0.5, 10.0, 4.0), pressure=0.25, pixels=8.0)
    assert value == pytest.approx(3 * math.exp(0.5) * 10**2 / 4 * 0.25**0.5 / 8**2)


def test_error_parts_by_hand():
    parts = error_parts(problem(descriptor_seeds=2000), Settings(8, 1e-4, 4, 100), 0.1, "area")
    variance = 0.1**2 / 4 + 0.5**2 / 100 + (1 - 0.5**2) / 2000
    assert parts["discretisation"] == pytest.approx(2 / 64)
    assert parts["solver"] == pytest.approx(1e-4)
    assert parts["sampling"] == pytest.approx(1.645 * 0.2 * math.sqrt(variance))
    plain = error_parts(problem(), Settings(8, 1e-4, 4, 0), 0.1, "area")
    assert plain["sampling"] == pytest.approx(1.645 * 0.2 / 2)


def test_cost_by_hand():
    """Grids of 8, 4 and 2 points; a tolerance of 1e-6 in place of 1e-8 saves a factor 100^0.02."""
    cost = predicted_cost(problem(pressures=LOADS, descriptor_seeds=2000), Settings(8, 1e-6, 3, 50))
    saved = 100**-0.02
    assert cost == pytest.approx(2 * saved * (3 * (64 + 16 + 4) + 50 * 4) + 2000 * 0.001)


@pytest.mark.slow
def test_cheapest_is_that_of_all_settings():
    wanted, every = problem("area", "a_v", pressures=LOADS), []
    for one in itertools.product(PIXELS, TOLERANCES, SEEDS, COARSE_SEEDS):
        settings = Settings(*one)
        every.append((worst_error(wanted, settings)[0], predicted_cost(wanted, settings)))
    for asked in (0.3, 0.1, 0.05, 0.02):
        chosen = cheapest(wanted, asked)
        least = min(cost for error, cost in every if error <= asked)
        assert worst_error(wanted, chosen)[0] <= asked
        cost = predicted_cost(wanted, chosen)
        assert least <= cost * (1 + 1e-9) <= 1.05 * least * (1 + 1e-8)


def test_settings_that_cost_more_than_ones_found_are_not_evaluated(monkeypatch):
    evaluated = []
    monkeypatch.setattr(
        settings_module,
        "joint_error",
        lambda errors: evaluated.append(np.size(errors[0])) or joint_error(errors),
    )
    cheapest(problem("area", pressures=LOADS), 0.1)
    assert sum(evaluated) < 0.5 * len(PIXELS) * len(TOLERANCES) * len(SEEDS) * len(COARSE_SEEDS)


def test_least_settings_are_kept():
    least = Settings(16, 1e-6, 8, 64)
    chosen = cheapest(problem("area", pressures=LOADS), 0.3, least=least)
    assert (chosen.pixels_per_wavelength, chosen.tolerance, chosen.seeds) == (16, 1e-6, 8)
    assert chosen.coarse_seeds >= 64
    assert cheapest(problem("area", pressures=LOADS), 0.3) != least


@pytest.mark.parametrize("accuracy", [0.15, 0.1, 0.05])
def test_seeds_enough_by_hand(accuracy):
    """Seeds that scatter twice as much as predicted: 0.4, with Student's t of their number."""
    few = Settings(8, 1e-8, 4, 0)

    def error(n):
        return SAFETY * math.hypot(0.02, stats.t.ppf(0.95, n - 1) * 0.4 / math.sqrt(n))

    sampling = [[stats.t.ppf(0.95, 3) * 0.4 / 2]]
    found = seeds_enough(problem("area"), few, accuracy, [[0.02]], sampling)
    want = next((n for n in SEEDS if error(n) <= accuracy), None)
    assert found == want
    assert seeds_enough(problem("area"), few, accuracy, [[accuracy]], sampling) is None


def test_out_of_reach_says_what_can_be_reached():
    with pytest.raises(UnreachableError, match=r"reach is 0\.0\d+, for area at pressure"):
        cheapest(problem("area", pressures=LOADS), 1e-4)
    with pytest.raises(UnreachableError, match="take 4000 points a side, above 2048"):
        cheapest(problem("area", surface=Surface(0.8, 1000.0)), 0.1)


def test_table_survives_writing(tmp_path):
    write_models(tmp_path / "laws.csv", made_up(), "two lines\nof comment")
    read = read_models(tmp_path / "laws.csv")
    assert read.keys() == made_up().keys()
    for key, law in made_up().items():
        assert read[key].constant == pytest.approx(law.constant, rel=1e-4)


def test_bad_tables(tmp_path):
    with pytest.raises(ValueError, match="no such file"):
        read_models(tmp_path / "nowhere.csv")
    laws = made_up()
    del laws["scatter", "a_v"]
    write_models(tmp_path / "laws.csv", laws, "")
    with pytest.raises(ValueError, match="lacks scatter of a_v"):
        read_models(tmp_path / "laws.csv")
    (tmp_path / "laws.csv").write_text("part,quantity,constant\nscatter,area,x\n", encoding="utf-8")
    with pytest.raises(ValueError, match="not a table of error models"):
        read_models(tmp_path / "laws.csv")


@pytest.fixture(scope="module")
def coarse():
    """Area and mean gap of 64 surfaces that no law was fitted to."""
    return np.array([solved(4 * 24, seed) for seed in range(7001, 7065)])


@pytest.mark.slow
def test_grid_errors_of_coarse_pixels_are_within_their_law(coarse):
    """Mean change from 4 to 16 points, of the first 48."""
    laws = read_models(TABLE)
    fine = np.array([solved(16 * 24, seed) for seed in range(7001, 7049)])
    change = (coarse[:48] - fine) / fine.mean(0)
    found, noise = np.abs(change.mean(0)), change.std(0, ddof=1) / math.sqrt(48)
    known = [
        single_error(laws, "discretisation", column, ROUGH, LOAD, pixels=4.0)
        for column in ("area", "mean_gap")
    ]
    assert (noise < 0.25 * np.array(known)).all()
    assert (found <= known + noise).all(), (found, known)


@pytest.mark.slow
def test_scatter_is_that_of_fresh_surfaces(coarse):
    """Sixty-four surfaces know their scatter to 9 %; the law, a power of the load, is good to 18 %.

    The grid hardly matters to it.
    """
    laws = read_models(TABLE)
    scatter = coarse.std(0, ddof=1) / coarse.mean(0)
    known = [laws["scatter", column](ROUGH, LOAD) for column in ("area", "mean_gap")]
    np.testing.assert_allclose(scatter, known, rtol=0.3)


ROUGH, LOAD = Surface(hurst=0.7, magnification=24.0), 0.1
BAND = spectrum.SelfAffine(hurst=ROUGH.hurst, q0=1.0, q1=ROUGH.magnification, h_rms=1.0)


def solved(n, seed):
    heights = surface.synthesise(BAND, n, 2 * np.pi, seed)
    contact = repulsive.solve(heights, 2 * np.pi, LOAD, tol=1e-5)
    return contact.area_fraction - dmt.boundary_strip(contact.gap == 0), contact.mean_gap


@pytest.mark.parametrize("seeds", [2, 3, 4, 8])
def test_plain_errors_of_few_skewed_seeds_cover_nine_in_ten(seeds):
    """Log-normal samples of scatter 0.4; 1.645 standard errors would cover 63, 74, 78 and 84 %."""
    samples = np.random.default_rng(1).lognormal(sigma=0.4, size=(20000, seeds))
    error = samples.std(1, ddof=1) / math.sqrt(seeds)
    settings = Settings(8, 1e-8, seeds, 0)
    factor = covering_factor(problem(), settings, 0.1, "area")
    covered = np.mean(np.abs(samples.mean(1) - math.exp(0.08)) <= factor * error)
    assert 0.87 <= covered <= 0.93


@pytest.mark.parametrize(("seeds", "coarse"), [(2, 32), (4, 32), (8, 64)])
def test_multilevel_errors_cover_nine_in_ten(seeds, coarse):
    """Skewed levels whose scatter is that of the laws, which say 0.1 and 0.5 of a plain one."""
    rng, settings = np.random.default_rng(2), Settings(8, 1e-8, seeds, coarse)
    mean, variance = np.zeros(20000), np.zeros(20000)
    for scatter, number in ((0.1, seeds), (0.5, coarse)):
        samples = scatter * (rng.gamma(4.0, 0.5, size=(20000, number)) - 2.0)
        mean += samples.mean(1)
        variance += samples.var(1, ddof=1) / number
    factor = covering_factor(problem(), settings, 0.1, "area")
    assert 0.87 <= np.mean(np.abs(mean) <= factor * np.sqrt(variance)) <= 0.95


def test_single_seed_covers_nothing_known():
    assert math.isnan(covering_factor(problem(), Settings(8, 1e-8, 1, 0), 0.1, "area"))


def test_outside_the_measurement_laws_stop_and_widen():
    """P(u) on 4 points at magnification 128, H = 0.8, erred by 1.4 and 1.3 %; laws went below."""
    laws, beyond = read_models(TABLE), Surface(0.8, 128.0)
    for load, found in ((0.03, 0.014), (0.3, 0.013)):
        where = Problem(laws, beyond, [load], ["gap_distribution"])
        parts = error_parts(where, Settings(4, 1e-8, 128, 2048), load, "gap_distribution")
        assert parts["discretisation"] >= found
    far = single_error(laws, "theory", "area", Surface(0.8, 1e4), 0.03)
    edge = single_error(laws, "theory", "area", Surface(0.8, 64.0), 0.03)
    assert far == pytest.approx(OUTSIDE * edge)


@pytest.mark.parametrize(
    ("part", "knob", "error"),
    [
        ("discretisation", {"pixels": 2.0}, 2 * 2 / 2**2),
        ("discretisation", {"pixels": 8.0}, 2 / 8**2),
        ("discretisation", {"pixels": 64.0}, 2 / 16**2),
        ("solver", {"tolerance": 1e-2}, 2e-2),
        ("solver", {"tolerance": 1e-14}, 1e-8),
    ],
)
def test_settings_outside_the_measurement(part, knob, error):
    """Coarser ones widen the error; finer ones are not taken to be better than the finest."""
    assert single_error(made_up(), part, "area", SMOOTH, 0.1, **knob) == pytest.approx(error)


SAME = model_surface()
OTHERS = [
    {"rolloff": 3.0},
    {"amplitudes": "fixed"},
    {"anisotropy": 4.0},
    {"heights": {"skewness": 1.0}},
]


@pytest.mark.parametrize("other", OTHERS)
def test_kinds_of_surfaces_that_were_not_measured_have_wider_errors(other):
    asked, settings = Surface.of(SAME | other), Settings(8, 1e-4, 4, 0)
    usual = error_parts(problem(), settings, 0.1, "area")
    for part, error in error_parts(problem(surface=asked), settings, 0.1, "area").items():
        assert error == pytest.approx(OUTSIDE * usual[part]), part
    # What the grids of the case say stands alone, even if the error model promises less.
    assert grid_error(made_up(), "area", asked, 0.1, 8, 0.5) == 0.5


@pytest.mark.parametrize(
    ("where", "outside"),
    [
        ((SMOOTH, 0.1), False),
        ((Surface(0.8, 128.0), 0.1), True),
        ((SMOOTH, 0.1, 2, 1e-8), True),
        ((Surface.of(SAME | {"rolloff": None, "amplitudes": "gaussian"}), 0.1), False),
        ((Surface.of(SAME | {"rolloff": 3.0}), 0.1), True),
    ],
)
def test_what_is_extrapolated_is_flagged(where, outside):
    assert extrapolated(*where) is outside


def test_grid_error_is_the_smaller_of_law_and_case_within_the_measurement():
    where = "area", SMOOTH, 0.1, 8
    assert grid_error(made_up(), *where, 0.5) == pytest.approx(2 / 64)
    assert grid_error(made_up(), *where, 0.01) == 0.01
    assert grid_error(made_up(), "area", Surface(0.8, 128.0), 0.1, 8, 0.5) == 0.5


def test_joint_error_by_hand():
    """Tails of 0.0707 each add up to 0.1 with the power two."""
    margin = SAFETY
    assert joint_error([0.2]) == pytest.approx(0.2 * margin, rel=1e-4)
    assert joint_error([0.2, 1e-3, 0.0]) == pytest.approx(0.2 * margin, rel=1e-3)
    tail = 0.1 / math.sqrt(2)
    factor = stats.norm.isf(tail / 2) / stats.norm.isf(0.05)
    assert joint_error([0.2, 0.2]) == pytest.approx(0.2 * factor * margin, rel=1e-3)
    both = joint_error([[0.2, 0.3], [0.2, 0.0]])
    assert both == pytest.approx([0.2 * factor * margin, 0.3 * margin], rel=1e-3)


def test_joint_error_covers_the_worst_of_errors_that_are_correlated_as_quantities_are():
    """Seven quantities at three loads; of single surfaces correlations are 0.8 in the median."""
    rng, shape = np.random.default_rng(3), (4000, 7, 3)
    errors = 0.8 * rng.normal(size=(4000, 1, 1)) + 0.4 * rng.normal(size=(4000, 7, 1))
    errors = errors + 0.4 * rng.normal(size=(4000, 1, 3)) + 0.2 * rng.normal(size=shape)
    size = np.linspace(0.3, 1.0, 21).reshape(7, 3)
    worst = np.abs(errors * size).max(axis=(1, 2))
    single = COVERS * size * errors.std(axis=(0, 1, 2))
    covered = np.mean(worst <= joint_error(single.ravel()) / SAFETY)
    assert 0.86 <= covered <= 0.95


def test_errors_are_widened_beyond_the_loads_of_the_campaign():
    campaign = yaml.safe_load((ROOT / "config/campaigns/tradeoff.yaml").read_text())
    laws = read_models(TABLE)

    def find_error(load):
        return single_error(laws, "theory", "area", Surface(0.8, 64.0), load)

    largest = max(campaign["pressures"])
    assert find_error(1.01 * largest) == pytest.approx(OUTSIDE * find_error(largest))
    smallest = min(campaign["presets"]["pressures"])
    assert find_error(0.99 * smallest) == pytest.approx(OUTSIDE * find_error(smallest))
    assert find_error(0.99 * largest) == pytest.approx(find_error(largest), rel=0.1)
