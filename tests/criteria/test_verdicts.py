"""The a_V of a pair and the verdict that follows."""

from contextlib import nullcontext
from types import SimpleNamespace
from unittest import mock

import numpy as np
import pytest
import xarray as xr
from scipy.stats import binomtest, norm

from common.materials import read_material
from criteria import verdicts
from criteria.budgets import add_budget_of_probability
from criteria.simulated_a_v import measure_a_v
from criteria.verdicts import decide_pairs
from stickiness import criteria, datasets
from stickiness import error_budget as budget
from stickiness.criteria import equivalent_sphere
from stickiness.criteria.a_v_table import VARIANTS, SurfaceAv, edge_range, local_a_v
from stickiness.criteria.pair import REGIMES, WORDS
from stickiness.criteria.registry import EDGES, REMAINING
from stickiness.criteria.verdict import verdict
from stickiness.persson import Persson
from stickiness.plausibility import PlausibilityWarning
from stickiness.remaining import predict
from stickiness.spectrum import SelfAffine
from stickiness.statistics import COVERS

LOAD = 0.065


def edge_ratio(hurst, magnification):
    """Theory's a_V of the edges over the one equivalent to Pastewka and Robbins'."""
    spectrum = SelfAffine(hurst=hurst, q0=1.0, q1=magnification, h_rms=1.0)
    ranges = np.geomspace(1e-12, 10, 105)
    a_v = [
        local_a_v(Persson(spectrum, variant=variant).gap_cumulative(ranges, LOAD), LOAD, ranges)
        for variant in VARIANTS
    ]
    edge = edge_range(ranges, *a_v)
    at_edge = np.exp(np.interp(np.log(edge), np.log(ranges), np.log(a_v[0])))
    theirs = criteria.pastewka_robbins_a_v(1.0, 1.0, spectrum.rms_slope, spectrum.rms_curvature)
    return float(at_edge) / theirs


@pytest.mark.parametrize("hurst", [0.6, 0.7, 0.8, 0.9])
def test_edges_agree_with_pastewka_and_robbins(hurst):
    """Theirs rests on rms slope and curvature alone and knows nothing of Persson's theory."""
    ratios = [edge_ratio(hurst, zeta) for zeta in (1e3, 1e4, 1e5, 1e6)]
    # Estimates of the contact area alone differ by kappa = 2 against 2.36; both enter the limits
    # of a pair's a_V.
    assert ratios == pytest.approx([1.1] * 4, rel=0.35)
    # 0.03 is small against the exponents (5H - 3)/3 of 0 to 0.5, and what two decades leave of
    # transients.
    assert abs(np.log(ratios[3] / ratios[1]) / np.log(100)) < 0.03


def test_pair_takes_its_own_range():
    ranges = np.array([1e-4, 1e-2, 1.0])
    theory = np.array([[4.0, 2.0, 1.0], [2.0, 2.0, 3.0]])
    pair = SurfaceAv(ranges, 1.5 * theory, relative_error=0.1)
    value, low, high = pair.at(1e-4)
    assert (value, low, high) == pytest.approx((6.0, 3.0 * 0.9, 6.0 * 1.1))
    assert pair.at(1e-3)[0] == pytest.approx(1.5 * np.sqrt(4.0 * 2.0))  # halfway in logarithms
    assert pair.at(1e-9) == pytest.approx(pair.at(1e-4))
    for found, *expected in zip(
        pair.at(np.array([1e-4, 1.0])), pair.at(1e-4), (1.5, 1.35, 4.95), strict=True
    ):
        assert found == pytest.approx(expected)


UNMEASURED = (np.nan,) * 3


