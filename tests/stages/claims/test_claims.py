"""The ledger's claims on made-up files, for which the verdict and the number are known."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from claims import check_claims
from pipeline import conventions
from pipeline.claims import adhesion as adhesive_claims
from pipeline.claims import claim as _claim
from pipeline.claims import contact, criterion, ledger
from pipeline.claims.claim import NOT, OPEN, QUALIFIED, REPRODUCED, total_error
from pipeline.conventions import LOAD
from stickiness import criteria, surface
from stickiness.adhesion import equivalent_sphere
from stickiness.core import budget
from stickiness.spectrum import SelfAffine

RULES = Path(__file__).parents[3] / "rules" / "common.smk"
LOADS = np.array([0.001, 0.0065, 0.03, LOAD, 0.13, 0.52])
RANGES = np.geomspace(1e-4, 10, 81)
GAPS = np.sqrt(RANGES[1:] * RANGES[:-1])
WINDOWS = [[0.01, 0.1], [0.003, 0.03], [0.03, 0.3]]


def made_by(dataset, **parameters):
    return dataset.assign_attrs(parameters=json.dumps(parameters))


def case(zeta, **more):
    return {"case": f"made up {zeta}", "hurst": 0.8, "magnification": zeta, **more}


def with_errors(dataset, *names, model=0.0):
    """Sampling errors of 3 % and discretisation errors of 4 %: 5 % in all, but for the model's."""
    none = budget.absent("made up")
    for name in names:
        value = dataset[name] = dataset[name].assign_attrs(units="1", long_name="made up")
        parts = {"discretisation": 0.04, "sampling": 0.03, "model": model}
        parts = {source: budget.Part(part * value, "made up") for source, part in parts.items()}
        dataset = budget.with_budget(dataset, name, solver=none, bandwidth=none, **parts)
    return dataset


def kappa(zeta, fall=0.0, level=2.0, **more):
    """kappa that falls in proportion to ln p, `level` at the paper's load."""
    values = level * (1 - fall * np.log(LOADS / LOAD))
    data = xr.Dataset(
        {
            "area_fraction": ("pressure", LOADS * values / 2),
            "kappa": ("pressure", values),
            "kappa_fit": values[-1],
            "kappa_theory": (("variant", "pressure"), [0 * LOADS + 2.4]),
        },
        coords={"pressure": LOADS, "variant": [conventions.VARIANT]},
    )
    return made_by(with_errors(data, "kappa", "kappa_fit"), **case(zeta, **more))


def ensemble(zeta, separation=1.0, power=1.0, **more):
    """Simulation with p = exp(-2 separation u) and A_ad proportional to p^power."""
    area = 0.9 * LOADS[:, None] ** power * RANGES ** (2 / 3)
    data = xr.Dataset(
        {
            "mean_gap_mean": ("pressure", -np.log(LOADS) / (2 * separation)),
            "attractive_area_mean": (("pressure", "range"), area),
        },
        coords={"pressure": LOADS, "range": RANGES},
    )
    return made_by(data, **case(zeta, **more))


def lattice():
    data = ensemble(32)
    data = data.rename(mean_gap_mean="mean_gap", attractive_area_mean="attractive_area")
    return data.expand_dims(variant=[conventions.VARIANT])


def sweep(zetas=(1000.0,), hursts=(0.8,), loads=(LOAD,), exponent=-1 / 3, power=1.0):
    """Theory whose P(u) falls as a power law, as p^power, with p = exp(-2 u)."""
    dims = ("variant", "hurst", "magnification", "load")
    shape = (1, len(hursts), len(zetas), len(loads))
    pressure = np.broadcast_to(loads, shape)
    scale = 3.0 * pressure[..., None] ** power
    area = scale * RANGES ** (1 + exponent) / (1 + exponent)
    return xr.Dataset(
        {
            "pressure": (dims, pressure),
            "mean_gap": (dims, -np.log(pressure) / 2),
            "attractive_area": ((*dims, "range"), area),
            "gap_density": ((*dims, "gap"), scale * GAPS**exponent),
        },
        coords={
            "variant": [conventions.VARIANT],
            "hurst": list(hursts),
            "magnification": list(zetas),
            "range": RANGES,
            "gap": GAPS,
        },
    )


