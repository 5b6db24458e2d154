"""Tools have one version, whoever starts them."""

import re
import tomllib
from pathlib import Path

import yaml

ROOT = Path(__file__).parents[2]
PINS = dict(re.findall(r"^([\w-]+)==(.+)$", (ROOT / "envs/dev.txt").read_text(), re.M))


def test_hooks_have_the_versions_of_the_environment():
    hooks = yaml.safe_load((ROOT / ".pre-commit-config.yaml").read_text())["repos"]
    found = {Path(one["repo"]).name.removesuffix("-pre-commit"): one["rev"] for one in hooks}
    assert found.pop("pre-commit-hooks")
    assert found == {name: f"v{PINS[name]}" for name in ("codespell", "ruff", "snakefmt")}


def test_the_group_for_development_names_what_is_pinned():
    groups = tomllib.loads((ROOT / "pyproject.toml").read_text())["dependency-groups"]
    assert groups["dev"] == [*PINS]
