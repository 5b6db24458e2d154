"""Two made-up experiments, a sphere and a flat: dataset, page and figure."""

from types import SimpleNamespace

import matplotlib.pyplot as plt
import numpy as np
import pytest
from helpers.experiments import known, make_experiments, observe, seen

from experiments import plot_experiments, predict_experiments, texts
from experiments.entries import OBSERVED_UNITS
from experiments.judgements import COMPATIBLE, MISSED, SILENT, SOME
from experiments.predictions import ROUGHNESS
from stickiness import datasets
from stickiness import error_budget as budget
from stickiness.remaining import predict
from stickiness.spectrum.kinds import SelfAffine

CASES = ["ball/limit", "ball/work", "plate/steel"]


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """What the rule makes: dataset and page."""
    folder = tmp_path_factory.mktemp("experiments")
    job = SimpleNamespace(
        output=SimpleNamespace(dataset=str(folder / "x.nc"), table=str(folder / "x.md")),
        params=SimpleNamespace(experiments=make_experiments()),
    )
    predict_experiments.main(job)
    return folder


@pytest.fixture(scope="module")
def dataset(made):
    return datasets.read(made / "x.nc")


@pytest.fixture(scope="module")
def page(made):
    return (made / "x.md").read_text(encoding="utf-8")


def test_every_case_is_there_with_what_it_was_made_from(dataset):
    assert dataset.case.values.tolist() == CASES
    assert datasets.parameters(dataset)["experiments"] == make_experiments()
    assert dataset["quantity"].values.tolist() == [
        "limiting_roughness",
        "work_of_separation",
        "sticks",
    ]
    for name, variable in dataset.variables.items():
        assert "long_name" in variable.attrs, name
        assert variable.dtype.kind in "OU" or "units" in variable.attrs, name


def test_observations_are_in_si_units_and_of_one_quantity(dataset):
    expected = {"ball/limit": (1e-6, 4e-6), "ball/work": (0.03, 0.03), "plate/steel": (0.0, 0.0)}
    for case, limits in expected.items():
        point = dataset.sel(case=case)
        for name in OBSERVED_UNITS:
            found = [float(point[f"observed_{name}_{end}"]) for end in ("low", "high")]
            if name == point["quantity"].item():
                assert found == pytest.approx(limits, rel=1e-12)
            else:
                assert np.isnan(found).all()


@pytest.mark.parametrize("name", predict_experiments.QUOTED)
def test_limits_are_in_order(dataset, name):
    ends = [dataset[f"{name}{end}"] for end in ("_lowest", "_low", "", "_high", "_highest")]
    for less, more in zip(ends[:-1], ends[1:], strict=True):
        assert np.all(less <= more), (less.name, more.name)
    if name != "relative_pull_off":  # nothing is left of that of the plate
        assert np.all(ends[0] < ends[-1])


def test_curves_are_in_order_along_the_roughness(dataset):
    np.testing.assert_allclose(dataset.roughness, ROUGHNESS)
    ends = [dataset[f"pull_off_curve{end}"] for end in ("_lowest", "_low", "", "_high", "_highest")]
    for less, more in zip(ends[:-1], ends[1:], strict=True):
        assert np.all(less <= more)
    assert ends[2].dims == ("case", "roughness")


@pytest.mark.parametrize("name", predict_experiments.QUOTED)
def test_budgets_hold_the_limits(dataset, name):
    parts = dataset[f"{name}_error"]
    assert list(parts.source.values) == list(budget.SOURCES)
    value = dataset[name]
    model = np.maximum(dataset[f"{name}_high"] - value, value - dataset[f"{name}_low"])
    np.testing.assert_allclose(parts.sel(source="model"), model)
    reach = np.maximum(dataset[f"{name}_highest"] - value, value - dataset[f"{name}_lowest"])
    np.testing.assert_allclose(dataset[f"{name}_total_error"], reach, rtol=1e-6)
    assert np.all(parts.sel(source=["solver", "discretisation", "bandwidth"]) == 0)


