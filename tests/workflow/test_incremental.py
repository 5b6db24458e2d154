"""What a change re-runs, and that it is no more than that."""

import os
import re
import subprocess
import sys
import time

import pytest
import yaml
from helpers.copy_workflow import SURFACES as REAL_SURFACES
from snakemake.utils import update_config

from stickiness import datasets

pytestmark = pytest.mark.workflow

SEEDS, CASES, SURFACES = 2, 6, 6
SMALLEST = "{hurst: 0.8, magnification: 32}"  # of the measured errors of the DMT limit
MULTILEVEL = 5  # cases with coarse solutions
COMPARISONS = 1  # further surfaces on which theory is compared with simulation
ADHESIVE = 6  # sets of adhesive parameters


def test_clean_run_has_no_warnings(finished):
    """A complete run says nothing that a user would have to look into."""
    assert re.search(r"(\d+) of \1 steps \(100%\) done", finished.run.stdout), "not every job ran"
    assert "warning" not in finished.run.stdout.lower()
    for log in (finished / "results/tiny/logs").rglob("*.log"):
        text = log.read_text(encoding="utf-8")
        assert "WARNING" not in text, log
        assert "ERROR" not in text, log


def test_every_rule_logs_and_benchmarks(finished):
    logs = {p.relative_to(finished / "results/tiny/logs").parts[0] for p in logs_of(finished)}
    assert len(logs) >= 20
    assert list((finished / "results/tiny/benchmarks").rglob("*.tsv"))


def logs_of(workflow):
    return list((workflow / "results/tiny/logs").rglob("*.log"))


def test_touching_nothing_runs_nothing(finished):
    assert finished.planned() == {}


def test_editing_a_material_reruns_verdicts_and_report(copy_of_finished):
    copy_of_finished.edit("config/materials.yaml", '"40 mJ/m^2"', '"45 mJ/m^2"')
    planned = set(copy_of_finished.planned())
    # A claim is on what holds for practically all materials.
    assert planned == {"judge", "write_surface", "plot_fig9", "check_claims", "write_report"}


def test_editing_an_experiment_reruns_its_prediction_claims_and_report(copy_of_finished):
    copy_of_finished.edit("config/experiments.yaml", '"37 mJ/m^2"', '"38 mJ/m^2"')
    planned = set(copy_of_finished.planned())
    assert planned == {"predict_experiments", "plot_experiments", "check_claims", "write_report"}


def test_changing_the_loads_of_the_case_of_a_v_reruns_its_maps_and_no_verdict(copy_of_finished):
    copy_of_finished.edit(
        "config/tiny.yaml",
        "theory:\n",
        "cases:\n  H0.8_zeta32_wide: {pressures: [0.03, 0.065]}\ntheory:\n",
    )
    planned = copy_of_finished.planned("fig5")
    assert planned["solve_repulsive"] == 1
    assert {"fit_a_v", "map_criterion"} <= planned.keys()
    assert copy_of_finished.planned("verdicts") == {}


def test_adding_a_surface_judges_that_surface_alone(copy_of_finished):
    with (copy_of_finished / "config/tiny_surfaces.yaml").open("a", encoding="utf-8") as file:
        file.write(
            "  mine: {kind: self_affine, label: mine, source: own, hurst: 0.8, h_rms: 1 um, "
            "longest_wavelength: 1 mm, shortest_wavelength: 1 um}\n"
        )
    planned = copy_of_finished.planned("results/tiny/report/surfaces/mine.html")
    assert planned == {"analyse_surface": 1, "write_surface": 1}


def test_adding_a_seed_runs_its_file_and_its_averages(copy_of_finished):
    copy_of_finished.edit("config/tiny.yaml", "seeds: 2", "seeds: 3")
    planned = copy_of_finished.planned()
    assert planned["synthesise_surface"] == SURFACES
    assert planned["solve_repulsive"] == CASES
    assert planned["average_ensemble"] == CASES
    unaffected = {"persson_sweep", "persson_lattice", "analyse_surface", "judge"}
    unaffected.add("solve_coarse")  # the new seed is solved on the coarse grid by its own job
    assert unaffected.isdisjoint(planned)


def test_adding_a_seed_to_one_case_leaves_the_others(copy_of_finished):
    with (copy_of_finished / "config/tiny.yaml").open("a", encoding="utf-8") as file:
        file.write("cases:\n  H0.9_zeta64: {seeds: 3}\n")
    planned = copy_of_finished.planned()
    assert planned["synthesise_surface"] == planned["solve_repulsive"] == 1
    assert planned["average_ensemble"] == 1


def test_more_coarse_seeds_leave_the_fine_solutions(copy_of_finished):
    copy_of_finished.edit("config/tiny.yaml", "coarse_seeds: 32", "coarse_seeds: 40")
    planned = copy_of_finished.planned()
    assert planned["solve_coarse"] == MULTILEVEL
    assert planned["average_ensemble"] == MULTILEVEL
    assert {"synthesise_surface", "solve_repulsive", "persson_lattice"}.isdisjoint(planned)


def test_a_case_that_takes_plain_means_is_only_averaged_again(copy_of_finished):
    with (copy_of_finished / "config/tiny.yaml").open("a", encoding="utf-8") as file:
        file.write("cases:\n  H0.9_zeta64: {sampling: plain}\n")
    planned = copy_of_finished.planned()
    assert planned["average_ensemble"] == 1
    assert {"synthesise_surface", "solve_repulsive", "solve_coarse"}.isdisjoint(planned)


