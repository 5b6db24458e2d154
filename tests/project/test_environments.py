"""Every environment names what the code imports, no more, and in the same versions."""

import ast
import importlib.metadata
import re
import sys
import tomllib
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[2]
ENVS = ROOT / "envs"
CONDA_NAMES = {"matplotlib": "matplotlib-base", "snakemake": "snakemake-minimal"}
# Needed without being imported: the engine behind xarray's files, and `snakemake --report`.
NEVER_IMPORTED = {"netcdf4", "pygments"}
OUR_OWN = {path.name for folder in ("scripts", "tests") for path in (ROOT / folder).glob("*/")}


def normalise(name):
    return re.sub(r"[-_.]+", "-", name).lower()


def pip_pins(name):
    lines = (ENVS / name).read_text(encoding="utf-8").splitlines()
    pins = (line.split("==") for line in lines if "==" in line and not line.startswith("#"))
    return {normalise(package): version for package, version in pins}


def pyproject():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"]
    return {
        "library": {normalise(name) for name in project["dependencies"]},
        **{extra: {normalise(name) for name in names} for extra, names in extras.items()},
    }


def imported_by(*folders):
    """Distributions that the Python and Snakemake files below the folders import."""
    modules = set()
    for folder in folders:
        for path in (ROOT / folder).rglob("*.py"):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Import):
                    modules |= {alias.name for alias in node.names}
                elif isinstance(node, ast.ImportFrom) and not node.level:
                    modules.add(node.module)
        for path in (ROOT / folder).rglob("*.smk"):  # no Python that ast could parse
            text = path.read_text(encoding="utf-8")
            modules |= set(re.findall(r"^\s*(?:import|from) ([\w.]+)", text, re.MULTILINE))
    names = {module.split(".")[0] for module in modules} - sys.stdlib_module_names - OUR_OWN
    places = importlib.metadata.packages_distributions()
    return {normalise(places[name][0]) if name in places else normalise(name) for name in names}


def test_conda_and_pip_agree():
    conda = yaml.safe_load((ENVS / "environment.yaml").read_text(encoding="utf-8"))
    pins = dict(line.split("=", 1) for line in conda["dependencies"] if ">" not in line)
    pip = pip_pins("requirements.txt")
    assert {CONDA_NAMES.get(package, package) for package in pip} == pins.keys()
    for package, version in pip.items():
        release = re.sub(r"\.post\d+$", "", version)  # a rebuilt wheel, the same sources
        assert release.startswith(pins[CONDA_NAMES.get(package, package)])


def test_pixi_names_the_versions_of_conda_and_of_the_tests():
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    pixi = tomllib.loads(text)["tool"]["pixi"]
    conda = yaml.safe_load((ENVS / "environment.yaml").read_text(encoding="utf-8"))
    python, *pinned = conda["dependencies"]
    pins = dict(line.split("=") for line in pinned)
    named = {
        package: version.removesuffix(".*") for package, version in pixi["dependencies"].items()
    }
    assert named.pop("python") == python.removeprefix("python")
    assert named == pins
    assert pixi["workspace"]["channels"] == [
        channel for channel in conda["channels"] if channel != "nodefaults"
    ]
    tested = pixi["feature"]["test"]["pypi-dependencies"]
    assert {package: version.removeprefix("==") for package, version in tested.items()} == pip_pins(
        "dev.txt"
    )
    assert {"reproduce", "draft", "dag"} == pixi["tasks"].keys()


def test_container_is_made_of_the_pins():
    text = (ENVS / "Containerfile").read_text(encoding="utf-8")
    (python,) = re.findall(r"^FROM python:(\d+\.\d+)-slim-\w+$", text, re.M)
    assert tuple(map(int, python.split("."))) >= (3, 11)
    (installed,) = re.findall(r"^RUN pip install (.*)$", text, re.M)
    assert "-c envs/constraints.txt -r envs/requirements.txt" in installed
    for line in re.findall(r"^COPY (.*)$", text, re.M):
        for source in line.split()[:-1]:
            assert (ROOT / source).exists(), source


@pytest.mark.parametrize(
    "name", ["requirements.txt", "dev.txt", "docs.txt", "slurm.txt", "progress.txt"]
)
def test_constraints_agree(name):
    constraints = pip_pins("constraints.txt")
    for package, version in pip_pins(name).items():
        assert constraints[package] == version


@pytest.mark.parametrize(
    ("name", "package"),
    [
        ("instruments.txt", "surfacetopography"),
        ("progress.txt", "snakemake-logger-plugin-rich"),
    ],
)
def test_options_are_pinned_and_no_requirement(name, package):
    optional = pip_pins(name)
    assert package in optional
    assert optional.keys().isdisjoint(pip_pins("requirements.txt"))


@pytest.mark.slow
def test_requirements_are_what_the_pipeline_imports():
    imported = imported_by("scripts", "rules") - pip_pins("instruments.txt").keys()
    assert imported | NEVER_IMPORTED == pip_pins("requirements.txt").keys()
    assert imported.isdisjoint(NEVER_IMPORTED)


def test_pyproject_names_the_requirements():
    named = pyproject()
    assert named["library"] | named["workflow"] == pip_pins("requirements.txt").keys()
    assert named["library"].isdisjoint(named["workflow"])
    assert named["instruments"] == pip_pins("instruments.txt").keys()
    assert named["progress"] == pip_pins("progress.txt").keys()


def test_the_library_depends_on_what_it_imports_alone():
    imported = imported_by("scripts/stickiness") - pip_pins("instruments.txt").keys()
    assert imported | {"netcdf4"} == pyproject()["library"]


@pytest.mark.slow
def test_tests_import_nothing_that_no_environment_names():
    files = ("requirements.txt", "dev.txt", "docs.txt", "peers.txt", "instruments.txt")
    named = {package for name in files for package in pip_pins(name)}
    assert imported_by("tests") <= named