def fit(of, *slopes):
    """a_V of a sweep or ensemble, one value for each window."""
    area = of.attractive_area if "attractive_area" in of else of.attractive_area_mean
    one = xr.ones_like(area.isel(range=0, drop=True))
    a_v = xr.concat([one * slope for slope in slopes], "window")
    low, high = np.transpose(WINDOWS)
    data = xr.Dataset({"a_v": a_v, "window_low": ("window", low), "window_high": ("window", high)})
    data["a_v_mean"] = data.a_v
    return with_errors(data, "a_v", "a_v_mean").assign_attrs(of.attrs)


def adhesion(zeta, q0_h_rms=0.1):
    """A_ad by the formula with a_V = 2.8, which makes the threshold independent of load."""
    axes = {
        "pressure": LOADS,
        "adhesion_length_over_range": [0.1, 0.5, 1.0],
        "range_over_h_rms": [0.0075, 0.1],
    }
    length, range_ = (xr.DataArray(axes[n], dims=n, coords={n: axes[n]}) for n in list(axes)[1:])
    inverse = 0.75 * 2.8 / q0_h_rms * length * range_ ** (2 / 3)
    inverse = inverse * xr.ones_like(xr.DataArray(LOADS, dims="pressure", coords=[LOADS]))
    data = xr.Dataset({"inverse_kappa_ad": inverse, "q0_h_rms": q0_h_rms})
    data["attraction"] = 2 * inverse * data.pressure
    return made_by(with_errors(data, "inverse_kappa_ad"), **case(zeta))


def adhesive(zeta, q0_h_rms=0.1, scale=1.0):
    """Full simulation that follows the formula up to a factor."""
    data = adhesion(zeta, q0_h_rms=q0_h_rms).drop_attrs(deep=False)
    data = data[["inverse_kappa_ad", "q0_h_rms"]]
    data["inverse_kappa_ad"] = scale * data.inverse_kappa_ad
    data = with_errors(data, "inverse_kappa_ad")
    data["inverse_kappa_ad_net"] = 0.9 * data.inverse_kappa_ad
    data["inverse_kappa_ad_direct"] = 0.8 * data.inverse_kappa_ad
    data["inverse_kappa"] = 0.5 - data.inverse_kappa_ad
    data["inverse_kappa_net"] = 1.1 * data.inverse_kappa
    data["inverse_kappa_fit"] = data.inverse_kappa.mean("pressure")
    data["model"] = xr.full_like(data.inverse_kappa, "full", dtype="U4")
    slopes = "inverse_kappa", "inverse_kappa_net", "inverse_kappa_fit", "inverse_kappa_ad_net"
    data = with_errors(data, *slopes)
    return made_by(data, **case(zeta))


def loop(pull_off=-0.02, area=0.03, wider=1.5):
    """Area on loading 2 p, on unloading `wider` times that from the pull-off on."""
    there, back = np.linspace(0, 0.1, 61), np.linspace(0.1, pull_off, 61)
    back_area = np.interp(back, [pull_off, 0, 0.02, 0.1], [area, area, 0.04 * wider, 0.2])
    values = {
        "mean_pressure": np.concatenate([there, back]),
        "repulsive_area_fraction": np.concatenate([2 * there, back_area]),
        "net_repulsive_area_fraction": np.concatenate([2 * there, 0.75 * back_area]),
        "separating": np.repeat([0.0, 1.0], 61),
        "jumped": np.zeros(122),
        "work": np.full(122, 1.0),
        "dissipated": np.full(122, 0.25),
    }
    dims = "resolution", "control", "adhesion_length_over_range", "state"
    data = xr.Dataset(
        {name: (dims, np.broadcast_to(value, (2, 2, 2, 122))) for name, value in values.items()},
        coords={
            "resolution": [4.0, 8.0],
            "control": ["mean_gap", "pressure"],
            "adhesion_length_over_range": [0.05, 0.1],
            "state": np.arange(122),
        },
    )
    return made_by(data, range_over_h_rms=0.1, q0_h_rms=0.1, **case(32))


