"""Versions agree: of the tools, whoever starts them, and of the project."""

import re
import tomllib
from pathlib import Path

import yaml

import stickiness

ROOT = Path(__file__).parents[2]
PINS = dict(re.findall(r"^([\w-]+)==(.+)$", (ROOT / "envs/dev.txt").read_text(), re.M))


def test_hooks_have_the_versions_of_the_environment():
    hooks = yaml.safe_load((ROOT / ".pre-commit-config.yaml").read_text())["repos"]
    found = {Path(one["repo"]).name.removesuffix("-pre-commit"): one["rev"] for one in hooks}
    pinned = {name: f"v{PINS[name]}" for name in ("codespell", "ruff", "snakefmt")}
    assert found.items() >= pinned.items()


def test_places_of_the_version_agree():
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text())["version"]
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert stickiness.__version__ == project["version"] == cited
    assert f"## {cited} - " in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")


def test_the_group_for_development_names_what_is_pinned():
    groups = tomllib.loads((ROOT / "pyproject.toml").read_text())["dependency-groups"]
    assert groups["dev"] == [*PINS]
