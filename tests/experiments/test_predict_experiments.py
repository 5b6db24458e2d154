"""Made-up experiments: inputs swept, predictions against the library, outcomes, page and figure."""

from types import SimpleNamespace

import matplotlib.pyplot as plt
import numpy as np
import pytest
from helpers.experiments import (
    EXPERIMENTS,
    complete_experiments,
    known,
    make_dataset,
    observe,
    seen,
)

from common import experiment_outcomes as outcomes
from common.config import load
from common.experiment_outcomes import COMPATIBLE, MISSED, SILENT, SOME
from experiments import plot_experiments
from experiments import predict_experiments as experiments
from experiments.predict_experiments import ROUGHNESS
from stickiness import datasets
from stickiness.criteria.registry import CRITERIA
from stickiness.remaining import Roughness, predict, sphere
from stickiness.spectrum import SelfAffine, SpectrumFamily

LENGTH, RANGE = 0.05 / 1e6, 0.3e-9
LIMIT = seen("limiting_roughness", ["1 um", "2 um"])
WORK = seen("work_of_separation", "30 mJ/m^2")
FILES = {"dataset": "nc", "table": "md", "png": "png", "pdf": "pdf"}


def spectrum(h_rms=1.0, **more):
    given = {"hurst": 0.8, "q0": 2 * np.pi / 1e-4, "q1": 2 * np.pi / 1e-6} | more
    return SelfAffine(h_rms=h_rms, **given)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """What the rule makes of a sphere and a flat: dataset and page."""
    folder = tmp_path_factory.mktemp("experiments")
    job = SimpleNamespace(
        input=SimpleNamespace(template="report/experiments.md.j2"),
        output=SimpleNamespace(**{name: str(folder / f"x.{end}") for name, end in FILES.items()}),
        params=SimpleNamespace(experiments=EXPERIMENTS),
    )
    experiments.main(job)
    return folder


@pytest.fixture(scope="module")
def dataset(made):
    return datasets.read(made / "x.nc")


def test_combinations_are_the_middle_then_each_end_then_all_corners():
    ends = {"a": np.array([1.0, 4.0]), "b": np.array([7.0]), "c": np.array([0.0, 1000.0])}
    found = experiments.combine_inputs(ends, ("a", "c"))
    # Middles are geometric, but half the high end above zero.
    rows = [(2, 500), (1, 500), (4, 500), (2, 0), (2, 1000)]
    corners = [(1, 0), (1, 1000), (4, 0), (4, 1000)]
    np.testing.assert_allclose(np.transpose([found["a"], found["c"]]), rows + corners)
    np.testing.assert_array_equal(found["b"], np.full(9, 7.0))


def test_observations_are_read_in_si_units():
    young = {"youngs_modulus": known("0.75 MPa"), "poisson_ratio": known(0.5)}
    found = observe(LIMIT, plane_strain_modulus=None, **young)
    np.testing.assert_allclose(found.inputs["modulus"], 1e6)  # E/(1 - 1/4)
    assert found.limits == pytest.approx([1e-6, 2e-6])


def predict_quantity(quantity, value=None, **conditions):
    """Low limit, value and high limit, every input in the middle."""
    observed = seen(quantity, value) if isinstance(quantity, str) else quantity
    return experiments.predict(observe(observed, **conditions)).quantity[:, 0]


@pytest.mark.parametrize("h_rms", [0.2, 1.0, 3.0])
def test_flats_are_predicted_as_by_the_library(h_rms):
    given = {"h_rms": known(f"{h_rms} um")}
    expected = predict(spectrum(h_rms * 1e-6), LENGTH, RANGE)
    shares = [expected.separation_limits[0], expected.separation]
    np.testing.assert_allclose(predict_quantity("sticks", True, **given)[:2], shares, rtol=1e-6)
    for name in ("approach", "separation"):
        low, high = getattr(expected, f"{name}_limits")
        works = 0.05 * np.array([low, getattr(expected, name), high])
        found = predict_quantity(f"work_of_{name}", "30 mJ/m^2", **given)
        np.testing.assert_allclose(found, works, rtol=1e-6)


def test_the_law_of_an_experiment_counts():
    given = {"h_rms": known("10 nm"), "plane_strain_modulus": known("1000 GPa")}
    expected = predict(spectrum(1e-8), LENGTH / 1e6, RANGE, law="van_der_waals").separation
    found = predict_quantity("sticks", True, **given, law="van_der_waals")[1]
    assert found == pytest.approx(expected, rel=1e-6)
    assert found > 5 * predict_quantity("sticks", True, **given)[1]