def test_the_flat_is_predicted_as_by_the_library(dataset):
    q0, q1 = 2 * np.pi / 1e-4, 2 * np.pi / 1e-6
    s = SelfAffine(hurst=0.8, q0=q0, q1=q1, h_rms=1e-6)
    modulus = np.sqrt(100e9 * 200e9)  # the geometric middle
    expected = predict(s, 0.05 / modulus, 0.3e-9)
    plate = dataset.sel(case="plate/steel")
    assert float(plate.remaining) == pytest.approx(expected.separation, abs=1e-9)
    assert float(plate.energy_ratio) == pytest.approx(expected.energy_ratio, rel=1e-6)
    assert float(plate.remaining_highest) < 0.1
    assert int(plate.outcome) == COMPATIBLE
    assert np.isnan(float(plate.waves_in_contact))


def test_the_limiting_roughness_of_the_plate_is_where_a_tenth_remains(dataset):
    """Between flats, and of the value; criteria's roughness is read off the coarser heights."""
    plate = dataset.sel(case="plate/steel")
    h = float(plate.limiting_roughness)
    q0, q1 = 2 * np.pi / 1e-4, 2 * np.pi / 1e-6
    s = SelfAffine(hurst=0.8, q0=q0, q1=q1, h_rms=h)
    found = predict(s, 0.05 / np.sqrt(100e9 * 200e9), 0.3e-9)
    assert found.separation == pytest.approx(0.1, rel=0.1)
    limit = float(plate.criterion_roughness.sel(criterion="remaining_adhesion"))
    assert limit == pytest.approx(h, rel=0.02)


def test_rms_heights_are_those_given_or_the_limiting_one(dataset):
    limit = float(dataset.limiting_roughness.sel(case="ball/limit"))
    np.testing.assert_allclose(dataset.h_rms, [limit, 1e-6, 1e-6])
    np.testing.assert_allclose(dataset.work_of_adhesion, 0.05)


def test_few_waves_are_across_the_ball(dataset):
    """Across Derjaguin's zone, which is wider than JKR's contact with the work that remains."""
    ball = dataset.sel(case="ball/work")
    held = float(ball.work_of_separation) / 1e6
    contact = np.cbrt(9 * np.pi / 8 * held * 5e-3**2)
    distance = 0.3e-9 + 1.25 * float(ball.energy_ratio) ** 0.25 * 1e-6
    zone = np.sqrt(2 * 5e-3 * distance)
    assert zone > contact
    expected = 2 * zone / np.sqrt(50e-6 * 100e-6)
    assert float(ball.waves_in_contact) == pytest.approx(expected, rel=1e-6)


def test_relations_and_unpublished_answers_are_no_tests(dataset):
    assert dataset.tests.values.tolist() == [1, 1, 1]
    assert dataset.by_relation.values.tolist() == [0, 0, 0]
    relation = seen("work_of_separation", relation="cycle_loss", factor=[1.0, 1.4])
    for observed, published, expected in (
        (relation, True, (1, 0)),
        (seen("sticks", True), False, (0, 0)),
        (seen("sticks", True), True, (0, 1)),
    ):
        observation = observe(observed, h_rms=known("1 um"), published=published)
        case = predict_experiments.predict_case(observation)
        assert (int(case.by_relation), int(case.tests)) == expected


def test_the_value_itself_is_held_against_what_was_observed(dataset):
    for case, (low, high) in {"ball/limit": (1e-6, 4e-6), "ball/work": (0.03, 0.03)}.items():
        point = dataset.sel(case=case)
        value = float(point[point["quantity"].item()])
        assert int(point.value_inside) == (low <= value <= high)
    assert int(dataset.value_inside.sel(case="plate/steel")) == 1
    assert set(dataset.value_inside.values.tolist()) == {0, 1}


