"""What jobs ask a cluster for, how the Slurm profile groups them, and what every rule names."""

import re
from pathlib import Path

import pytest
import yaml
from helpers.dry_runs import dry_run

ROOT = Path(__file__).parents[2]
PROFILE = yaml.safe_load((ROOT / "profiles/slurm/config.yaml").read_text(encoding="utf-8"))


def ask(workflow, target):
    """Memory [MB] and time [min] that the job of a target asks for."""
    listed = workflow.dry_run(target).stdout
    resources = re.search(r"resources: (.*)", listed[listed.index(f"output: {target}") :])[1]
    return tuple(int(re.search(rf"{name}=(\d+)", resources)[1]) for name in ("mem_mb", "runtime"))


@pytest.mark.workflow
def test_a_larger_grid_asks_for_more(fresh):
    target = "results/tiny/contact/H0.7_zeta64@4_1e-06/seeds1-2_p0.0065_0.03_0.065_0.13_0.3.nc"
    small = ask(fresh, target)
    fresh.edit(
        "config/tiny.yaml", "hurst: 0.7, magnification: 8", "hurst: 0.7, magnification: 1024"
    )
    large = ask(fresh, target)
    # 4096 x 4096 doubles are 134 MB; the solver holds about 17 of them.
    assert 17 * 134 < large[0] < 40 * 134
    assert large[1] > small[1]
    assert small[0] < 1000


@pytest.mark.workflow
def test_groups_are_of_rules_that_exist_and_none_depends_on_itself(fresh):
    listed = fresh.dry_run("--list-rules")
    groups = dict(entry.split("=") for entry in PROFILE["groups"])
    components = dict(entry.split("=") for entry in PROFILE["group-components"])
    assert groups.keys() <= set(listed.stdout.split())
    assert set(groups.values()) == components.keys()
    options = ["--groups", *PROFILE["groups"], "--group-components", *PROFILE["group-components"]]
    planned = dry_run(fresh.folder, "--quiet", "all", *options)
    assert planned.returncode == 0, planned.stdout


def test_what_runs_once_for_each_case_or_surface_is_grouped():
    text = "\n".join(file.read_text(encoding="utf-8") for file in (ROOT / "rules").glob("*.smk"))
    blocks = re.split(r"^(?=rule |use rule )", text, flags=re.M)[1:]
    repeated = set()
    for block in blocks:
        name = re.match(r"rule (\w+)|use rule \w+ as (\w+)", block)
        output = re.search(r"^    output:\n(.*?)^    \w", block, flags=re.M | re.S)
        if output and re.search(r"{{(case|model_surface|real_surface)}}", output[1]):
            repeated.add(name[1] or name[2])
    groups = dict(entry.split("=") for entry in PROFILE["groups"])
    # Maps are wanted for a few cases.
    assert repeated - groups.keys() == {"contact_maps"}
    # A job that reads all cases would put them all into one Slurm job.
    assert groups["compare_theory"] not in {groups[name] for name in repeated & groups.keys()}


@pytest.mark.parametrize("file", sorted((ROOT / "rules").glob("*.smk")), ids=lambda path: path.stem)
def test_rules_say_what_they_make_with_environment_log_and_hash_of_their_script(file):
    for rule in re.split(r"^ *(?=rule\b)", file.read_text(encoding="utf-8"), flags=re.M)[1:]:
        if script := re.search(r'"\.\./(scripts/.*\.py)"', rule):
            assert re.search(r'message:\s+f?"[A-Z][^"]+"', rule)
            environment = re.search(r'conda:\s+"\.\./(.*)"', rule)[1]
            assert (ROOT / environment).is_file()
            assert re.search(r"log:\s+f\"\{\w+\}/(\{\{stage\}\}/)?logs/", rule)
            assert re.search(r"benchmark:\s+f\"\{\w+\}/(\{\{stage\}\}/)?benchmarks/", rule)
            hashed = re.search(r'code=(?:lambda wildcards: )?source_hash\(f?"(.*)"\)', rule)[1]
            assert f"scripts/{hashed}" == script[1].replace("{params.figure}", "{figure}")