@pytest.mark.parametrize("level", [0.03, 0.5])
def test_the_limiting_roughness_is_where_adhesion_falls_to_its_level(level):
    unit, observed = spectrum(), LIMIT | {"level": level}

    def rough(h):
        return Roughness(h_rms=h, q0=unit.q0, elastic_energy=unit.elastic_energy() * h**2)

    for height, sign in zip(predict_quantity(observed), (-1, 0, 1), strict=True):
        at_limit = rough(height).deviating(sign)
        assert at_limit.threshold(RANGE, level) == pytest.approx(LENGTH, rel=0.06)
    h = predict_quantity(observed, radius=known("5 mm"))[1]
    below, above = (
        sphere.pull_off(rough(h * f), 5e-3, LENGTH, RANGE).relative for f in (1.02, 0.98)
    )
    assert below < level < above


def test_adhesion_falls_for_good():
    heights = np.geomspace(1e-9, 1e-3, 61)
    values = np.where((heights < 1e-7) | (heights > 1e-6), 1.0, 0.01)  # it comes back
    values[heights > 1e-5] = 0.01
    step = heights[1] / heights[0]
    assert 1e-5 / step < experiments.find_fall(heights, values, 0.1) < 1e-5 * step
    power_law = experiments.find_fall(heights, (1e-7 / heights) ** 1.5, 0.1)
    assert power_law == pytest.approx(1e-7 / 0.1 ** (2 / 3), rel=1e-9)
    # From 0.4 to 0 between 1 and 100 um: 0.1 is left at three quarters of the way, 10^1.5 um.
    to_nothing = experiments.find_fall(np.array([1e-8, 1e-6, 1e-4]), np.array([1, 0.4, 0.0]), 0.1)
    assert to_nothing == pytest.approx(1e-6 * 10**1.5, rel=1e-9)
    assert np.isnan(experiments.find_fall(heights, np.full(61, 0.2), 0.1))


# Which holds on any of these heights, and on none.
@pytest.mark.parametrize(
    ("modulus", "work", "reach"),
    [("10 Pa", "10 J/m^2", "0.3 nm"), ("1e13 Pa", "1e-6 J/m^2", "1e-11 m")],
)
def test_a_limiting_roughness_beyond_the_heights_is_an_error_that_names_the_case(
    modulus, work, reach
):
    given = {"plane_strain_modulus": known(modulus), "work_of_adhesion": known(work)}
    given["range"] = known(reach)
    with pytest.raises(ValueError, match="^mine.cases.one: adhesion falls to 0.1 at no rms"):
        experiments.predict(observe(LIMIT, **given))


@pytest.mark.parametrize(
    ("quantity", "relation", "expected"),
    [
        ("work_of_approach", "conformal_contact", lambda u: (0.05 - u - 0.004, 0.074 - u)),
        ("work_of_separation", "cycle_loss", lambda u: (0.1 - u - 0.004, 0.144 - u)),
        (
            *("limiting_roughness", "energy_ratio"),
            lambda u: [1e-7 * np.sqrt(0.05 / (factor * u)) for factor in (1.4, 1.0)],
        ),
    ],
)
def test_a_relation_is_evaluated_with_the_inputs(quantity, relation, expected):
    observed = seen(quantity, relation=relation, factor=[1.0, 1.4], error="4 mJ/m^2")
    observation = observe(observed, h_rms=known("0.1 um"))
    energy = 1e6 * spectrum(1e-7).elastic_energy()
    found = experiments.find_observed(observation, observation.pair(np.array([[1e-7]])))[:, 0]
    assert found == pytest.approx(expected(energy), rel=1e-6)
    far = experiments.find_observed(observation, observation.pair(np.array([[1e-4]])))[:, 0]
    assert relation == "energy_ratio" or far.tolist() == [0, 0]  # not below nothing


@pytest.mark.parametrize(
    ("observed", "least", "most", "outcome"),
    [
        (WORK, [0.02, 0.02], [0.04, 0.03], COMPATIBLE),
        (WORK, [0.031, 0.02], [0.04, 0.029], MISSED),
        (seen("sticks", True), [0, 0], [0.2, 0.09], SOME),  # the high limit may stick
        (seen("sticks", False), [0.09, 0], [1, 1], COMPATIBLE),  # the low limit may not
        (seen("sticks", False), [0.2, 0.1], [1, 1], MISSED),
    ],
)
def test_limits_that_overlap_agree(observed, least, most, outcome):
    observation = observe(observed, h_rms=known("1 um"))
    limits = np.transpose([observation.limits] * 2)
    right = experiments.agrees(observation, limits, np.array(least), np.array(most))
    assert experiments.summarise(right) == outcome