@pytest.mark.parametrize(
    ("low", "high", "grows", "quantiles", "expected"),
    [
        ((0.9, 0.8), (1.0, 0.9), 1.1, UNMEASURED, "sticks fully"),
        ((0.9, 0.79), (1.0, 0.9), 0.1, UNMEASURED, "sticks"),  # the onset does not matter here
        ((0.1, 0.1), (0.2, 0.1), 0.1, UNMEASURED, "sticks"),
        ((0.5, 0.09), (1.0, 0.1), 1.1, UNMEASURED, "depends"),
        ((0.0, 0.0), (0.1, 0.0), 0.1, UNMEASURED, "depends"),
        ((0.0, 0.0), (0.09, 0.0), 1.1, UNMEASURED, "adheres locally, does not hold"),
        ((0.0, 0.0), (0.09, 0.0), 0.9, UNMEASURED, "does not stick"),
        # On a measured surface the draws decide.
        ((0.0, 0.0), (1.0, 1.0), 2.0, (0.85, 0.9, 1.0), "sticks fully"),
        ((0.0, 0.0), (1.0, 1.0), 2.0, (0.15, 0.3, 0.5), "sticks"),
        ((0.0, 0.0), (1.0, 1.0), 2.0, (0.05, 0.3, 0.5), "depends"),
        ((0.0, 0.0), (1.0, 1.0), 0.5, (0.0, 0.0, 0.08), "does not stick"),
    ],
)
def test_word_follows_from_shares_at_both_ends_or_of_draws(low, high, grows, quantiles, expected):
    data = {
        "remaining_low": ("end", list(low)),
        "remaining_high": ("end", list(high)),
        "margin": (("end", "criterion"), [[grows], [0.1]]),
        "remaining_quantile": ("quantile", list(quantiles)),
    }
    assert WORDS[int(decide_pairs(xr.Dataset(data, coords={"criterion": [EDGES]})))] == expected


def judge(modulus, reach, h_rms=1e-6, a_v=(4.0, 4.0, 4.0)):
    """Verdict on a material of a modulus and a range on one surface."""
    entry = {"plane_strain_modulus": f"{modulus} Pa", "work_of_adhesion": "0.05 J/m^2"}
    solid = read_material(entry | {"range": f"{reach} m"})
    s = SelfAffine(hurst=0.8, q0=1e5, q1=1e8, h_rms=h_rms)
    known = {name: getattr(s, name) for name in ("h_rms", "rms_slope", "rms_curvature")}
    known["elastic_energy"] = s.elastic_energy()
    surface = xr.Dataset(
        {name: ("end", [value, value]) for name, value in known.items()} | {"q0": s.q0},
        coords={"end": ["smooth", "rough"]},
    )
    a_v = SurfaceAv(np.array([1e-9, 1.0]), np.transpose([a_v, a_v]), 0.0)
    with mock.patch.object(verdicts, "find_a_v", return_value=(a_v, a_v)):
        found = verdicts.find_verdicts({"one": solid}, {"one": surface}, {}, np.array([1.0, 1e3]))
    return found.isel(end=0, surface=0, material=0)


@pytest.mark.parametrize(
    ("modulus", "reach", "regime"),
    [(1e11, 1e-9, 0), (1e5, 1e-10, 2), (1e5, 1e-9, 2), (1e3, 1e-6, 3)],
)
def test_edges_are_classified_by_strength_and_zone(modulus, reach, regime):
    found = judge(modulus, reach)
    assert int(found.regime) == regime
    t, tau = float(found.attractive_over_contact), float(found.edge_strength)
    dmt = float(found.margin.sel(criterion="violano")) ** (5 / 3)
    effect = float(found.margin.sel(criterion=EDGES)) / dmt
    assert effect == pytest.approx(float(found.over_dmt), rel=1e-9)
    limit, within = equivalent_sphere.tough_effect(t, tau), 0.1
    if REGIMES[regime] == "DMT-like":
        limit, within = equivalent_sphere.weak_effect(t), 0.02
    assert (effect == pytest.approx(limit, rel=within)) == (REGIMES[regime] != REGIMES[-1])


@pytest.mark.slow
@pytest.mark.parametrize(("modulus", "reach"), [(5e3, 1e-9), (1e4, 3e-8), (1e5, 1e-6)])
def test_library_rule_and_prediction_give_the_same_numbers(modulus, reach):
    a_v = (4.0, 3.0, 5.0)
    by_rule = judge(modulus, reach, a_v=a_v)
    s = SelfAffine(hurst=0.8, q0=1e5, q1=1e8, h_rms=1e-6)
    doubts = pytest.warns(PlausibilityWarning) if reach > 1e-7 else nullcontext()
    with doubts:
        found = verdict(s, modulus=modulus, work_of_adhesion=0.05, range=reach, a_v=a_v)
    for name, margin in found.margins.items():
        assert float(by_rule.margin.sel(criterion=name)) == pytest.approx(margin, rel=1e-12)
    for name in ("remaining", "pull_off", "modulus_threshold"):
        by = [float(by_rule[f"{name}{end}"]) for end in ("", "_low", "_high")]
        ours = [getattr(found, name), *getattr(found, f"{name}_limits")]
        assert ours == pytest.approx(by, rel=1e-9), name
    assert found.word == WORDS[int(by_rule.verdict)]
    assert found.regime == REGIMES[int(by_rule.regime)]
    expected = predict(s, 0.05 / modulus, reach)
    assert found.remaining == pytest.approx(expected.separation, rel=1e-9)
    assert found.remaining_limits[0] == pytest.approx(expected.separation_limits[0], rel=1e-9)
    pulled = expected.pull_off, *expected.pull_off_limits
    ours = found.pull_off, *found.pull_off_limits
    assert np.divide(ours, modulus) == pytest.approx(pulled, rel=1e-9)
    assert float(by_rule.energy_ratio) == pytest.approx(expected.energy_ratio, rel=1e-9)


