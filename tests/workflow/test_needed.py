"""A case runs what its quantities need and nothing else."""

import pytest
from helpers.copy_workflow import FEW

from stickiness import datasets

pytestmark = pytest.mark.workflow

CASE = "  {}: {{surface: H0.7_zeta64, pressures: [{}], {}}}\n"
PAGE = {"analyse_surface": 1, "judge_surface": 1, "write_surface": 1}
SIMULATION = {"synthesise_surface": 1, "solve_repulsive": 1, "solve_coarse": 1}


def plan_cases(workflow, **cases):
    """Jobs that answer these cases, each given by its loads and other keys."""
    text = "".join(CASE.format(name, *keys) for name, keys in cases.items())
    workflow.add(f"cases:\n{text}")
    return workflow.planned(*(f"results/tiny/cases/{name}.nc" for name in cases))


def test_a_verdict_needs_no_simulation_and_a_page_no_other_surface(fresh):
    count = len(FEW["surfaces"])
    planned = fresh.planned("verdicts")
    every = {"analyse_surface": count, "judge_surface": count}
    assert planned == every | {"judge": 1, "check_surfaces": 1}
    assert fresh.planned("results/tiny/report/surfaces/asphalt.html") == PAGE


@pytest.mark.parametrize(
    ("keys", "jobs"),
    [
        ("model: theory", {"persson_lattice": 1, "answer_by_theory": 1}),
        ("quantities: [area]", SIMULATION | {"answer_case": 1}),
        ("quantities: [a_v, kappa]", SIMULATION | {"answer_case": 1}),
    ],
)
def test_quantities_bring_what_they_need(fresh, keys, jobs):
    assert plan_cases(fresh, mine=("0.05", keys)) == jobs


def test_theory_is_not_compared_with_skewed_heights(fresh):
    """A case for every quantity, which is compared on Gaussian heights, needs no theory."""
    before = fresh.planned("results/tiny/fits/gamma.nc")
    surface = "  {}: {{hurst: 0.7, magnification: 8{}}}\n"
    case = "  {}: {{surface: {}, pressures: [0.05]}}\n"
    fresh.edit(
        "config/tiny.yaml",
        "model_surfaces:\n",
        "model_surfaces:\n"
        + surface.format("plain", "")
        + surface.format("honed", ", heights: {skewness: -1.0}"),
    )
    fresh.add("cases:\n" + case.format("honed", "honed") + case.format("plain", "plain"))
    planned = fresh.planned("results/tiny/fits/gamma.nc")
    assert planned["answer_case"] == before["answer_case"] + 1  # of the plain one
    assert fresh.planned("results/tiny/cases/honed.nc") == SIMULATION | {"answer_case": 1}


def test_cases_on_the_same_realisations_share_them(fresh):
    """The loads of the second case are among those of the first, which is another one's whole."""
    also = ("0.1", "quantities: [area, a_v]")
    planned = plan_cases(fresh, mine=("0.05, 0.1", "seeds: 2"), also_mine=also)
    assert SIMULATION.items() <= planned.items()
    assert planned["answer_case"] == 2


def test_a_case_of_area_alone_runs(fresh):
    """Files without attractive areas go through every stage."""
    plan_cases(fresh, mine=("0.05, 0.1", "quantities: [area, mean_gap]"))
    done = fresh.snakemake("results/tiny/cases/mine.nc")
    assert done.returncode == 0, done.stdout
    answer = datasets.read(fresh / "results/tiny/cases/mine.nc")
    assert list(answer.column.values) == ["area", "mean_gap"]
    area = answer.sel(column="area")
    assert (area.value < [0.2, 0.4]).all()
    ensemble = datasets.read(fresh / "results/tiny/contact/ensembles/mine.nc")
    assert "attractive_area" not in ensemble
    assert (area.value.values == ensemble.area_fraction_mean.values).all()
    assert (answer.extrapolated == 1).all()  # magnification 8 is below what was measured