@pytest.mark.parametrize(
    ("effects", "name", "effect", "of_shortest"),
    [
        ({}, "", 1.0, 1.0),
        ({"hurst": 1.5, "range": 3.0}, "range", 3.0, 1.0),
        ({"hurst": 1.5, "shortest_wavelength": np.inf}, "shortest_wavelength", 1e9, 1e9),
        ({"hurst": 1.5, "shortest_wavelength": np.nan}, "hurst", 1.5, np.nan),
        ({"hurst": np.nan, "range": np.nan}, "", np.nan, 1.0),
    ],
)
def test_the_largest_effect_is_kept_finite(effects, name, effect, of_shortest):
    found = predict_experiments.describe_effects(effects)
    assert found["most_effective_input"] == name
    assert found["effect_of_input"] == pytest.approx(effect, nan_ok=True)
    assert found["effect_of_shortest_wave"] == pytest.approx(of_shortest, nan_ok=True)


@pytest.mark.parametrize(
    ("low", "high", "limits"),
    [
        ([0.2, np.nan, 0.1], [0.3, 0.5, np.nan], (0.1, 0.5)),
        ([np.nan] * 3, [np.nan] * 3, (np.nan, np.nan)),
    ],
)
def test_limits_over_all_inputs_are_of_what_is_known(low, high, limits):
    found = predict_experiments.quote("x", np.array([low, [0.25, 0.4, 0.3], high]))
    assert (found["x_lowest"], found["x_highest"]) == pytest.approx(limits, nan_ok=True)
    middle = found["x_low"], found["x"], found["x_high"]
    assert middle == pytest.approx((low[0], 0.25, high[0]), nan_ok=True)


def test_what_matters_most_is_named(dataset):
    assert dataset.most_effective_input.values.tolist()[:2] == ["longest_wavelength"] * 2
    # The energy of full contact goes with q0 h_rms^2, so that the roughness goes with its root.
    effect = float(dataset.effect_of_input.sel(case="ball/limit"))
    assert effect == pytest.approx(np.sqrt(2), rel=0.05)
    assert np.all(dataset.effect_of_shortest_wave == 1)  # which is known here


def test_the_least_known_input_is_kept(dataset):
    assert dataset.known.values.tolist() == [3, 3, 3]  # assumed
    assert dataset.observed_known.values.tolist() == [2, 1, 2]


def test_criteria_are_judged_and_their_roughness_is_kept(dataset):
    assert set(np.unique(dataset.criterion_outcome)) <= {SILENT, MISSED, SOME, COMPATIBLE}
    steel = dataset.criterion_outcome.sel(case="plate/steel")
    assert int(steel.sel(criterion="dahlquist")) == COMPATIBLE
    limit = dataset.sel(case="ball/limit")
    assert int(limit.criterion_outcome.sel(criterion="dahlquist")) == SILENT
    assert np.isnan(limit.criterion_roughness.sel(criterion="dahlquist"))
    s = SelfAffine(hurst=0.8, q0=2 * np.pi / np.sqrt(50e-6 * 100e-6), q1=2 * np.pi / 1e-6, h_rms=1)
    expected = np.sqrt(0.05 / 1e6 / s.elastic_energy())
    found = float(limit.criterion_roughness.sel(criterion="persson_tosatti"))
    assert found == pytest.approx(expected, rel=1e-6)


def test_nothing_is_missing_when_no_input_is_unknown(tmp_path):
    """A table of one experiment, all of whose inputs were read."""
    plate = make_experiments()["plate"] | {"plane_strain_modulus": known("115 GPa")}
    output = SimpleNamespace(dataset=str(tmp_path / "x.nc"), table=str(tmp_path / "x.md"))
    params = SimpleNamespace(experiments={"plate": plate})
    predict_experiments.main(SimpleNamespace(output=output, params=params))
    found = datasets.read(output.dataset).squeeze()
    assert found.most_effective_input.item() == ""
    assert float(found.remaining_low) == float(found.remaining_lowest)
    assert "| no unknown input |" in (tmp_path / "x.md").read_text(encoding="utf-8")