@pytest.mark.parametrize(
    ("module", "reruns", "leaves"),
    [
        (
            "persson/theory.py",
            {"persson_sweep": 6, "persson_lattice": CASES + COMPARISONS},
            {"synthesise_surface", "solve_repulsive", "analyse_surface", "average_ensemble"},
        ),
        (
            "contact/solver.py",
            {"solve_repulsive": CASES, "solve_coarse": MULTILEVEL, "contact_maps": 1},
            {"synthesise_surface", "persson_sweep", "persson_lattice", "analyse_surface"},
        ),
        (
            "accuracy/multilevel.py",
            {"solve_coarse": MULTILEVEL, "average_ensemble": CASES},
            {"synthesise_surface", "solve_repulsive", "persson_table", "analyse_surface"},
        ),
        (
            "adhesion/edge_zone.py",
            {"solve_adhesive": ADHESIVE, "average_adhesive": ADHESIVE, "follow_loop": 1},
            {"solve_repulsive", "persson_sweep", "analyse_surface", "average_ensemble"},
        ),
        (
            "measured/topography.py",
            {"analyse_surface": len(REAL_SURFACES)},
            {"synthesise_surface", "solve_repulsive", "persson_sweep", "fit_a_v"},
        ),
        (
            "criteria/errata.py",
            {"check_claims": 1},
            {"judge", "solve_repulsive", "persson_sweep", "fit_a_v", "analyse_surface"},
        ),
    ],
)
def test_changing_a_module_reruns_the_stages_that_use_it(copy_of_finished, module, reruns, leaves):
    with (copy_of_finished / "scripts/stickiness" / module).open("a", encoding="utf-8") as file:
        file.write("\nA_CHANGE = 1\n")
    planned = copy_of_finished.planned()
    assert reruns.items() <= planned.items(), planned
    assert leaves.isdisjoint(planned), planned


def test_comments_docstrings_and_times_of_change_rerun_nothing(copy_of_finished):
    time.sleep(1.1)  # file systems with whole-second time stamps
    for file in (copy_of_finished / "scripts").rglob("*.py"):
        text = file.read_text(encoding="utf-8")
        file.write_text(text.replace('"""', '"""Other words. ', 1) + "\n# A comment.\n")
    assert copy_of_finished.planned() == {}


@pytest.mark.parametrize(
    ("targets", "expected", "absent"),
    [
        ("fig3", {"plot_fig3": 1, "solve_repulsive": CASES}, {"analyse_surface", "judge"}),
        (
            "fig6 results/tiny/persson/sweeps/fig1a.nc",
            {"plot_fig6": 1, "analyse_surface": len(REAL_SURFACES), "persson_sweep": 1},
            {"solve_repulsive", "judge"},
        ),
        ("claims", {"check_claims": 1}, {"plot_fig1", "write_report"}),
        (
            "experiments",
            {"predict_experiments": 1, "plot_experiments": 1},
            {"solve_repulsive", "judge", "check_claims", "write_report"},
        ),
        (
            "results/tiny/contact/ensembles/H0.9_zeta64.nc",
            {
                "synthesise_surface": 1,
                "solve_repulsive": 1,
                "solve_coarse": 1,
                "average_ensemble": 1,
            },
            {"persson_sweep"},
        ),
    ],
)
def test_targets(fresh, targets, expected, absent):
    planned = fresh.planned(*targets.split())
    assert expected.items() <= planned.items(), planned
    assert absent.isdisjoint(planned), planned


def test_full_adhesion_is_solved_only_where_the_dmt_limit_is_not_good_enough(fresh):
    asked = {
        "rough": "model: auto, accuracy: 0.15",
        "close": "model: auto, accuracy: 0.01",
        "limit": "model: dmt",
        "full": "model: full",
    }
    fresh.edit("config/tiny.yaml", "{hurst: 0.8, magnification: 4}", SMALLEST)
    with (fresh / "config/tiny.yaml").open("a", encoding="utf-8") as file:
        file.write("adhesion:\n")
        for name, model in asked.items():
            file.write(
                f"  {name}: {{case: H0.8_zeta32, q0_h_rms: 0.1, range_over_h_rms: [3], "
                "adhesion_length_over_range: [0.001, 0.003], pressures: [0.0065, 0.065], "
                f"law: exponential, {model}}}\n"
            )
    done = fresh.dry_run(*(f"results/tiny/adhesion/full/{name}.nc" for name in asked))
    assert done.returncode == 0, done.stdout
    made = " ".join(re.findall("output: .*", done.stdout))
    outputs = re.findall(r"results/tiny/adhesion/(\S+)\.nc", made)
    assert {output for output in outputs if "/seeds" in output} == {
        f"full/{name}/seeds1-{SEEDS}" for name in ("close", "full")
    }
    for name in asked:
        assert outputs.count(f"dmt/{name}") == outputs.count(f"full/{name}") == 1


def test_a_script_runs_by_hand(copy_of_finished):
    target = copy_of_finished / "results/tiny/adhesion/dmt/fig2.nc"
    before = datasets.read(target)
    target.unlink()
    tiny, config = (copy_of_finished / f"config/{name}.yaml" for name in ("tiny", "config"))
    merged = yaml.safe_load(config.read_text(encoding="utf-8"))
    update_config(merged, yaml.safe_load(tiny.read_text(encoding="utf-8")))
    config.write_text(yaml.safe_dump(merged), encoding="utf-8")
    run = subprocess.run(
        [sys.executable, "scripts/adhesion/average_adhesive.py", "adhesion=fig2"],
        cwd=copy_of_finished.folder,
        env={**os.environ, "PYTHONPATH": "scripts"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    assert datasets.read(target).equals(before)
