"""What pages tell a user to write is valid: YAML, commands and Python."""

import os
import re
import runpy
import shlex
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest
import yaml
from helpers.dry_runs import dry_run, jobs
from snakemake.cli import get_argument_parser
from snakemake.utils import update_config

from common.config import load
from common.config.models import MODELS

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / name for name in ("README.md", "CONTRIBUTING.md", "config/README.md")]
PAGES += sorted(ROOT.glob("docs/**/*.md"))
COMMANDS = ("python -m stickiness", "stickiness", "snakemake")
#: Options that pages name without their command: of docker, and of Snakemake's plugin for Slurm.
OTHERS = {"--entrypoint", "--slurm-status-command", "--slurm-no-account"}


def name_page(page):
    return str(page.relative_to(ROOT))


def read_blocks(page, language):
    """Blocks of code of a page in a language, or in none."""
    text = page.read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.S | re.M)


def read_code(page):
    """Lines of commands, and what stands between backquotes in the prose."""
    lines = "".join(read_blocks(page, "")).replace("\\\n", "").splitlines()
    prose = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.S | re.M)
    return [*lines, *re.findall(r"(?<!`)`([^`]+)`(?!`)", prose)]


def split_command(code):
    """Return which of `COMMANDS` the code is, and its arguments; None of other code."""
    for command in COMMANDS:
        if re.match(rf"{command}(?= [-a-z/])", code):
            return command, shlex.split(code.removeprefix(command), comments=True)
    return None


@cache
def find_options():
    """Options of the command and of Snakemake."""
    told = subprocess.run(
        [sys.executable, "-m", "stickiness", "--help"],
        env=os.environ | {"PYTHONPATH": str(ROOT / "scripts")},
        capture_output=True,
        text=True,
        check=True,
    )
    of_command = {*re.findall(r"--[a-z-]+", told.stdout)}
    of_snakemake = {
        option for action in get_argument_parser()._actions for option in action.option_strings
    }
    return {
        "python -m stickiness": of_command,
        "stickiness": of_command,
        "snakemake": of_snakemake | OTHERS,
    }


@pytest.fixture(scope="module")
def rules(tmp_path_factory):
    """Names of all rules, targets among them."""
    done = dry_run(tmp_path_factory.mktemp("rules"), "-s", ROOT / "Snakefile", "--list-rules")
    assert done.returncode == 0, done.stdout
    return {*done.stdout.split()}


def check_yaml(blocks):
    """Check each block as the file of the configuration that it is an excerpt of."""
    contents = [yaml.safe_load(block) for block in blocks]
    # Materials may name the surfaces of another block.
    surfaces = load.load(ROOT / "config/surfaces.yaml")["surfaces"]
    for content in contents:
        if isinstance(content.get("surfaces"), dict):
            surfaces.update(content["surfaces"])
    for block, content in zip(blocks, contents, strict=True):
        tables = [table for table in load.TABLES if isinstance(content.get(table), dict)]
        if tables:
            load.check(MODELS[tables[0]], content, block, surfaces=surfaces, made=True)
        else:
            config = load.defaults(ROOT)
            update_config(config, content)
            load.check(MODELS["config"], config, block)


def check_command(code, rules, folder):
    """Check the options of a command, and the targets of Snakemake."""
    command, words = split_command(code)
    options = {word.partition("=")[0] for word in words if word.startswith("--")} - {"--"}
    assert options <= find_options()[command], code
    if command == "snakemake" and not options & OTHERS:
        for target in get_argument_parser().parse_args(words).targets:
            if target.startswith("results/"):
                # Surfaces of the reader are not in the configuration.
                assert "my_" in target or jobs(dry_run(folder, "-s", ROOT / "Snakefile", target))
            else:
                assert target in rules, code


@pytest.mark.workflow
@pytest.mark.parametrize("page", PAGES, ids=name_page)
def test_yaml_and_commands_of_a_page_are_valid(page, rules, tmp_path):
    check_yaml(read_blocks(page, "yaml"))
    for code in read_code(page):
        if split_command(code):
            check_command(code, rules, tmp_path)
        elif code.startswith("--"):
            options = {*re.findall(r"(?<!\S)--[a-z-]+", code)}
            assert options <= set.union(*find_options().values()), code


GUIDES = [page for page in PAGES if ROOT / "docs" in page.parents and read_blocks(page, "python")]


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::stickiness.plausibility.PlausibilityWarning")
@pytest.mark.parametrize("page", GUIDES, ids=name_page)
def test_python_of_a_guide_runs(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for block in read_blocks(page, "python"):
        Path("block.py").write_text(block, encoding="utf-8")
        runpy.run_path("block.py")
