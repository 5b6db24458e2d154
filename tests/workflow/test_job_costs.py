"""Memory and time that jobs ask for, beside what they were measured to take."""

import csv
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from contact import solve_repulsive
from pipeline import job_cost
from stickiness.config import checks as configuration
from surfaces import synthesise_surface

ROOT = Path(__file__).parents[2]
MEASURED = ROOT / "tests/data/job_costs.csv"


def rows(rule):
    """Size, seconds, processor time and memory of every measured job of a rule."""
    with MEASURED.open(encoding="utf-8") as file:
        chosen = [row for row in csv.DictReader(file) if row["rule"] == rule]
    return [
        (
            job_cost.Work(*(int(row[name]) for name in ("stored", "solved", "solutions"))),
            *(float(row[name]) for name in ("seconds", "cpu_seconds", "max_rss_mb")),
        )
        for row in chosen
    ]


@pytest.mark.parametrize("rule", job_cost.COSTS)
def test_memory_is_not_below_what_was_measured(rule):
    measured = rows(rule)
    assert len({size.stored for size, *_ in measured}) >= 2, "says nothing about the grid"
    for size, _, _, memory in measured:
        assert memory <= job_cost.memory_mb(rule, size), size
    largest = max(measured, key=lambda row: row[0].stored)
    assert job_cost.memory_mb(rule, largest[0]) <= 1.5 * largest[3], "asks for far too much"


@pytest.mark.parametrize("rule", job_cost.COSTS)
def test_time_is_not_below_what_was_measured(rule):
    for size, seconds, processor, _ in rows(rule):
        assert processor <= job_cost.seconds(rule, size), size
        # Nor do all jobs pass for long ones. Time on the clock, of a machine that others used too.
        assert job_cost.seconds(rule, size) <= 8 * seconds, size


def test_a_finer_grid_asks_for_more():
    config = configuration.load(ROOT / "config/config.yaml")
    asked = {}
    for fidelity in ("draft", "standard", "fine"):
        size = job_cost.work(
            config | {"fidelity": fidelity}, "solve_repulsive", case="H0.8_zeta128"
        )
        asked[fidelity] = size.stored
    assert asked["fine"] == asked["standard"] == 4 * asked["draft"] == 1024**2
    size = job_cost.work(config, "solve_adhesive", adhesion="fig4b_rough", seed="1")
    asked = config["adhesion"]["fig4b_rough"]
    laws = len(asked["range_over_h_rms"]) * len(asked["adhesion_length_over_range"])
    assert size.stored == (asked.get("refine", 1) * 512) ** 2
    assert size.solutions == len(asked["pressures"]) * (1 + laws)


def test_grids_are_those_of_the_scripts():
    """A little smaller: without what the Fourier transform adds, which takes scipy to know."""
    assert job_cost.COARSE == solve_repulsive.COARSE
    for magnification in (16, 31, 67, 128, 509, 1023):
        surface = {"hurst": 0.8, "magnification": magnification}
        points = job_cost.pixels({"model_surfaces": {"one": surface}}, "one", 8)
        made = synthesise_surface.grid_points(surface, 8) ** 2
        assert points <= made <= job_cost.MEMORY_MARGIN * points


def test_profile_groups_rules_that_exist():
    profile = yaml.safe_load((ROOT / "profiles/slurm/config.yaml").read_text(encoding="utf-8"))
    rules = {
        line.removesuffix(" with:").split()[-1].rstrip(":")  # also of "use rule … as … with:"
        for file in (ROOT / "rules").glob("*.smk")
        for line in file.read_text(encoding="utf-8").splitlines()
        if line.startswith(("rule ", "use rule "))
    }
    groups = dict(entry.split("=") for entry in profile["groups"])
    components = dict(entry.split("=") for entry in profile["group-components"])
    assert groups.keys() <= rules
    assert set(groups.values()) == components.keys()


@pytest.mark.workflow
def test_no_group_of_the_profile_depends_on_itself(tmp_path):
    """Snakemake refuses groups that are left and entered again; no executor is needed to see it."""
    profile = yaml.safe_load((ROOT / "profiles/slurm/config.yaml").read_text(encoding="utf-8"))
    command = [sys.executable, "-m", "snakemake", "-n", "--quiet", "all"]
    command += ["--groups", *profile["groups"], "--group-components", *profile["group-components"]]
    command += ["--config", f"results={tmp_path}"]
    planned = subprocess.run(command, cwd=ROOT, text=True, capture_output=True, check=False)
    assert planned.returncode == 0, planned.stdout + planned.stderr