def judge(observed, **conditions):
    observation = observe(observed, **conditions)
    pair = observation.pair(np.full((len(observation.inputs["hurst"]), 1), 1e-6))
    limits = experiments.find_observed(observation, pair)
    found = experiments.judge_criteria(observation, limits, pair)
    return dict(zip(CRITERIA, found, strict=True))


@pytest.mark.parametrize(
    ("observed", "modulus", "outcome"),
    [
        (seen("sticks", True), "0.5 MPa", COMPATIBLE),
        (seen("sticks", False), ["0.5 MPa", "2 MPa"], SOME),
        (seen("work_of_approach", ["1 mJ/m^2", "4.9 mJ/m^2"]), "0.5 MPa", MISSED),
        (seen("work_of_approach", ["4.9 mJ/m^2", "9 mJ/m^2"]), "0.5 MPa", SILENT),  # undecided
        (seen("relative_pull_off", 0.05), "0.5 MPa", MISSED),
        (seen("sticks", True, silent=["dahlquist"]), "0.5 MPa", SILENT),
        (LIMIT, "0.5 MPa", SILENT),  # it knows no adhesion length
    ],
)
def test_dahlquist_is_right_on_what_sticks_below_a_megapascal(observed, modulus, outcome):
    assert judge(observed, plane_strain_modulus=known(modulus))["dahlquist"] == outcome


@pytest.mark.parametrize(
    ("factors", "outcome"),  # the adhesion length that is required goes with the square of h_rms
    [((1.99, 3.0), COMPATIBLE), ((0.2, 0.501), COMPATIBLE), ((2.01, 3.0), MISSED)],
)
def test_a_criterion_is_right_within_a_factor_of_four_of_the_adhesion(factors, outcome):
    limit = np.sqrt(LENGTH / spectrum().elastic_energy())  # of Persson and Tosatti
    found = judge(seen("limiting_roughness", [f"{factor * limit} m" for factor in factors]))
    assert found["persson_tosatti"] == outcome


def test_the_roughness_of_criteria_is_where_their_margin_is_one():
    observation = observe(LIMIT, longest_wavelength=known(["50 um", "0.2 mm"]))
    found = dict(zip(CRITERIA, experiments.find_roughness(observation), strict=True))
    expected = np.sqrt(LENGTH / spectrum().elastic_energy())  # of the middle, 100 um
    assert found["persson_tosatti"] == pytest.approx(expected, rel=1e-6)
    assert np.isnan(found["dahlquist"])
    for name, limit in found.items():
        if np.isfinite(limit):
            margin = CRITERIA[name].margin(observation.pair(np.array([[limit]])))
            assert margin == pytest.approx(1, rel=0.05), name


def test_the_dataset_has_predictions_limits_and_outcomes(dataset):
    assert dataset.case.values.tolist() == ["ball/limit", "ball/work", "plate/steel"]
    for name in ("predicted", "pull_off_curve"):
        # Near full contact limits and value agree; roots are found to 1e-8.
        assert np.all(dataset[f"{name}_lowest"] <= dataset[name] * (1 + 1e-8))
        assert np.all(dataset[name] <= dataset[f"{name}_highest"] * (1 + 1e-8))
    plate, ball = dataset.sel(case="plate/steel"), dataset.sel(case="ball/work")
    assert (int(plate.outcome), int(plate.value_inside)) == (COMPATIBLE, 1)
    assert ball.most_effective_input.item() == "longest_wavelength"
    assert float(ball.observed_low) == pytest.approx(0.03)
    # Across Derjaguin's zone, which is wider than JKR's contact with the work that remains.
    longest = np.sqrt(50e-6 * 100e-6)
    rough = spectrum(1e-6, q0=2 * np.pi / longest)
    pair = Roughness.of(SpectrumFamily.of(rough), q0=np.array([rough.q0]), q1=rough.q1)
    zone = np.sqrt(2 * 5e-3 * pair.distance(LENGTH, RANGE).item())
    assert float(ball.waves_in_contact) == pytest.approx(2 * zone / longest, rel=1e-6)
    limit = float(dataset.predicted.sel(case="ball/limit"))
    np.testing.assert_allclose(dataset.h_rms, [limit, 1e-6, 1e-6])


