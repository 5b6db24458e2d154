"""The pip and conda environments name the same versions."""

import re
from pathlib import Path

import pytest
import yaml

ENVS = Path(__file__).parents[2] / "envs"
CONDA_NAMES = {"matplotlib": "matplotlib-base", "snakemake": "snakemake-minimal"}


def pip_pins(name):
    lines = (ENVS / name).read_text(encoding="utf-8").splitlines()
    pins = (line.split("==") for line in lines if "==" in line and not line.startswith("#"))
    return {package.lower(): version for package, version in pins}


def test_conda_and_pip_agree():
    conda = yaml.safe_load((ENVS / "environment.yaml").read_text(encoding="utf-8"))
    pins = dict(line.split("=", 1) for line in conda["dependencies"] if ">" not in line)
    pip = pip_pins("requirements.txt")
    assert {CONDA_NAMES.get(package, package) for package in pip} == pins.keys()
    for package, version in pip.items():
        release = re.sub(r"\.post\d+$", "", version)  # a rebuilt wheel, the same sources
        assert release.startswith(pins[CONDA_NAMES.get(package, package)])


@pytest.mark.parametrize("name", ["requirements.txt", "dev.txt", "slurm.txt"])
def test_constraints_agree(name):
    constraints = pip_pins("constraints.txt")
    for package, version in pip_pins(name).items():
        assert constraints[package] == version


def test_instruments_are_optional_and_pinned():
    optional = pip_pins("instruments.txt")
    assert "surfacetopography" in optional
    assert optional.keys().isdisjoint(pip_pins("requirements.txt"))