LIMIT_FACTORS = {
    "h_rms_limit": 1.0,
    "h_rms_limit_edges": 2.0,
    "h_rms_limit_edges_low": 1.0,
    "h_rms_limit_edges_high": 3.0,
    "weak_limit": 4.0,
}


def stickiness_map(a_v=(3.5, 2.5, 4.5)):
    dims = "range_times_q0", "adhesion_length_over_range"
    q0, length = np.geomspace(1e-12, 1e-2, 11), np.array([0.01, 0.1])
    limit = 1 / np.sqrt(q0[:, None]) * length
    roughness, parameters = np.geomspace(0.1, 100, 301), np.array([1, 0.5])
    inverse = criteria.inverse_kappa_ad(roughness, parameters[:, None], 1.0, 1.0, 3.0)
    angles = np.degrees(criteria.slope_angle(criteria.inverse_kappa(inverse)))
    data = xr.Dataset(
        {
            "slope_angle": (("slope_parameter", "h_rms_over_range"), angles),
            **dict(zip(("a_v", "a_v_low", "a_v_high"), a_v, strict=True)),
            **{name: (dims, factor * limit) for name, factor in LIMIT_FACTORS.items()},
        },
        coords={
            "slope_parameter": parameters,
            "h_rms_over_range": roughness,
            dims[0]: q0,
            dims[1]: length,
        },
    )
    return made_by(data, slope_a_v=3.0, shortest_over_range=4)


def real_surface(label, kind="self_affine", q0=1e3, c0=1e-3, h_rms=1e-6):
    data = xr.Dataset(
        {
            "C0": ("end", [c0 / 10, c0]),
            "C0_reference_upper": ("end", [c0 / 10, c0]),
            "h_rms": ("end", [h_rms / 10, h_rms]),
            "rms_slope": ("end", [0.1, 1.0]),
            "q0": q0,
            "q1": 2 * np.pi / 1e-6,
            "hurst": 0.8,
        },
        coords={"end": ["smooth", "rough"]},
    )
    return made_by(data, kind=kind, label=label)


def theory_on(label, a_v=4.0):
    data = xr.Dataset(
        {"a_v": (("variant", "range"), np.full((1, 2), a_v))},
        coords={"variant": ["afferrante2018"], "range": [1e-9, 1.0]},
    )
    return made_by(data, label=label)


def generated(seed, zeta=16, stretch=1.0):
    """A surface as the pipeline makes it; `stretch` spoils its isotropy."""
    asked = case(zeta, seed=seed)
    spectrum = SelfAffine(hurst=0.8, q0=1.0, q1=zeta, h_rms=1.0)
    heights = surface.synthesise(spectrum, 3 * zeta, 2 * np.pi, seed)
    k = np.fft.fftfreq(3 * zeta, 1 / (3 * zeta))
    damped = np.fft.ifft2(np.fft.fft2(heights) * np.exp(-(((stretch - 1) * k / zeta) ** 2))).real
    data = xr.Dataset({"height": (("x", "y"), damped), "window_length": 2 * np.pi})
    return made_by(data, **asked)


