"""What installs the project: metadata of the wheel, environments, the container, CI."""

import importlib
import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.version import Version

import stickiness

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
CONDA_NAMES = {"matplotlib-base": "matplotlib", "snakemake-minimal": "snakemake"}


def read_tested():
    """Tested versions by name, in lower case."""
    lines = (ROOT / "envs/requirements.txt").read_text(encoding="utf-8").splitlines()
    pairs = [line.split("==") for line in lines if "==" in line and not line.startswith("#")]
    return {name.lower(): Version(version) for name, version in pairs}


def test_every_dependency_has_a_lower_bound_that_the_tested_version_meets():
    tested = read_tested()
    listed = [*PROJECT["dependencies"], *PROJECT["optional-dependencies"]["workflow"]]
    requirements = [Requirement(text) for text in listed]
    assert {requirement.name.lower() for requirement in requirements} == tested.keys()
    for requirement in requirements:
        assert [bound.operator for bound in requirement.specifier] == [">="], requirement.name
        assert tested[requirement.name.lower()] in requirement.specifier, requirement.name


def test_metadata_name_the_authors_and_the_script_is_there():
    authors = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))["authors"]
    assert PROJECT["authors"] == authors
    module, _, function = PROJECT["scripts"]["stickiness"].partition(":")
    assert callable(getattr(importlib.import_module(module), function))


def test_nothing_is_left_to_be_filled_in():
    files = [ROOT / "pyproject.toml", ROOT / "paper.md", ROOT / "CITATION.cff"]
    files += [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")]
    for file in files:
        left = re.findall(r"PLACEHOLDER|OWNER|TODO|to be added", file.read_text(encoding="utf-8"))
        assert left == [], file


def test_pages_name_the_version_that_they_come_with():
    pages = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "examples/module/Snakefile"]
    pages += [*ROOT.glob("docs/**/*.md")]
    named = [
        re.findall(r"(?<!/)\bv(\d+\.\d+\.\d+)\b", page.read_text(encoding="utf-8"))
        for page in pages
    ]
    versions = sum(named, [])
    assert len(versions) >= 3
    assert {*versions} == {stickiness.__version__}


def test_the_environment_of_conda_has_the_tested_versions():
    content = yaml.safe_load((ROOT / "envs/environment.yaml").read_text(encoding="utf-8"))
    lines = [line for line in content["dependencies"] if isinstance(line, str)]
    (pip,) = [line["pip"] for line in content["dependencies"] if isinstance(line, dict)]
    pinned = dict(re.split("=+", line) for line in [*lines, *pip] if re.search("[^<>]=", line))
    pinned = {CONDA_NAMES.get(name, name).lower(): text for name, text in pinned.items()}
    tested = read_tested()
    assert pinned.keys() == tested.keys()
    # Builds of a release have a version of their own on the package index alone.
    for name, text in pinned.items():
        assert tested[name].release[: len(text.split("."))] == Version(text).release, name


def test_ci_covers_every_python_that_metadata_names_and_macos():
    jobs = yaml.safe_load((ROOT / ".github/workflows/ci.yaml").read_text(encoding="utf-8"))["jobs"]
    matrix = jobs["test"]["strategy"]["matrix"]
    named = [line.rpartition(" ")[2] for line in PROJECT["classifiers"] if ":: 3." in line]
    assert named == matrix["python"]
    assert "macos" in str(matrix["include"])


@pytest.fixture
def image(tmp_path):
    """What the steps of the container make, without installing: its folder and its last words."""
    folder, words = tmp_path / "opt", {}
    text = (ROOT / "envs/Containerfile").read_text(encoding="utf-8").replace("\\\n", "")
    for line in text.splitlines():
        step, _, rest = line.partition(" ")
        if step == "COPY":
            *sources, target = rest.split()
            for source in sources:
                # A folder gives its content, a file goes by its name.
                place = folder / target
                if (ROOT / source).is_dir():
                    shutil.copytree(
                        ROOT / source, place, ignore=shutil.ignore_patterns("__pycache__")
                    )
                else:
                    place.mkdir(parents=True, exist_ok=True)
                    shutil.copy(ROOT / source, place)
        if step == "RUN" and rest.startswith("pip install"):
            read = re.findall(r"-[rc] (\S+)", rest)
            assert all((folder / file).is_file() for file in read), rest
            if "--editable ." in rest:
                project = tomllib.loads((folder / "pyproject.toml").read_text())["project"]
                for file in ("setup.py", "README.md", *project["license-files"]):
                    assert (folder / file).is_file()
                words["package"] = folder / "scripts"
        if step in ("ENTRYPOINT", "WORKDIR"):
            words[step] = rest
    return folder, words


@pytest.mark.workflow
def test_the_container_runs_the_workflow_and_the_command(image, tmp_path):
    folder, words = image
    work = tmp_path / "work"
    shutil.copytree(ROOT / "config", work / "config")
    environment = os.environ | {"PYTHONPATH": str(words["package"])}
    python = [sys.executable, "-m"]

    entry = yaml.safe_load(words["ENTRYPOINT"].replace("/opt/stickiness", str(folder)))
    dry = [*python, *entry, "-n", "-j2", "surfaces"]
    done = subprocess.run(dry, cwd=work, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "write_surface" in done.stdout + done.stderr

    (script,) = PROJECT["scripts"]
    command = [*python, script, *shlex.split("--version")]
    done = subprocess.run(command, cwd=work, env=environment, capture_output=True, text=True)
    assert done.stdout.startswith(f"stickiness {stickiness.__version__} ")
    where = f"import {script}; print({script}.__file__)"
    command = [sys.executable, "-c", where]
    done = subprocess.run(command, cwd=work, env=environment, capture_output=True, text=True)
    assert Path(done.stdout.strip()).parents[2] == folder
    assert (folder / "Snakefile").is_file()
