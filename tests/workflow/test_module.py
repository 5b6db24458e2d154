"""Other workflows use this one as a module, from a folder and from git, with a few own keys."""

import shutil
import subprocess
import sys

import pytest
from helpers.copy_workflow import PARTS, ROOT
from helpers.dry_runs import dry_run, jobs, outputs

pytestmark = pytest.mark.workflow

EXAMPLE = ROOT / "examples/module"
PAGE = "results/stickiness/draft/report/surfaces/my_wall.html"
HOSTED = "snakemake/snakemake/source-cache/snakemake-git-cache/github.com/someone/stickiness"


@pytest.fixture
def folder(tmp_path):
    """A folder with the configuration of the example."""
    shutil.copytree(EXAMPLE / "config", tmp_path / "config")
    return tmp_path


@pytest.fixture
def cache(tmp_path_factory):
    """Snakemake's cache with a clone of the project as it stands, which saves the network."""
    place = tmp_path_factory.mktemp("git")
    for part in (*PARTS, "scripts"):
        copy = shutil.copytree if (ROOT / part).is_dir() else shutil.copy2
        copy(ROOT / part, place / part)
    git = ["git", "-c", "user.name=test", "-c", "user.email=test"]
    for command in (["init", "-q"], ["add", "."], ["commit", "-qm", "all"], ["tag", "v1"]):
        subprocess.run([*git, *command], cwd=place, check=True)
    cache = tmp_path_factory.mktemp("cache")
    subprocess.run(["git", "clone", "-q", "--bare", place, cache / HOSTED], check=True)
    return cache


def test_example_runs_from_a_hosted_repository(folder, cache, monkeypatch):
    """Materials and surfaces of its own, one of them made by a rule of its own."""
    text = (EXAMPLE / "Snakefile").read_text(encoding="utf-8")
    text = text.replace(
        '"../../Snakefile"', 'github("someone/stickiness", path="Snakefile", tag="v1")'
    )
    monkeypatch.setenv("XDG_CACHE_HOME", str(cache))
    (folder / "workflow").mkdir()
    (folder / "workflow/Snakefile").write_text(text, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "snakemake", "-j2"],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout
    answers = (folder / "results/answer.txt").read_text(encoding="utf-8").splitlines()
    assert len(answers) == 2
    assert "firm tape" in answers[0] + answers[1]
    assert (folder / PAGE).stat().st_size > 100_000
    written = {path.name for path in folder.iterdir()} - {"workflow", "config"}
    assert written == {"data", "results", ".snakemake"}
    assert {path.name for path in (folder / "results").iterdir()} == {"stickiness", "answer.txt"}
    assert jobs(dry_run(folder)) == {}


def test_a_prefix_holds_for_results_alone(folder):
    text = (EXAMPLE / "Snakefile").read_text(encoding="utf-8")
    text = text.replace('"../../Snakefile"', f'"{ROOT}/Snakefile"\n    prefix:\n        "deep"')
    (folder / "Snakefile").write_text(text, encoding="utf-8")
    (folder / "data").mkdir()
    (folder / "data/wall.txt").write_text("not read in a dry-run", encoding="utf-8")
    rules = ("analyse_surface", "judge_surface", "write_surface")
    assert jobs(dry_run(folder, f"deep/{PAGE}")) == {f"stickiness_{rule}": 1 for rule in rules}


def test_what_is_solved_is_found_below_a_prefix(folder):
    text = (EXAMPLE / "Snakefile").read_text(encoding="utf-8")
    text = text.replace('"../../Snakefile"', f'"{ROOT}/Snakefile"\n    prefix:\n        "deep"')
    (folder / "Snakefile").write_text(text, encoding="utf-8")
    surfaces = folder / "deep/results/stickiness/draft/surfaces/H0.7_zeta64@4"
    surfaces.mkdir(parents=True)
    (surfaces / "seeds1-1.nc").touch()  # a dry-run does not read it
    answer = "deep/results/stickiness/draft/cases/H0.7_zeta64.nc"
    planned = outputs(dry_run(folder, answer))
    assert planned["stickiness_synthesise_surface"] == {
        "stickiness/draft/surfaces/H0.7_zeta64@4/seeds2-3.nc"
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
    assert line.startswith("config of module stickiness: sedes: ")


def test_the_snakefile_itself_may_come_from_a_git_host(tmp_path, cache, monkeypatch):
    """It is then no module: its rules have no prefix, and files are those of the clone."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(cache))
    page = "results/standard/report/surfaces/asphalt.html"
    done = dry_run(tmp_path, "-s", "gh:someone/stickiness@v1:Snakefile", page)
    assert jobs(done) == {"analyse_surface": 1, "judge_surface": 1, "write_surface": 1}


def test_from_any_folder(tmp_path):
    """No configuration of its own at all."""
    page = "results/standard/report/surfaces/asphalt.html"
    planned = jobs(dry_run(tmp_path, "-s", ROOT / "Snakefile", page))
    assert planned == {"analyse_surface": 1, "judge_surface": 1, "write_surface": 1}