@pytest.fixture
def files():
    """Files of a world in which the paper's power laws hold."""
    broad = (1000.0, 1e4, 5e4)
    wide, narrow = ensemble(32, window=4), ensemble(128)
    fig3a = sweep(broad)
    fig3c = sweep((10.0, 100.0, 1e4, 1e5, 1e6), hursts=(0.7, 0.8, 0.9))
    fig3d = sweep(loads=(0.001, 0.01, LOAD, 0.1, 0.5))
    return {
        "kappa_64": kappa(64),
        "kappa_128": kappa(128),
        "kappa_wide": kappa(32, window=4),
        "ensemble_wide": wide,
        "lattice_wide": lattice(),
        "fit_bem_wide": fit(wide, 2.9, 3.0, 3.1),
        "fit_bem_64": fit(ensemble(64), 2.9, 3.0, 3.1),
        "fit_bem_128": fit(narrow, 2.9, 3.0, 3.1),
        "fit_lattice_128": fit(lattice(), 3.0, 3.0, 3.0),
        "fig1b": sweep((100.0, 1e4, 1e6)),
        "fig3a": fig3a,
        "fig3b": sweep(loads=(0.0065, 0.03, 0.13, 0.52)),
        "fig3c": fig3c,
        "fig3d": fig3d,
        "fit_fig3a": fit(fig3a, 3.0, 3.0, 3.0),
        "fit_fig3c": fit(fig3c, 3.0, 2.9, 3.2),
        "fit_fig3d": fit(fig3d, 3.0, 3.0, 3.0),
        "loop": loop(),
        "adhesive_fig2": adhesive(64),
        "adhesive_rough": adhesive(64, q0_h_rms=0.3),
        "adhesive_smooth": adhesive(128, q0_h_rms=0.006),
        "adhesion_fig2": adhesion(64),
        "adhesion_rough": adhesion(64, q0_h_rms=0.3),
        "adhesion_smooth": adhesion(128, q0_h_rms=0.006),
        "map": stickiness_map(),
        "asphalt": real_surface("asphalt"),
        "asphalt_theory": theory_on("asphalt"),
        "polished_steel": real_surface("polished steel", q0=2 * np.pi / 1e-4),
        "surface:asphalt.nc": real_surface("asphalt"),
        "surface:terrain.nc": real_surface("terrain", kind="measured", c0=0.07),
        "seed:1": generated(1),
        "seed:2": generated(2),
        "seed:3": generated(3),
    }


@pytest.mark.parametrize(
    ("fully", "partly", "verdict"),
    [
        (True, True, REPRODUCED),
        (True, False, REPRODUCED),
        (False, True, QUALIFIED),
        (False, False, NOT),
    ],
)
def test_verdicts(fully, partly, verdict):
    assert _claim.graded(fully, partly) == verdict


def test_an_unknown_error_grades_as_not_reproduced():
    assert _claim.graded(abs(3 - 3) < np.nan, False) == NOT


def test_errors_add_in_quadrature():
    assert float(_claim.total_error(kappa(64), "kappa_fit")) == pytest.approx(0.05 * 2)


def test_quoted_leaves_out_an_unknown_error():
    assert _claim.quoted(1.234, 0.056) == "1.23 ± 0.06"
    assert _claim.quoted(1.234, np.nan) == "1.23"


@pytest.mark.parametrize(
    ("number", "text"), [(10.0, "10"), (1000.0, "1000"), (5e4, "5e4"), (1e6, "1e6")]
)
def test_magnifications_in_words(number, text):
    assert _claim.power(number) == text


def test_close_to_third_finds_the_longest_range():
    gap = np.arange(1.0, 9.0)
    values = -1 / 3 + np.array([0.04, 0.2, 0.04, -0.04, 0.0, 0.3, 0.01, 0.3])
    exponent = xr.DataArray(values, dims="gap", coords={"gap": gap})
    assert contact.close_to_third(exponent) == (3.0, 5.0)
    assert contact.close_to_third(exponent + 1) == (1.0, 1.0)


def test_every_claim_runs_and_names_its_files(files):
    claims = [judge(files) for judge in ledger.CLAIMS]
    assert [claim.number for claim in claims] == list(range(1, 19))
    paths = {name: f"out/{name}" for name in files}
    for claim in claims:
        assert claim.verdict in (REPRODUCED, QUALIFIED, NOT)
        assert np.isfinite(claim.value)
        assert "nan" not in claim.remark + claim.quantity
        assert all(check_claims.source_paths(claim, paths))
    by_number = {claim.number: claim for claim in claims}
    for number in (1, 2, 3, 4, 6, 7, 8, 9):  # what the made-up world obeys to the letter
        assert by_number[number].verdict == REPRODUCED, by_number[number]


