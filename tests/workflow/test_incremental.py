"""What a change re-runs, and that it is no more than that."""

import re
import time

import pytest
from helpers.copy_workflow import copy_code

pytestmark = pytest.mark.workflow

SOLUTIONS = {"synthesise_surface", "solve_repulsive", "solve_coarse"}


def test_a_complete_run_has_no_warnings_and_leaves_nothing_to_do(finished):
    assert re.search(r"(\d+) of \1 steps \(100%\) done", finished.run.stdout), "not every job ran"
    assert "warning" not in finished.run.stdout.lower()
    logs = list((finished / "results/tiny/logs").rglob("*.log"))
    assert logs
    for log in logs:
        assert not re.search("WARNING|ERROR", log.read_text(encoding="utf-8")), log
    assert list((finished / "results/tiny/benchmarks").rglob("*.tsv"))
    assert finished.planned() == {}


# File, text and its replacement, rules that run again, rules that do not.
CHANGES = {
    "material": (
        "config/materials.yaml",
        ("{common: pdms}", '{common: pdms, work_of_adhesion: "45 mJ/m^2"}'),
        {"judge", "write_surface", "plot_fig9", "check_claims", "write_report"},
        {"analyse_surface", *SOLUTIONS},
    ),
    "label of a material": (
        "config/materials.yaml",
        ("{common: pdms}", "{common: pdms, label: silicone}"),
        {"judge", "write_surface", "write_report"},
        {"analyse_surface", "picture_contact", "plot_fig6", *SOLUTIONS},
    ),
    "label of a surface": (
        "config/tiny_surfaces.yaml",
        ("label: ultrananocrystalline diamond", "label: diamond"),
        {"judge", "write_surface", "write_report", "check_claims"},
        {"analyse_surface", "picture_contact", "plot_fig6", *SOLUTIONS},
    ),
    "experiment": (
        "config/experiments.yaml",
        ('"37 mJ/m^2"', '"38 mJ/m^2"'),
        {"predict_experiments", "check_claims", "write_report"},
        {"judge", "analyse_surface", *SOLUTIONS},
    ),
    "seed": (
        "config/tiny.yaml",
        (" seeds: 2, coarse_", " seeds: 3, coarse_"),
        {"synthesise_surface", "solve_repulsive", "answer_case"},
        {"solve_coarse", "persson_sweep", "persson_lattice", "analyse_surface", "judge"},
    ),
    "coarse seeds": (
        "config/tiny.yaml",
        ("coarse_seeds: 32", "coarse_seeds: 40"),
        {"solve_coarse", "answer_case"},
        {"synthesise_surface", "solve_repulsive", "persson_lattice"},
    ),
    "theory": (
        "scripts/stickiness/persson/theory.py",
        ("class Persson", "A_CHANGE = 1\n\n\nclass Persson"),
        # What is known of a surface includes its a_V by theory.
        {"persson_sweep", "persson_lattice", "analyse_surface"},
        {"answer_case", *SOLUTIONS},
    ),
    "solver": (
        "scripts/stickiness/repulsive/solver.py",
        ("def solve(", "A_CHANGE = 1\n\n\ndef solve("),
        # Contact is simulated on measured heights, too.
        {"solve_repulsive", "solve_coarse", "contact_maps", "analyse_surface"},
        {"synthesise_surface"},
    ),
}


@pytest.mark.parametrize(("path", "texts", "reruns", "leaves"), CHANGES.values(), ids=CHANGES)
def test_a_change_reruns_what_uses_it(copy_of_finished, path, texts, reruns, leaves):
    copy_of_finished.edit(path, *texts)
    planned = copy_of_finished.planned().keys()
    assert reruns <= planned
    assert leaves.isdisjoint(planned)


def test_changes_of_cases_rerun_those_cases_and_what_averages_them(copy_of_finished):
    """Loads of one case, a seed for one, plain means for one; then a seed for all."""
    copy_of_finished.add("cases:\n  H0.8_zeta32_wide: {pressures: [0.03, 0.065]}\n")
    planned = copy_of_finished.planned("fig5")
    assert planned["solve_repulsive"] == 1
    assert {"answer_case", "map_criterion"} <= planned.keys()
    assert copy_of_finished.planned("verdicts") == {}

    copy_of_finished.edit(
        "config/tiny.yaml",
        "H0.8_zeta32_wide: {pressures: [0.03, 0.065]}",
        "H0.9_zeta64: {seeds: 3}",
    )
    planned = copy_of_finished.planned()
    assert planned["synthesise_surface"] == planned["solve_repulsive"] == 1
    assert planned["answer_case"] == 1

    copy_of_finished.edit("config/tiny.yaml", "{seeds: 3}", "{sampling: plain}")
    planned = copy_of_finished.planned()
    assert planned["answer_case"] == 1
    assert SOLUTIONS.isdisjoint(planned)


def test_a_new_case_leaves_the_figures_of_other_cases(copy_of_finished):
    copy_of_finished.add("cases:\n  mine: {surface: H0.7_zeta64, pressures: [0.05]}\n")
    assert copy_of_finished.planned("fig1", "fig2", "fig4") == {}
    assert copy_of_finished.planned("results/tiny/persson/lattice/mine.nc") == {
        "persson_lattice": 1
    }


def test_comments_docstrings_and_times_of_change_rerun_nothing(copy_of_finished):
    time.sleep(1.1)  # file systems with whole-second time stamps
    copy_code(copy_of_finished.folder)
    for file in (copy_of_finished / "scripts").rglob("*.py"):
        text = file.read_text(encoding="utf-8")
        file.write_text(text.replace('"""', '"""Other words. ', 1) + "\n# A comment.\n")
    assert copy_of_finished.planned() == {}


@pytest.mark.parametrize(
    ("targets", "runs", "leaves"),
    [
        ("fig3", {"plot_fig3", "solve_repulsive"}, {"analyse_surface", "judge"}),
        ("claims", {"check_claims"}, {"plot_fig1", "write_report"}),
        ("experiments", {"predict_experiments"}, {"solve_repulsive", "judge", "check_claims"}),
        (
            "fig6 results/tiny/persson/sweeps/fig1a.nc",
            {"plot_fig6", "analyse_surface", "persson_sweep"},
            {"solve_repulsive", "judge"},
        ),
    ],
)
def test_targets_run_what_they_need(fresh, targets, runs, leaves):
    planned = fresh.planned(*targets.split()).keys()
    assert runs <= planned
    assert leaves.isdisjoint(planned)


def test_adhesion_is_solved_in_full_only_where_the_dmt_limit_is_not_good_enough(fresh):
    models = {
        "rough": "model: auto, accuracy: 0.15",
        "close": "model: auto, accuracy: 0.01",
        "limit": "model: dmt",
        "full": "model: full",
    }
    # The least rough of the surfaces on which the error of the DMT sum was measured.
    fresh.edit(
        "config/tiny.yaml", "{hurst: 0.8, magnification: 4}", "{hurst: 0.8, magnification: 32}"
    )
    for name, model in models.items():
        fresh.add(
            f"  {name}: {{case: H0.8_zeta32, q0_h_rms: 0.1, range_over_h_rms: [3], "
            "adhesion_length_over_range: [0.001, 0.003], pressures: [0.0065, 0.065], "
            f"law: exponential, {model}}}\n"
        )
    done = fresh.dry_run(*(f"results/tiny/adhesion/full/{name}.nc" for name in models))
    assert done.returncode == 0, done.stdout
    solved = re.findall(r"Solve contact with adhesion: (\w+), seeds", done.stdout)
    assert set(solved) == {"close", "full"}