PLATE_CASE = EXPERIMENTS["plate"]["cases"]["steel"]
FLAT_ROW = {"quantity": "sticks", "observed": (0.0, 0.0), "most_effective_input": "range"}


def test_a_case_says_why_its_value_differs():
    plate = EXPERIMENTS["plate"] | {"cases": {"steel": PLATE_CASE | {"missed": "it was wet"}}}
    for inside, outcome, reason in ((0, SOME, "it was wet"), (0, MISSED, "it was wet"), (1, 2, "")):
        row = FLAT_ROW | {"predicted": (0.3, 0.01, 0.5), "value_inside": inside, "outcome": outcome}
        found = outcomes.describe(make_dataset({"plate/steel": row}, {"plate": plate}))
        assert found["cases"][0]["reason"] == reason
        assert found["missed"] == ({"hard plate: steel on steel": reason} if reason else {})


@pytest.mark.parametrize(("waves", "shown"), [(4.04, "4, too few"), (40.4, "40"), (np.nan, "flat")])
def test_few_waves_in_contact_are_told(waves, shown):
    row = FLAT_ROW | {"predicted": (0.3, 0.01, 0.5), "waves_in_contact": waves}
    (case,) = outcomes.describe(make_dataset({"plate/steel": row}))["cases"]
    assert case["waves"] == shown


def test_a_share_is_compared_with_the_share_that_remains():
    found = predict_quantity("share", [0.01, 0.3], h_rms=known("0.2 um"))
    np.testing.assert_allclose(found, predict_quantity("sticks", True, h_rms=known("0.2 um")))
    observed = seen("share", [0.01, 0.3])
    assert judge(observed)["persson_tosatti"] == SILENT  # it decides nothing at a tenth


@pytest.mark.slow
def test_every_pair_that_people_know_agrees_or_has_an_explanation():
    """The committed ones: tapes, skin, geckos, wafers, tyres, rulers and machines."""
    entries = load.load("config/experiments.yaml")["experiments"]
    everyday = complete_experiments(everyday=entries["everyday"])["everyday"]
    dataset = experiments.predict_all({"everyday": everyday})
    cases = outcomes.describe(dataset, {"everyday": everyday})["cases"]
    differ = [case for case in cases if "value too" not in case["outcome"]]
    assert len(cases) == len(everyday["cases"]) >= 12
    assert differ
    for case in differ:
        assert len(case["reason"]) > 40, case["case"]
        assert case["reason"] != "no reason was found", case["case"]
    for case in cases:
        assert bool(case["reason"]) == (case in differ), case["case"]
    assert not (dataset.tests == 1).any()  # none of them counts as published


def test_the_page_has_every_case_and_source(made, dataset):
    page = (made / "x.md").read_text(encoding="utf-8")
    described = outcomes.describe(dataset)
    for case in described["cases"]:
        (row,) = (line for line in page.splitlines() if f"| {case['case']} |" in line)
        assert all(case[key] in row for key in ("observed", "predicted", "outcome", "depends"))
    for text in (
        "- soft ball: the color of the ball",
        "- hard plate: no sou",
    ):
        assert text in page
    assert "nan" not in page.lower()


def test_the_figure_shows_the_curve_the_observations_and_every_mark(dataset, monkeypatch):
    monkeypatch.setattr(plot_experiments, "FOLLOWED", "ball")
    _, axes = plt.subplots(1, 3)
    plot_experiments.draw_pull_off(axes[0], dataset, EXPERIMENTS)
    curve = np.transpose([ROUGHNESS * 1e6, dataset.pull_off_curve.sel(case="ball/limit")])
    lines = [line.get_xydata() for line in axes[0].lines]
    assert any(line.shape == curve.shape and np.allclose(line, curve) for line in lines)
    plot_experiments.draw_works(axes[1], dataset, EXPERIMENTS)
    work = 1e3 * dataset.predicted.sel(case="ball/work").item()
    points = [line.get_xydata() for line in axes[1].lines if len(line.get_xdata()) == 1]
    np.testing.assert_allclose(np.vstack(points), [[30.0, work]])
    plot_experiments.draw_criteria(axes[2], dataset, EXPERIMENTS)
    marks = [text.get_text() for text in axes[2].texts]
    # A case has the mark of its value first, which a right answer on sticking must not hide.
    rows = np.column_stack([dataset.outcome, dataset.criterion_outcome])
    assert marks == [outcomes.MARKS[int(code)] for code in rows.ravel()]
    plt.close("all")