def test_files_are_those_of_the_workflow(files):
    """The names that the claims were tested with are those that the rule passes on."""
    text = RULES.read_text(encoding="utf-8")
    start = text.index("def ledger_inputs")
    names = {"RESULTS": "out", "REAL_SURFACES": ["a"], "seeds_of": lambda case: [1]}
    exec(text[start : text.index("\n\n\n", start)], names)
    groups = {"surfaces", "seeds"}
    assert names["ledger_inputs"]().keys() - groups == {name for name in files if ":" not in name}


def test_kappa_is_that_of_the_load_and_not_of_the_fit(files):
    files["kappa_128"] = kappa(128, fall=0.05, level=2.08)
    claim = contact.area_slope(files)
    assert claim.value == pytest.approx(2.08)
    assert claim.uncertainty == pytest.approx(0.05 * 2.08)
    first = 2.08 * (1 - 0.05 * np.log(LOADS[0] / LOAD))
    assert f"from {first:.2f} at" in claim.remark
    assert claim.verdict == QUALIFIED
    files["kappa_128"] = kappa(128, level=2.3)
    assert contact.area_slope(files).verdict == NOT


def test_kappa_ends_start_at_the_smallest_load():
    (small, _), (large, _) = contact.kappa_ends(kappa(64))
    assert (small, large) == (LOADS[0], LOADS[-2])  # half of kappa = 2: the area is the load


def test_exponent_is_that_of_the_density(files):
    files["fig3a"] = sweep((1000.0, 5e4), exponent=-0.55)
    claim = contact.small_gap_exponent(files)
    assert claim.value == pytest.approx(-0.55)
    assert claim.errors["model"] == pytest.approx(0, abs=1e-9)
    assert claim.verdict == NOT


def test_exponent_is_graded_at_the_largest_magnification_alone(files):
    steep = sweep((5e4,), exponent=-0.55)
    files["fig3a"] = xr.concat([sweep((1000.0,)), steep], "magnification")
    claim = contact.small_gap_exponent(files)
    assert claim.verdict == NOT
    assert "at zeta = 1000" in claim.remark


@pytest.mark.parametrize(
    ("theory", "simulation", "verdict"),
    [(1.0, 1.0, REPRODUCED), (1.0, 0.8, QUALIFIED), (0.8, 1.0, NOT)],
)
def test_separation_is_graded_on_theory_and_simulation(files, theory, simulation, verdict):
    files["fig3d"] = files["fig3d"].assign(mean_gap=files["fig3d"].mean_gap / theory)
    files["ensemble_wide"] = ensemble(32, separation=simulation, window=4)
    claim = contact.load_separation(files)
    assert claim.verdict == verdict
    assert (claim.uncertainty > 1e-9) == (simulation != 1)  # theory is at 1 on the same spectrum
    assert ("disagrees" in claim.remark) == (simulation != 1)


def test_threshold_lies_between_the_lengths_around_it(files):
    full = files["adhesive_fig2"]
    claim = adhesive_claims.kappa_threshold(files)
    below = full.inverse_kappa.sel(pressure=LOAD, method="nearest").isel(range_over_h_rms=0)
    # the last length with a positive slope and the first with a negative one
    lengths = full.adhesion_length_over_range.values
    first = int(np.flatnonzero(below.values < 0)[0])
    assert lengths[first - 1] < claim.value < lengths[first]
    assert claim.verdict == QUALIFIED
    at = float(below[int(np.argmin(np.abs(below.values - 0.25)))])
    assert f"1/kappa is {at:.2f} ± {0.05 * at:.2f} by that area and {1.1 * at:.2f}" in claim.remark


def test_threshold_that_is_not_reached_is_no_number_of_its_own(files):
    files["adhesive_fig2"] = adhesive(64, scale=1e-3)
    claim = adhesive_claims.kappa_threshold(files)
    assert claim.verdict == OPEN
    assert claim.value == float(files["adhesive_fig2"].adhesion_length_over_range[-1])
    assert "largest simulated" in claim.quantity


@pytest.mark.parametrize(
    ("slopes", "verdict"),
    [((3, 3, 3), REPRODUCED), ((3, 3.3, 3), QUALIFIED), ((3.4, 4.4, 2.9), NOT)],
)
def test_linearity_is_graded(files, slopes, verdict):
    files["fit_fig3a"] = fit(files["fig3a"], *slopes)
    claim = contact.area_against_range(files)
    assert claim.verdict == verdict
    assert claim.value == pytest.approx(max(slopes) / min(slopes))


