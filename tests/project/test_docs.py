"""Links and paths in the documentation exist, versions agree, and the example runs."""

import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import yaml

import stickiness

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "config/README.md"]
PAGES += sorted(ROOT.glob("docs/**/*.md"))


def anchors(page):
    headings = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.M)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)\s]+)\)", page.read_text(encoding="utf-8")):
        if not target.startswith(("https://", "http://")):
            file, _, anchor = target.partition("#")
            place = page.parent / file if file else page
            assert place.exists(), target
            assert not anchor or anchor in anchors(place), target


def test_paths_in_the_map_exist():
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    paths = re.findall(r"`((?:scripts|rules|report|config|docs|tests)/[\w./]+)`", text)
    assert len(paths) > 10
    assert [path for path in paths if not (ROOT / path).exists()] == []


def test_places_of_the_version_agree():
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text())["version"]
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert stickiness.__version__ == project["version"] == cited


def test_the_example_for_dem_gives_less_work_than_that_of_smooth_balls():
    done = subprocess.run(
        [sys.executable, ROOT / "examples/rough_ball.py"],
        env=os.environ | {"PYTHONPATH": str(ROOT / "scripts"), "OMP_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        check=True,
    )
    value, low, high = map(float, re.findall(r"[\d.]+", done.stdout.partition("limits:")[2]))
    assert low <= value < high
    assert 35 < value < 70  # of 70 mJ/m^2


@pytest.mark.slow
def test_the_example_of_the_library_runs(tmp_path):
    done = subprocess.run(
        [sys.executable, ROOT / "examples/library.py"],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(ROOT / "scripts"), "OMP_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    found = dict(line.split(" = ", 1) for line in done.stdout.splitlines() if " = " in line)
    area, theory = (float(found[name].split()[0]) for name in ("contact area", "predicted area"))
    assert area == pytest.approx(theory, rel=0.3)


@pytest.mark.parametrize("page", sorted(ROOT.glob("docs/example/*.html")), ids=lambda p: p.name)
def test_examples_hold_no_path_of_a_machine(page):
    text = page.read_text(encoding="utf-8")
    for folder in ("home", "root", "tmp", "work", "Users", "mnt", "opt", "srv", "var"):
        assert re.findall(rf"(?<![\w.:/])/{folder}/[\w./-]{{1,80}}", text) == []
