"""What jobs ask a cluster for, and how the Slurm profile groups them."""

import re
from pathlib import Path

import pytest
import yaml
from helpers.dry_runs import dry_run

pytestmark = pytest.mark.workflow

ROOT = Path(__file__).parents[2]
PROFILE = yaml.safe_load((ROOT / "profiles/slurm/config.yaml").read_text(encoding="utf-8"))


def asked(workflow, target, *options):
    """Memory [MB] and time [min] that the job of a target asks for."""
    listed = workflow.dry_run(target, *options).stdout
    output = listed.index(f"output: {target}")
    resources = re.search(r"resources: (.*)", listed[output:])[1]
    return tuple(int(re.search(rf"{name}=(\d+)", resources)[1]) for name in ("mem_mb", "runtime"))


def test_a_larger_grid_asks_for_more(fresh):
    small = asked(fresh, "results/tiny/contact/H0.7_zeta64/seeds1-2.nc")
    fresh.edit(
        "config/tiny.yaml",
        "H0.7_zeta64: {hurst: 0.7, magnification: 8}",
        "H0.7_zeta64: {hurst: 0.7, magnification: 1024}",
    )
    large = asked(fresh, "results/tiny/contact/H0.7_zeta64/seeds1-2.nc")
    # 4096 x 4096 doubles are 134 MB; the solver holds about 17 of them.
    assert 17 * 134 < large[0] < 40 * 134
    assert large[1] > small[1]
    assert small[0] < 1000


def test_groups_are_of_rules_that_exist_and_none_depends_on_itself(fresh):
    listed = fresh.dry_run("--list-rules")
    groups = dict(entry.split("=") for entry in PROFILE["groups"])
    components = dict(entry.split("=") for entry in PROFILE["group-components"])
    assert groups.keys() <= set(listed.stdout.split())
    assert set(groups.values()) == components.keys()
    options = ["--groups", *PROFILE["groups"], "--group-components", *PROFILE["group-components"]]
    planned = dry_run(fresh.folder, "--quiet", "all", *options)
    assert planned.returncode == 0, planned.stdout