def test_growth_with_magnification_is_graded_though_the_area_is_linear(files):
    area = files["fig3a"].attractive_area
    files["fig3a"]["attractive_area"] = area * (area.magnification / 1e4) ** 0.1
    assert contact.area_against_range(files).verdict == NOT


@pytest.mark.parametrize(
    ("theory", "simulation", "verdict"),
    [(1, 1, REPRODUCED), (1, 0.8, QUALIFIED), (0.8, 0.7, NOT)],
)
def test_load_is_graded_on_theory_and_simulation(files, theory, simulation, verdict):
    files["fig3b"] = sweep(loads=(0.0065, 0.03, 0.13, 0.52), power=theory)
    files["ensemble_wide"] = ensemble(32, power=simulation, window=4)
    claim = contact.area_against_load(files)
    assert claim.value == pytest.approx(theory)
    assert np.isnan(claim.uncertainty)
    assert claim.verdict == verdict


@pytest.mark.parametrize(
    ("slopes", "verdict"),
    [((3.0, 2.9, 3.2), REPRODUCED), ((3.7, 5.1, 3.1), QUALIFIED), ((4.0, 4.2, 3.9), NOT)],
)
def test_a_v_is_graded_with_its_uncertainty(files, slopes, verdict):
    files["fit_fig3c"] = fit(files["fig3c"], *slopes)
    claim = contact.a_v_against_magnification(files)
    parts = np.array([0.04, 0.03, 0.0]) * slopes[0]  # grid, sampling, growth
    expected = np.linalg.norm([*parts, np.ptp(slopes) / 2])
    assert claim.uncertainty == pytest.approx(expected)
    assert claim.verdict == verdict


def test_continuous_a_v_is_taken_at_the_magnification_of_the_simulation(files):
    continuous = files["fit_fig3c"].isel(window=0, load=0).sel(variant=conventions.VARIANT).a_v
    continuous = continuous * np.log10(continuous.magnification)
    text = contact.simulated_a_v(files, continuous)
    assert f"{3 * np.log10(128):.2f} on the continuous one" in text


@pytest.mark.parametrize(
    ("made", "verdict"),
    [({}, REPRODUCED), ({"wider": 1.0}, QUALIFIED), ({"pull_off": 0.01}, NOT)],
)
def test_loop_is_graded_by_its_width_and_its_pull_off(files, made, verdict):
    files["loop"] = loop(**made)
    claim = adhesive_claims.hysteresis(files)
    assert claim.verdict == verdict
    assert claim.value == pytest.approx(made.get("pull_off", -0.02))
    assert "at p = 0.02 the area is 0.040 on loading" in claim.remark
    if "pull_off" not in made:
        assert "0.030 at zero gap, 0.022 of it compressed" in claim.remark
    assert "25% of the work" in claim.remark


@pytest.mark.parametrize(
    ("scale", "verdict"), [(1, REPRODUCED), (2, QUALIFIED), (5, NOT), (0.2, NOT)]
)
def test_simulation_is_compared_with_the_formula(files, scale, verdict):
    files["adhesive_rough"] = adhesive(64, q0_h_rms=0.3, scale=scale)
    files["adhesive_smooth"] = adhesive(128, q0_h_rms=0.006, scale=scale)
    claim = adhesive_claims.inverse_kappa_ad(files)
    assert claim.value == pytest.approx(scale)
    assert claim.uncertainty == pytest.approx(0.05 * scale)
    assert claim.verdict == verdict
    assert f"{0.8 * scale:.2f} to {0.8 * scale:.2f}" in claim.remark  # directly
    assert "2.90 ± 0.14" in claim.remark  # a_V of the surfaces


def test_the_error_of_the_model_counts(files):
    full = files["adhesive_rough"]
    full = with_errors(full, "inverse_kappa_ad", model=0.12)
    error = total_error(full, "inverse_kappa_ad") / full.inverse_kappa_ad
    np.testing.assert_allclose(error, 0.13)  # 0.05 and 0.12 in quadrature