def test_the_page_has_every_case_miss_and_source(dataset, page):
    rows = [line for line in page.splitlines() if line.startswith("| ")]
    for case in texts.describe(dataset)["cases"]:
        (row,) = (r for r in rows if f"| {case['case']} |" in r)
        for text in (
            "experiment",
            "quantity",
            "observed",
            "predicted",
            "outcome",
            "depends",
            "waves",
        ):
            assert case[text] in row
    # Cases by their short names, and experiments by what survives them.
    for start, count in (("Ball 1999", 2), ("soft ball", 1), ("hard plate", 2)):
        assert sum(row.startswith(f"| {start} |") for row in rows) == count
    for line in (
        "- soft ball: the color of the ball",
        "- soft ball: Ball, J. Made Up 1, 2 (1999)",
        "- hard plate: no source",
    ):
        assert line in page
    assert "at least 10 % of its adhesion remains" in page
    assert "a work of adhesion within a factor of 4 of the actual\none." in page
    assert "about 5 or more" in page
    assert texts.count_outcomes(dataset) in page
    assert "| recalled; inputs assumed |" in page
    assert "—" not in page
    assert "nan" not in page.lower()


def test_only_misses_are_explained_on_the_page(dataset, page):
    missed = set(np.array(CASES)[dataset.outcome.values == MISSED])
    assert ("the ball was wet" in page) == any(case.startswith("ball") for case in missed)
    assert ("\n# Missed\n" in page) == bool(missed)


def remember(panel, shown):
    """What draws a panel, and keeps it."""
    draw = getattr(plot_experiments, f"draw_{panel}")

    def spy(ax, *rest):
        shown[panel] = ax
        draw(ax, *rest)

    return spy


@pytest.mark.slow
def test_the_figure_shows_the_curve_the_works_and_every_mark(made, dataset, monkeypatch):
    monkeypatch.setattr(plot_experiments, "FOLLOWED", "ball")
    shown = {}
    for panel in ("pull_off", "works", "criteria"):
        monkeypatch.setattr(plot_experiments, f"draw_{panel}", remember(panel, shown))
    files = [str(made / name) for name in ("x.png", "x.pdf")]
    plot_experiments.main(SimpleNamespace(input=[str(made / "x.nc")], output=files))
    for file, start in zip(files, (b"\x89PNG", b"%PDF"), strict=True):
        with open(file, "rb") as stream:
            assert stream.read(4) == start
    lines = [line.get_xydata() for line in shown["pull_off"].lines]
    curve = np.transpose([ROUGHNESS * 1e6, dataset.pull_off_curve.sel(case="ball/limit")])
    assert any(line.shape == curve.shape and np.allclose(line, curve) for line in lines)
    pairs = [line for line in lines if line.shape == (2, 2)]
    observed = [line for line in pairs if np.allclose(line[:, 0], [1.0, 4.0])]
    (level,) = {value for line in observed for value in line[:, 1]}
    assert level == pytest.approx(0.1, rel=0.1)
    work = 1e3 * dataset.work_of_separation.sel(case="ball/work").item()
    points = [line for line in shown["works"].lines if len(line.get_xdata()) == 1]
    assert [tuple(np.ravel(point.get_data())) for point in points] == [
        pytest.approx((30.0, work), rel=1e-9)
    ]
    marks = [text.get_text() for text in shown["criteria"].texts]
    assert marks == [texts.MARKS[int(code)] for code in dataset.criterion_outcome.values.ravel()]
    names = [label.get_text() for label in shown["criteria"].get_yticklabels()]
    assert names == ["Ball 1999: lost", "Ball 1999: held", "steel on steel"]
    plt.close("all")


def test_an_observed_pull_off_is_drawn_at_its_roughness():
    observation = observe(
        seen("relative_pull_off", [0.0, 0.1]), h_rms=known("2 um"), radius=known("5 mm")
    )
    case = predict_experiments.predict_case(observation)
    _, ax = plt.subplots()
    plot_experiments.draw_observed(ax, case.assign_coords(roughness=ROUGHNESS), "red")
    (line,) = ax.lines
    np.testing.assert_allclose(line.get_xydata(), [[2.0, 0.005], [2.0, 0.1]])
    plt.close("all")
