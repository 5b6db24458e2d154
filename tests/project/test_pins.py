"""Versions agree: of the tools, whoever starts them, and of the project."""

import re
import tomllib
from pathlib import Path

import yaml

import stickiness

ROOT = Path(__file__).parents[2]
PINS = dict(re.findall(r"^([\w-]+)==(.+)$", (ROOT / "envs/dev.txt").read_text(), re.M))
TABLES = tomllib.loads((ROOT / "pyproject.toml").read_text())


def test_tools_have_one_version():
    hooks = yaml.safe_load((ROOT / ".pre-commit-config.yaml").read_text())["repos"]
    found = {Path(one["repo"]).name.removesuffix("-pre-commit"): one["rev"] for one in hooks}
    for tool in ("codespell", "ruff", "snakefmt"):
        assert found[tool] == f"v{PINS[tool]}"
    assert TABLES["dependency-groups"]["dev"] == [*PINS]


def test_places_of_the_version_agree():
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text())["version"]
    assert stickiness.__version__ == TABLES["project"]["version"] == cited