@pytest.mark.parametrize("a_v", [1.5, 3.0])
def test_largest_dmt_is_where_threshold_and_jtb_line_cross(a_v):
    h = criterion.largest_dmt(a_v)
    c = 1.5 * a_v
    assert h == pytest.approx(4 / 75 * (c**0.6 * 18.75) ** 2.5)
    length = 0.05
    q0 = length * (c / h ** (5 / 3))  # threshold at h, solved for q0
    assert criteria.h_rms_limit(q0, length, 1.0, a_v) == pytest.approx(h)
    assert criteria.jtb_limit(q0, length, 1.0) == pytest.approx(h)
    # A longer adhesion length raises the JTB line above the threshold.
    assert criteria.jtb_limit(q0, 2 * length, 1.0) > criteria.h_rms_limit(q0, 2 * length, 1.0, a_v)


def test_formula_against_itself_is_qualified_and_wrong_angles_are_not(files):
    assert criterion.slope_angle(files).verdict == QUALIFIED
    m = files["map"]
    files["map"] = m.assign_coords(h_rms_over_range=1.1 * m.h_rms_over_range)
    assert criterion.slope_angle(files).verdict == NOT


def test_limits_count_those_outside_the_dmt_range(files):
    assert "6 of these 6" in criterion.roughness_limits(files).remark
    # With a_V = 8 the limit at range q0 = 1e-6 passes the JTB limit, 2667.
    files["map"] = stickiness_map(a_v=(8.0, 7.0, 9.0))
    assert "5 of these 6" in criterion.roughness_limits(files).remark


def test_limits_by_the_edges_are_read_off_the_map(files):
    # limits are q0^(-1/2) l_a/range times 2, 1 and 3
    remark = criterion.roughness_limits(files).remark
    assert "100, 3.16e+03, 1e+05 (50, 1.58e+03, 5e+04 to 150, 4.74e+03, 1.5e+05)" in remark
    assert "0% of the map's thresholds have weak edges" in criterion.slope_angle(files).remark


def test_tough_edges_do_not_ask_for_more_adhesion_on_finer_surfaces():
    """JKR with the edges of Pastewka and Robbins: zeta^(1 - 2H), from h'^3/h''."""
    for hurst in (0.5, 0.8):
        assert criterion.tough_exponent(hurst) == pytest.approx(1 - 2 * hurst, abs=1e-3)


def test_asphalt_by_its_edges_does_not_know_the_range(files, monkeypatch):
    files["asphalt"] = real_surface("asphalt", h_rms=1e-3)
    texts = []
    for reach in (1e-10, 2e-10):
        monkeypatch.setattr(criterion, "RANGE", reach)
        texts.append(criterion.asphalt_by_edges(files))
    assert all("tough" in text for text in texts)
    assert len({text.split(" µm and")[0] for text in texts}) == 1
    assert len({text.split("in attraction: ")[1].split(". At")[0] for text in texts}) == 1


def test_asphalt_by_its_edges_hinges_on_the_shortest_wavelength(files):
    """Tough edges with Pastewka and Robbins' a_V: E* goes as wavelength^(1 - 2H), here -0.6."""
    found = criterion.cutoff_factors(files["asphalt"].sel(end="rough"), [1e-5, 1e-6, 1e-7])
    # The limit of broad spectra and of tough edges, which these are near.
    np.testing.assert_allclose(found, [10**-0.6, 1, 10**0.6], rtol=0.1)
    files["asphalt"] = real_surface("asphalt", h_rms=1e-3)
    text = criterion.asphalt_by_edges(files)
    assert "are tough" in text
    number = r"([-+.\de]+)"
    value, long, short, finest, smooth, low, high = (
        float(re.search(pattern.replace("#", number), text).group(1))
        for pattern in (
            "it is # MPa",
            "edges # MPa",
            "10 µm, # for",
            "0.1 µm and # for 1 nm",
            "gives # MPa",
            "attraction: # to",
            "to # MPa. At",
        )
    )
    # numbers are quoted with two digits
    assert long / value == pytest.approx(found[0], rel=0.1)
    assert short / value == pytest.approx(found[2], rel=0.1)
    # of tough edges attraction goes as the root of the adhesion length
    assert low == pytest.approx(long / equivalent_sphere.ERROR_BEYOND**2, rel=0.1)
    assert high == pytest.approx(smooth * found[2] * equivalent_sphere.ERROR_BEYOND**2, rel=0.1)
    assert low < long < value < short < min(finest, high)


