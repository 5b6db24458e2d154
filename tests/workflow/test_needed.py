"""A case runs what its quantities need and nothing else."""

import pytest
from helpers.copy_workflow import SURFACES

pytestmark = pytest.mark.workflow


def cases(workflow, text):
    """Add cases to the tiny configuration."""
    workflow.add(f"cases:\n{text}")


def test_a_verdict_needs_no_simulation(fresh):
    assert fresh.planned("verdicts") == {"analyse_surface": len(SURFACES), "judge": 1}


def test_the_page_of_a_surface_runs_no_other(fresh):
    planned = fresh.planned("results/tiny/report/surfaces/asphalt.html")
    assert planned == {"analyse_surface": 1, "judge_surface": 1, "write_surface": 1}


def test_a_case_of_theory_needs_no_surfaces(fresh):
    cases(fresh, "  mine: {surface: H0.7_zeta64, pressures: [0.05], model: theory}\n")
    planned = fresh.planned("results/tiny/cases/mine.nc")
    assert planned == {"persson_lattice": 1, "answer_case": 1}


def test_area_alone_needs_no_fits_and_no_theory(fresh):
    cases(fresh, "  mine: {surface: H0.7_zeta64, pressures: [0.05], quantities: [area]}\n")
    planned = fresh.planned("results/tiny/cases/mine.nc")
    assert planned == {
        "synthesise_surface": 1,
        "solve_repulsive": 1,
        "solve_coarse": 1,
        "average_ensemble": 1,
        "answer_case": 1,
    }


def test_quantities_bring_their_own_fits(fresh):
    cases(fresh, "  mine: {surface: H0.7_zeta64, pressures: [0.05], quantities: [a_v, kappa]}\n")
    planned = fresh.planned("results/tiny/cases/mine.nc")
    assert planned["fit_a_v"] == 1
    assert "persson_lattice" not in planned


def test_cases_on_the_same_realisations_share_them(fresh):
    """The loads of the second case are among those of the first, which is another one's whole."""
    cases(
        fresh,
        "  mine: {surface: H0.7_zeta64, pressures: [0.05, 0.1]}\n"
        "  also_mine: {surface: H0.7_zeta64, pressures: [0.1], quantities: [area, a_v]}\n",
    )
    both = [f"results/tiny/cases/{name}.nc" for name in ("mine", "also_mine")]
    planned = fresh.planned(*both)
    assert planned["synthesise_surface"] == planned["solve_repulsive"] == 1
    assert planned["solve_coarse"] == 1
    assert planned["average_ensemble"] == planned["answer_case"] == 2


def test_accuracy_has_its_own_grid_and_seeds(fresh):
    """Three plain seeds or more on whatever grid; not those of the tiny preset."""
    cases(
        fresh,
        "  rough: {surface: H0.7_zeta64, pressures: [0.05], accuracy: 0.3, quantities: [area]}\n"
        "  close: {surface: H0.7_zeta64, pressures: [0.05], accuracy: 0.1, quantities: [area]}\n",
    )
    rough, close = (fresh.planned(f"results/tiny/cases/{name}.nc") for name in ("rough", "close"))
    assert "fit_a_v" not in close
    work = [plan["solve_repulsive"] + 10 * plan.get("solve_coarse", 0) for plan in (rough, close)]
    assert work[0] < work[1]


def test_a_case_of_area_alone_runs(fresh):
    """Not a dry-run: files without attractive areas go through every stage."""
    from stickiness import datasets

    cases(
        fresh,
        "  mine:\n    surface: H0.7_zeta64\n    pressures: [0.05, 0.1]\n"
        "    quantities: [area, mean_gap]\n",
    )
    done = fresh.snakemake("results/tiny/cases/mine.nc")
    assert done.returncode == 0, done.stdout
    answer = datasets.read(fresh / "results/tiny/cases/mine.nc")
    assert list(answer.column.values) == ["area", "mean_gap"]
    area = answer.sel(column="area")
    assert (area.value < [0.2, 0.4]).all()
    ensemble = datasets.read(fresh / "results/tiny/contact/ensembles/mine.nc")
    assert "attractive_area" not in ensemble
    assert (area.value.values == ensemble.area_fraction_mean.values).all()
    # Magnification 8 is below what was measured.
    assert (answer.extrapolated == 1).all()
