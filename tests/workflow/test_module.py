"""Other workflows use this one as a module, from a folder and from git, with a few own keys."""

import os
import shutil
import subprocess
import sys

import pytest
from helpers.copy_workflow import PARTS, ROOT
from helpers.dry_runs import dry_run, jobs

pytestmark = pytest.mark.workflow

EXAMPLE = ROOT / "examples/module"
PAGE = "results/stickiness/draft/report/surfaces/my_wall.html"
# What `snakedeploy deploy-workflow` 0.17 writes to workflow/Snakefile.
DEPLOYED = """
from snakemake.utils import min_version


min_version("6.10.0")


configfile: "config/config.yaml"


# declare https://github.com/someone/stickiness as a module
module stickiness:
    snakefile:
        github("someone/stickiness", path="Snakefile", tag="v1")
    config:
        config


# use all rules from https://github.com/someone/stickiness
use rule * from stickiness
"""


def snakemake(folder, *arguments, **environment):
    return subprocess.run(
        [sys.executable, "-m", "snakemake", "-j2", *arguments],
        cwd=folder,
        env=os.environ | environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=600,
        check=False,
    )


@pytest.fixture
def folder(tmp_path):
    """A folder with the configuration of the example."""
    shutil.copytree(EXAMPLE / "config", tmp_path / "config")
    return tmp_path


@pytest.fixture(scope="module")
def repository(tmp_path_factory):
    """The project as it stands, in a git repository with a tag."""
    place = tmp_path_factory.mktemp("git")
    for part in (*PARTS, ".snakemake-workflow-catalog.yml", "LICENSE"):
        if (ROOT / part).is_dir():
            ignore = shutil.ignore_patterns("__pycache__")
            shutil.copytree(ROOT / part, place / part, ignore=ignore)
        else:
            shutil.copy2(ROOT / part, place / part)
    git = ["git", "-c", "user.name=test", "-c", "user.email=test"]
    for command in (["init", "-q"], ["add", "."], ["commit", "-qm", "all"], ["tag", "v1"]):
        subprocess.run([*git, *command], cwd=place, check=True)
    return place


def test_example_runs(folder):
    """Materials and surfaces of its own, one of them made by a rule of its own."""
    done = snakemake(folder, "-s", EXAMPLE / "Snakefile")
    assert done.returncode == 0, done.stdout
    answers = (folder / "results/answer.txt").read_text(encoding="utf-8").splitlines()
    assert len(answers) == 2
    assert "firm tape" in answers[0] + answers[1]
    assert (folder / PAGE).stat().st_size > 100_000
    assert {path.name for path in folder.iterdir()} == {"config", "data", "results", ".snakemake"}
    assert {path.name for path in (folder / "results").iterdir()} == {"stickiness", "answer.txt"}
    logs = folder / "results/stickiness/draft/logs"
    assert {path.name for path in logs.iterdir()} == {
        *("analyse_surface", "picture_contact", "judge", "judge_surface", "write_surface"),
    }
    again = dry_run(folder, "-s", EXAMPLE / "Snakefile")
    assert "Nothing to be done" in again.stdout, again.stdout


def test_a_prefix_holds_for_results_alone(folder):
    text = (EXAMPLE / "Snakefile").read_text(encoding="utf-8")
    text = text.replace('"../../Snakefile"', f'"{ROOT}/Snakefile"\n    prefix:\n        "deep"')
    (folder / "Snakefile").write_text(text, encoding="utf-8")
    (folder / "data").mkdir()
    (folder / "data/wall.txt").write_text("not read in a dry-run", encoding="utf-8")
    assert jobs(dry_run(folder, f"deep/{PAGE}")) == {
        "stickiness_analyse_surface": 1,
        "stickiness_picture_contact": 1,
        "stickiness_judge_surface": 1,
        "stickiness_write_surface": 1,
    }


def test_claims_say_which_surface_they_lack(folder):
    done = dry_run(folder, "-s", EXAMPLE / "Snakefile", "stickiness_claims")
    assert done.returncode != 0
    assert "config/surfaces.yaml: the claims need the surface 'asphalt'" in done.stdout
    planned = jobs(dry_run(folder, "-s", EXAMPLE / "Snakefile", "stickiness_all"))
    assert "stickiness_check_claims" not in planned
    assert planned["stickiness_plot_fig1"] == 1


def test_a_wrong_key_names_the_module(folder):
    path = folder / "config/config.yaml"
    path.write_text(path.read_text(encoding="utf-8") + "  sedes: 3\n", encoding="utf-8")
    done = dry_run(folder, "-s", EXAMPLE / "Snakefile")
    assert done.returncode != 0
    (line,) = done.stdout.strip().splitlines()
    assert line.startswith("config of module stickiness: unknown key 'sedes'")


def test_deployed_from_a_hosted_repository(repository, tmp_path):
    """Snakemake's clone of it is laid out beforehand, which saves the network."""
    cache, folder = tmp_path / "cache", tmp_path / "deployed"
    hosted = (
        cache / "snakemake/snakemake/source-cache/snakemake-git-cache/github.com/someone/stickiness"
    )
    subprocess.run(["git", "clone", "-q", "--bare", repository, hosted], check=True)
    for part in ("config", "profiles"):
        shutil.copytree(repository / part, folder / part)
    (folder / "workflow").mkdir()
    (folder / "workflow/Snakefile").write_text(DEPLOYED, encoding="utf-8")
    page = "results/draft/report/surfaces/asphalt.html"
    done = snakemake(folder, "--config", "fidelity=draft", "--", page, XDG_CACHE_HOME=str(cache))
    assert done.returncode == 0, done.stdout
    assert (folder / page).exists()
    assert len(jobs(snakemake(folder, "-n", XDG_CACHE_HOME=str(cache)))) > 40


def test_from_any_folder(tmp_path):
    """No configuration of its own at all."""
    page = "results/standard/report/surfaces/asphalt.html"
    planned = jobs(dry_run(tmp_path, "-s", ROOT / "Snakefile", page))
    assert planned == {"analyse_surface": 1, "judge_surface": 1, "write_surface": 1}