def test_only_measured_surfaces_test_the_line(files):
    claim = criterion.real_surfaces(files)
    assert claim.verdict == QUALIFIED
    assert "terrain reaches 70 times the line" in claim.remark
    assert "asphalt reaches" not in claim.remark
    assert set(claim.sources) == {"asphalt", "asphalt_theory", "map", "surface:terrain.nc"}
    del files["surface:terrain.nc"]
    assert "there are none" in criterion.real_surfaces(files).remark


def test_moment_ratios_of_two_crossed_waves():
    """Heights cos x cos 2y have m20 : m02 : m22 : m40 : m04 = 1 : 4 : 4 : 1 : 16."""
    x = np.arange(16) * 2 * np.pi / 16
    heights = np.cos(x)[:, None] * np.cos(2 * x)[None, :]
    expected = [
        [12, 12 / 16],
        [np.sqrt(5 / 2), np.sqrt(5 / 8)],
        [np.sqrt(3 * 25 / 8), np.sqrt(3 * 25 / (8 * 16))],
    ]
    np.testing.assert_allclose(criterion.moment_ratios(heights, 2 * np.pi), expected)


def test_lattice_expectation_is_that_of_its_modes():
    """3 m22/m40 summed over the disc of modes with C = q^-3.6, without a surface."""
    zeta = 16
    i, j = np.meshgrid(np.arange(-zeta, zeta + 1), np.arange(-zeta, zeta + 1))
    square = i**2 + j**2
    inside = (square >= 1) & (square <= zeta**2)
    weight = square[inside] ** -1.8
    expected = 3 * np.sum(weight * (i * j)[inside] ** 2) / np.sum(weight * i[inside] ** 4)
    found = criterion.moment_ratios(*criterion.fixed_amplitudes(generated(1, zeta)))
    np.testing.assert_allclose(found[0], expected)
    assert abs(expected - 1) > 1e-3  # else 1 would do as the reference


def test_moments_of_isotropic_surfaces_agree_and_of_stretched_ones_do_not(files):
    claim = criterion.spectral_moments(files)
    ratios = [criterion.moment_ratios(*criterion.heights_of(generated(s)))[0] for s in (1, 2, 3)]
    assert claim.value == pytest.approx(np.mean(ratios))
    scatter = np.var(ratios, axis=0, ddof=1).mean()  # x and y each about their own mean
    assert claim.uncertainty == pytest.approx(2.92 * np.sqrt(scatter / 6), rel=1e-3)  # t, 2 dof
    assert claim.verdict != NOT
    files |= {f"seed:{seed}": generated(seed, stretch=2.0) for seed in (1, 2, 3)}
    assert criterion.spectral_moments(files).verdict == NOT


def test_sources_are_listed_once_and_a_misspelt_one_is_an_error(files):
    paths = {"map": "a.nc", "asphalt": "b.nc", "surface:b.nc": "b.nc", "surface:c.nc": "c.nc"}
    claim = criterion.roughness_limits(files)
    several = _claim.Claim(**{**vars(claim), "sources": ("asphalt", "surfaces", "map")})
    assert check_claims.source_paths(several, paths) == ["b.nc", "c.nc", "a.nc"]
    misspelt = _claim.Claim(**{**vars(claim), "sources": ("maps",)})
    with pytest.raises(KeyError, match="maps"):
        check_claims.source_paths(misspelt, paths)


def test_number_leaves_out_an_unknown_error():
    assert check_claims.number(2.0789, 0.0284) == "2.079 ± 0.028"
    assert check_claims.number(1.1312, np.nan) == "1.131"