@pytest.mark.slow
def test_errors_of_the_spectrum_are_counted_once():
    """Limits are of the model alone; the spectrum adds a part, which is 0 for one spectrum."""
    found = judge(1e4, 1e-9)
    for name in ("remaining", "pull_off", "margin", "modulus_threshold"):
        assert np.all(found[f"{name}_error"].sel(source="sampling") == 0), name
    error = found.remaining_error.sel(source="model")
    expected = np.maximum(
        found.remaining_high - found.remaining, found.remaining - found.remaining_low
    )
    np.testing.assert_allclose(error, expected)
    others = found.margin_error.sel(source="model").where(found.criterion != REMAINING, drop=True)
    assert np.isnan(others).all()  # other criteria state no error


@pytest.mark.slow
@pytest.mark.parametrize("h_rms", [0.1e-6, 1e-5])
def test_steel_does_not_stick(h_rms):
    """Nor does its contact grow by itself, from polished to coarse."""
    found = judge(230e9, 3e-10, h_rms)
    assert WORDS[int(found.verdict)] == "does not stick"


def fit_file(path, name, coords, **parameters):
    """Fits of a_V over three intervals, as `fit_a_v` writes them."""
    dims = ("window", *coords)
    shape = (3, *(len(values) for values in coords.values()))
    data = xr.Dataset({name: (dims, np.full(shape, 2.0))}, coords=coords)
    described = {key: ("1", key) for key in data.variables}
    none = budget.not_applicable("made up")
    data = budget.with_budget(
        datasets.annotate(data, **described),
        name,
        discretisation=budget.ErrorComponent(0.1, "made up"),
        sampling=budget.ErrorComponent(0.38, "made up"),
        **dict.fromkeys(("solver", "bandwidth", "model"), none),
    )
    datasets.write(data, path, title="t", parameters=parameters)
    return path


@pytest.fixture(scope="module")
def inputs(tmp_path_factory):
    """Simulation with a_V = 2, theory 2 on the same spectrum and on all others."""
    folder, loads = tmp_path_factory.mktemp("a_v"), {"pressure": [0.03, 0.065]}
    variant = {"variant": ["afferrante2018"]}
    sweep = variant | {"hurst": [0.8], "magnification": [1e2, 1e4, 1e6], "load": [0]}
    return SimpleNamespace(
        a_v=fit_file(folder / "case.nc", "a_v_mean", loads),
        lattice=fit_file(folder / "lattice.nc", "a_v", variant | loads, hurst=0.8),
        theory=fit_file(folder / "theory.nc", "a_v", sweep),
    )


@pytest.mark.slow
def test_a_v_is_that_of_the_simulation_in_the_file(inputs):
    a_v, parts = measure_a_v(inputs, 0.065)
    assert a_v == 2.0
    assert parts["sampling"].error == pytest.approx(0.38)  # as the file states it, covering 90 %
    assert parts["discretisation"].error == pytest.approx(0.1)
    assert (parts["model"].error, parts["bandwidth"].error) == (0, 0)


def test_a_v_at_another_load_is_refused(inputs):
    with pytest.raises(
        ValueError, match=r"case.nc: has no a_V at criteria.a_v.pressure = 0.1;.*0.03"
    ):
        measure_a_v(inputs, 0.1)


@pytest.mark.parametrize("count", [0, 3, 100, 200])
def test_error_of_a_probability_is_that_of_its_interval(count):
    covered = 2 * norm.cdf(COVERS) - 1
    interval = binomtest(count, 200).proportion_ci(covered, method="wilson")
    share = count / 200
    about = {"units": "1", "long_name": "share of the draws that stick"}
    pair = xr.Dataset({"probability": (("material", "surface"), [[share]], about)})
    found = add_budget_of_probability(pair, [200])
    farther = max(share - interval.low, interval.high - share)
    assert float(found.probability_total_error.squeeze()) == pytest.approx(farther, rel=1e-10)
