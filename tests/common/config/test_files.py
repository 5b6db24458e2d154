import copy
from pathlib import Path

import pytest

from common.config import checks
from common.config.files import locate_files

ROOT = Path(__file__).parents[3]


def strings(value):
    """All texts in a configuration."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return [text for inner in value for text in strings(inner)]
    return [value] if isinstance(value, str) else []


def test_every_file_of_the_project_is_located_and_nothing_else():
    config = checks.load(ROOT / "config/config.yaml")
    before = copy.deepcopy(config)
    located = locate_files(config, lambda path: f"/project/{path}")
    assert config == before
    files = {text for text in strings(config) if text.startswith("config/")}
    assert all((ROOT / path).is_file() for path in files)
    changed = {text for text in strings(located) if text.startswith("/project/")}
    assert changed == {f"/project/{path}" for path in files}
    assert set(strings(located)) - changed == set(strings(config)) - files


def test_a_file_that_another_workflow_makes_may_be_missing():
    surfaces = {"mine": {"kind": "measured", "file": "not/there.txt"}}
    checks.check_surfaces(surfaces, made=True)
    with pytest.raises(checks.ConfigError, match=r"mine\.file = 'not/there.txt': no such file"):
        checks.check_surfaces(surfaces)
